// Guided paths of diffuse GI: the mean stays, and noise falls where light comes from few places.
#include <cmath>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
constexpr uint32_t LearningFrames = 16;

class FPathGuideTest : public FSignalTest
{
protected:
	/// A closed room with a hole of a metre in its roof, through which the sun lights a spot on the floor. The sun is alone.
	[[nodiscard]] bool LoadRoom()
	{
		FTestScene Scene("room");
		const int32_t Grey = Scene.AddLambert(glm::vec3(0.6f));
		constexpr float Half = 5.0f, Height = 3.0f, Hole = 0.5f;
		std::vector<FTestScene::FQuad> Quads{FTestScene::MakeFloor(Grey, Half)};
		const auto AddRoof = [&](float X0, float X1, float Z0, float Z1) {
			Quads.push_back({Grey, {{X0, Height, Z0}, {X1, Height, Z0}, {X1, Height, Z1}, {X0, Height, Z1}}});
		};
		AddRoof(-Half, Half, -Half, -Hole);
		AddRoof(-Half, Half, Hole, Half);
		AddRoof(-Half, -Hole, -Hole, Hole);
		AddRoof(Hole, Half, -Hole, Hole);
		const glm::vec2 Corners[] = {{-Half, -Half}, {Half, -Half}, {Half, Half}, {-Half, Half}};
		for (size_t I = 0; I < 4; ++I)
		{
			const glm::vec2 A = Corners[I], B = Corners[(I + 1) % 4];
			Quads.push_back({Grey, {{B.x, 0, B.y}, {A.x, 0, A.y}, {A.x, Height, A.y}, {B.x, Height, B.y}}});
		}
		Scene.AddNode(Scene.AddMesh(Quads));
		if (!Load(std::move(Scene.Scene))) { return false; }
		SetSun(0.0, 10.0f, {0.05, -1, 0.03});
		SetIndirect(1, 1);
		SetVariable("r.RT.Reflections", "0");
		SetVariable("r.RT.GI.Guide", "1");
		return true;
	}
	static FView See(uint32_t Width, uint32_t Height) { return LookAt({-3, 1.6, 3.5}, {0.5, 1.2, -5}, 1.0f, Width, Height); }

	/// Relative variance of a pixel's mean over the four frames that follow LearningFrames.
	double MeasureNoise(bool bGuided, FView View)
	{
		SetVariable("r.RT.GI.Guide", bGuided ? "1" : "0");
		FImage Pictures[2];
		for (uint32_t I = 0; I < 2; ++I)
		{
			View.Seed = 7 + I;
			RenderSignal(ESignal::DiffuseGI, View, LearningFrames); // what the next frames follow
			Pictures[I] = RenderSignal(ESignal::DiffuseGI, View, 4, LearningFrames);
		}
		double Squares = 0.0, Sum = 0.0;
		for (size_t I = 0; I < Pictures[0].Pixels.size(); I += Pictures[0].Channels)
		{
			const double A = double(Pictures[0].Pixels[I + 1]), B = double(Pictures[1].Pixels[I + 1]);
			Squares += 0.5 * (A - B) * (A - B);
			Sum += 0.5 * (A + B);
		}
		const double Count = double(Pictures[0].GetPixelCount()), Mean = Sum / Count;
		return Squares / Count / (Mean * Mean);
	}
};

TEST_F(FPathGuideTest, RoomAsTheReference)
{
	ASSERT_TRUE(LoadRoom());
	SetIndirect(8, 1);
	SetVariable("r.RT.Reflections", "0");
	ExpectUnbiased("guided room", ESignal::DiffuseGI, See(64, 48), LearningFrames, 768, 2, 0.02);
}

// The planted fault: what the guide draws counts as if the cosine had.
TEST_F(FPathGuideTest, WithoutItsPdfTheMeanIsWrong)
{
	ASSERT_TRUE(LoadRoom());
	const FEstimate Right = EstimateFrames(ESignal::DiffuseGI, See(64, 48), LearningFrames);
	SetVariable("r.RT.Debug.GI.MixturePdf", "0");
	const FEstimate Wrong = EstimateFrames(ESignal::DiffuseGI, See(64, 48), LearningFrames);
	EXPECT_GT(Wrong.Mean, 1.5 * Right.Mean);
}

TEST_F(FPathGuideTest, SavesNoiseWhereLightComesFromOneSpot)
{
	ASSERT_TRUE(LoadRoom());
	const FView View = See(256, 192); // tiles are small against the distance to the spot
	const double Plain = MeasureNoise(false, View), Guided = MeasureNoise(true, View);
	RecordProperty("variance_ratio", std::to_string(Guided / Plain));
	EXPECT_LT(Guided, 0.5 * Plain);
}

// Under a sky of one value the cosine is all there is to know.
TEST_F(FPathGuideTest, CostsNoNoiseUnderAnEvenSky)
{
	FTestScene Scene("open");
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 50.0f)}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSky(glm::vec3(1));
	SetIndirect(1, 1);
	EXPECT_LT(MeasureNoise(true, See(64, 48)), 1e-6); // of halves
}

} // namespace
} // namespace Lantern
