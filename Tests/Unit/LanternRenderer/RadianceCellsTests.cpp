// Radiance cells on the mock: what their passes are told of changes of the scene, and of the table's size.
#include <cmath>
#include <cstring>

#include "RadianceCellTypes.h"
#include "SettledTypes.h"
#include "Support/MockReads.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

constexpr float QuietFrames = 6.0f; // r.RT.GI.Cells.Seconds in frames

class FRadianceCellsMockTest : public FRendererTest
{
protected:
	/// What the passes of the last frame were told.
	FRadianceGrid GetTold()
	{
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			if (Call.Name.rfind("RadianceCells/Commit.comp", 0) != 0) { continue; }
			FRadianceCellConstants Push{};
			std::memcpy(&Push, Call.Bytes.data(), std::min(sizeof(Push), Call.Bytes.size()));
			return ReadMockEntry<FRadianceGrid>(Mock(), Push.Grid, 0);
		}
		ADD_FAILURE() << "no cells were updated";
		return {};
	}
	FRadianceGrid RenderAndGetTold()
	{
		Render();
		return GetTold();
	}
	/// Frames until what changed is no event any more.
	void Wait()
	{
		for (int Frame = 0; Frame < 20; ++Frame) { Render(); }
	}
	FRTScene& GetScene() { return Engine->GetScene().GetScene(); }
	void TurnSun(double Degrees)
	{
		FSunLight Sun = GetScene().GetSun();
		Sun.Direction = {std::sin(glm::radians(Degrees)), -std::cos(glm::radians(Degrees)), 0.0};
		GetScene().SetSun(Sun);
	}
	void Start(const FContent& Content)
	{
		Set("r.RT.GI", "3");
		Set("r.RT.GI.Cells.Seconds", "0.1");
		LoadAndRender(Content);
		TurnSun(0.0);
		Wait();
		Wait(); // a new table averages over less
	}
};

TEST_F(FRadianceCellsMockTest, ASunThatJumpsMakesThemForgetForAWhile)
{
	Start({.bSky = true});
	const FRadianceGrid Quiet = RenderAndGetTold();
	EXPECT_NEAR(Quiet.Window, QuietFrames, 0.1f);
	EXPECT_EQ(Quiet.EventCount, 0u);
	TurnSun(50.0);
	const FRadianceGrid Jump = RenderAndGetTold();
	EXPECT_EQ(Jump.Window, 4.0f);
	EXPECT_GT(Jump.Budget, Quiet.Budget);
	EXPECT_EQ(RenderAndGetTold().Window, 4.0f) << "a frame later";
	Wait();
	EXPECT_EQ(RenderAndGetTold().Window, Quiet.Window);
	EXPECT_EQ(GetTold().Budget, Quiet.Budget);
}

TEST_F(FRadianceCellsMockTest, ASlowSunLimitsThemByItsSpeed)
{
	Start({});
	double Degrees = 0.0;
	const auto Sweep = [&](double Speed) {
		Wait();
		TurnSun(Degrees += Speed);
		return RenderAndGetTold().Window;
	};
	EXPECT_NEAR(Sweep(0.001), QuietFrames, 0.1f);
	EXPECT_NEAR(Sweep(0.2), 5.0f, 0.1f) << "a degree";
	Set("r.RT.Debug.GI.Events", "0");
	EXPECT_NEAR(Sweep(10.0), QuietFrames, 0.1f) << "the planted fault";
}

TEST_F(FRadianceCellsMockTest, StrengthsOfSunAndSkyCount)
{
	Start({.bSky = true});
	GetScene().SetSky(glm::vec3(0.5f));
	EXPECT_EQ(RenderAndGetTold().Window, 4.0f);
	Wait();
	FSunLight Sun = GetScene().GetSun();
	Sun.Irradiance *= 0.98f;
	GetScene().SetSun(Sun);
	EXPECT_NEAR(RenderAndGetTold().Window, 5.0f, 0.1f) << "a tenth";
}

TEST_F(FRadianceCellsMockTest, MovedObjectsTellWhere)
{
	Start({});
	EXPECT_EQ(GetTold().MoverCount, 0u);
	EXPECT_FALSE(HasPass("MovedShare")) << "nothing moves";
	const FRTObjectId Object = Engine->GetScene().GetDraws()[0].Object;
	const auto MoveTo = [&](double X) {
		glm::dmat4 Transform(1.0);
		Transform[3].x = X;
		GetScene().SetTransform(Object, Transform);
	};
	MoveTo(0.25);
	Render();
	MoveTo(0.5);
	const FRadianceGrid Told = RenderAndGetTold();
	EXPECT_NEAR(Told.Window, QuietFrames, 0.1f) << "elsewhere nothing has changed";
	EXPECT_EQ(Told.EventCount, 0u);
	ASSERT_EQ(Told.MoverCount, 1u) << "both moves are of one object";
	const auto Mover = ReadMockEntry<FMovedCaster>(Mock(), Told.Movers, 0);
	EXPECT_NEAR(Mover.To.x - Mover.From.x, 0.5f, 1e-5f);
	EXPECT_NEAR(Mover.Changed, 0.5f / (2.0f * Mover.Radius), 1e-3f) << "its way over its width";
	EXPECT_TRUE(HasPass("MovedShare")) << "the filter is told as well";
	Set("r.RT.Debug.GI.Events", "0");
	EXPECT_EQ(RenderAndGetTold().MoverCount, 0u) << "the planted fault";
	EXPECT_FALSE(HasPass("MovedShare"));
	Set("r.RT.Debug.GI.Events", "1");
	Wait();
	EXPECT_EQ(RenderAndGetTold().MoverCount, 0u);
}

TEST_F(FRadianceCellsMockTest, MoversThatHideMostCountFirst)
{
	Start({});
	const FRTObjectId First = Engine->GetScene().GetDraws()[0].Object;
	FRTObjectInfo Info = GetScene().GetObject(First);
	for (int I = 0; I < int(SETTLED_MOST_CASTERS) + 40; ++I)
	{
		Info.Transform = glm::dmat4(1.0);
		Info.Transform[3] = {I < 40 ? 1000.0 + I : 0.01 * I, 0, 0, 1};
		GetScene().AddObject(Info);
	}
	const FRadianceGrid Told = RenderAndGetTold();
	ASSERT_EQ(Told.MoverCount, uint32_t(SETTLED_MOST_CASTERS));
	for (uint32_t I = 0; I < Told.MoverCount; ++I)
	{
		const auto Mover = ReadMockEntry<FMovedCaster>(Mock(), Told.Movers, I);
		ASSERT_LT(Mover.To.x, 100.0f) << "what is far away had no room";
		ASSERT_EQ(Mover.Changed, 1.0f) << "it came";
	}
}

TEST_F(FRadianceCellsMockTest, LampsTellHowMuchTheyBring)
{
	Start({.bLights = true});
	const FRadianceGrid Quiet = GetTold();
	EXPECT_EQ(Quiet.EventCount, 0u);
	EXPECT_FALSE(HasPass("MovedShare"));
	FSceneLight Lamp;
	Lamp.Position = {1, 2, 3};
	Lamp.Color = glm::vec3(100.0f);
	Lamp.Range = 7.0f;
	const FLightId Id = GetScene().AddLight(Lamp);
	const FRadianceGrid Told = RenderAndGetTold();
	ASSERT_EQ(Told.EventCount, 1u);
	const auto Event = ReadMockEntry<FRadianceEvent>(Mock(), Told.Events, 0);
	EXPECT_EQ(Event.Radius, 7.0f);
	EXPECT_NEAR(Event.Strength, 100.0f, 1e-3f);
	EXPECT_GT(Told.Budget, Quiet.Budget) << "all of it is new";
	EXPECT_NEAR(Told.Window, QuietFrames, 0.1f) << "elsewhere nothing has changed";
	EXPECT_TRUE(HasPass("MovedShare")) << "the filter is told as well";
	Wait();
	EXPECT_EQ(RenderAndGetTold().EventCount, 0u);
	for (const float Dimmed : {90.0f, 95.0f, 94.0f})
	{
		Lamp.Color = glm::vec3(Dimmed);
		GetScene().SetLight(Id, Lamp);
		Render();
	}
	const FRadianceGrid Flickers = RenderAndGetTold();
	ASSERT_EQ(Flickers.EventCount, 1u) << "one lamp";
	const float Strength = ReadMockEntry<FRadianceEvent>(Mock(), Flickers.Events, 0).Strength;
	EXPECT_LE(Strength, 10.0f) << "the greatest change of late, and less of it with each one after it";
	EXPECT_GT(Strength, 5.0f);
	EXPECT_EQ(Flickers.Budget, Quiet.Budget) << "flicker is usual";
	Wait();
	Lamp.Position.x += 50.0;
	GetScene().SetLight(Id, Lamp);
	EXPECT_EQ(RenderAndGetTold().EventCount, 2u) << "where it was, and where it is";
	Set("r.RT.Debug.GI.Events", "0");
	EXPECT_EQ(RenderAndGetTold().EventCount, 0u) << "the planted fault";
	EXPECT_FALSE(HasPass("MovedShare"));
}

TEST_F(FRadianceCellsMockTest, LampsThatBringMostCountFirst)
{
	Start({.bLights = true});
	FSceneLight Lamp;
	Lamp.Color = glm::vec3(100.0f);
	for (uint32_t I = 0; I < RADIANCE_CELL_MOST_EVENTS + 20; ++I)
	{
		Lamp.Position = {I < 20 ? 1000.0 : 0.01 * I, 0, 0};
		GetScene().AddLight(Lamp);
	}
	const FRadianceGrid Told = RenderAndGetTold();
	ASSERT_EQ(Told.EventCount, RADIANCE_CELL_MOST_EVENTS);
	for (uint32_t I = 0; I < Told.EventCount; ++I)
	{
		ASSERT_LT(ReadMockEntry<FRadianceEvent>(Mock(), Told.Events, I).Center.x, 500.0f) << "what is far away had no room";
	}
}

TEST_F(FRadianceCellsMockTest, SizesAreRoundedWithOneMessage)
{
	Set("r.RT.GI.Cells.Capacity", "1000");
	Start({});
	EXPECT_EQ((GetTold().BucketMask + 1) * RADIANCE_CELL_BUCKET, 1024u);
	Set("r.RT.GI.Cells.Capacity", "256");
	EXPECT_EQ((RenderAndGetTold().BucketMask + 1) * RADIANCE_CELL_BUCKET, 256u);
}

} // namespace
} // namespace Lantern
