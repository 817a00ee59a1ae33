// Radiance cells pass on that their light changes, to other cells and to the filter's histories (r.RT.GI.Cells.Change).
#include "CachedGIFixture.h"

namespace Lantern
{

namespace
{
class FRadianceChangeTest : public FCachedGITest
{
protected:
	static constexpr uint32_t Settled = 72; // frames

	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("3");
		SetVariable("r.RT.GI.Denoise", "1");
		SetVariable("r.RT.GI.Rate", "2");
		SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "500000");
	}

	/// The end of a corridor that has all its light by a door and then by other surfaces.
	static FView LookFarFromDoor() { return LookAt({0, 1.6, 0}, {4, 0.9, 0}, 1.2f, 48, 27); }

	void OpenDoor(bool bOpen)
	{
		FHostScene& Scene = GetScene();
		const FSceneDescription& Description = Scene.GetDescription();
		const auto Pose = EvaluatePose(Description, 0.0);
		for (size_t I = 0; I < Scene.GetInstanceCount(); ++I)
		{
			const auto Node = static_cast<size_t>(Scene.GetNode(I));
			if (Description.Nodes[Node].Name != "door") { continue; }
			glm::dmat4 Transform = Pose.World[Node];
			Transform[3].x += bOpen ? 1.5 : 0.0;
			Scene.SetTransform(I, Transform);
		}
	}

	/// Frames with the door open, and with the door shut behind them.
	struct FPlayed
	{
		FImage Lit, Left;
	};
	FPlayed PlayDoor(bool bChange, uint32_t Frames)
	{
		FPlayed Played;
		if (!Load("stability-door")) { return Played; }
		SetVariable("r.RT.GI.Cells.Change", bChange ? "1" : "0");
		RenderSignal(ESignal::DiffuseGI, LookFarFromDoor(), 1); // the first frame poses the scene
		OpenDoor(true);
		RenderSignal(ESignal::DiffuseGI, LookFarFromDoor(), Settled - 1, 1);
		Played.Lit = RenderSignal(ESignal::DiffuseGI, LookFarFromDoor(), 4, Settled);
		OpenDoor(false);
		RenderSignal(ESignal::DiffuseGI, LookFarFromDoor(), Frames, Settled + 4);
		Played.Left = RenderSignal(ESignal::DiffuseGI, LookFarFromDoor(), 4, Settled + 4 + Frames);
		return Played;
	}
};

// The scene tells of a door what lies close by alone. Light that has come by other surfaces is theirs to tell.
TEST_F(FRadianceChangeTest, LightFarFromDoorLeaves)
{
	double Left[2];
	for (const bool bChange : {false, true})
	{
		const FPlayed Played = PlayDoor(bChange, 40);
		ASSERT_GT(MeanGreen(Played.Lit), 0.0);
		Left[bChange] = MeanGreen(Played.Left) / MeanGreen(Played.Lit);
		PrintFigure(fmt::format("door, change {}: 44 frames after it is shut {:.3f} of the light is left", bChange, Left[bChange]));
	}
	EXPECT_LT(Left[true], 0.5 * Left[false]);
}

// Each round of updates brings light one surface further. With one in a frame, it goes round two corners by as many frames as surfaces.
TEST_F(FRadianceChangeTest, LightGoesSeveralSurfacesFurtherInAFrame)
{
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "2500000"); // rounds share a frame's budget
	double Left[2], Lit[2];
	for (const bool bRounds : {false, true})
	{
		SetVariable("r.RT.GI.Cells.Rounds", bRounds ? "4" : "1");
		const FPlayed Played = PlayDoor(true, 12);
		Lit[bRounds] = MeanGreen(Played.Lit);
		ASSERT_GT(Lit[bRounds], 0.0);
		Left[bRounds] = MeanGreen(Played.Left) / Lit[bRounds];
		PrintFigure(fmt::format("door, rounds {}: light {:.5f}, 16 frames after it is shut {:.3f} of it is left", bRounds ? 4 : 1,
		    Lit[bRounds], Left[bRounds]));
	}
	EXPECT_LT(Left[true], 0.7 * Left[false]);
	EXPECT_GT(Lit[true], 0.95 * Lit[false]);
}

// Rays from one slope of a long valley meet the other one far away, where their cells ask for more. There are always more new cells than
// updates, and what pixels ask for must not wait for them: when the sun is gone, its light is not seen for long.
TEST_F(FRadianceChangeTest, NewCellsFarAwayDoNotKeepWhatIsSeenWaiting)
{
	FTestScene Scene("valley");
	const int32_t Ground = Scene.AddLambert(glm::vec3(0.7f));
	constexpr float Long = 300.0f, Wide = 20.0f;
	Scene.AddNode(Scene.AddMesh({{Ground, {{-Wide, Wide, Long}, {0, 0, Long}, {0, 0, -Long}, {-Wide, Wide, -Long}}},
	    {Ground, {{0, 0, Long}, {Wide, Wide, Long}, {Wide, Wide, -Long}, {0, 0, -Long}}}}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	SetSun(0.0, 2.0f, {0.6, -0.8, 0.0});
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "60000");
	const FView View = LookAt({1, 3, 0}, {4, 4, 0}, 0.2f, 24, 24);
	constexpr uint32_t Change = 136; // frame
	RenderSignal(ESignal::DiffuseGI, View, Change - 8);
	const double Before = MeanGreen(RenderSignal(ESignal::DiffuseGI, View, 8, Change - 8));
	ASSERT_GT(Before, 0.0);
	SetSun(0.0, 0.02f, {0.6, -0.8, 0.0});
	RenderSignal(ESignal::DiffuseGI, View, 16, Change);
	const double Left = MeanGreen(RenderSignal(ESignal::DiffuseGI, View, 8, Change + 16)) / Before;
	PrintFigure(fmt::format("valley: 20 frames after the sun has gone, {:.3f} of its light is left", Left));
	EXPECT_LT(Left, 0.25);
}

TEST_F(FRadianceChangeTest, SameBitsAgain)
{
	PlayDoor(true, 4); // shaders are then there, and both others come behind the same changes
	const FPlayed First = PlayDoor(true, 4), Second = PlayDoor(true, 4);
	ASSERT_GT(MeanGreen(First.Left), 0.0);
	EXPECT_EQ(FractionDiffering(First.Left, Second.Left, 0.0), 0.0);
}
} // namespace

} // namespace Lantern
