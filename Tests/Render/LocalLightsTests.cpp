// Shadowed local lights against the reference, in tiles of few and of many lights; queues without room; numbers that break others.
#include <cmath>

#include "LanternImage/ImageStatistics.h"
#include "LocalLightsFixture.h"

namespace Lantern
{

namespace
{
constexpr ESignal Lobes[] = {ESignal::LocalDiffuse, ESignal::LocalSpecular};

class FLocalLightsTest : public FLocalLightsFixture
{
protected:
	void SetUp() override
	{
		FLocalLightsFixture::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0"); // the filter weighs outliers less
	}
};

TEST_F(FLocalLightsTest, FewAndManyAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	const FView View = LookAtPosts(64, 36);
	for (const uint32_t Count : {1u, 4u, 8u, 64u})
	{
		const std::vector<FLightId> Ids = AddLamps(Count);
		for (const ESignal Lobe : Lobes)
		{
			const std::string Name = fmt::format("{} lights, {}", Count, GetSignalInfo(Lobe).Name);
			// Highlights of the few are the noisiest.
			const uint32_t Frames = Count <= 4 ? 32 : Count == 8 && Lobe == ESignal::LocalSpecular ? 512 : 256;
			ExpectUnbiased(Name.c_str(), Lobe, View, Frames, Count > 4 ? 768 : 128, 1, 0.005);
		}
		for (const FLightId Id : Ids) { GetWorld().RemoveLight(Id); }
	}
}

using FLocalLightsDeepTest = FLocalLightsTest;

// A tile weighs a random part of its lights if they are more than its table holds.
TEST_F(FLocalLightsDeepTest, MoreThanATableHoldsAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	const FView View = LookAtPosts(48, 27);
	AddLamps(1500);
	ExpectUnbiased("1,500 lights", ESignal::LocalDiffuse, View, 128, 384, 1, 0.005);
}

// Either way to choose a light: from all of them, and from the tile's with the light's own colour.
TEST_F(FLocalLightsTest, WalkAndUnbiasedAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	AddLamps(64);
	const FView View = LookAtPosts(64, 36);
	SetVariable("r.RT.Lights.Unbiased", "1");
	for (const char* const Candidates : {"0", "1", "8"})
	{
		SetVariable("r.RT.Lights.Candidates", Candidates);
		const std::string Name = fmt::format("{} candidates", Candidates);
		ExpectUnbiased(Name.c_str(), ESignal::LocalDiffuse, View, 256, 768, 1, 0.005);
	}
}

// A tile that weighs its lights at one place never chooses some of those that reach others.
TEST_F(FLocalLightsTest, TilesWeighForAllTheirPixels)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	AddLamps(16);
	const FView View = LookAtPosts(48, 27);
	const double Right = EstimateFrames(ESignal::LocalDiffuse, View, 8).Mean;
	SetVariable("r.RT.Debug.Lights.CellTarget", "0");
	EXPECT_LT(EstimateFrames(ESignal::LocalDiffuse, View, 8).Mean, 0.98 * Right);
}

// Pixels whose ray was blocked are black. Tiles that remember which lights are hidden waste fewer rays on them.
TEST_F(FLocalLightsTest, TilesRememberHiddenLights)
{
	FTestScene Scene("hidden");
	const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 8.0f, 0.0f)}));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 8.0f, 2.0f)})); // a ceiling
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	for (int I = 0; I < 16; ++I)
	{
		FSceneLight Light;
		Light.Position = {-1.5 + (I % 4), I < 12 ? 2.5 : 1.5, -0.5 * (I / 4)}; // twelve of them above the ceiling
		Light.Color = glm::vec3(1);
		GetWorld().AddLight(Light);
	}
	const FView View = LookAt({0, 1.8, 0.5}, {0, 0, -0.7}, 0.9f, 64, 36); // nothing but floor
	const auto CountBlocked = [&](const char* Seconds) {
		SetVariable("r.RT.Lights.GuideSeconds", Seconds);
		FImage Picture;
		for (uint32_t Frame = 0; Frame < 16; ++Frame) { Picture = RenderSignal(ESignal::LocalDiffuse, View, 1, Frame); }
		size_t Blocked = 0;
		for (size_t Pixel = 0; Pixel < 64u * 36u; ++Pixel) { Blocked += Picture.Pixels[Pixel * Picture.Channels + 1] <= 0.0f ? 1 : 0; }
		return Blocked;
	};
	const size_t Forgetful = CountBlocked("0"), Knowing = CountBlocked("0.5");
	PrintFigure(fmt::format("blocked rays: {} without memory, {} with it", Forgetful, Knowing));
	EXPECT_GT(Forgetful, 64u * 36u / 4);
	EXPECT_LT(2 * Knowing, Forgetful);
}

TEST_F(FLocalLightsTest, PathsAgree)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	SetVariable("r.RT.Lights.GuideSeconds", "0"); // frames depend on no others
	AddLamps(6);
	for (const char* const Exact : {"8", "1"})
	{
		SetVariable("r.RT.Lights.Exact", Exact);
		for (const ESignal Lobe : Lobes)
		{
			SetVariable("r.RT.Shadow.Path", "1");
			const FImage Pipeline = RenderSignal(Lobe, LookAtPosts(64, 36), 1, 3);
			SetVariable("r.RT.Shadow.Path", "2");
			const FImage Query = RenderSignal(Lobe, LookAtPosts(64, 36), 1, 3);
			EXPECT_GT(MeanGreen(Query), 0.0);
			EXPECT_EQ(Pipeline.Pixels, Query.Pixels) << GetSignalInfo(Lobe).Name << ", exact " << Exact;
		}
	}
}

// The composite holds either lobe once, and nothing of the light without shadows.
TEST_F(FLocalLightsTest, CompositeAsTheWholeFrame)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	AddLamps(4);
	const FView View = LookAtPosts(64, 36);
	std::vector<double> Ours, Theirs;
	for (uint32_t Batch = 0; Batch < 6; ++Batch)
	{
		FView Seeded = View;
		Seeded.Seed = 1 + Batch;
		Ours.push_back(ComputeMeans(RenderLighting(Seeded)).Luminance);
		FReferenceSettings Settings;
		Settings.View = Seeded;
		Settings.Samples = 96;
		Settings.Bounces = 1;
		Settings.bPixelCenters = true;
		Theirs.push_back(ComputeMeans(TraceReference(Settings)).Luminance);
	}
	ExpectClosedForm("composite of local lights over the reference", MakeEstimate(Ours), MakeEstimate(Theirs).Mean, 0.005);
	SetVariable("r.RT.Lights", "0");
	EXPECT_GT(ComputeMeans(RenderLighting(View)).Luminance, 1.05 * MakeEstimate(Theirs).Mean) << "there is a shadow to lose";
}

TEST_F(FLocalLightsTest, PlantedFaultIsSeen)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	AddLamps(16);
	const FView View = LookAtPosts(48, 27);
	const double Right = EstimateFrames(ESignal::LocalDiffuse, View, 8).Mean;
	SetVariable("r.RT.Debug.Lights.Weight", "0");
	EXPECT_LT(EstimateFrames(ESignal::LocalDiffuse, View, 8).Mean, 0.9 * Right);
}

TEST_F(FLocalLightsTest, LightsWithoutShadowsShineThroughPosts)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	const std::vector<FLightId> Ids = AddLamps(3);
	const FView View = LookAtPosts(64, 36);
	const double Shadowed = MeanGreen(RenderSignal(ESignal::LocalDiffuse, View));
	for (const FLightId Id : Ids)
	{
		FSceneLight Light = GetWorld().GetLights().Get(Id);
		Light.bCastsShadow = false;
		GetWorld().SetLight(Id, Light);
	}
	for (const char* const Exact : {"8", "1"})
	{
		SetVariable("r.RT.Lights.Exact", Exact);
		const FImage Composite = RenderLighting(View);
		SetVariable("r.RT.Lights", "0");
		const FImage Unshadowed = RenderLighting(View);
		SetVariable("r.RT.Lights", "1");
		// One light chosen of three is noise, whose mean over the picture is known to a few percent.
		const double Tolerance = *Exact == '8' ? 0.002 : 0.05;
		EXPECT_NEAR(MeanGreen(Composite) / MeanGreen(Unshadowed), 1.0, Tolerance) << Exact;
	}
	SetVariable("r.RT.Lights.Exact", "8");
	EXPECT_GT(MeanGreen(RenderSignal(ESignal::LocalDiffuse, View)), 1.02 * Shadowed);
}

// Either way to take shadows away makes one picture, and so does either renderer.
TEST_F(FLocalLightsTest, KindsOfLightsLoseTheirShadows)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	SetVariable("r.RT.Lights.Exact", "8"); // no guide: frames depend on no others
	const std::vector<FLightId> Ids = AddLamps(5);
	FSceneLight Panel = GetWorld().GetLights().Get(Ids[0]);
	Panel.Type = LIGHT_DISK;
	Panel.Size = {0.2, 0};
	Panel.Color *= 10.0f;
	GetWorld().SetLight(Ids[0], Panel);
	const FView View = LookAtPosts(64, 36);
	const auto Render = [&] { return RenderSignal(ESignal::LocalDiffuse, View, 1, 3).Pixels; };
	const auto Trace = [&] { return TraceSignal(ESignal::LocalDiffuse, View, 4, 1).Pixels; };
	const std::vector<float> Shadowed = Render();
	const std::pair<const char*, ELightKind> Kinds[] = {{"r.RT.Lights.Shadows.Point", ELightKind::Point},
	    {"r.RT.Lights.Shadows.Spot", ELightKind::Spot}, {"r.RT.Lights.Shadows.Rect", ELightKind::Rect}};
	for (const auto& [Variable, Kind] : Kinds)
	{
		SetVariable(Variable, "0");
		const std::vector<float> ByKind = Render(), ReferenceByKind = Trace();
		SetVariable(Variable, "1");
		std::vector<FSceneLight> Before;
		for (const FLightId Id : Ids)
		{
			FSceneLight Light = GetWorld().GetLights().Get(Id);
			Before.push_back(Light);
			Light.bCastsShadow = GetLightKind(Light) != Kind;
			GetWorld().SetLight(Id, Light);
		}
		EXPECT_EQ(ByKind, Render()) << Variable;
		EXPECT_EQ(ReferenceByKind, Trace()) << Variable;
		EXPECT_NE(ByKind, Shadowed) << Variable;
		for (size_t I = 0; I < Ids.size(); ++I) { GetWorld().SetLight(Ids[I], Before[I]); }
	}
	EXPECT_EQ(Render(), Shadowed);
}

// Rays without room take the mean of their tile's others. Which rays have room does not depend on the order of tiles.
TEST_F(FLocalLightsTest, QueueWithoutRoom)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	SetVariable("r.RT.Lights.GuideSeconds", "0"); // what rays had no room for would be remembered
	AddLamps(4);
	const FView View = LookAtPosts(131, 73);
	const auto Play = [&](const char* PerPixel) {
		SetVariable("r.RT.Rays.QueuePerPixel", PerPixel == std::string("4") ? "5" : "4"); // another value: demand is forgotten
		GetEngine().SetFrameIndex(0);
		EXPECT_OK(GetEngine().RenderFrame(MakeView(8, 8), 0.0, {}, nullptr));
		SetVariable("r.RT.Rays.QueuePerPixel", PerPixel);
		std::vector<FImage> Pictures;
		for (uint32_t Frame = 0; Frame < 4; ++Frame) { Pictures.push_back(RenderSignal(ESignal::LocalDiffuse, View, 1, Frame)); }
		return Pictures;
	};
	for (const char* const Exact : {"4", "1"})
	{
		SetVariable("r.RT.Lights.Exact", Exact);
		const std::vector<FImage> Right = Play("8"), Small = Play("0.5"), Again = Play("0.5");
		for (size_t Frame = 0; Frame < Small.size(); ++Frame) { EXPECT_EQ(Small[Frame].Pixels, Again[Frame].Pixels) << Frame; }
		EXPECT_NE(Small[0].Pixels, Right[0].Pixels) << "all had room";
		EXPECT_NEAR(MeanGreen(Small[0]) / MeanGreen(Right[0]), 1.0, 0.05) << Exact;
		EXPECT_EQ(Small[3].Pixels, Right[3].Pixels) << "the queue has grown";
		for (const FImage& Picture : Play("0.01")) { EXPECT_EQ(CountNonFinitePixels(Picture), 0u); }
	}
}

// Room for 1 % of the rays: after a second, nothing of it is left in what the filter has accumulated.
TEST_F(FLocalLightsTest, FilteredPictureAfterAQueueWithoutRoom)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	SetVariable("r.RT.Lights.Denoise", "1");
	AddLamps(12);
	const FView View = LookAtPosts(64, 36);
	const FImage Truth = TraceSignal(ESignal::LocalDiffuse, View, 256, 1);
	const auto Play = [&](const char* PerPixel, uint32_t Frames) {
		SetVariable("r.RT.Rays.QueuePerPixel", PerPixel);
		GetEngine().SetFrameIndex(0);
		EXPECT_OK(GetEngine().RenderFrame(MakeView(8, 8), 0.0, {}, nullptr)); // another size: nothing to keep
		FImage Picture;
		for (uint32_t Frame = 0; Frame < Frames; ++Frame) { Picture = RenderSignal(ESignal::LocalDiffuse, View, 1, Frame); }
		return Picture;
	};
	const auto GetError = [&](const FImage& Picture) {
		double Sum = 0.0;
		for (size_t I = 1; I < Truth.Pixels.size(); I += Truth.Channels) { Sum += std::pow(Picture.Pixels[I] - Truth.Pixels[I], 2); }
		return std::sqrt(Sum);
	};
	const double Ratio = GetError(Play("0.01", 60)) / GetError(Play("8", 60));
	PrintFigure(fmt::format("error after a queue without room over that of one with room: {:.3f}", Ratio));
	EXPECT_LE(Ratio, 1.5);
	EXPECT_NE(Play("0.011", 1).Pixels, Play("8.5", 1).Pixels) << "there was room for all";
}

TEST_F(FLocalLightsTest, OddSizes)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	SetVariable("r.RT.Lights.GuideSeconds", "0"); // a tile that knows some of its lights only would choose with noise
	FSceneLight Light;
	Light.Type = LIGHT_DIRECTIONAL;
	Light.Color = glm::vec3(2);
	for (const uint32_t Count : {3u, 7u})
	{
		std::vector<FLightId> Ids;
		for (uint32_t I = 0; I < Count; ++I) { Ids.push_back(GetWorld().AddLight(Light)); }
		for (const auto& [X, Y] : {std::pair{1u, 1u}, {7u, 3u}, {9u, 1u}, {1u, 17u}, {131u, 73u}})
		{
			// A bare part of the floor: each pixel has all of the light.
			const FImage Picture = RenderSignal(ESignal::LocalDiffuse, LookAt({-6, 2, 0}, {-6, 0, 0.01}, 0.2f, X, Y));
			for (size_t Pixel = 0; Pixel < size_t(X) * Y; ++Pixel)
			{
				ASSERT_NEAR(Picture.Pixels[Pixel * Picture.Channels], 2.0 * Count / 3.14159265, 0.01 * Count) << X << " x " << Y;
			}
		}
		for (const FLightId Id : Ids) { GetWorld().RemoveLight(Id); }
	}
}

// Values that overflow or divide by zero elsewhere: none comes out, and other lights stay as they are.
TEST_F(FLocalLightsTest, ExtremeLights)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	AddLamps(2);
	const FView View = LookAtPosts(48, 27);
	const FImage Before = RenderSignal(ESignal::LocalDiffuse, View);
	std::vector<FSceneLight> Extreme(6);
	Extreme[0].Color = glm::vec3(1e9f);
	Extreme[1].Position = {0.6, 0.6, 0.5}; // within a post
	Extreme[1].Color = glm::vec3(1e9f);
	Extreme[2].Range = 1e-6f;
	Extreme[3].Type = LIGHT_SPHERE;
	Extreme[3].Size = {1e-6f, 0};
	Extreme[3].Color = glm::vec3(1e9f);
	Extreme[4].OuterCone = 1e-4f;
	Extreme[4].Position = {0, 3, 0};
	Extreme[4].Color = glm::vec3(100);
	Extreme[5].OuterCone = 3.14159f;
	Extreme[5].InnerCone = 3.1f;
	Extreme[5].Color = glm::vec3(1);
	for (const FSceneLight& Light : Extreme)
	{
		const FLightId Id = GetWorld().AddLight(Light);
		for (const char* const Exact : {"8", "1"})
		{
			SetVariable("r.RT.Lights.Exact", Exact);
			for (const ESignal Lobe : Lobes) { EXPECT_EQ(CountNonFinitePixels(RenderSignal(Lobe, View)), 0u); }
		}
		GetWorld().RemoveLight(Id);
	}
	SetVariable("r.RT.Lights.Exact", "4");
	EXPECT_EQ(RenderSignal(ESignal::LocalDiffuse, View).Pixels, Before.Pixels);
}

} // namespace
} // namespace Lantern
