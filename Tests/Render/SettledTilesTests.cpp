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
	PrintFigure(fmt::format("courtyard, still: {:.3f} rays per pixel of {:.3f}; mean {:.5f} of {:.5f}", Few.RaysPerPixel, All.RaysPerPixel,
	    MeanOfLast(Few.Images, 16), MeanOfLast(All.Images, 16)));
	EXPECT_LE(Few.RaysPerPixel, 0.35);
}

TEST_F(FSettledTilesTest, MovedCasterShowsAtOnce)
{
	ASSERT_NO_FATAL_FAILURE(LoadSwarm());
	FSequence Sequence;
	Sequence.Camera = Still(LookDown());
	Sequence.Frames = Settling + 3;
	Sequence.Change = [](uint32_t Frame) { SetSwarm(Frame == Settling ? SwarmPlace : glm::dvec3(0, 3, 1000)); };
	const std::vector<FImage> Right = Play(false, Sequence).Images;
	EXPECT_EQ(MeanGreen(Right[Settling - 1]), 1.0);
	EXPECT_LT(MeanGreen(Right[Settling]), 0.999) << "the swarm has no shadow";
	const FPlayed Few = Play(true, Sequence);
	PrintFigure(fmt::format("swarm: {:.3f} rays per pixel", Few.RaysPerPixel));
	for (uint32_t Frame = 0; Frame < Sequence.Frames; ++Frame) { EXPECT_EQ(Few.Images[Frame].Pixels, Right[Frame].Pixels) << Frame; }
	SetVariable("r.RT.Debug.Shadow.Capsules", "0");
	const std::vector<FImage> Faulty = Play(true, Sequence).Images;
	EXPECT_NE(Faulty[Settling].Pixels, Right[Settling].Pixels);
}
} // namespace
} // namespace Lantern
