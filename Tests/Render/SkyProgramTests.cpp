// A sky that is a program: its map against the program itself, how the map follows, and programs of a host.
#include <cmath>
#include <fstream>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRenderer/SkyProgram.h"
#include "Support/RenderFixture.h"
#include "Support/SharedFiles.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

/// Mean of |A − B| over mean of B.
double MeanOff(const FImage& A, const FImage& B)
{
	double Sum = 0.0, Of = 0.0;
	for (size_t I = 0; I < B.Pixels.size(); ++I)
	{
		Sum += std::abs(double(A.Pixels[I]) - double(B.Pixels[I]));
		Of += double(B.Pixels[I]);
	}
	return Sum / Of;
}

/// A mirror on the ground shows the sky alone, without noise.
FTestScene MakeMirror()
{
	FTestScene Scene("Mirror");
	FHostMaterial Mirror;
	Mirror.Metallic = 1.0f;
	Mirror.Roughness = 0.0f;
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(Mirror), 1000.0f)}));
	return Scene;
}

class FSkyProgramTest : public FRenderTest
{
protected:
	static constexpr float DeltaSeconds = 1.0f / 60.0f;
	void LoadMirror()
	{
		ASSERT_TRUE(Load(MakeMirror().Scene));
		SetSun(0.5);
		SetSky({0.4f, 0.5f, 0.7f});
		SetVariable("r.Sky.Program", "1");
		SetVariable("r.RT.GI", "0");
		SetVariable("r.RT.Reflections", "1");
	}
	static FView MakeMirrorView()
	{
		FView View = LookAt({0, 2, 0}, {0, 0, -2}, 0.6f, 64, 64);
		View.DeltaSeconds = DeltaSeconds;
		return View;
	}
	static FImage RenderMirror(double Time = 0.0)
	{
		return RenderSignal(ESignal::Reflections, MakeMirrorView(), 1, GetEngine().GetFrameIndex(), Time);
	}
	/// What rays see at that time without a map.
	static FImage RenderInPlace(double Time = 0.0)
	{
		SetVariable("r.RT.Sky.Bake", "0");
		FImage Out = RenderMirror(Time);
		SetVariable("r.RT.Sky.Bake", "1");
		return Out;
	}
};

TEST_F(FSkyProgramTest, TheMapShowsWhatTheProgramSays)
{
	ASSERT_NO_FATAL_FAILURE(LoadMirror());
	const FImage Baked = RenderMirror(), InPlace = RenderInPlace();
	const double Off = MeanOff(Baked, InPlace);
	SetVariable("r.RT.Sky.Size", "64");
	const double Coarse = MeanOff(RenderMirror(), InPlace);
	PrintFigure(fmt::format("the map is off by {:.5f}, one of 64 texels by {:.5f}", Off, Coarse));
	EXPECT_LT(Off, 0.004) << "texels are 0.2 degrees wide, pixels 0.8";
	EXPECT_GT(Coarse, 3.0 * Off) << "else nothing was seen that a map could miss";
	// Pixels of the reference look all over their area.
	SetVariable("r.RT.Sky.Size", "1024");
	const double Traced = MeanGreen(TraceReference(MakeMirrorView(), 16)), Shown = MeanGreen(RenderLighting(MakeMirrorView()));
	PrintFigure(fmt::format("picture {:.5f}, reference {:.5f}", Shown, Traced));
	EXPECT_NEAR(Shown / Traced, 1.0, 0.005);
}

TEST_F(FSkyProgramTest, AmbientLightIsThatOfTheProgram)
{
	FTestScene Scene("wall");
	const int32_t Wall = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({{Wall, {{0, -9, 9}, {0, -9, -9}, {0, 9, -9}, {0, 9, 9}}}}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSun(0.0, 0.0f);
	SetSky({0.4f, 0.5f, 0.7f});
	SetVariable("r.Sky.Program", "1");
	SetVariable("r.RT.GI", "0");
	const FView View = LookAt({3, 0, 0}, {0, 0, 0}, 0.8f, 24, 24);
	const double Plugin = MeanGreen(RenderLighting(View)), Reference = MeanGreen(TraceReference(View, 256));
	PrintFigure(fmt::format("plugin {:.5f}, reference {:.5f}", Plugin, Reference));
	EXPECT_NEAR(Plugin / Reference, 1.0, 0.02) << "three bands of harmonics; noise of the reference is 0.1 %";
}

/// Greatest step from one frame to the next while clouds drift. Steps that the fade spreads are planted anew without it.
TEST_F(FSkyProgramTest, NoStepShowsInARefresh)
{
	ASSERT_NO_FATAL_FAILURE(LoadMirror());
	SetVariable("r.RT.Sky.RefreshSeconds", "1");
	const auto Measure = [] {
		double Greatest = 0.0;
		int Steps = 0;
		FImage Last;
		for (int Frame = 0; Frame < 190; ++Frame)
		{
			FImage Now = RenderMirror(Frame * double(DeltaSeconds));
			if (Frame > 62) // the first round begins when clouds have hardly drifted
			{
				const double Step = MeanOff(Now, Last);
				Greatest = std::max(Greatest, Step);
				Steps += Step > 0.0;
			}
			Last = std::move(Now);
		}
		return std::pair(Greatest, Steps);
	};
	const auto [Faded, FadedSteps] = Measure();
	SetVariable("r.RT.Debug.Sky.Fade", "0");
	const auto [Stepped, Steps] = Measure();
	PrintFigure(fmt::format("greatest step {:.5f} in {} frames; without the fade {:.5f} in {}", Faded, FadedSteps, Stepped, Steps));
	EXPECT_LE(Faded, 0.01);
	EXPECT_GE(FadedSteps, 28) << "two refreshes, 15 frames each";
	EXPECT_GT(Stepped, 0.01) << "the planted fault shows";
	EXPECT_LE(Steps, 2);
}

TEST_F(FSkyProgramTest, AStillSkyIsBakedOnce)
{
	ASSERT_NO_FATAL_FAILURE(LoadMirror());
	const auto CountPasses = [](const char* Name) {
		const std::vector<FPassTiming>& Timings = GetEngine().GetRenderer().GetGraphResources().GetTimings();
		return std::ranges::count_if(Timings, [&](const FPassTiming& Pass) { return Pass.Name == Name; });
	};
	(void)RenderMirror();
	EXPECT_EQ(CountPasses("SkyBake"), 1);
	for (int Frame = 0; Frame < 3; ++Frame)
	{
		(void)RenderMirror();
		EXPECT_EQ(CountPasses("SkyBake") + CountPasses("SkyFade"), 0);
	}
	(void)RenderMirror(DeltaSeconds);
	EXPECT_EQ(CountPasses("SkyBake"), 1) << "clouds have drifted";
}

TEST_F(FSkyProgramTest, ASunThatJumpsIsFollowedAtOnce)
{
	ASSERT_NO_FATAL_FAILURE(LoadMirror());
	const FImage Day = RenderMirror();
	SetSun(0.5, 0.1f, {1.0, -0.1, 0.35});
	SetSky({0.02f, 0.03f, 0.05f});
	FImage Now;
	for (int Frame = 0; Frame < 16; ++Frame) { Now = RenderMirror(); }
	EXPECT_LT(MeanOff(Now, RenderInPlace()), 0.004) << "within r.RT.Sky.FadeSeconds";
	EXPECT_GT(MeanOff(Day, Now), 1.0);
	// A sun that sweeps is followed all the while.
	for (int Frame = 0; Frame < 30; ++Frame)
	{
		const double Angle = 0.1 + 0.01 * Frame;
		SetSun(0.5, 0.1f, {std::cos(Angle), -std::sin(Angle), 0.35});
		Now = RenderMirror();
	}
	EXPECT_LT(MeanOff(Now, RenderInPlace()), 0.05) << "the fade lags by 0.25 s, which is 8 degrees of the sun's way here";
}

// A program's brightness is its own: neither the sun nor the uniform sky says how bright its map must be able to be.
TEST_F(FSkyProgramTest, TheMapHoldsNightsAndSuns)
{
	ASSERT_NO_FATAL_FAILURE(LoadMirror());
	for (const float Brightness : {1.0e-4f, 1.0e8f})
	{
		SetSky(Brightness * glm::vec3(0.4f, 0.5f, 0.7f));
		SetSun(0.5, 0.0f);
		FImage Now;
		for (int Frame = 0; Frame < 17; ++Frame) { Now = RenderMirror(); }
		const double Most = Brightness > 1.0f ? 65504.0 : 1.0e30; // of the signal's half floats
		double Off = 0.0, Of = 0.0;
		const FImage InPlace = RenderInPlace();
		for (size_t I = 0; I < Now.Pixels.size(); ++I)
		{
			Off += std::abs(double(Now.Pixels[I]) - std::min(double(InPlace.Pixels[I]), Most));
			Of += double(Now.Pixels[I]);
		}
		EXPECT_LT(Off, 0.004 * Of) << Brightness;
		EXPECT_GT(Of, 0.0);
	}
}

// What shaders of a frame before may still ask for must be there.
TEST_F(FSkyProgramTest, AProgramMayGoWhileItsShadersAreInUse)
{
	ASSERT_NO_FATAL_FAILURE(LoadMirror());
	SetVariable("r.RT.Reflections.Path", "1");
	SetVariable("r.RT.Sky.Bake", "0");
	const FImage InPlace = RenderMirror();
	GetEngine().bRealTime = true;
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::Reflections);
	FCapturedFrame Shown;
	for (const auto& [Name, Value] : {std::pair("r.Sky.Program", "0"), std::pair("r.Sky.Program", "1"), std::pair("r.RT.Sky.Bake", "1")})
	{
		SetVariable(Name, Value);
		for (int Frame = 0; Frame < 3; ++Frame)
		{
			ASSERT_OK(GetEngine().RenderFrame(MakeMirrorView(), 0.0, Capture, &Shown));
			// There are none while other shaders than those of rays compile.
			for (const float Pixel : Shown.Get(ESignal::Reflections).Pixels) { ASSERT_TRUE(std::isfinite(Pixel)) << Name; }
		}
	}
	GetEngine().bRealTime = false;
	EXPECT_LT(MeanOff(RenderMirror(), InPlace), 0.004);
}

class FOwnSkyTest : public FSkyProgramTest
{
protected:
	/// One frame of the mirror, and of the sky above it, with a program of the host's.
	void Render(const std::string& Program, FImage& Sky, FImage& Mirror)
	{
		const FTemporaryFolder Folder;
		const std::string File = Folder / "OwnSky.glsl";
		std::ofstream(File) << Program;
		FRendererDesc Desc;
		Desc.ShaderFolders = {LANTERN_SOURCE_DIR "/Shaders"};
		Desc.ShaderHeaders = {MakeSkyProgramHeader(File)};
		FSampleEngine Own(GetDevice(), Desc);
		Own.bRealTime = true; // an error is then logged, and frames go on
		ASSERT_OK(Own.Load(MakeMirror().Scene));
		Own.GetScene().GetScene().SetSky({0.25f, 0.25f, 0.25f});
		SetVariable("r.Sky.Program", "1");
		SetVariable("r.RT.GI", "0");
		SetVariable("r.RT.Reflections", "1");
		FFrameCapture Capture;
		Capture.bLighting = true;
		Capture.Signals.Add(ESignal::Reflections);
		FConsoleVariables::Get().BeginFrame(); // else what is compiled ahead is for the variables of before
		(void)Own.Precache(Capture, {});
		FCapturedFrame Out;
		for (int Frame = 0; Frame < 3; ++Frame) { ASSERT_OK(Own.RenderFrame(MakeMirrorView(), 0.0, Capture, &Out)); }
		Mirror = Out.Get(ESignal::Reflections);
		ASSERT_OK(Own.RenderFrame(LookAt({0, 2, 0}, {0, 4, -2}, 0.9f, 64, 64), 0.0, Capture, &Out));
		Sky = Out.Lighting;
	}
};

TEST_F(FOwnSkyTest, WhatIsNotFiniteCountsAsDark)
{
	FImage Sky, Mirror;
	ASSERT_NO_FATAL_FAILURE(Render(R"(
vec3 EvaluateSky(vec3 Direction, FSkyData Sky)
{
	float Zero = Sky.Values[15].x;
	return Direction.x < 0.0 ? vec3(0.0 / Zero, 1.0 / Zero, -1.0) : 4.0 * Sky.Radiance * vec3(max(Direction.y, 0.0), 1.0, 0.5);
}
)",
	    Sky, Mirror));
	for (const FImage* Image : {&Sky, &Mirror})
	{
		for (const float Value : Image->Pixels) { ASSERT_TRUE(std::isfinite(Value)); }
	}
	const double Up = std::sqrt(0.5); // at the picture's middle
	for (const uint32_t X : {33u, 60u})
	{
		EXPECT_NEAR(double(Sky.At(X, 32, 1)), 1.0, 1e-3);
		EXPECT_NEAR(double(Sky.At(X, 32, 2)), 0.5, 1e-3);
		EXPECT_NEAR(double(Mirror.At(X, 32, 1)), 1.0, 0.01) << "of the mirror's own colour there is a half-float's error";
	}
	EXPECT_NEAR(double(Sky.At(33, 32, 0)), Up, 0.02);
	EXPECT_NEAR(double(Mirror.At(33, 32, 0)), Up, 0.02);
	for (uint32_t Channel = 0; Channel < 3; ++Channel)
	{
		EXPECT_EQ(Sky.At(10, 32, Channel), 0.0f) << Channel;
		EXPECT_EQ(Mirror.At(10, 32, Channel), 0.0f) << Channel;
	}
}

TEST_F(FOwnSkyTest, WhatDoesNotCompileLeavesTheUniformSky)
{
	FImage Sky, Mirror;
	ASSERT_NO_FATAL_FAILURE(Render("vec3 EvaluateSky(vec3 Direction, FSkyData Sky) { return Sky.Radiance * Nothing; }", Sky, Mirror));
	for (const float Value : Mirror.Pixels) { ASSERT_NEAR(double(Value), 0.25, 0.005); }
}

} // namespace
} // namespace Lantern
