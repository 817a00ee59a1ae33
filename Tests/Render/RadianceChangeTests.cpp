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

TEST_F(FRadianceChangeTest, SameBitsAgain)
{
	const FPlayed First = PlayDoor(true, 4), Second = PlayDoor(true, 4);
	ASSERT_GT(MeanGreen(First.Left), 0.0);
	EXPECT_EQ(FractionDiffering(First.Left, Second.Left, 0.0), 0.0);
}
} // namespace

} // namespace Lantern
