// Sun shadows with fewer rays where they tell nothing new: how many are traced, and that the picture is that of all rays.
#include "DenoiseFixture.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
class FSettledTilesTest : public FDenoiseTest
{
protected:
	static constexpr uint32_t Width = 128, Height = 72;
	static constexpr uint32_t Settling = 24; ///< frames after which everything that can settle has

	void SetUp() override
	{
		FDenoiseTest::SetUp();
		UseFilter();
		SetVariable("r.RT.Rays.Count", "1");
		SetVariable("r.RT.Lights", "0");          // the sun's rays alone count
		SetVariable("r.RT.Shadow.MoreRays", "0"); // and of these, the first of each pixel
	}
	struct FPlayed
	{
		std::vector<FImage> Images;
		double RaysPerPixel = 0.0; ///< of the frames from the first counted one on
	};
	/// CountFrom: the first frame whose rays count.
	FPlayed Play(bool bAdaptive, FSequence Sequence, uint32_t CountFrom = 0)
	{
		SetVariable("r.RT.Shadow.Adaptive", bAdaptive ? "1" : "0");
		FRenderer& Renderer = GetEngine().GetRenderer();
		uint64_t Before = 0;
		const std::function<void(uint32_t)> Change = Sequence.Change;
		Sequence.Change = [&](uint32_t Frame) {
			if (Frame == CountFrom)
			{
				EXPECT_OK(Renderer.WaitForAll());
				Before = Renderer.GetRayCounts().Total;
			}
			if (Change) { Change(Frame); }
		};
		FPlayed Played;
		Played.Images = RenderSequence(Sequence);
		EXPECT_OK(Renderer.WaitForAll());
		const FImage& Last = Played.Images.back();
		const double Pixels = double(Last.Width) * Last.Height * (Sequence.Frames - CountFrom);
		Played.RaysPerPixel = double(Renderer.GetRayCounts().Total - Before) / Pixels;
		return Played;
	}
	static double MeanOfLast(const std::vector<FImage>& Images, size_t Count)
	{
		double Sum = 0.0;
		for (size_t I = Images.size() - Count; I < Images.size(); ++I) { Sum += MeanGreen(Images[I]); }
		return Sum / double(Count);
	}
	static FCameraPath Still(FView View)
	{
		View.DeltaSeconds = 1.0f / 60.0f;
		return [View](uint32_t) { return View; };
	}

	/// A floor, and far beside it a swarm of leaves, each as large as a pixel of LookDown. Its shadow falls on what the camera sees once
	/// the swarm is at SwarmPlace. Leaves so small fall between the pixels that a settled tile traces.
	void LoadSwarm()
	{
		FTestScene Scene("swarm");
		const int32_t Lambert = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Lambert, 20.0f)}));
		std::vector<FTestScene::FQuad> Leaves;
		uint32_t State = 1;
		const auto Random = [&State] {
			State = State * 1664525u + 1013904223u;
			return float(State >> 8) / float(1u << 24) - 0.5f;
		};
		for (int I = 0; I < 100; ++I)
		{
			const float X = 5.0f * Random(), Z = 2.8f * Random();
			Leaves.push_back(FTestScene::MakeFloor(Lambert, 0.02f, 0.0f, {X, Z}));
		}
		Scene.AddNode(Scene.AddMesh(Leaves));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.01, 4.0f, {1, -1, 0});
		SetSwarm(glm::dvec3(0, 3, 1000));
	}
	static constexpr glm::dvec3 SwarmPlace{-6, 6, 0}; // its shadow lies around the origin, and the camera does not see it
	static FRTObjectId GetSwarm() { return GetScene().GetDraws()[1].Object; }
	static void SetSwarm(glm::dvec3 Position)
	{
		glm::dmat4 Transform(1.0);
		Transform[3] = glm::dvec4(Position, 1.0);
		GetScene().GetScene().SetTransform(GetSwarm(), Transform);
	}
	static FView LookDown() { return LookAt({0, 3.0, 0}, {0, 0, 0}, 0.9f, Width, Height); }
};

// What is still is known: a quarter of the rays, and those of penumbrae.
TEST_F(FSettledTilesTest, StillSceneTracesAThird)
{
	ASSERT_TRUE(Load("courtyard"));
	FSequence Sequence;
	Sequence.Camera = Still(MakeView(240, 135));
	Sequence.Frames = Settling + 16;
	const FPlayed All = Play(false, Sequence, Settling), Few = Play(true, Sequence, Settling);
	const double Mean = MeanOfLast(Few.Images, 16), Right = MeanOfLast(All.Images, 16);
	PrintFigure(fmt::format(
	    "courtyard, still: {:.3f} rays per pixel of {:.3f}; mean {:.5f} of {:.5f}", Few.RaysPerPixel, All.RaysPerPixel, Mean, Right));
	EXPECT_LE(Few.RaysPerPixel, 0.35);
	// Both trace the same rays where they trace: what differs is a pixel of a settled tile here and there, for a frame.
	EXPECT_NEAR(Mean, Right, 5e-4);
}

TEST_F(FSettledTilesTest, MovingCameraTracesMore)
{
	ASSERT_TRUE(Load("courtyard"));
	const FView Start = MakeView(240, 135);
	FSequence Sequence;
	Sequence.Camera = [&](uint32_t Frame) {
		FView View = Move(Start, 0.02 * Frame, 0.01 * Frame, 0.2 * Frame);
		View.DeltaSeconds = 1.0f / 60.0f;
		return View;
	};
	Sequence.Frames = Settling + 16;
	const FPlayed All = Play(false, Sequence, Settling), Few = Play(true, Sequence, Settling);
	const double Mean = MeanOfLast(Few.Images, 16), Right = MeanOfLast(All.Images, 16);
	PrintFigure(fmt::format(
	    "courtyard, moving: {:.3f} rays per pixel of {:.3f}; mean {:.5f} of {:.5f}", Few.RaysPerPixel, All.RaysPerPixel, Mean, Right));
	EXPECT_LE(Few.RaysPerPixel, 0.6);
	EXPECT_NEAR(Mean, Right, 1e-3);
}

// Further rays go where histories fail: into a picture that moves, not into one that stands still.
TEST_F(FSettledTilesTest, MoreRaysWhereHistoriesFail)
{
	ASSERT_TRUE(Load("courtyard"));
	const FView Start = MakeView(240, 135);
	FSequence Sequence;
	Sequence.Camera = Still(Start);
	Sequence.Frames = Settling + 8;
	const double Few = Play(true, Sequence, Settling).RaysPerPixel;
	FSequence Moving = Sequence;
	Moving.Camera = [&](uint32_t Frame) {
		FView View = Move(Start, 0.0, 0.0, 0.1 * Frame);
		View.DeltaSeconds = 1.0f / 60.0f;
		return View;
	};
	const double FewMoving = Play(true, Moving, Settling).RaysPerPixel;
	SetVariable("r.RT.Shadow.MoreRays", "8");
	EXPECT_EQ(Play(true, Sequence, Settling).RaysPerPixel, Few);
	const double More = Play(true, Moving, Settling).RaysPerPixel;
	PrintFigure(fmt::format("courtyard, turning by 6 degrees a second: {:.3f} rays per pixel instead of {:.3f}", More, FewMoving));
	EXPECT_GT(More, FewMoving + 0.1);
	EXPECT_LT(More, FewMoving + 3.0);
	const FImage First = RenderSequence(Moving).back(), Again = RenderSequence(Moving).back();
	EXPECT_EQ(First.Pixels, Again.Pixels);
}

// Whatever changes shadows shows in its own frame, and bit for bit as if all rays were traced: the floor is lit all over before.
TEST_F(FSettledTilesTest, ChangesShowAtOnce)
{
	ASSERT_NO_FATAL_FAILURE(LoadSwarm());
	struct FCase
	{
		const char* What;
		bool bTold; ///< by the list of moved casters: without it, leaves are missed
		std::function<void(uint32_t Frame)> Change;
	};
	const glm::dvec3 Away(0, 3, 1000);
	FRTScene& Scene = GetScene().GetScene();
	FRTObjectId Added;
	const auto SetMask = [&](bool bCasts) { Scene.SetMask(GetSwarm(), bCasts ? MaskDefault : MaskVisible); };
	const FCase Cases[] =
	    {
	        {"moved", true, [&](uint32_t Frame) { SetSwarm(Frame == Settling ? SwarmPlace : Away); }},
	        {"added", true,
	            [&](uint32_t Frame) {
		SetSwarm(Away);
		if (Frame == Settling + 1) { Scene.RemoveObject(Added); }
		if (Frame != Settling) { return; }
		FRTObjectInfo Info = Scene.GetObject(GetSwarm());
		Info.Transform[3] = glm::dvec4(SwarmPlace, 1.0);
		Added = Scene.AddObject(Info);
	         }},
	        {"casts", true,
	            [&](uint32_t Frame) {
		SetSwarm(SwarmPlace);
		SetMask(Frame == Settling);
	         }},
	            {"sun", false,
	                [&](uint32_t Frame) {
		SetMask(true);
		SetSwarm(SwarmPlace);
		SetSun(0.01, 4.0f, Frame == Settling ? glm::dvec3(1, -1, 0) : glm::dvec3(0, -1, 0));
	             }},
	    {"moved and stays", true,
	        [&](uint32_t Frame) {
		SetSun(0.01, 4.0f, {1, -1, 0});
		SetSwarm(Frame >= Settling ? SwarmPlace : Away);
	     }},
	    };
	for (const FCase& Case : Cases)
	{
		FSequence Sequence;
		Sequence.Camera = Still(LookDown());
		Sequence.Frames = Settling + 4;
		Sequence.Change = Case.Change;
		const std::vector<FImage> Right = Play(false, Sequence).Images;
		EXPECT_EQ(MeanGreen(Right[Settling - 1]), 1.0) << Case.What;
		EXPECT_LT(MeanGreen(Right[Settling]), 0.999) << Case.What << ": there is no shadow";
		const FPlayed Few = Play(true, Sequence, Settling - 4);
		PrintFigure(fmt::format("{}: {:.3f} rays per pixel", Case.What, Few.RaysPerPixel));
		for (uint32_t Frame = 0; Frame < Sequence.Frames; ++Frame)
		{
			EXPECT_EQ(Few.Images[Frame].Pixels, Right[Frame].Pixels) << Case.What << ", frame " << Frame;
		}
		SetVariable("r.RT.Debug.Shadow.Capsules", "0");
		const std::vector<FImage> Faulty = Play(true, Sequence).Images;
		SetVariable("r.RT.Debug.Shadow.Capsules", "1");
		EXPECT_EQ(Faulty[Settling].Pixels != Right[Settling].Pixels, Case.bTold) << Case.What;
	}
}

// Stability cases 11 and 10: a fan, and a cube that crosses the picture. What is left out never shows: pixels whose rays disagree send
// their tile to the second queue.
TEST_F(FSettledTilesTest, MovingShadowsAreThoseOfAllRays)
{
	for (const char* const Name : {"stability-fan", "stability-ghost"})
	{
		ASSERT_TRUE(Load(Name));
		FSequence Sequence;
		Sequence.Camera = Still(MakeView(Width, Height));
		Sequence.Time = [](uint32_t Frame) { return double(Frame) / 60.0; };
		Sequence.Frames = 60;
		const FPlayed All = Play(false, Sequence, Settling), Few = Play(true, Sequence, Settling);
		double Worst = 0.0, Error = 0.0;
		for (uint32_t Frame = Settling; Frame < Sequence.Frames; ++Frame)
		{
			Worst = std::max(Worst, FractionDiffering(Few.Images[Frame], All.Images[Frame], 0.1));
			Error += std::abs(MeanGreen(Few.Images[Frame]) - MeanGreen(All.Images[Frame])) / (Sequence.Frames - Settling);
		}
		PrintFigure(fmt::format("{}: {:.3f} rays per pixel of {:.3f}; worst frame {:.2f} % of pixels differ by a tenth, means by {:.5f}",
		    Name, Few.RaysPerPixel, All.RaysPerPixel, 100 * Worst, Error));
		EXPECT_LE(Worst, 2e-3) << Name;
		EXPECT_LE(Error, 2e-4) << Name;
	}
}

/// Mean step from one column or row to the next, at borders of tiles and elsewhere.
struct FSteps
{
	double Border = 0.0, Inside = 0.0;
	double GetRatio() const { return Border / Inside; }
};
FSteps MeasureSteps(const FImage& Image, uint32_t Period)
{
	FSteps Steps;
	size_t Borders = 0, Others = 0;
	for (uint32_t Y = 1; Y < Image.Height; ++Y)
	{
		for (uint32_t X = 1; X < Image.Width; ++X)
		{
			for (const bool bX : {true, false})
			{
				const double Step = std::abs(Image.At(X, Y, 0) - Image.At(X - (bX ? 1 : 0), Y - (bX ? 0 : 1), 0));
				const bool bBorder = (bX ? X : Y) % Period == 0;
				(bBorder ? Steps.Border : Steps.Inside) += Step;
				++(bBorder ? Borders : Others);
			}
		}
	}
	Steps.Border /= double(Borders);
	Steps.Inside /= double(Others);
	return Steps;
}

// Stability case 20: nothing of tiles or of their pattern shows in a wide penumbra.
TEST_F(FSettledTilesTest, TilesLeaveNoSeams)
{
	ASSERT_TRUE(Load("stability-seams"));
	FSequence Sequence;
	Sequence.Camera = Still(MakeView(240, 136));
	Sequence.Frames = Settling + 16;
	const FPlayed All = Play(false, Sequence);
	for (const bool bFar : {false, true})
	{
		SetVariable("r.RT.Shadow.RateDistance", bFar ? "1" : "0"); // all that is seen is farther than four times that
		const FPlayed Few = Play(true, Sequence, Settling);
		for (const uint32_t Period : {2u, 4u, 8u})
		{
			const FSteps Steps = MeasureSteps(Few.Images.back(), Period), Right = MeasureSteps(All.Images.back(), Period);
			PrintFigure(
			    fmt::format("seams{}, {:.3f} rays per pixel: steps at every {} pixels {:.5f}, {:.2f} times those elsewhere; of all rays "
			                "{:.5f}, {:.2f} times",
			        bFar ? ", far away" : "", Few.RaysPerPixel, Period, Steps.Border, Steps.GetRatio(), Right.Border, Right.GetRatio()));
			EXPECT_LE(Steps.GetRatio(), 1.1 * Right.GetRatio()) << Period;
		}
	}
	SetVariable("r.RT.Shadow.RateDistance", "0");
}

// Far away, a quarter of the pixels is traced, and the mean stays.
TEST_F(FSettledTilesTest, RateFallsWithDistance)
{
	ASSERT_TRUE(Load("courtyard"));
	SetVariable("r.RT.Shadow.Denoise", "0");
	FSequence Sequence;
	Sequence.Camera = Still(MakeView(240, 135));
	Sequence.Frames = 8;
	const FPlayed All = Play(false, Sequence);
	SetVariable("r.RT.Shadow.RateDistance", "0.01");
	const FPlayed Quarter = Play(false, Sequence);
	SetVariable("r.RT.Shadow.RateDistance", "8");
	const FPlayed Some = Play(false, Sequence);
	SetVariable("r.RT.Shadow.RateDistance", "0");
	PrintFigure(fmt::format("courtyard: {:.3f} rays per pixel, a quarter is {:.3f}, from 8 m on {:.3f}; means {:.4f}, {:.4f}, {:.4f}",
	    All.RaysPerPixel, Quarter.RaysPerPixel, Some.RaysPerPixel, MeanOfLast(All.Images, 8), MeanOfLast(Quarter.Images, 8),
	    MeanOfLast(Some.Images, 8)));
	EXPECT_NEAR(Quarter.RaysPerPixel, 0.25 * All.RaysPerPixel, 0.01);
	EXPECT_LT(Some.RaysPerPixel, 0.9 * All.RaysPerPixel);
	EXPECT_GT(Some.RaysPerPixel, 1.1 * Quarter.RaysPerPixel);
	EXPECT_NEAR(MeanOfLast(Quarter.Images, 8), MeanOfLast(All.Images, 8), 0.005) << "leaves and edges are filled from their neighbours";
}

// A smaller disk makes a narrower penumbra; 0 makes it hard.
TEST_F(FSettledTilesTest, SourceScaleNarrowsThePenumbra)
{
	ASSERT_TRUE(Load("penumbra:1"));
	UseRays(64);
	const auto CountSoft = [&](const char* Scale) {
		SetVariable("r.RT.Shadow.SourceScale", Scale);
		const FImage Image = RenderSunShadow(MakeView(64, 64));
		return std::count_if(Image.Pixels.begin(), Image.Pixels.end(), [](float V) { return V > 0.02f && V < 0.98f; }) / 64.0;
	};
	const double Whole = CountSoft("1"), Half = CountSoft("0.5"), None = CountSoft("0");
	PrintFigure(fmt::format("penumbra: {} pixels, half the disk {}, no disk {}", Whole, Half, None));
	EXPECT_NEAR(Half, 0.5 * Whole, 1.0);
	EXPECT_EQ(None, 0.0);
}

// Pebbles that culling hides from rays shadow the floor at their feet, and nothing else does.
TEST_F(FSettledTilesTest, ContactShadowsOfWhatIsCulled)
{
	FTestScene Scene("pebbles");
	const int32_t Lambert = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Lambert, 20.0f)}));
	// Cubes of 10 cm: a top and four sides.
	std::vector<FTestScene::FQuad> Quads = {FTestScene::MakeFloor(Lambert, 0.05f, 0.1f)};
	for (const glm::vec2 Side : {glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(-1, 0), glm::vec2(0, -1)})
	{
		const auto Corner = [&](float Y, float Along) {
			return glm::vec3(0.05f * (Side.x - Along * Side.y), Y, 0.05f * (Side.y + Along * Side.x));
		};
		Quads.push_back({Lambert, {Corner(0, -1), Corner(0, 1), Corner(0.1f, 1), Corner(0.1f, -1)}});
	}
	const int32_t Cube = Scene.AddMesh(Quads);
	for (int I = 0; I < 9; ++I)
	{
		glm::dmat4 Transform(1.0);
		Transform[3] = {0.4 * (I % 3 - 1), 0, 0.4 * (I / 3 - 1), 1};
		Scene.AddNode(Cube, Transform);
	}
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.1, 4.0f, {1, -1, 0.2});
	UseRays(1);
	const FView View = LookAt({-0.3, 1.4, 1.0}, {0, 0, 0}, 0.9f, 192, 108);
	const auto Render = [&](const char* MinPixels, const char* Contact) {
		SetVariable("r.RT.Culling.Shadow.MinPixels", MinPixels);
		SetVariable("r.RT.Shadow.Contact", Contact);
		return RenderSunShadow(View);
	};
	const FImage Rays = Render("0", "0"), Lost = Render("100", "0"), Contact = Render("100", "1");
	EXPECT_EQ(Render("0", "1").Pixels, Rays.Pixels) << "where all cast rays, contacts add nothing";
	size_t Shadowed = 0, Found = 0, Wrong = 0;
	for (size_t I = 0; I < Rays.Pixels.size(); ++I)
	{
		Shadowed += Rays.Pixels[I] < 0.5f && Lost.Pixels[I] > 0.5f ? 1 : 0;
		Found += Rays.Pixels[I] < 0.5f && Lost.Pixels[I] > 0.5f && Contact.Pixels[I] < 0.5f ? 1 : 0;
		Wrong += Rays.Pixels[I] > 0.5f && Contact.Pixels[I] < 0.5f ? 1 : 0;
	}
	PrintFigure(fmt::format("contacts: {} pixels lack their shadow, {} have it back, {} have one they should not", Shadowed, Found, Wrong));
	EXPECT_GT(Shadowed, 200u);
	EXPECT_GT(Found, Shadowed / 2);
	EXPECT_LT(Wrong, Shadowed / 5) << "depth knows no thickness: a tenth of the shadow lies where the cube's back is not";
}
} // namespace
} // namespace Lantern
