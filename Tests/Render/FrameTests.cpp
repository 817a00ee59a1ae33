// Whole frames of whole scenes: a picture of sound numbers, the passes that the scene needs and no others.
#include <algorithm>
#include <cmath>

#include "LanternImage/ImageStatistics.h"
#include "Support/RenderFixture.h"

namespace Lantern
{

namespace
{

class FFrameTest : public FRenderTest
{
protected:
	static std::vector<std::string> GetPasses()
	{
		std::vector<std::string> Names;
		for (const FPassTiming& Pass : GetEngine().GetRenderer().GetGraphResources().GetTimings()) { Names.push_back(Pass.Name); }
		return Names;
	}
	static bool Contains(const std::vector<std::string>& Names, const char* Name)
	{
		return std::find(Names.begin(), Names.end(), Name) != Names.end();
	}

	/// Three frames, then judges the last. Expected: passes beside those of every picture.
	void ExpectSoundFrames(const FView& View, const std::vector<const char*>& Expected, const std::vector<const char*>& Absent)
	{
		FCapturedFrame Frame;
		FFrameCapture Capture;
		Capture.bLighting = Capture.bDisplay = true;
		for (int I = 0; I < 3; ++I) { ASSERT_OK(GetEngine().RenderFrame(View, 0.3 * I, Capture, &Frame)); }
		EXPECT_EQ(CountNonFinitePixels(Frame.Lighting), 0u);
		for (const FImage* Picture : {&Frame.Lighting, &Frame.Display})
		{
			const double Mean = ComputeMeans(*Picture).Luminance;
			double Variance = 0.0;
			for (uint32_t Y = 0; Y < Picture->Height; ++Y)
			{
				for (uint32_t X = 0; X < Picture->Width; ++X)
				{
					Variance += std::pow(GetLuminance(*Picture, X, Y) - Mean, 2) / double(Picture->GetPixelCount());
				}
			}
			EXPECT_GT(Mean, 0.01);
			EXPECT_GT(std::sqrt(Variance), 0.05 * Mean) << "a picture must show something";
		}
		const std::vector<std::string> Passes = GetPasses();
		for (const char* Pass : {"GBuffer", "DirectLighting", "ToneMap"}) { EXPECT_TRUE(Contains(Passes, Pass)) << Pass; }
		for (const char* Pass : Expected) { EXPECT_TRUE(Contains(Passes, Pass)) << Pass; }
		for (const char* Pass : Absent) { EXPECT_FALSE(Contains(Passes, Pass)) << Pass; }
	}
};

TEST_F(FFrameTest, Courtyard)
{
	ASSERT_TRUE(Load("courtyard"));
	ExpectSoundFrames(MakeView(160, 90), {"SunShadow"}, {"Skinning"});
}

TEST_F(FFrameTest, Sponza)
{
	REQUIRE_SCENE(Scene, "sponza/Sponza.gltf");
	ASSERT_TRUE(Load(Scene));
	SetSun(0.53);
	SetSky({0.5f, 0.7f, 1.0f});
	ExpectSoundFrames(LookAt({-9, 1.6, -0.4}, {10, 3.2, -1.2}, glm::radians(60.0f), 160, 90), {"SunShadow"}, {"Skinning"});
}

TEST_F(FFrameTest, BlackForest)
{
	REQUIRE_SCENE(Scene, "black_forest/black_forest.gltf");
	ASSERT_TRUE(Load(Scene));
	SetSun(0.53);
	SetSky({0.5f, 0.7f, 1.0f});
	ExpectSoundFrames(LookAt({541, 20, -200}, {300, 0, -300}, glm::radians(60.0f), 160, 90), {"SunShadow"}, {"Skinning"});
}

TEST_F(FFrameTest, Brainstem)
{
	REQUIRE_SCENE(Scene, "brainstem/BrainStem.glb");
	ASSERT_TRUE(Load(Scene));
	SetSun(0.53);
	SetSky({0.5f, 0.7f, 1.0f});
	ExpectSoundFrames(MakeView(160, 90), {"SunShadow", "Skinning", "Structures"}, {});
}

TEST_F(FFrameTest, Roughness)
{
	REQUIRE_SCENE(Scene, "roughness/scene.gltf");
	ASSERT_TRUE(Load(Scene));
	SetSun(0.53);
	SetSky({0.5f, 0.7f, 1.0f});
	ExpectSoundFrames(MakeView(160, 90), {"SunShadow"}, {"Skinning"});
}

// Without a sun there are no shadow rays and nothing is prepared for them.
TEST_F(FFrameTest, NoSunNoRays)
{
	ASSERT_TRUE(Load("courtyard"));
	SetSun(0.5, 0.0f);
	SetSky(glm::vec3(1));
	SetVariable("r.RT.Transmission", "0"); // the fountain's water has rays of its own
	ExpectSoundFrames(MakeView(160, 90), {}, {"SunShadow", "ShaderTable", "Skinning"});
}

// A sky without any object is a picture too.
TEST_F(FFrameTest, EmptySky)
{
	ASSERT_TRUE(Load("emptysky"));
	SetSun(0.5, 0.0f);
	SetSky({0.25f, 0.5f, 1.0f});
	const FImage Picture = RenderLighting(MakeView(33, 17));
	for (size_t I = 0; I < Picture.GetPixelCount(); ++I)
	{
		ASSERT_EQ(Picture.Pixels[3 * I], 0.25f);
		ASSERT_EQ(Picture.Pixels[3 * I + 2], 1.0f);
	}
	// Also with shadow rays through an empty scene, on either path, and for the path tracer.
	SetSun(0.5);
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		EXPECT_EQ(MeanGreen(RenderSunShadow(MakeView(16, 16))), 1.0);
	}
	EXPECT_NEAR(MeanGreen(TraceReference(MakeView(16, 16), 2)), 0.5, 1e-6);
}

// Odd sizes, down to a single pixel.
TEST_F(FFrameTest, Sizes)
{
	ASSERT_TRUE(Load("planes"));
	for (const auto& [Width, Height] : {std::pair{1u, 1u}, {1u, 64u}, {257u, 3u}, {640u, 2u}, {33u, 65u}})
	{
		const FImage Picture = RenderLighting(MakeView(Width, Height));
		EXPECT_EQ(Picture.GetPixelCount(), size_t(Width) * Height);
		EXPECT_EQ(CountNonFinitePixels(Picture), 0u);
		EXPECT_EQ(CountNonFinitePixels(TraceReference(MakeView(Width, Height), 1, 2)), 0u);
	}
}

} // namespace
} // namespace Lantern
