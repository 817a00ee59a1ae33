// Light cells on the mock: what a frame makes for them, and that it makes nothing where nothing has a use for them.
#include <algorithm>
#include <cmath>

#include "Lights/LightCells.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class FLightCellsTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow", "0");
		Set("r.RT.AO", "0");
		Set("r.RT.Lights", "0"); // direct lighting then visits lights itself
	}
	FRTScene& GetWorld() { return Engine->GetScene().GetScene(); }
	FLightId AddLamp(float Range, double X = 0.0)
	{
		FSceneLight Light;
		Light.Position = {X, 0, 1};
		Light.Range = Range;
		Light.Color = glm::vec3(1);
		return GetWorld().AddLight(Light);
	}
	std::vector<std::string> GetCellPasses()
	{
		std::vector<std::string> Names = GetPasses();
		std::erase_if(Names, [](const std::string& Name) { return Name.rfind("LightCells", 0) != 0; });
		return Names;
	}
	/// Memories of tiles that were created.
	size_t CountGuides()
	{
		const auto Calls = Mock().FindCalls(ERTMockCall::CreateBuffer);
		return size_t(std::count_if(Calls.begin(), Calls.end(), [](const FRTMockCall& Call) { return Call.Name == "LightGuide"; }));
	}
	/// Whether something of light cells was created since the device was opened.
	void ExpectNothing()
	{
		EXPECT_THAT(GetCellPasses(), ElementsAre());
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateBuffer))
		{
			EXPECT_EQ(Call.Name.find("LightCell"), std::string::npos);
		}
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("Lights/LightCells"))));
	}
};

TEST_F(FLightCellsTest, ScenesWithoutUseForThemPayNothing)
{
	LoadAndRender({});
	ExpectNothing();
	for (int I = 0; I < 40; ++I) { AddLamp(0.0f); }
	Render();
	ExpectNothing(); // every light reaches everything
	for (int I = 0; I < 15; ++I) { AddLamp(3.0f); }
	Render();
	ExpectNothing(); // too few to look them up
	AddLamp(3.0f);
	Set("r.RT.LocalLights", "0");
	Render();
	ExpectNothing(); // nobody walks them
	Set("r.RT.LocalLights", "1");
	Set("r.RT.Lights.Cells", "0");
	Render();
	ExpectNothing();
	Set("r.RT.Lights.Cells", "1");
	Render();
	EXPECT_THAT(GetCellPasses(),
	    ElementsAre("LightCellsClear", "LightCellsMark", "LightCellsPrepare", "LightCellsBlocks", "LightCells", "LightCellsCount"));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::DispatchIndirect), 2u);
}

TEST_F(FLightCellsTest, ChangesAreToldOnce)
{
	Set("r.RT.Lights.Cells.Least", "1");
	ASSERT_TRUE(Load({}));
	const FLightId Lamp = AddLamp(3.0f);
	Render();
	EXPECT_TRUE(HasPass("LightCellsClear"));
	Render();
	EXPECT_THAT(GetCellPasses(), ElementsAre("LightCellsMark", "LightCellsPrepare", "LightCellsBlocks", "LightCells", "LightCellsCount"));
	FSceneLight Light = GetWorld().GetLights().Get(Lamp);
	Light.Color *= 2.0f;
	GetWorld().SetLight(Lamp, Light);
	Render();
	EXPECT_FALSE(HasPass("LightCellsChange")) << "it reaches what it did";
	Light.Position.x += 1.0;
	GetWorld().SetLight(Lamp, Light);
	// A frame in which nobody asks for cells leaves the change to a later one.
	Set("r.RT.LocalLights", "0");
	Render();
	EXPECT_THAT(GetCellPasses(), ElementsAre());
	Set("r.RT.LocalLights", "1");
	Render();
	EXPECT_TRUE(HasPass("LightCellsChange"));
	EXPECT_FALSE(HasPass("LightCellsClear"));
	Render();
	EXPECT_FALSE(HasPass("LightCellsChange"));
	Set("r.RT.Debug.Lights.Changes", "0");
	AddLamp(2.0f);
	Render();
	EXPECT_FALSE(HasPass("LightCellsChange"));
}

TEST_F(FLightCellsTest, ManyChangesAndFarTravelBeginAnew)
{
	Set("r.RT.Lights.Cells.Least", "1");
	ASSERT_TRUE(Load({}));
	AddLamp(3.0f);
	Render();
	const auto GetRevision = [&] { return Engine->GetRenderer().GetLightCells().GetGrid().Revision; };
	uint32_t Revision = GetRevision();
	Render();
	EXPECT_EQ(GetRevision(), Revision);
	for (uint32_t I = 0; I <= FLightJournal::MostChanges; ++I) { AddLamp(1.0f); }
	Render();
	EXPECT_NE(GetRevision(), Revision) << "nobody remembers all changes";
	EXPECT_FALSE(HasPass("LightCellsChange"));
	Revision = GetRevision();
	Render(0.0, {0, 0, 8'000});
	EXPECT_EQ(GetRevision(), Revision);
	Render(0.0, {0, 0, 9'000});
	EXPECT_NE(GetRevision(), Revision) << "keys of cells would repeat";
	Revision = GetRevision();
	Set("r.RT.Lights.CellMetres", "2");
	Render(0.0, {0, 0, 9'000});
	EXPECT_NE(GetRevision(), Revision);
}

TEST_F(FLightCellsTest, FramesThatAreNotReadMakeNone)
{
	Set("r.RT.Lights.Cells.Least", "1");
	ASSERT_TRUE(Load({}));
	AddLamp(3.0f);
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr));
	EXPECT_THAT(GetCellPasses(), ElementsAre());
	Render();
	EXPECT_TRUE(HasPass("LightCellsClear"));
}

// Where each pixel chooses one light of all, it visits those of its cell. Direct lighting then visits none. Candidates of the pixel's tile
// need no cells.
TEST_F(FLightCellsTest, ShadowedLightsHaveThemWherePixelsChoose)
{
	Set("r.RT.Lights", "1");
	Set("r.RT.Lights.Exact", "4");
	Set("r.RT.Lights.Candidates", "0");
	Set("r.RT.Lights.Cells.Least", "1");
	ASSERT_TRUE(Load({}));
	for (int I = 0; I < 4; ++I) { AddLamp(3.0f); }
	Render();
	EXPECT_TRUE(HasPass("ShadowLightsShade"));
	ExpectNothing(); // each pixel has a ray to each light
	AddLamp(3.0f);
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr));
	EXPECT_THAT(GetCellPasses(), ElementsAre()) << "nobody reads the frame";
	Render();
	EXPECT_THAT(GetCellPasses(),
	    ElementsAre("LightCellsClear", "LightCellsMark", "LightCellsPrepare", "LightCellsBlocks", "LightCells", "LightCellsCount"));
	EXPECT_EQ(CountGuides(), 0u);
	Set("r.RT.Lights.Candidates", "4");
	Mock().ClearCalls();
	Render();
	EXPECT_THAT(GetCellPasses(), ElementsAre());
	EXPECT_EQ(CountGuides(), 1u) << "tiles remember";
}

// Tiles of few lights remember nothing.
TEST_F(FLightCellsTest, GuidesAreWherePixelsChoose)
{
	Set("r.RT.Lights", "1");
	Set("r.RT.Lights.Exact", "4");
	ASSERT_TRUE(Load({}));
	for (int I = 0; I < 4; ++I) { AddLamp(0.0f); }
	Render();
	EXPECT_EQ(CountGuides(), 0u);
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("GUIDED"))));
	AddLamp(0.0f);
	Render();
	EXPECT_EQ(CountGuides(), 1u);
}

// A tile looks at all lights of the scene while they are few enough for it. Where all are visited, regions list none.
TEST_F(FLightCellsTest, RegionsAreWhereTilesCannotLookAtAll)
{
	Set("r.RT.Lights", "1");
	ASSERT_TRUE(Load({}));
	for (uint32_t I = 0; I < 128; ++I) { AddLamp(0.0f); }
	Render();
	EXPECT_FALSE(HasPass("ShadowLightRegions"));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("LocalLights/Regions"))));
	AddLamp(0.0f);
	Render();
	EXPECT_TRUE(HasPass("ShadowLightRegions"));
	Set("r.RT.Lights.Candidates", "0");
	Render();
	EXPECT_FALSE(HasPass("ShadowLightRegions"));
}

TEST_F(FLightCellsTest, DebugViewShowsThem)
{
	Set("r.RT.Debug.View", "light_cells");
	Set("r.RT.Lights.Cells.Least", "1");
	LoadAndRender({});
	EXPECT_FALSE(HasPass("DebugView")) << "there are none, and the picture is shown";
	AddLamp(3.0f);
	Set("r.RT.LocalLights", "0");
	Render();
	EXPECT_TRUE(HasPass("DebugView")) << "it asks for them itself";
	EXPECT_THAT(Mock().GetCreatedPipelines(), Contains(HasSubstr("Lights/LightCellsView.comp")));
}

TEST_F(FLightCellsTest, MemoryIsWhatTheGridTakes)
{
	Set("r.RT.Lights.Cells.Least", "1");
	ASSERT_TRUE(Load({}));
	AddLamp(3.0f);
	Render();
	uint64_t Bytes = 0;
	for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateBuffer))
	{
		if (Call.Name == "LightCells") { Bytes = Call.Numbers[0]; }
	}
	EXPECT_EQ(Bytes, 256 + LIGHT_CELL_HEADERS * 24ull + (1u << 18)) << "lists, stamps, requests, and a quarter of a MiB of slots";
}

TEST_F(FLightCellsTest, LevelsAreCentredAndBeginWithABlock)
{
	Set("r.RT.Lights.Cells.Least", "1");
	ASSERT_TRUE(Load({}));
	AddLamp(3.0f);
	const double Offset = LIGHT_CELL_OFFSET / double(LIGHT_POSITION_STEPS);
	for (const glm::dvec3& Camera : {glm::dvec3(0, 0, 5), glm::dvec3(1.99, -2.01, 5), glm::dvec3(-777.7, 310.2, 4321.0)})
	{
		Render(0.0, Camera);
		const FLightGrid& Grid = Engine->GetRenderer().GetLightCells().GetGrid();
		for (uint32_t Level = 0; Level < LIGHT_CELL_LEVELS; ++Level)
		{
			const double Edge = std::exp2(double(Level));
			const glm::dvec3 First = glm::dvec3(Grid.First[Level]) / double(LIGHT_POSITION_STEPS);
			for (int Axis = 0; Axis < 3; ++Axis)
			{
				EXPECT_EQ(std::remainder(First[Axis], 4.0 * Edge), 0.0) << Level;
				const double Half = Axis == 1 ? 8.0 : 16.0;
				EXPECT_LE(std::abs(First[Axis] + Half * Edge - Camera[Axis] - Offset), 2.0 * Edge) << Level << ", " << Axis;
			}
		}
	}
}

} // namespace
} // namespace Lantern
