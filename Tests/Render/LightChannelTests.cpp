// Channels: lights light objects that share a bit with them, in the reference, in direct lighting, in signals and at hits of rays.
#include "SignalFixture.h"

namespace Lantern
{

namespace
{
constexpr uint8_t First = 1, Second = 2;

class FLightChannelTest : public FSignalTest
{
protected:
	/// Two plates side by side, and a wall between them that both see.
	void LoadPlates(uint8_t Left, uint8_t Right)
	{
		FTestScene Out("channels");
		const int32_t Grey = Out.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		const int32_t LeftNode = Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Grey, 1.0f, 0.0f, {-1, 0})}));
		const int32_t RightNode =
		    Out.AddNode(Out.AddMesh({{Grey, {{0.01f, 0.01f, 1}, {0.01f, 0.01f, -1}, {1.5f, 1.2f, -1}, {1.5f, 1.2f, 1}}}})); // it leans
		Out.Scene.Nodes[static_cast<size_t>(LeftNode)].Traits.Channels = Left;
		Out.Scene.Nodes[static_cast<size_t>(RightNode)].Traits.Channels = Right;
		ASSERT_TRUE(Load(std::move(Out.Scene)));
		SetSky({});
		SetSun(0.0, 0.0f);
		Lamps.clear();
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	void AddLamps(uint32_t Count, uint8_t Channels)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			FSceneLight Light;
			Light.Position = {-1.2 + 0.1 * I, 1.5, 0.3 - 0.05 * I};
			Light.Color = glm::vec3(2);
			Light.Channels = Channels;
			Lamps.push_back(GetWorld().AddLight(Light));
		}
	}
	static FView See(bool bLeft)
	{
		return bLeft ? LookAt({-0.7, 0.4, 2.0}, {-0.7, 0, 0}, 0.05f, 16, 16) : LookAt({0.0, 1.5, 1.0}, {0.7, 0.56, 0}, 0.05f, 16, 16);
	}
	/// Returns whether the plate is lit. All pixels must agree.
	static bool IsLit(const FImage& Picture)
	{
		uint32_t Lit = 0;
		const size_t Pixels = Picture.Pixels.size() / Picture.Channels;
		for (size_t I = 0; I < Pixels; ++I) { Lit += Picture.Pixels[I * Picture.Channels + 1] > 0.0f ? 1 : 0; }
		EXPECT_TRUE(Lit == 0 || Lit == Pixels) << Lit << " of " << Pixels;
		return Lit > 0;
	}
	void ExpectLit(const std::string& What, bool bLeft, bool bExpected)
	{
		const FView View = See(bLeft);
		EXPECT_EQ(IsLit(TraceReference(View, 4, 1)), bExpected) << What << ", reference";
		EXPECT_EQ(IsLit(RenderLighting(View)), bExpected) << What << ", lighting";
		EXPECT_EQ(IsLit(RenderSignal(ESignal::LocalDiffuse, View)), bExpected) << What << ", signal";
		EXPECT_EQ(IsLit(TraceSignal(ESignal::LocalDiffuse, View, 4, 1)), bExpected) << What << ", the signal's reference";
	}

	std::vector<FLightId> Lamps;
};

TEST_F(FLightChannelTest, LampsLightWhatSharesAChannel)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(First, Second));
	for (const uint32_t Count : {1u, 12u})
	{
		for (const uint8_t Channels : {First, Second, uint8_t(First | Second), uint8_t(128)})
		{
			AddLamps(Count, Channels);
			const std::string What = fmt::format("{} lamps of channels {}", Count, Channels);
			ExpectLit(What + ", left", true, (Channels & First) != 0);
			ExpectLit(What + ", right", false, (Channels & Second) != 0);
			for (const FLightId Id : std::exchange(Lamps, {})) { GetWorld().RemoveLight(Id); }
		}
	}
	// With the fault planted, all lamps light all.
	AddLamps(1, Second);
	SetVariable("r.RT.Debug.Lights.Channels", "0");
	ExpectLit("the planted fault", true, true);
}

// Objects change their channels, and all pixels know in the next frame.
TEST_F(FLightChannelTest, ObjectsChangeTheirChannels)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(First, First));
	AddLamps(1, First);
	ExpectLit("as they are by default", true, true);
	const FRTObjectId Left = GetScene().GetDraws()[0].Object;
	GetWorld().SetChannels(Left, Second);
	ExpectLit("another channel", true, false);
	FReferenceSettings Raster;
	Raster.View = See(true);
	Raster.Signal = ESignal::LocalDiffuse;
	Raster.Samples = 4;
	Raster.Bounces = 1;
	Raster.bPixelCenters = Raster.bRasterSurfaces = true;
	EXPECT_FALSE(IsLit(TraceReference(Raster))) << "the reference at surfaces of the raster";
	ExpectLit("the other plate", false, true);
	GetWorld().SetChannels(Left, Second | First);
	ExpectLit("all channels", true, true);
}

TEST_F(FLightChannelTest, TheSunHasChannels)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(First, Second));
	for (const float Diameter : {0.0f, 0.1f})
	{
		FSunLight Sun;
		Sun.Direction = {0.2, -1, 0};
		Sun.Irradiance = 4.0f;
		Sun.AngularDiameter = Diameter;
		Sun.Channels = Second;
		GetScene().SetSun(Sun);
		for (const bool bLeft : {true, false})
		{
			EXPECT_EQ(IsLit(RenderLighting(See(bLeft))), !bLeft);
			EXPECT_EQ(IsLit(TraceReference(See(bLeft), 4, 1)), !bLeft);
		}
	}
}

// A plate that the lamp does not light receives what the other one reflects, unless that is dark as well.
TEST_F(FLightChannelTest, HitsKnowTheirObject)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(Second, First));
	SetIndirect(4, 1);
	AddLamps(1, First);
	const FRTObjectId Right = GetScene().GetDraws()[1].Object;
	const auto Measure = [&] {
		return glm::dvec2(MeanGreen(TraceReference(See(true), 256, 2)), MeanGreen(RenderSignal(ESignal::DiffuseGI, See(true))));
	};
	const glm::dvec2 Lit = Measure();
	EXPECT_GT(Lit.x, 0.0);
	EXPECT_GT(Lit.y, 0.0);
	GetWorld().SetChannels(Right, Second);
	EXPECT_EQ(Measure(), glm::dvec2(0));
	SetVariable("r.RT.Debug.Lights.Channels", "0");
	EXPECT_GT(Measure().y, 0.0) << "the planted fault goes unnoticed";
}

} // namespace
} // namespace Lantern
