// FGeometryStore: what is created, built when, refitted and rebuilt.
#include <limits>
#include <map>
#include <random>

#include "GeometryStoreTestTools.h"

namespace Lantern
{
namespace
{

std::string Refusal(FGeometryStore& Store, FRTGeometryInfo Info)
{
	FRTGeometryRef Out;
	const FRTStatus Status = Store.Create(std::move(Info), Out);
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_EQ(Out, nullptr);
	return Status.Message;
}

// ---------------------------------------------------------------------------------------------------- creation

TEST_F(FGeometryStoreTest, SectionWithoutTrianglesIsRefusedByName)
{
	FRTGeometryInfo Info = MakeInfo("Fence", 4, 3);
	Info.Sections[1].IndexCount = 0;
	EXPECT_EQ(Refusal(*Store, Info), "geometry \"Fence\", section 1: no triangles");
	Info.Sections[1].IndexCount = 2;
	EXPECT_EQ(Refusal(*Store, Info), "geometry \"Fence\", section 1: no triangles");
	Info.Sections[1].IndexCount = 7;
	EXPECT_EQ(Refusal(*Store, Info), "geometry \"Fence\", section 1: the number of indices is not a multiple of 3");
	Info.Sections[1] = {0, 0, true, true};
	EXPECT_EQ(Refusal(*Store, Info), "geometry \"Fence\", section 1: no boxes");
	Info.Sections[1].IndexCount = 5;
	EXPECT_EQ(Refusal(*Store, Info), "geometry \"Fence\", section 1: boxes, but no buffer of them");
	Info.Sections.clear();
	EXPECT_EQ(Refusal(*Store, Info), "geometry \"Fence\" has no section");
	EXPECT_EQ(Store->GetSlotCount(), 0u);
	EXPECT_FALSE(Store->NeedsUpdate());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateGeometry), 0u);
}

TEST_F(FGeometryStoreTest, SlotsAreConstantAndUsedAgain)
{
	FRTGeometryRef A = Make("A", 1), B = Make("B", 1);
	EXPECT_NE(A->GetSlot(), B->GetSlot());
	Frames(4);
	const uint32_t Slot = A->GetSlot();
	EXPECT_EQ(Store->Get(Slot), A.get());
	A.reset();
	EXPECT_EQ(Store->Get(Slot), nullptr);
	FRTGeometryRef C = Make("C", 1);
	EXPECT_EQ(C->GetSlot(), Slot);
	EXPECT_EQ(GetAddress(C), 0u) << "the address of the geometry before";
	Frames(1);
	EXPECT_NE(GetAddress(C), 0u);
	EXPECT_EQ(Store->Get(Slot), C.get());
}

TEST_F(FGeometryStoreTest, GeometryOutlivesItsStore)
{
	FRTGeometryRef Geometry = Make("A", 1);
	Frames(2);
	Store.reset();
	Geometry.reset();
	EXPECT_EQ(Device->GetMemoryStats().Geometry, 0u);
}

TEST_F(FGeometryStoreTest, BoundsComeFromPositionsAndHoldThem)
{
	FRTGeometryInfo Info = MakeTerrain("Terrain", 16);
	FRTGeometryRef Geometry;
	ASSERT_TRUE(Store->Create(Info, Geometry));
	const FRTGeometryInfo& Made = Geometry->GetInfo();
	EXPECT_NEAR(Made.BoundsCenter.x, 8.0f, 1e-5f);
	EXPECT_NEAR(Made.BoundsCenter.z, 8.0f, 1e-5f);
	for (const glm::vec3 P : CpuPositions.back()) { EXPECT_LE(glm::length(P - Made.BoundsCenter), Made.BoundsRadius); }
	EXPECT_LT(Made.BoundsRadius, 12.0f);
	Info.BoundsRadius = 3.0f; // what the engine knows better
	ASSERT_TRUE(Store->Create(Info, Geometry));
	EXPECT_EQ(Geometry->GetInfo().BoundsRadius, 3.0f);
	Info.BoundsRadius = -1.0f;
	Info.bDynamic = true;
	ASSERT_TRUE(Store->Create(Info, Geometry));
	EXPECT_LT(Geometry->GetInfo().BoundsRadius, 0.0f);
}

TEST_F(FGeometryStoreTest, PartsOfClassifiedSections)
{
	FRTGeometryInfo Info = MakeInfo("Tree", 10, 5); // 30 indices each
	for (FRTSectionInfo& Section : Info.Sections) { Section.bOpaque = false; }
	Info.Sections[0].OpaqueIndexCount = 9; // mixed 15, opaque 9, transparent 6
	Info.Sections[0].TransparentIndexCount = 6;
	Info.Sections[1].OpaqueIndexCount = 30;
	Info.Sections[2].TransparentIndexCount = 30;
	Info.Sections[3].TransparentIndexCount = 12;
	const std::vector<FRTGeometryPart> Expected = {
	    {0, 15, 0, false}, {30, 30, 1, true}, {60, 3, 2, false}, {90, 18, 3, false}, {120, 30, 4, false}, {15, 9, 0, true}};
	FRTGeometryRef Geometry;
	ASSERT_TRUE(Store->Create(Info, Geometry));
	EXPECT_EQ(Geometry->GetParts(), Expected);
	EXPECT_EQ(Geometry->GetPartCapacity(), 9u);
	EXPECT_EQ(Geometry->GetPrimitiveCount(), 5u + 10 + 1 + 6 + 10 + 3);
	Frames(1);
	const FRTMockGeometry Built = Mock().GetGeometry(Geometry->GetStructure());
	ASSERT_EQ(Built.Sections.size(), 6u);
	EXPECT_EQ(Built.Sections[5].IndexOffset, 15u * 4);
	EXPECT_EQ(Built.Sections[5].TriangleCount, 3u);
	EXPECT_TRUE(Built.Sections[5].bOpaque);
	EXPECT_FALSE(Built.Sections[0].bOpaque);
}

TEST_F(FGeometryStoreTest, BoxesReachTheStructure)
{
	FRTGeometryInfo Info;
	Info.Name = "Balls";
	Info.Aabbs = MakeBuffer("Boxes", 24 * 100);
	Info.AabbsOffset = 48;
	Info.Sections = {{0, 7, true, true}, {7, 20, false, true}};
	FRTGeometryRef Geometry;
	ASSERT_TRUE(Store->Create(Info, Geometry));
	Frames(1);
	const FRTMockGeometry Built = Mock().GetGeometry(Geometry->GetStructure());
	ASSERT_EQ(Built.Sections.size(), 2u);
	EXPECT_TRUE(Built.Sections[1].bProcedural);
	EXPECT_EQ(Built.Sections[1].VertexCount, 20u);
	EXPECT_EQ(Built.Sections[1].VertexOffset, 48u + 7 * 24);
	EXPECT_EQ(Built.Sections[1].VertexStride, 24u);
}

// ---------------------------------------------------------------------------------------------------- budget of triangles

TEST_F(FGeometryStoreTest, TrianglesPerFrameAreKept)
{
	Set("r.RT.Build.TrianglesPerFrame", "1000");
	std::vector<FRTGeometryRef> Geometries;
	std::mt19937 Random(1);
	for (int I = 0; I < 200; ++I) { Geometries.push_back(Make("G" + std::to_string(I), 1 + Random() % 700)); }
	Geometries.push_back(Make("Huge", 5000));
	uint32_t Built = 0;
	uint32_t Count = 0;
	for (; Built < Geometries.size() && Count < 500; ++Count)
	{
		ASSERT_TRUE(Frame());
		EXPECT_TRUE(Stats().TrianglesBuilt <= 1000 || Stats().Built == 1) << Stats().TrianglesBuilt;
		EXPECT_GT(Stats().Built, 0u);
		Built += Stats().Built;
	}
	EXPECT_EQ(Built, Geometries.size());
	EXPECT_GT(Count, 70u);
	for (const FRTGeometryRef& Geometry : Geometries) { EXPECT_NE(GetAddress(Geometry), 0u); }
}

TEST_F(FGeometryStoreTest, BuildAllHeedsNoBudgetOfTriangles)
{
	Set("r.RT.Build.TrianglesPerFrame", "10");
	std::vector<FRTGeometryRef> Geometries;
	for (int I = 0; I < 50; ++I) { Geometries.push_back(Make("G", 100)); }
	ASSERT_TRUE(Frame(true));
	EXPECT_EQ(Stats().Built, 50u);
	EXPECT_EQ(Stats().Pending, 0u);
}

TEST_F(FGeometryStoreTest, SizeThatIsNoNumberIsNone)
{
	Set("r.RT.Build.TrianglesPerFrame", "100");
	const FRTGeometryRef Odd = Make("Odd", 100), Small = Make("Small", 100);
	Store->RaisePriority(Odd->GetSlot(), std::numeric_limits<float>::quiet_NaN());
	Store->RaisePriority(Small->GetSlot(), 0.1f);
	ASSERT_TRUE(Frame());
	EXPECT_EQ(GetAddress(Odd), 0u);
	EXPECT_NE(GetAddress(Small), 0u);
	ASSERT_TRUE(Frame());
	EXPECT_NE(GetAddress(Odd), 0u);
}

TEST_F(FGeometryStoreTest, LargeOnScreenComesFirstThenTheOldest)
{
	Set("r.RT.Build.TrianglesPerFrame", "100");
	std::vector<FRTGeometryRef> G;
	for (int I = 0; I < 6; ++I) { G.push_back(Make("G" + std::to_string(I), 100)); }
	Store->RaisePriority(G[3]->GetSlot(), 0.5f);
	Store->RaisePriority(G[3]->GetSlot(), 0.1f); // the larger of both counts
	Store->RaisePriority(G[5]->GetSlot(), 0.4f);
	std::string Order;
	std::vector<bool> Seen(G.size());
	for (int I = 0; I < 6; ++I)
	{
		ASSERT_TRUE(Frame());
		for (size_t J = 0; J < G.size(); ++J)
		{
			if (GetAddress(G[J]) == 0 || Seen[J]) { continue; }
			Seen[J] = true;
			Order += static_cast<char>('0' + J);
		}
	}
	EXPECT_EQ(Order, "350124");
}

TEST_F(FGeometryStoreTest, NothingStarves)
{
	Set("r.RT.Build.TrianglesPerFrame", "100");
	const FRTGeometryRef Small = Make("Small", 100);
	std::vector<FRTGeometryRef> Others;
	uint32_t Waited = 0;
	for (; GetAddress(Small) == 0 && Waited < 1000; ++Waited)
	{
		Others.push_back(Make("Other", 100)); // each fills the picture
		Store->RaisePriority(Others.back()->GetSlot(), 1.0f);
		ASSERT_TRUE(Frame());
	}
	EXPECT_LT(Waited, 250u);
	EXPECT_GT(Waited, 100u) << "the small one was not behind at all";
}

// ---------------------------------------------------------------------------------------------------- frames that never ran

TEST_F(FGeometryStoreTest, LostBuildsAreRecordedAgainBeforeOthers)
{
	Set("r.RT.Build.TrianglesPerFrame", "100");
	const FRTGeometryRef A = Make("A", 100), B = Make("B", 100);
	ASSERT_TRUE(Frame(false, false));
	EXPECT_EQ(GetAddress(A), 0u);
	Store->RaisePriority(B->GetSlot(), 5.0f);
	ASSERT_TRUE(Frame(false, false));
	ASSERT_TRUE(Frame());
	EXPECT_NE(GetAddress(A), 0u);
	EXPECT_EQ(GetAddress(B), 0u);
	EXPECT_EQ(Mock().GetGeometry(A->GetStructure()).BuildCount, 1u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateGeometry, "A"), 1u) << "its memory was kept";
	Frames(5);
	EXPECT_FALSE(Store->NeedsUpdate());
}

TEST_F(FGeometryStoreTest, LostRefitsAreRecordedAgain)
{
	const FRTGeometryRef Body = Make("Body", 10, true);
	Frames(1);
	Store->MarkDeformed(Body);
	ASSERT_TRUE(Frame(false, false));
	EXPECT_TRUE(Store->NeedsUpdate());
	ASSERT_TRUE(Frame());
	EXPECT_EQ(Stats().Refitted, 1u);
	EXPECT_EQ(Mock().GetGeometry(Body->GetStructure()).UpdateCount, 1u);
	EXPECT_FALSE(Store->NeedsUpdate());
	Set("r.RT.Skinning.RebuildInterval", "1");
	Store->MarkDeformed(Body);
	ASSERT_TRUE(Frame(false, false));
	EXPECT_EQ(Stats().Rebuilt, 1u);
	Set("r.RT.Skinning.RebuildInterval", "1000");
	ASSERT_TRUE(Frame());
	EXPECT_EQ(Stats().Rebuilt, 1u) << "a lost rebuild stays one";
	EXPECT_EQ(Mock().GetGeometry(Body->GetStructure()).BuildCount, 2u);
}

TEST_F(FGeometryStoreTest, RandomLostFramesLoseNothing)
{
	Set("r.RT.Build.TrianglesPerFrame", "300");
	std::mt19937 Random(7);
	std::map<int, FRTGeometryRef> Live;
	for (int Step = 0; Step < 600; ++Step)
	{
		const int Key = static_cast<int>(Random() % 40);
		if (Random() % 3 == 0) { Live.erase(Key); }
		else if (!Live.count(Key)) { Live[Key] = Make("G" + std::to_string(Step), 1 + Random() % 200, Random() % 3 == 0); }
		for (const auto& [Unused, Geometry] : Live)
		{
			if (Geometry->GetInfo().bDynamic && Random() % 2) { Store->MarkDeformed(Geometry); }
		}
		ASSERT_TRUE(Frame(Random() % 20 == 0, Random() % 3 != 0));
	}
	for (int I = 0; I < 60; ++I) { ASSERT_TRUE(Frame()); }
	EXPECT_FALSE(Store->NeedsUpdate());
	for (const auto& [Unused, Geometry] : Live)
	{
		EXPECT_NE(GetAddress(Geometry), 0u) << Geometry->GetInfo().Name;
		EXPECT_TRUE(Mock().GetGeometry(Geometry->GetStructure()).IsUsable());
	}
	EXPECT_EQ(Device->GetMemoryStats().Geometry > 0, !Live.empty());
	Live.clear();
	Frames(2);
	EXPECT_EQ(Device->GetMemoryStats().Geometry, 0u);
}

TEST_F(FGeometryStoreTest, GeometryMayGoInTheMiddleOfAFrame)
{
	FRTGeometryRef Geometry = Make("A", 10);
	ASSERT_TRUE(Store->BeginFrame(true));
	Geometry.reset();
	TRTRef<IRTCommandList> List;
	ASSERT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
	ASSERT_TRUE(List->Begin());
	ASSERT_TRUE(Store->Record(*List));
	ASSERT_TRUE(List->End());
	IRTCommandList* const Lists[] = {List.Get()};
	FRTFence Fence = 0;
	ASSERT_TRUE(Device->Submit(Lists, 1, &Fence));
	List.Reset();
	Store->EndFrame(true);
	Frames(2);
	EXPECT_EQ(Device->GetMemoryStats().Geometry, 0u);
}

// ---------------------------------------------------------------------------------------------------- deformed geometry

TEST_F(FGeometryStoreTest, RebuildsOfManyAreSpreadOverFrames)
{
	Set("r.RT.Skinning.RebuildInterval", "8");
	Set("r.RT.Build.StructuresPerFrame", "0"); // all are there after a frame
	std::vector<FRTGeometryRef> Bodies;
	for (int I = 0; I < 50; ++I) { Bodies.push_back(Make("Body", 10, true)); }
	ASSERT_TRUE(Frame());
	uint32_t Rebuilt = 0;
	for (int I = 0; I < 64; ++I)
	{
		for (const FRTGeometryRef& Body : Bodies) { Store->MarkDeformed(Body); }
		ASSERT_TRUE(Frame());
		EXPECT_LE(Stats().Rebuilt, 7u);
		EXPECT_EQ(Stats().Rebuilt + Stats().Refitted, 50u);
		Rebuilt += Stats().Rebuilt;
	}
	for (const FRTGeometryRef& Body : Bodies) { EXPECT_GE(Mock().GetGeometry(Body->GetStructure()).BuildCount, 7u); }
	EXPECT_GE(Rebuilt, 350u);
}

TEST_F(FGeometryStoreTest, DegradedRefitIsRebuiltOnce)
{
	Set("r.RT.Skinning.RebuildInterval", "1000");
	Set("r.RT.Skinning.RebuildQuality", "2");
	const FRTGeometryRef Body = Make("Body", 10, true), Other = Make("Other", 10, true);
	Frames(1);
	const auto Deform = [&] {
		Store->MarkDeformed(Body);
		Store->MarkDeformed(Other);
		EXPECT_TRUE(Frame());
		return Stats().Rebuilt;
	};
	EXPECT_EQ(Deform(), 0u);
	Store->SetRefitQuality(Body->GetSlot(), 1.9f);
	EXPECT_EQ(Deform(), 0u);
	Store->SetRefitQuality(Body->GetSlot(), 2.1f);
	EXPECT_EQ(Deform(), 1u);
	EXPECT_EQ(Mock().GetGeometry(Body->GetStructure()).BuildCount, 2u);
	EXPECT_EQ(Store->GetBuildCount(Body->GetSlot()), 2u);
	EXPECT_EQ(Deform(), 0u) << "the measure was of the structure before";
	Set("r.RT.Skinning.RebuildQuality", "0");
	Store->SetRefitQuality(Body->GetSlot(), 1e9f);
	EXPECT_EQ(Deform(), 0u);
	EXPECT_EQ(Mock().GetGeometry(Other->GetStructure()).BuildCount, 1u);
}

// ---------------------------------------------------------------------------------------------------- scratch

TEST_F(FGeometryStoreTest, ScratchShrinksAfterAWhile)
{
	bInstances = false;
	const FRTGeometryRef Huge = Make("Huge", 200000);
	const FRTGeometryRef Body = Make("Body", 100, true);
	Frames(1);
	const uint64_t Large = Device->GetMemoryStats().Scratch;
	EXPECT_GT(Large, 10u << 20);
	for (int I = 0; I < 63; ++I)
	{
		Store->MarkDeformed(Body);
		ASSERT_TRUE(Frame());
		EXPECT_EQ(Device->GetMemoryStats().Scratch, Large) << I;
	}
	for (int I = 0; I < 3; ++I)
	{
		Store->MarkDeformed(Body);
		ASSERT_TRUE(Frame());
	}
	EXPECT_LT(Device->GetMemoryStats().Scratch, 256u << 10);
	EXPECT_EQ(Mock().GetGeometry(Body->GetStructure()).UpdateCount + Mock().GetGeometry(Body->GetStructure()).BuildCount, 67u);
}

TEST_F(FGeometryStoreTest, BatchesFitTheirScratch)
{
	std::vector<FRTGeometryRef> Geometries;
	for (int I = 0; I < 300; ++I) { Geometries.push_back(Make("G", 5000)); } // 96 MB of scratch, were it one batch
	ASSERT_TRUE(Frame(true));
	EXPECT_LE(Device->GetMemoryStats().Scratch, 33u << 20);
	std::vector<std::pair<uint64_t, uint64_t>> Batch;
	uint32_t Checked = 0;
	for (const FRTMockCall& Call : Mock().GetCalls())
	{
		if (Call.Kind == ERTMockCall::Barrier) { Batch.clear(); }
		if (Call.Kind != ERTMockCall::BuildGeometry) { continue; }
		const uint64_t First = Call.Numbers[2], Last = First + Geometries[0]->GetStructure()->GetBuildSizes().BuildScratchBytes;
		EXPECT_LE(Last, Device->GetMemoryStats().Scratch);
		for (const auto& [Begin, End] : Batch) { EXPECT_TRUE(Last <= Begin || End <= First); }
		Batch.push_back({First, Last});
		++Checked;
	}
	EXPECT_EQ(Checked, 300u);
}

} // namespace
} // namespace Lantern
