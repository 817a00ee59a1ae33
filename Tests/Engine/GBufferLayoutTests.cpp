// Pictures from G-buffers in other layouts, against those from native ones.
#include <algorithm>

#include "EngineFixture.h"

namespace Lantern
{
namespace
{

class FGBufferLayoutTest : public FBoxesTest
{
protected:
	/// A renderer of its own, so that pictures of two layouts have the same noise.
	void Restart()
	{
		Raster.reset();
		Renderer.Reset();
		ASSERT_NO_FATAL_FAILURE(Open());
		Raster->Change = Lie;
	}
	void SetSoftSun()
	{
		FRTModuleSun Sun;
		for (int Axis = 0; Axis < 3; ++Axis) { Sun.Direction[Axis] = -ToSun[Axis]; }
		Sun.Irradiance = 1.0f;
		Sun.AngularDiameter = 0.12f;
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.Soft", "1"));
		// Pictures that hardly need motion would hide what is wrong with it.
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.MoreRays", "0"));
		ASSERT_OK(Renderer->SetSun(Sun));
	}
	/// One picture after warming up. The scene, or the camera, moves by Step each frame.
	std::vector<float> RenderMoving(const FEngineConventions& As, bool bCameraMoves)
	{
		std::vector<float> Out;
		std::vector<uint32_t> Triangles;
		Restart();
		if (HasFatalFailure()) { return Out; }
		SetSoftSun();
		const FEngineCamera Start = Camera;
		Raster->Shift = Raster->PreviousShift = glm::dvec3(0);
		Raster->Previous = Camera;
		constexpr int WarmFrames = 8, MovingFrames = 8;
		for (int Frame = 0; Frame < WarmFrames + MovingFrames; ++Frame)
		{
			if (Frame >= WarmFrames) { (bCameraMoves ? Camera.Position : Raster->Shift) += Step; }
			if (!bCameraMoves) { PlaceSoup(Raster->Shift); }
			const FRTStatus Status = Raster->Render(*Renderer, Camera, As, Size, Out, Triangles);
			EXPECT_TRUE(Status.IsOk()) << Status.Message;
			EXPECT_TRUE(Frame < 2 || Raster->IsComplete()) << "frames wait for their shaders (r.RT.Pipeline.Fallback)";
			Raster->PreviousShift = Raster->Shift;
			Raster->Previous = Camera;
		}
		Camera = Start;
		return Out;
	}
	void PlaceSoup(const glm::dvec3& At)
	{
		const double Transform[12] = {1, 0, 0, At.x, 0, 1, 0, At.y, 0, 0, 1, At.z};
		EXPECT_TRUE(Renderer->SetObjectTransform(Object, Transform).IsOk());
	}
	/// Mean difference of two pictures.
	static double Compare(const std::vector<float>& A, const std::vector<float>& B)
	{
		EXPECT_EQ(A.size(), B.size());
		double Sum = 0.0;
		for (size_t I = 0; I < std::min(A.size(), B.size()); ++I) { Sum += std::abs(double(A[I]) - double(B[I])); }
		return Sum / double(std::max<size_t>(A.size(), 1));
	}
	static void Print(const char* What, double Good, double Bad)
	{
		std::printf("[  figure  ] %s: mean difference %.6f, with the planted fault %.6f\n", What, Good, Bad);
	}
	static FRTModuleGBufferLayout MakeMotion(ERTModuleMotion Coding, float Scale, bool bDistance)
	{
		FRTModuleGBufferLayout Layout;
		Layout.Motion = Coding;
		Layout.MotionScale[0] = Layout.MotionScale[1] = Scale;
		Layout.bMotionDistance = bDistance;
		return Layout;
	}
	/// The plugin is told that motion leads the other way.
	static void TurnMotion(FRTModuleFrame& Frame)
	{
		for (int Axis = 0; Axis < 2; ++Axis)
		{
			Frame.Layout.MotionScale[Axis] *= -1.0f;
			Frame.Layout.MotionOffset[Axis] *= -1.0f;
		}
	}
	std::function<void(FRTModuleFrame&)> Lie; ///< what the plugin is told otherwise than it is
	const glm::dvec3 Step{0.07, 0.02, 0.03};  ///< of a frame, metres
	const FEngineConventions Native{.MotionFormat = ERTFormat::RGBA32_FLOAT};
};

TEST_F(FGBufferLayoutTest, LinearDepthIsTheSame)
{
	ASSERT_NO_FATAL_FAILURE(Open());
	FEngineConventions As;
	const std::vector<float> Projected = RenderPicture(As);
	As.Name = "linear depth";
	As.bLinearDepth = true;
	const FVerdict Verdict = RenderAndJudge(As);
	EXPECT_GE(Verdict.Lit, 20000u);
	EXPECT_LE(Verdict.GetDarkShare(), 0.0005);
	EXPECT_LE(Verdict.GetLitShare(), 0.0005);
	EXPECT_LE(CountDifferent(RenderPicture(As), Projected), 0.0005) << "rounding decides at the edges of shadows";
	Raster->Change = [](FRTModuleFrame& Frame) { Frame.Layout.Depth = ERTModuleDepth::Projected; };
	EXPECT_GT(CountDifferent(RenderPicture(As), Projected), 0.01) << "the test could not fail";
}

// The raster has no far plane, but the engine says 8 m: what lies beyond is sky, whatever the texel says.
TEST_F(FGBufferLayoutTest, LinearDepthEndsAtTheFarPlane)
{
	ASSERT_NO_FATAL_FAILURE(Open());
	const FEngineConventions As{.bLinearDepth = true};
	FEngineConventions Told = As;
	Told.Far = 8.0;
	const std::vector<float> Whole = RenderPicture(As);
	std::vector<float> Near;
	std::vector<uint32_t> Triangles;
	Raster->Change = [&](FRTModuleFrame& Frame) { Frame.View.Projection = FEngineRaster::MakeProjection(Camera, Told, Size); };
	ASSERT_OK(Raster->Render(*Renderer, Camera, As, Size, Near, Triangles));
	size_t Dark[2] = {}, Wrong = 0;
	for (size_t Pixel = 0; Pixel < Near.size(); ++Pixel)
	{
		if (Triangles[Pixel] == 0) { continue; }
		glm::dvec3 Origin, Direction;
		FEngineRaster::MakeRay(Camera, As, Size, {double(Pixel % Size.x) + 0.5, double(Pixel / Size.x) + 0.5}, Origin, Direction);
		const glm::dvec3 Point = Truth->MeetPlane(Triangles[Pixel] - 1, Origin, Direction).Point;
		const double Away = glm::dot(Point - Camera.Position, glm::normalize(Camera.Forward));
		if (std::abs(Away - Told.Far) < 1e-3) { continue; } // rounding of floats
		const bool bBeyond = Away > Told.Far;
		Dark[bBeyond ? 1 : 0] += Whole[Pixel] == 0.0f ? 1 : 0;
		Wrong += Near[Pixel] != (bBeyond ? 1.0f : Whole[Pixel]) ? 1 : 0;
	}
	EXPECT_EQ(Wrong, 0u);
	EXPECT_GT(Dark[0], 100u) << "the test could not fail";
	EXPECT_GT(Dark[1], 100u) << "the test could not fail";
}

TEST_F(FGBufferLayoutTest, EveryCodingOfMotionIsTheSame)
{
	const std::vector<float> Right = RenderMoving(Native, false);
	EXPECT_EQ(Compare(RenderMoving(Native, false), Right), 0.0) << "two runs have the same noise";
	const FEngineConventions Rows[] = {
	    {.Name = "pixels", .MotionFormat = ERTFormat::RG16_FLOAT, .Layout = MakeMotion(ERTModuleMotion::Pixels, 1, false)},
	    {.Name = "UV, to this frame", .MotionFormat = ERTFormat::RG16_FLOAT, .Layout = MakeMotion(ERTModuleMotion::UV, -1, false)},
	    {.Name = "UV with distance", .MotionFormat = ERTFormat::RGBA32_FLOAT, .Layout = MakeMotion(ERTModuleMotion::UV, 1, true)}};
	for (const FEngineConventions& Row : Rows)
	{
		const double Good = Compare(RenderMoving(Row, false), Right);
		Lie = TurnMotion;
		const double Bad = Compare(RenderMoving(Row, false), Right);
		Lie = {};
		Print(Row.Name, Good, Bad);
		EXPECT_LE(Good, 0.0005) << Row.Name << ": halves round motion to a few hundredths of a pixel";
		EXPECT_GE(Bad, 4 * std::max(Good, 0.0005)) << Row.Name << ": the test could not fail";
	}
}

// Without motion vectors, everything stands still, and the camera's own motion is known.
TEST_F(FGBufferLayoutTest, NoMotionIsThatOfTheCamera)
{
	const FEngineConventions None{.Name = "none"};
	const double Good = Compare(RenderMoving(None, true), RenderMoving(Native, true));
	const double Bad = Compare(RenderMoving(None, false), RenderMoving(Native, false));
	Print("no motion", Good, Bad);
	EXPECT_LE(Good, 0.0005);
	EXPECT_GE(Bad, 4 * std::max(Good, 0.0005)) << "objects that move need motion: the test could not fail";
}

class FUnrealGBufferTest : public FGBufferLayoutTest
{
protected:
	static FEngineConventions MakeUnreal()
	{
		return {.Name = "Unreal",
		    .DepthFormat = ERTFormat::D32_FLOAT_S8_UINT,
		    .Near = 0.1,
		    .Normals = EEngineNormals::World,
		    .MotionFormat = ERTFormat::RG16_UNORM,
		    .bMaterials = true,
		    .bUnrealMaterial = true,
		    .Layout = MakeUnrealGBuffer()};
	}
};

TEST_F(FUnrealGBufferTest, ShadowsAreRight)
{
	ASSERT_NO_FATAL_FAILURE(Open());
	const FVerdict Verdict = RenderAndJudge(MakeUnreal());
	EXPECT_GE(Verdict.Lit, 20000u);
	EXPECT_LE(Verdict.GetDarkShare(), 0.0005);
	EXPECT_LE(Verdict.GetLitShare(), 0.005) << "geometric normals come from depth";
	bCastsShadow = false; // only the normals tell what turns away
	ASSERT_NO_FATAL_FAILURE(Restart());
	const FVerdict Right = RenderAndJudge(MakeUnreal());
	Raster->Change = [](FRTModuleFrame& Frame) { Frame.Layout.bViewSpaceNormals = true; };
	const FVerdict Wrong = RenderAndJudge(MakeUnreal());
	EXPECT_LE(Right.GetLitShare(), 0.01);
	EXPECT_GT(Wrong.GetLitShare() + Wrong.GetDarkShare(), 0.05) << "the test could not fail";
}

TEST_F(FUnrealGBufferTest, VelocityIsMotion)
{
	// Geometric normals alike, so that motion alone is compared.
	FEngineConventions Plain = MakeUnreal();
	Plain.MotionFormat = ERTFormat::RGBA32_FLOAT;
	Plain.Layout.Motion = ERTModuleMotion::Native;
	Plain.Layout.bMotionPartial = false;
	Plain.Layout.MotionScale[0] = Plain.Layout.MotionScale[1] = 1.0f;
	Plain.Layout.MotionOffset[0] = Plain.Layout.MotionOffset[1] = 0.0f;
	const std::vector<float> Right = RenderMoving(Plain, false);
	const double Good = Compare(RenderMoving(MakeUnreal(), false), Right);
	Lie = TurnMotion;
	const double Bad = Compare(RenderMoving(MakeUnreal(), false), Right);
	Print("Unreal's velocity", Good, Bad);
	EXPECT_LE(Good, 0.0005);
	EXPECT_GE(Bad, 4 * std::max(Good, 0.0005)) << "the test could not fail";
}

TEST_F(FUnrealGBufferTest, MaterialsAreThoseOfTheNativeLayout)
{
	ASSERT_OK(Module->SetConsoleVariable("r.RT.Reflections", "1"));
	FEngineConventions Unreal = MakeUnreal(), Plain = MakeUnreal();
	Unreal.Signal = Plain.Signal = ESignal::Reflections;
	Plain.bUnrealMaterial = false;
	Plain.Layout.Material = ERTModuleMaterialLayout::Native;
	const auto Render = [&](const FEngineConventions& As) {
		std::vector<float> Out;
		std::vector<uint32_t> Triangles;
		Restart();
		const float Sky[3] = {0.4f, 0.6f, 1.0f};
		EXPECT_TRUE(Renderer->SetSky(Sky).IsOk());
		for (int Frame = 0; Frame < 6; ++Frame)
		{
			const FRTStatus Status = Raster->Render(*Renderer, Camera, As, Size, Out, Triangles);
			EXPECT_TRUE(Status.IsOk()) << Status.Message;
		}
		EXPECT_TRUE(Raster->IsComplete());
		return Out;
	};
	const std::vector<float> Right = Render(Plain);
	const double Good = Compare(Render(Unreal), Right);
	Unreal.Layout.Material = ERTModuleMaterialLayout::Native;
	const double Bad = Compare(Render(Unreal), Right);
	Print("Unreal's materials", Good, Bad);
	EXPECT_LE(Good, 0.005) << "8 bits round F0 otherwise than its root";
	EXPECT_GE(Bad, 4 * std::max(Good, 0.005)) << "the test could not fail";
}

} // namespace
} // namespace Lantern
