// Light cells: their lists against a walk over all lights on the CPU, and pictures with them against pictures without, to the bit.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRenderer/Renderer.h"
#include "LightCellOracle.h"
#include "Lights/LightCells.h"
#include "Support/CoreTestTools.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
class FLightCellsTest : public FRenderTest
{
protected:
	static constexpr uint32_t Width = 61, Height = 43;

	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	static const FLightCellStats& GetStats() { return GetEngine().GetRenderer().GetLightCells().GetStats(); }
	void SetUp() override
	{
		FRenderTest::SetUp();
		SetVariable("r.RT.Lights", "0"); // direct lighting then visits lights itself
	}
	void TearDown() override
	{
		GetEngine().ExtraPasses = {};
		FRenderTest::TearDown();
	}
	/// A floor and some steps around a point of the world, without other light.
	void LoadSteps(const glm::dvec3& At = glm::dvec3(0))
	{
		FTestScene Steps("steps");
		FHostMaterial Glossy; // either lobe has something to compare
		Glossy.BaseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
		Glossy.Metallic = 0.0f;
		Glossy.Roughness = 0.5f;
		const int32_t Grey = Steps.AddMaterial(Glossy);
		Steps.AddNode(Steps.AddMesh({FTestScene::MakeFloor(Grey, 60.0f), FTestScene::MakeFloor(Grey, 4.0f, 1.1f),
		                  FTestScene::MakeFloor(Grey, 2.0f, 2.3f)}),
		    glm::translate(glm::dmat4(1), At));
		ASSERT_TRUE(Load(std::move(Steps.Scene)));
		SetSun(0.0, 0.0f);
		SetSky({});
		SetVariable("r.RT.Lights.Cells.Least", "1");
		Middle = At;
	}
	std::vector<FLightId> AddLights(FNumbers& Numbers, uint32_t Count)
	{
		std::vector<FLightId> Ids;
		for (uint32_t I = 0; I < Count; ++I) { Ids.push_back(GetWorld().AddLight(MakeRandomLight(Numbers, Middle))); }
		return Ids;
	}
	FView LookFrom(const glm::dvec3& From, uint32_t InWidth = Width, uint32_t InHeight = Height) const
	{
		return LookAt(Middle + From, Middle + glm::dvec3(0, 0.5, 0), 1.2f, InWidth, InHeight);
	}
	static FImage Render(const FView& View, ESignal Signal = ESignal::Frame)
	{
		FCapturedFrame Out;
		FFrameCapture Capture;
		Capture.Signals.Add(Signal);
		EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Out));
		return std::move(Out.Get(Signal));
	}
	/// Renders the same frame with cells and without. Returns how many values differ.
	size_t CountDifferences(const FView& View, ESignal Signal = ESignal::Frame)
	{
		const uint32_t Frame = GetEngine().GetFrameIndex();
		SetVariable("r.RT.Lights.Cells", "1");
		const FImage With = Render(View, Signal);
		SetVariable("r.RT.Lights.Cells", "0");
		GetEngine().SetFrameIndex(Frame);
		const FImage Without = Render(View, Signal);
		SetVariable("r.RT.Lights.Cells", "1");
		EXPECT_EQ(With.Pixels.size(), Without.Pixels.size());
		EXPECT_FALSE(With.Pixels.empty());
		size_t Differing = 0;
		for (size_t I = 0; I < std::min(With.Pixels.size(), Without.Pixels.size()); ++I)
		{
			EXPECT_TRUE(std::isfinite(With.Pixels[I]));
			Differing += With.Pixels[I] != Without.Pixels[I] ? 1 : 0;
		}
		EXPECT_GT(MeanGreen(Without), 0.0) << "there is nothing to compare";
		return Differing;
	}
	/// Renders a frame and reads its grid.
	FGridData ReadGrid(const FView& View)
	{
		TRTRef<IRTBuffer> Readback;
		GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs&) {
			ASSERT_TRUE(Context.World->LightCells.Buffer.IsValid());
			const uint64_t Bytes = Context.Graph.GetDesc(Context.World->LightCells.Buffer).Size;
			ASSERT_OK(
			    GetDevice().CreateBuffer({Bytes, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Grid"}, Readback.ReleaseAndGetAddress()));
			const FGraphBuffer Out = Context.Graph.ImportBuffer(Readback.Get(), ERTAccess::None, ERTAccess::HostRead, "Grid");
			Context.Graph.AddPass("ReadGrid", [&](FPassBuilder& Builder) -> FPassExecute {
				Builder.Read(Context.World->LightCells.Buffer, ERTAccess::CopyRead);
				Builder.Write(Out, ERTAccess::CopyWrite);
				return [=, From = Context.World->LightCells.Buffer](
				           FPassContext& Pass) { Pass.Commands().CopyBuffer(Pass.GetBuffer(Out), 0, Pass.GetBuffer(From), 0, Bytes); };
			});
		};
		Render(View);
		GetEngine().ExtraPasses = {};
		FGridData Data;
		if (!Readback) { return Data; }
		const auto* const Bytes = static_cast<const uint8_t*>(Readback->GetMapped());
		Data.Grid = GetEngine().GetRenderer().GetLightCells().GetGrid();
		Data.Cells.resize(LIGHT_CELL_HEADERS);
		std::memcpy(Data.Cells.data(), Bytes + FLightCellBuffer::Cells, LIGHT_CELL_HEADERS * sizeof(FLightCell));
		Data.Pool.resize(Data.Grid.PoolEntries);
		std::memcpy(Data.Pool.data(), Bytes + FLightCellBuffer::Pool, Data.Pool.size() * sizeof(uint32_t));
		return Data;
	}
	/// Holds one list against all lights of the scene.
	void ExpectList(const FGridData& Data, uint32_t Index, const FWorldBox& Box, FNumbers& Numbers)
	{
		const FLightCell& Cell = Data.Cells[Index];
		const uint32_t Count = Cell.State & LIGHT_CELL_COUNT_MASK;
		if ((Cell.State & LIGHT_CELL_OVERFLOW) != 0)
		{
			EXPECT_TRUE(Index >= LIGHT_CELLS || Count > LIGHT_CELL_MOST || GetStats().Missing > 0);
			++Overflows;
			return;
		}
		const std::vector<uint32_t> List = Data.GetList(Cell);
		for (size_t I = 1; I < List.size(); ++I) { ASSERT_LT(List[I - 1], List[I]); }
		const FLightStore& Lights = GetWorld().GetLights();
		for (uint32_t Slot = 0; Slot < Lights.GetSlotCount(); ++Slot)
		{
			const FSceneLight* const Light = Lights.Find(Slot);
			const bool bListed = std::binary_search(List.begin(), List.end(), Slot);
			Listed += bListed ? 1 : 0;
			if (!Light || ReachesEverywhere(*Light))
			{
				ASSERT_FALSE(bListed) << "list " << Index << ", slot " << Slot;
				continue;
			}
			const double Distance = GetDistance(Box, Light->Position);
			// Rounding may let a light in that ends a little short of the cell, never one that ends far from it.
			if (bListed)
			{
				ASSERT_LE(Distance, 1.001 * double(Light->Range) + 0.001 * Box.Edge + 0.01) << "list " << Index << ", slot " << Slot;
			}
			if (bListed || Distance > double(Light->Range)) { continue; }
			for (int Point = 0; Point < 24; ++Point)
			{
				glm::dvec3 P = Box.Min + glm::dvec3(Numbers.Between(0, 1), Numbers.Between(0, 1), Numbers.Between(0, 1)) * Box.Edge;
				// Half of the points lie where a light that hardly reaches the cell reaches it first.
				if (Point % 2 == 0) { P = glm::mix(glm::clamp(Light->Position, Box.Min, Box.Min + Box.Edge), P, 0.02 * Point); }
				ASSERT_FALSE(Shines(*Light, P)) << "list " << Index << " lacks slot " << Slot << " of type " << Light->Type;
			}
			++Refused;
		}
	}
	/// Holds all lists of a frame that are filled against all lights of the scene. Returns how many there are.
	uint32_t ExpectLists(const FGridData& Data, FNumbers& Numbers)
	{
		uint32_t Filled = 0;
		Listed = Refused = Overflows = 0;
		for (uint32_t Index = 0; Index < LIGHT_CELL_EVERYWHERE && !Data.Cells.empty(); ++Index)
		{
			const FLightCell& Cell = Data.Cells[Index];
			if (Cell.Revision != Data.Grid.Revision || (Cell.State & LIGHT_CELL_FILLED) == 0) { continue; }
			const FWorldBox Box = FindBox(Data.Grid, Index);
			if (Cell.Key != Box.Key) { continue; } // of an earlier place of the grid; look-ups know that, too
			++Filled;
			ExpectList(Data, Index, Box, Numbers);
			if (HasFatalFailure()) { return Filled; }
		}
		std::vector<uint32_t> Everywhere;
		const FLightStore& Lights = GetWorld().GetLights();
		for (uint32_t Slot = 0; Slot < Lights.GetSlotCount(); ++Slot)
		{
			if (Lights.Find(Slot) && ReachesEverywhere(*Lights.Find(Slot))) { Everywhere.push_back(Slot); }
		}
		if (!Data.Cells.empty()) { EXPECT_EQ(Data.GetList(Data.Cells[LIGHT_CELL_EVERYWHERE]), Everywhere); }
		return Filled;
	}

	glm::dvec3 Middle{0};
	uint64_t Listed = 0, Refused = 0; // pairs of a list and a light of its neighbourhood
	uint32_t Overflows = 0;
};

TEST_F(FLightCellsTest, ListsHaveAllLightsThatReachThem)
{
	const glm::dvec3 Places[] = {{0, 0, 0}, {30'000.5, 2'000.25, -45'000.125}, {-150'000, -1'000, 99'999.9}};
	for (const glm::dvec3& Place : Places)
	{
		ASSERT_NO_FATAL_FAILURE(LoadSteps(Place));
		FNumbers Numbers(7);
		(void)AddLights(Numbers, 300);
		const glm::dvec3 Cameras[] = {{6, 3, 8}, {7.3, 3.1, 8.2}, {-9, 12, 3}, {40, 30, -20}, {6, 3, 8}};
		for (const glm::dvec3& Camera : Cameras)
		{
			const FGridData Data = ReadGrid(LookFrom(Camera));
			const uint32_t Filled = ExpectLists(Data, Numbers);
			EXPECT_GT(Filled, 50u);
			EXPECT_GT(Listed, 100u);
			EXPECT_GT(Refused, 0u) << "cones and flat lights leave cells out that their range reaches";
			EXPECT_EQ(CountDifferences(LookFrom(Camera)), 0u) << Camera.x;
			if (HasFailure()) { return; }
		}
		PrintFigure(fmt::format("lists of {} lights at ({}, {}, {}): {} entries", 300, Place.x, Place.y, Place.z, Listed));
	}
}

// Lights come, move, turn and go between frames, while the camera flies about.
TEST_F(FLightCellsTest, ListsFollowLightsAndCamera)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps({-2'000, 10, 700}));
	FNumbers Numbers(11);
	std::vector<FLightId> Ids = AddLights(Numbers, 120);
	for (int Frame = 0; Frame < 24; ++Frame)
	{
		const glm::dvec3 Camera(8.0 * std::cos(0.4 * Frame), 3.0 + 0.2 * Frame, 8.0 * std::sin(0.4 * Frame));
		const FView View = LookFrom(Camera);
		EXPECT_EQ(CountDifferences(View), 0u) << Frame;
		for (int Change = 0; Change < 5; ++Change)
		{
			FLightId& Id = Ids[Numbers.Below(static_cast<uint32_t>(Ids.size()))];
			const uint32_t Kind = Numbers.Below(3);
			if (Kind == 0) { GetWorld().SetLight(Id, MakeRandomLight(Numbers, Middle)); }
			else
			{
				GetWorld().RemoveLight(Id);
				Id = GetWorld().AddLight(MakeRandomLight(Numbers, Middle));
			}
		}
		if (Frame % 8 == 7) { (void)ExpectLists(ReadGrid(View), Numbers); }
		if (HasFailure()) { return; }
	}
	// Far away, more often than keys can tell apart, and back.
	for (const double Away : {20'000.0, -50'000.0, 0.0})
	{
		Render(LookFrom({Away, 3, 8}));
		EXPECT_EQ(CountDifferences(LookFrom({6, 3, 8})), 0u);
	}
}

// Nothing is filled twice: a frame like the one before makes no list, and a light that moves makes those that it reaches.
TEST_F(FLightCellsTest, CostsWhatChanged)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(3);
	std::vector<FLightId> Ids = AddLights(Numbers, 60);
	FSceneLight Small = GetWorld().GetLights().Get(Ids[0]);
	Small.Type = LIGHT_POINT;
	Small.Range = 0.75f;
	Small.Position = {1.5, 1.5, 1.5};
	GetWorld().SetLight(Ids[0], Small);
	const FView View = LookFrom({6, 3, 8});
	const auto GetFilled = [&] {
		Render(View);
		for (int Frame = 0; Frame < 2; ++Frame) { Render(View); } // until the count is there
		return GetStats().Filled;
	};
	Render(View);
	Render(View);
	Render(View);
	const uint32_t All = GetStats().Filled;
	EXPECT_GT(All, 100u);
	EXPECT_EQ(GetFilled(), 0u) << "nothing changed";
	Small.Color *= 2.0f;
	GetWorld().SetLight(Ids[0], Small);
	EXPECT_EQ(GetFilled(), 0u) << "another colour reaches the same cells";
	Small.Position.x += 0.3;
	GetWorld().SetLight(Ids[0], Small);
	const uint32_t Moved = GetFilled();
	EXPECT_GT(Moved, 0u);
	EXPECT_LT(Moved, All / 8);
	PrintFigure(fmt::format("lists that a frame makes: {} at first, {} after a light of 0.75 m has moved", All, Moved));
}

// A cell with more lights than a list may have, and one lamp more elsewhere.
TEST_F(FLightCellsTest, CellsWithoutRoomLoseNoLight)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(5);
	for (int I = 0; I < 200; ++I)
	{
		FSceneLight Light = MakeRandomLight(Numbers, Middle);
		Light.Range = 1.5f;
		Light.Position = glm::dvec3(0.3, 1.6, 0.2) + Numbers.Point(0.2);
		(void)GetWorld().AddLight(Light);
	}
	(void)AddLights(Numbers, 20);
	const FView View = LookFrom({3, 3, 4});
	EXPECT_EQ(CountDifferences(View), 0u);
	(void)ExpectLists(ReadGrid(View), Numbers);
	EXPECT_GT(Overflows, 0u);
}

TEST_F(FLightCellsTest, PoolsWithoutRoomLoseNoLight)
{
	FLogCapture Log;
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(9);
	(void)AddLights(Numbers, 100);
	for (const char* const Room : {"0.0001", "0.001", "0.01"})
	{
		SetVariable("r.RT.Lights.CellPoolMB", Room);
		for (const glm::dvec3& Camera : {glm::dvec3(6, 3, 8), glm::dvec3(-3, 5, 6)})
		{
			EXPECT_EQ(CountDifferences(LookFrom(Camera)), 0u) << Room;
		}
		for (int Frame = 0; Frame < 3; ++Frame) { Render(LookFrom({-6, 3, 8})); }
		EXPECT_LE(GetStats().PoolEntries, 0.01 * (1 << 18) + 1);
		EXPECT_EQ(CountDifferences(LookFrom({-6, 3, 8})), 0u) << Room;
	}
	EXPECT_GE(Log.Count(ERTLogLevel::Warning), 1u) << "somebody must hear of it";
}

// Many large lights: the first pool has no room for the blocks, and a later frame has a larger one.
TEST_F(FLightCellsTest, PoolsGrow)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(13);
	for (int I = 0; I < 1'100; ++I) // more than 1,024: room is a power of two, and 32 lists of them fill the pool
	{
		FSceneLight Light = MakeRandomLight(Numbers, Middle);
		Light.Type = LIGHT_POINT;
		Light.OuterCone = 0.0f;
		Light.Range = 40.0f;
		(void)GetWorld().AddLight(Light);
	}
	SetVariable("r.RT.Lights.CellMetres", "0.125");
	FView View;
	for (int Frame = 0; Frame < 16; ++Frame)
	{
		const double Turn = std::min(Frame, 8) * 0.8;
		View = LookFrom({3.0 * std::cos(Turn), 4.0, 3.0 * std::sin(Turn)});
		Render(View);
	}
	EXPECT_GT(GetStats().PoolEntries, 1u << 16);
	EXPECT_EQ(GetStats().Missing, 0u);
	EXPECT_EQ(CountDifferences(View), 0u);
}

TEST_F(FLightCellsTest, OddSizesAndCells)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(17);
	(void)AddLights(Numbers, 50);
	for (const auto& [X, Y] : {std::pair{1u, 1u}, {7u, 3u}, {8u, 8u}, {9u, 1u}, {1u, 17u}, {131u, 73u}, {64u, 65u}})
	{
		EXPECT_EQ(CountDifferences(LookFrom({5, 3, 4}, X, Y)), 0u) << X << " x " << Y;
	}
	for (const char* const Metres : {"0.125", "0.3", "4", "32"})
	{
		SetVariable("r.RT.Lights.CellMetres", Metres);
		EXPECT_EQ(CountDifferences(LookFrom({5, 3, 4})), 0u) << Metres;
		(void)ExpectLists(ReadGrid(LookFrom({5, 3, 4})), Numbers);
	}
}

// A pixel in a tile of many lights that chooses without candidates takes one that reaches its cell, with the numbers that a choice of all takes.
TEST_F(FLightCellsTest, ChoicesOfShadowedLights)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	SetVariable("r.RT.Lights", "1");
	SetVariable("r.RT.Lights.Candidates", "0");
	SetVariable("r.RT.Lights.Denoise", "0");      // pictures of two frames are compared
	SetVariable("r.RT.Rays.QueuePerPixel", "16"); // all rays have room: without, it depends on the frames before
	FNumbers Numbers(29);
	std::vector<FLightId> Ids = AddLights(Numbers, 160);
	for (const char* const Exact : {"1", "4"})
	{
		SetVariable("r.RT.Lights.Exact", Exact);
		for (int Frame = 0; Frame < 4; ++Frame)
		{
			const FView View = LookFrom({6 - 2 * Frame, 3, 8});
			EXPECT_EQ(CountDifferences(View, ESignal::LocalDiffuse), 0u) << Exact << ", frame " << Frame;
			EXPECT_EQ(CountDifferences(View, ESignal::LocalSpecular), 0u) << Exact << ", frame " << Frame;
			for (int I = 0; I < 10; ++I) { GetWorld().SetLight(Ids[size_t(Frame * 10 + I)], MakeRandomLight(Numbers, Middle)); }
		}
		const FView View = LookFrom({6, 3, 8});
		EXPECT_GT(ExpectLists(ReadGrid(View), Numbers), 50u);
		EXPECT_GE(GetWorld().GetFacts().FiniteLights, 64u);
		// The comparison has teeth: cells that hear of no change lack lights.
		SetVariable("r.RT.Debug.Lights.Changes", "0");
		for (const FLightId Id : Ids) { GetWorld().SetLight(Id, MakeRandomLight(Numbers, Middle)); }
		EXPECT_GT(CountDifferences(View, ESignal::LocalDiffuse), 100u) << Exact;
		SetVariable("r.RT.Debug.Lights.Changes", "1");
		SetVariable("r.RT.Lights.CellMetres", "2"); // begins anew, without what they did not hear of
	}
}

// What rays hit looks up cells, too, and asks for those that no pixel shows.
TEST_F(FLightCellsTest, HitsOfRays)
{
	ASSERT_TRUE(Load("lamps:200"));
	SetVariable("r.RT.GI", "1");
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.Reflections", "2");
	const FView View = MakeView(Width, Height);
	for (const ESignal Signal : {ESignal::DiffuseGI, ESignal::Reflections})
	{
		for (int Frame = 0; Frame < 3; ++Frame) { EXPECT_EQ(CountDifferences(View, Signal), 0u) << GetSignalInfo(Signal).Name << Frame; }
	}
	SetVariable("r.RT.GI", "0");
	SetVariable("r.RT.Reflections", "0");
	const auto CountFilled = [&] {
		const FGridData Data = ReadGrid(View);
		return std::count_if(Data.Cells.begin(), Data.Cells.begin() + LIGHT_CELLS,
		    [&](const FLightCell& Cell) { return Cell.Revision == Data.Grid.Revision && (Cell.State & LIGHT_CELL_FILLED) != 0; });
	};
	SetVariable("r.RT.Lights.CellMetres", "2"); // begins anew
	const auto OfPixels = CountFilled();
	SetVariable("r.RT.GI", "1");
	for (int Frame = 0; Frame < 3; ++Frame) { Render(View, ESignal::DiffuseGI); }
	EXPECT_GT(CountFilled(), OfPixels);
}

TEST_F(FLightCellsTest, HallOfLampsAndFewLights)
{
	for (const char* const Scene : {"lamps:640", "lamps:2"})
	{
		ASSERT_TRUE(Load(Scene));
		for (int Frame = 0; Frame < 3; ++Frame) { EXPECT_EQ(CountDifferences(MakeView(Width, Height)), 0u) << Scene; }
	}
}

// A town of a million lamps, of which a picture sees a few.
TEST_F(FLightCellsTest, AMillionLights)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FSceneLight Lamp;
	Lamp.Color = glm::vec3(5);
	Lamp.Range = 4.0f;
	for (int I = 0; I < 1'000'000; ++I)
	{
		Lamp.Position = {3.0 * (I % 1000 - 500), 2.0, 3.0 * (I / 1000 - 500)};
		(void)GetWorld().AddLight(Lamp);
	}
	const FView View = LookFrom({6, 3, 8}, 16, 9);
	EXPECT_EQ(CountDifferences(View), 0u);
	EXPECT_EQ(CountDifferences(View), 0u);
}

// The grid is overwritten with what is no number, after a cut, and after frames that nobody submitted.
TEST_F(FLightCellsTest, GridsThatAreLostComeBack)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(19);
	(void)AddLights(Numbers, 80);
	FView View = LookFrom({6, 3, 8});
	EXPECT_EQ(CountDifferences(View), 0u);
	GetEngine().GetRenderer().GetGraphResources().PoisonHistory("LightCells");
	EXPECT_EQ(CountDifferences(View), 0u);
	for (int Frame = 0; Frame < 3; ++Frame) { Render(View); }
	EXPECT_GT(ExpectLists(ReadGrid(View), Numbers), 50u) << "they are filled anew";
	View.bCut = true;
	EXPECT_EQ(CountDifferences(View), 0u);
	EXPECT_GT(ExpectLists(ReadGrid(View), Numbers), 50u);
}

TEST_F(FLightCellsTest, CellsThatHearOfNoChangeAreSeen)
{
	ASSERT_NO_FATAL_FAILURE(LoadSteps());
	FNumbers Numbers(23);
	const std::vector<FLightId> Ids = AddLights(Numbers, 40);
	const FView View = LookFrom({6, 3, 8});
	EXPECT_EQ(CountDifferences(View), 0u);
	SetVariable("r.RT.Debug.Lights.Changes", "0");
	for (const FLightId Id : Ids) { GetWorld().SetLight(Id, MakeRandomLight(Numbers, Middle)); }
	EXPECT_GT(CountDifferences(View), 100u);
}

} // namespace
} // namespace Lantern
