// Reflections whose paths end in radiance cells (r.RT.Reflections 1): against the reference, and what mirrors show while all moves.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FReflectionPathsTest : public FSignalTest
{
protected:
	static constexpr uint32_t Frames = 48;
	static constexpr double FrameSeconds = 1.0 / 60.0;

	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.GI.Rate", "2");
		SetVariable("r.RT.Reflections", "1");
		SetVariable("r.RT.GI.Cells.Capacity", "65536"); // pictures here have few pixels
	}

	/// What moves reaches its last place when the last of Frames ends.
	[[nodiscard]] bool LoadMirror(bool bMirrorMoves)
	{
		FTestScene Room("mirror and mover");
		FHostMaterial Silver;
		Silver.Roughness = 0.0f;
		const int32_t Mirror = Room.AddMaterial(Silver), Floor = Room.AddLambert(glm::vec3(0.6f), glm::vec3(0), true),
		              Red = Room.AddLambert({0.8f, 0.2f, 0.1f}, glm::vec3(0), true),
		              Blue = Room.AddLambert({0.1f, 0.2f, 0.7f}, glm::vec3(0), true);
		Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Floor, 8.0f)}));
		// A board behind the camera, with slats before it that throw stripes of shadow on it.
		std::vector<FTestScene::FQuad> Board{{Red, {{8, 0, 5}, {-8, 0, 5}, {-8, 3, 5}, {8, 3, 5}}}};
		for (int I = -6; I < 6; ++I)
		{
			const float X = 1.2f * float(I);
			Board.push_back({Blue, {{X + 0.4f, 0, 3.6f}, {X, 0, 3.6f}, {X, 5, 3.6f}, {X + 0.4f, 5, 3.6f}}});
		}
		const int32_t Mover = Room.AddNode(Room.AddMesh(Board));
		const int32_t Glass =
		    Room.AddNode(Room.AddMesh({{Mirror, {{-1.5f, 0.2f, -2}, {1.5f, 0.2f, -2}, {1.5f, 2.2f, -2}, {-1.5f, 2.2f, -2}}}}));
		const float Seconds = float(Frames * FrameSeconds);
		FHostAnimation Motion{.Name = "Motion", .Channels = {}, .Duration = Seconds};
		const auto Move = [&](int32_t Node, glm::vec3 From, glm::vec3 To) {
			FHostChannel Channel{.Node = Node, .Times = {0.0f, Seconds}, .Values = {glm::vec4(From, 0), glm::vec4(To, 0)}};
			Room.Scene.Nodes[static_cast<size_t>(Node)].Matrix.reset();
			Motion.Channels.push_back(Channel);
		};
		Move(Mover, {-5, 0, 0}, {1, 0, 0});
		if (bMirrorMoves) { Move(Glass, {0, 0, -0.4f}, {0, 0, 0}); }
		Room.Scene.Animations.push_back(Motion);
		if (!Load(std::move(Room.Scene))) { return false; }
		SetSun(10.0, 4.0f, {-0.4, -0.6, 1.0});
		SetSky({0.3f, 0.35f, 0.4f});
		return true;
	}

	/// A mirror shows a floor, and a plate flies over it that the view does not show.
	[[nodiscard]] bool LoadPlate()
	{
		FTestScene Room("shadow in a mirror");
		FHostMaterial Silver;
		Silver.Roughness = 0.0f;
		const int32_t Mirror = Room.AddMaterial(Silver), Grey = Room.AddLambert(glm::vec3(0.6f), glm::vec3(0), true);
		Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Grey, 12.0f)}));
		Room.AddNode(Room.AddMesh({{Mirror, {{-3, 0, -2}, {3, 0, -2}, {3, 3, -2}, {-3, 3, -2}}}}));
		const int32_t Plate = Room.AddNode(Room.AddMesh({{Grey, {{-0.5, 3, 0.5}, {0.5, 3, 0.5}, {0.5, 3, -0.5}, {-0.5, 3, -0.5}}}}));
		const float Seconds = float(Frames * FrameSeconds);
		Room.Scene.Nodes[static_cast<size_t>(Plate)].Matrix.reset();
		Room.Scene.Animations.push_back({.Name = "Motion",
		    .Channels = {{.Node = Plate, .Times = {0.0f, 2 * Seconds}, .Values = {glm::vec4(-2, 0, 1, 0), glm::vec4(2, 0, 1, 0)}}},
		    .Duration = 2 * Seconds});
		if (!Load(std::move(Room.Scene))) { return false; }
		SetSun(1.5, 0.5f, {0.0, -1.0, 0.05});
		SetSky({0.3f, 0.35f, 0.4f});
		return true;
	}

	/// T: 0 to 1, of the camera's way.
	static FView Look(double T)
	{
		FView View = LookAt({-0.8 + 0.6 * T, 1.2, 2.4}, {-0.1, 1.2, -2}, 0.5f, 144, 96);
		View.DeltaSeconds = float(FrameSeconds);
		return View;
	}

	/// The last of Frames, in which the camera and the scene move, or stand where they end. First: number of the first frame, from 1.
	static FImage RenderLast(bool bMoves, uint32_t First = 1)
	{
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::Reflections);
		FCapturedFrame Frame;
		GetEngine().SetFrameIndex(0); // random numbers begin anew
		for (uint32_t I = First; I <= Frames; ++I)
		{
			FView View = Look(bMoves ? double(I) / Frames : 1.0);
			View.bCut = I == First;
			const FRTStatus Status = GetEngine().RenderFrame(View, (bMoves ? I : Frames) * FrameSeconds, Capture, &Frame);
			EXPECT_TRUE(Status) << Status.Message;
		}
		return Frame.Get(ESignal::Reflections);
	}

	/// Mean square difference over the square of the mean.
	static double MeasureError(const FImage& Image, const FImage& Truth)
	{
		double Sum = 0.0, Squares = 0.0;
		for (size_t I = 0; I < Truth.Pixels.size(); ++I)
		{
			const double Difference = double(Image.Pixels[I]) - double(Truth.Pixels[I]);
			Squares += Difference * Difference;
			Sum += double(Truth.Pixels[I]);
		}
		const double Count = double(Truth.Pixels.size()), Mean = Sum / Count;
		return Squares / Count / (Mean * Mean);
	}

	/// Mean square difference where Before and Truth differ by a tenth of Truth's mean or more, over the square of that mean.
	static double MeasureErrorOfChanged(const FImage& Image, const FImage& Truth, const FImage& Before)
	{
		const double Count = double(Truth.Pixels.size()), Mean = std::accumulate(Truth.Pixels.begin(), Truth.Pixels.end(), 0.0) / Count;
		double Squares = 0.0, Changed = 0.0;
		for (size_t I = 0; I < Truth.Pixels.size(); ++I)
		{
			if (std::abs(double(Before.Pixels[I]) - double(Truth.Pixels[I])) < 0.1 * Mean) { continue; }
			const double Difference = double(Image.Pixels[I]) - double(Truth.Pixels[I]);
			Squares += Difference * Difference;
			Changed += 1.0;
		}
		EXPECT_GT(Changed, 50.0);
		return Squares / std::max(Changed, 1.0) / (Mean * Mean);
	}

	/// Leaves the filter nothing but what the scene says to drop histories by.
	void KeepHistories()
	{
		for (const char* const Limit : {"r.RT.Reflections.ChangeSigma", "r.RT.Reflections.ClampSigma"}) { SetVariable(Limit, "0"); }
	}

	/// Share of the difference between Before and Truth that an image still shows.
	static double MeasureKept(const FImage& Image, const FImage& Truth, const FImage& Before)
	{
		double Kept = 0.0, All = 0.0;
		for (size_t I = 0; I < Truth.Pixels.size(); ++I)
		{
			const double Difference = double(Before.Pixels[I]) - double(Truth.Pixels[I]);
			Kept += (double(Image.Pixels[I]) - double(Truth.Pixels[I])) * Difference;
			All += Difference * Difference;
		}
		return Kept / All;
	}

	/// The reference where all things end, or as many frames before, seen from there.
	static FImage TraceLast(uint32_t FramesBefore = 0)
	{
		FReferenceSettings Settings;
		Settings.View = Look(1.0);
		Settings.Time = (Frames - FramesBefore) * FrameSeconds;
		Settings.Samples = 256;
		Settings.Signal = ESignal::Reflections;
		Settings.bRasterSurfaces = true;
		return TraceReference(Settings);
	}
};

// Both find the same hits, and draw the same random numbers. Radiance cells and the filter would make much of the last bits of a distance.
TEST_F(FReflectionPathsTest, PipelineAndQueryAgree)
{
	SetVariable("r.RT.GI", "0");
	SetVariable("r.RT.Reflections.Denoise", "0");
	FImage Pictures[2];
	for (int Path = 1; Path <= 2; ++Path)
	{
		ASSERT_TRUE(LoadMirror(false));
		SetVariable("r.RT.Reflections.Path", std::to_string(Path));
		Pictures[Path - 1] = RenderLast(true);
	}
	EXPECT_GT(MeanGreen(Pictures[0]), 0.01);
	// The payload of the pipeline's rays rounds normals and colours.
	const double Differing = FractionDiffering(Pictures[0], Pictures[1], 0.01);
	PrintFigure(fmt::format("pixels that differ by more than 0.01: {:.4f}", Differing));
	EXPECT_LT(Differing, 0.02);
}

// A mirror whose camera, mover and own place all change shows what the reference shows at the end, but for noise that time has not smoothed.
// Stripes of soft shadow move with a board, so that histories show where they were taken from. Nothing else that would drop them is on.
TEST_F(FReflectionPathsTest, FlatMirrorFollowsAllMotion)
{
	for (const bool bMirrorMoves : {false, true})
	{
		ASSERT_TRUE(LoadMirror(bMirrorMoves));
		KeepHistories();
		const FImage Truth = TraceLast();
		const double Still = MeasureError(RenderLast(false), Truth), Moving = MeasureError(RenderLast(true), Truth);
		SetVariable("r.RT.Debug.Reflections.Motion", "0");
		const double Fault = MeasureError(RenderLast(true), Truth);
		SetVariable("r.RT.Debug.Reflections.Motion", "1");
		PrintFigure(fmt::format("mirror {}: relative square error still {:.5f}, moving {:.5f}, without the motion of hits {:.5f}",
		    bMirrorMoves ? "moves" : "stands", Still, Moving, Fault));
		EXPECT_LT(Moving, 6.0 * Still);
		EXPECT_LT(Moving, 0.2 * Fault);
	}
}

// A plate flies above what a mirror shows, and its shadow below it. Where the shadow was, the mirror shows light at once. Nothing else
// that would drop histories is on. Planted fault: the mirror's is kept, since nothing moved at the mirror.
TEST_F(FReflectionPathsTest, ShadowsOnWhatAMirrorShowsAreFollowed)
{
	ASSERT_TRUE(LoadPlate());
	KeepHistories();
	const FImage Truth = TraceLast(), Before = TraceLast(4);
	const double Moving = MeasureKept(RenderLast(true), Truth, Before);
	SetVariable("r.RT.Debug.MovedShare.Shown", "0");
	const double Fault = MeasureKept(RenderLast(true), Truth, Before);
	SetVariable("r.RT.Debug.MovedShare.Shown", "1");
	PrintFigure(
	    fmt::format("kept of what was there four frames before: {:.4f}, with a mirror that keeps its history {:.4f}", Moving, Fault));
	EXPECT_LT(std::abs(Moving), 0.04);
	EXPECT_GT(Fault, 0.1);
}

// Where a mirror shows light that has changed, more paths are traced: few of them, and no more than the budget. Where nothing moves, there are
// none. Planted fault: such pixels have the one path of others.
TEST_F(FReflectionPathsTest, ChangedLightTakesFurtherPaths)
{
	ASSERT_TRUE(LoadPlate());
	SetVariable("r.RT.Rays.CountEnds", "1");
	const FImage Truth = TraceLast(), Before = TraceLast(4);
	const auto Measure = [&](bool bMoves, uint32_t First, FReflectionCounts& OutCounts) {
		const double Error = MeasureErrorOfChanged(RenderLast(bMoves, First), Truth, Before);
		EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
		OutCounts = GetEngine().GetRenderer().GetReflectionCounts();
		return Error;
	};
	FReflectionCounts Right, Still, Few, None;
	const double Error = Measure(true, 1, Right);
	Measure(false, Frames - 12, Still);
	SetVariable("r.RT.Reflections.ChangedPaths", "0.125");
	Measure(true, Frames - 12, Few);
	SetVariable("r.RT.Reflections.ChangedPaths", "1");
	SetVariable("r.RT.Reflections.ChangedSamples", "1");
	const double Fault = Measure(true, 1, None);
	SetVariable("r.RT.Reflections.ChangedSamples", "4");
	SetVariable("r.RT.Rays.CountEnds", "0");
	PrintFigure(fmt::format("relative square error where light has changed {:.5f} with {} further paths beside {}, {:.5f} without", Error,
	    Right.Further, Right.Mirrors, Fault));
	EXPECT_LT(Error, 0.5 * Fault);
	EXPECT_EQ(Right.Further % 3, 0u) << "each of these pixels has four";
	EXPECT_GT(Right.Further, 0u);
	EXPECT_LT(Right.Further, Right.Mirrors);
	EXPECT_EQ(Still.Further, 0u);
	EXPECT_GT(Few.Further, 0u);
	EXPECT_LT(Few.Further, Few.Mirrors / 7);
	EXPECT_EQ(None.Further, 0u);
}

// Two mirrors that face each other, with a lit floor between them. Paths follow some of the mirrors, and end in the light around the last:
// they are not black for it. Planted fault: they are.
TEST_F(FReflectionPathsTest, FacingMirrorsAreNotBlack)
{
	FTestScene Room("facing mirrors");
	FHostMaterial Silver;
	Silver.Roughness = 0.0f;
	Silver.BaseColor = glm::vec4(0.95f, 0.95f, 0.95f, 1.0f);
	const int32_t Mirror = Room.AddMaterial(Silver);
	Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Room.AddLambert(glm::vec3(0.6f), glm::vec3(0), true), 6.0f)}));
	for (const float Side : {-1.0f, 1.0f})
	{
		Room.AddNode(Room.AddMesh({{Mirror, {{4 * Side, 0, Side}, {-4 * Side, 0, Side}, {-4 * Side, 4, Side}, {4 * Side, 4, Side}}}}));
	}
	ASSERT_TRUE(Load(std::move(Room.Scene)));
	SetSun(6.0, 1.0f, {0.3, -1.0, 0.1});
	SetSky({0.3f, 0.4f, 0.6f});
	const FView View = LookAt({0, 1.2, 0.6}, {0.15, 0.9, -1}, 0.9f, 96, 64);
	FReferenceSettings Settings;
	Settings.View = View;
	Settings.Samples = 64;
	Settings.Signal = ESignal::Reflections;
	Settings.bRasterSurfaces = true;
	const double Truth = MeanGreen(TraceReference(Settings));
	const auto Measure = [&] {
		GetEngine().SetFrameIndex(0);
		return MeanGreen(RenderSignal(ESignal::Reflections, View, Frames)) / Truth;
	};
	SetVariable("r.RT.Rays.CountEnds", "1");
	const double Right = Measure();
	EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	const FReflectionCounts Counts = GetEngine().GetRenderer().GetReflectionCounts();
	EXPECT_GT(Counts.Mirrors, 4000u);
	EXPECT_EQ(Counts.Sharp + Counts.Wide, 0u) << "the floor has no reflections";
	EXPECT_EQ(Counts.Sky + Counts.Cells + Counts.StandIns + Counts.Dark + Counts.None, Counts.Mirrors + Counts.Further)
	    << "each path has one end";
	EXPECT_GT(Counts.StandIns, Counts.Mirrors / 10);
	EXPECT_LT(Counts.Dark, Counts.Mirrors / 20);
	SetVariable("r.RT.Rays.CountEnds", "0");
	SetVariable("r.RT.Debug.GI.LastMirror", "0");
	const double Fault = Measure();
	PrintFigure(fmt::format("facing mirrors over the reference: {:.3f}, and {:.3f} if paths end black", Right, Fault));
	EXPECT_NEAR(Right, 1.0, 0.15);
	EXPECT_LT(Fault, Right - 0.1);
}

// A mirror that fills the view shows an even sky as it is, in pictures of any size.
TEST_F(FReflectionPathsTest, AnyPictureSizeIsComplete)
{
	FTestScene Room("mirror alone");
	FHostMaterial Silver;
	Silver.Roughness = 0.0f;
	Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Room.AddMaterial(Silver), 20.0f)}));
	ASSERT_TRUE(Load(std::move(Room.Scene)));
	SetSun(0.0, 0.0f);
	SetSky({0.5f, 0.5f, 0.5f});
	SetVariable("r.RT.Rays.CountEnds", "1");
	for (const auto& [Width, Height] : {std::pair{1u, 1u}, {131u, 73u}, {17u, 1u}, {3u, 40u}})
	{
		const FImage Picture = RenderSignal(ESignal::Reflections, LookAt({0, 2, 0}, {0, 0, -2}, 0.6f, Width, Height), 2);
		ASSERT_EQ(Picture.Width, Width);
		EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
		const FReflectionCounts Counts = GetEngine().GetRenderer().GetReflectionCounts();
		EXPECT_EQ(Counts.Mirrors, Width * Height);
		EXPECT_EQ(Counts.Sky, Width * Height);
		for (size_t I = 0; I < Picture.Pixels.size(); ++I) { ASSERT_NEAR(Picture.Pixels[I], 0.5f, 0.01f) << Width << " x " << Height; }
	}
}

// Spheres of roughness 0 to 1, without the filter. Cells make them off by what they blur.
TEST_F(FReflectionPathsTest, SpheresAsTheReference)
{
	REQUIRE_SCENE(Scene, "roughness/scene.gltf");
	ASSERT_TRUE(Load(Scene));
	SetSky({0.6f, 0.7f, 0.8f});
	SetSun(0.533);
	SetVariable("r.RT.Reflections.Samples", "16");
	SetVariable("r.RT.Reflections.Denoise", "0");
	ExpectUnbiased("spheres, reflections by cells", ESignal::Reflections, MakeView(96, 54), 2, 32, UnlimitedBounces, 0.02);
}

} // namespace
} // namespace Lantern
