// FGeometryStore: compaction, the memory budget, coarser levels, failing allocations.
#include <cstring>
#include <map>
#include <mutex>
#include <random>
#include <set>

#include "GeometryStoreTestTools.h"
#include "LanternCore/Text/Log.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

class FGeometryMemoryTest : public FGeometryStoreTest
{
protected:
	void SetUp() override
	{
		FGeometryStoreTest::SetUp();
		SetLogSink([this](ERTLogLevel, std::string_view Line) {
			std::lock_guard Lock(Mutex);
			Lines.emplace_back(Line);
		});
	}
	void TearDown() override
	{
		SetLogSink({});
		FGeometryStoreTest::TearDown();
	}
	uint32_t CountLines(const std::string& Part)
	{
		std::lock_guard Lock(Mutex);
		return static_cast<uint32_t>(
		    std::count_if(Lines.begin(), Lines.end(), [&](const std::string& Line) { return Line.find(Part) != std::string::npos; }));
	}
	/// Frames until nothing is left to do.
	void Settle()
	{
		constexpr uint32_t Least = 3, Most = 400;
		uint32_t All = 0, Quiet = 0; // those that may pass the time while a task makes a coarser level are not quiet
		const auto IsSettled = [&] { return All >= Least && Stats().Pending == 0 && (Quiet >= Most || !Store->NeedsUpdate()); };
		const auto Step = [&] {
			const FRTStatus Status = Frame();
			ASSERT_TRUE(Status) << Status.Message;
			++All;
			if (Stats().Pending > 0) { GiveWay(); }
			else { ++Quiet; }
		};
		const auto Describe = [&] { return std::to_string(Stats().Pending) + " geometries pending"; };
		ASSERT_TRUE(WaitUntil("the geometry store to settle", IsSettled, Step, Describe));
	}
	FRTGeometryRef MakeCpu(const std::string& Name, uint32_t Cells)
	{
		FRTGeometryRef Out;
		EXPECT_TRUE(Store->Create(MakeTerrain(Name, Cells), Out));
		return Out;
	}

private:
	std::mutex Mutex;
	std::vector<std::string> Lines;
};

// ---------------------------------------------------------------------------------------------------- compaction

TEST_F(FGeometryMemoryTest, CompactionSwapsTheAddressAndFreesMemory)
{
	const FRTGeometryRef Geometry = Make("Rock", 10000);
	ASSERT_TRUE(Frame());
	const uint64_t Before = Device->GetMemoryStats().Geometry, Address = GetAddress(Geometry);
	EXPECT_EQ(Store->TakeChanged(), std::vector<uint32_t>{Geometry->GetSlot()});
	ASSERT_TRUE(Frame()); // the size is known: the copy is recorded
	EXPECT_EQ(Stats().Compacted, 1u);
	EXPECT_EQ(GetAddress(Geometry), Address) << "not before the copy was submitted";
	EXPECT_TRUE(Store->TakeChanged().empty());
	ASSERT_TRUE(Frame());
	EXPECT_NE(GetAddress(Geometry), Address);
	EXPECT_EQ(Store->TakeChanged(), std::vector<uint32_t>{Geometry->GetSlot()});
	EXPECT_TRUE(Mock().GetGeometry(Geometry->GetStructure()).IsUsable());
	EXPECT_EQ(Device->GetMemoryStats().Geometry, Before - Stats().CompactionSavedBytes);
	EXPECT_LT(Device->GetMemoryStats().Geometry, Before * 8 / 10);
	Frames(64); // in which the scratch buffer goes
	EXPECT_FALSE(Store->NeedsUpdate());
}

TEST_F(FGeometryMemoryTest, CompactionWaitsForNothing)
{
	Mock().SetManualFences(true);
	const FRTGeometryRef Geometry = Make("Rock", 1000);
	FRTGeometryRef Gone = Make("Gone", 1000);
	Frames(1);
	const uint64_t Address = GetAddress(Geometry);
	Frames(5); // the GPU has not even built it
	EXPECT_EQ(GetAddress(Geometry), Address);
	EXPECT_FALSE(Store->NeedsUpdate()) << "there is nothing to do before sizes are known";
	Gone.reset(); // while its size is being asked for
	Mock().CompleteUpTo(1);
	EXPECT_TRUE(Store->NeedsUpdate());
	Frames(2);
	EXPECT_NE(GetAddress(Geometry), Address);
	EXPECT_EQ(Mock().GetBlockingWaits(), 0u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CompactGeometry), 1u);
	Mock().SetManualFences(false);
	Frames(1);
	EXPECT_TRUE(Mock().GetGeometry(Geometry->GetStructure()).IsUsable());
}

TEST_F(FGeometryMemoryTest, LostCompactionIsRecordedAgain)
{
	const FRTGeometryRef Geometry = Make("Rock", 1000);
	ASSERT_TRUE(Frame());
	const uint64_t Address = GetAddress(Geometry);
	ASSERT_TRUE(Frame(false, false));
	EXPECT_EQ(Stats().Compacted, 1u);
	ASSERT_TRUE(Frame(false, false));
	EXPECT_EQ(GetAddress(Geometry), Address);
	Frames(2);
	EXPECT_NE(GetAddress(Geometry), Address);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateGeometry), 2u);
	EXPECT_TRUE(Mock().GetGeometry(Geometry->GetStructure()).IsUsable());
}

TEST_F(FGeometryMemoryTest, CompactionOffAndDynamicAreNotCopied)
{
	const FRTGeometryRef Body = Make("Body", 1000, true);
	Frames(4);
	Set("r.RT.Build.Compaction", "0");
	const FRTGeometryRef Rock = Make("Rock", 1000);
	Frames(4);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CompactGeometry) + Mock().CountCalls(ERTMockCall::WriteCompactedSize), 0u);
}

// ---------------------------------------------------------------------------------------------------- budget

TEST_F(FGeometryMemoryTest, PeakStaysBelowTheBudgetInAStream)
{
	for (const uint32_t Budget : {1u, 3u, 12u})
	{
		Open({});
		Shared.Reset();
		MostUsed = 0;
		bInstances = true;
		Set("r.RT.Build.MemoryMB", std::to_string(Budget));
		Set("r.RT.Build.TrianglesPerFrame", "20000");
		Mock().SetManualFences(true);
		Mock().SetCallRecording(false);
		std::mt19937 Random(Budget);
		std::map<int, FRTGeometryRef> Live;
		uint32_t Built = 0, Compacted = 0;
		for (int Step = 0; Step < 1500; ++Step)
		{
			for (int I = 0; I < 2; ++I)
			{
				const int Key = static_cast<int>(Random() % 60);
				if (Random() % 2) { Live.erase(Key); }
				else if (!Live.count(Key))
				{
					Live[Key] = Make("G", 1 + Random() % (Random() % 50 == 0 ? 60000 : 3000), Random() % 10 == 0);
				}
			}
			for (const auto& [Unused, Geometry] : Live)
			{
				if (Geometry->GetInfo().bDynamic) { Store->MarkDeformed(Geometry); }
			}
			if (Mock().GetLastFence() > 2) { Mock().CompleteUpTo(Mock().GetLastFence() - 2); }
			Device->CollectGarbage();
			ASSERT_TRUE(Frame(false, Random() % 10 != 0));
			Built += Stats().Built;
			Compacted += Stats().Compacted;
			ASSERT_LE(GetUsed(), uint64_t(Budget) << 20) << Step;
		}
		EXPECT_LE(MostUsed, uint64_t(Budget) << 20);
		EXPECT_LE(Stats().PeakBytes, uint64_t(Budget) << 20);
		EXPECT_GT(MostUsed, uint64_t(Budget) << 19) << "half of it was never used: the test proves nothing";
		EXPECT_GT(Built, 100u);
		EXPECT_GT(Compacted, 50u);
		EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>());
		Mock().SetManualFences(false);
	}
}

TEST_F(FGeometryMemoryTest, WhatWaitsForMemoryGetsIt)
{
	Set("r.RT.Build.MemoryMB", "4");
	Set("r.RT.Build.CoarserLevels", "0");
	std::vector<FRTGeometryRef> First;
	for (int I = 0; I < 5; ++I) { First.push_back(Make("First", 8000)); } // 0.8 MB each
	Settle();
	const FRTGeometryRef Late = Make("Late", 15000);
	Frames(40);
	EXPECT_EQ(GetAddress(Late), 0u);
	EXPECT_EQ(CountLines("geometry \"Late\" (15000 triangles) is left out"), 1u);
	First.clear();
	Settle();
	EXPECT_NE(GetAddress(Late), 0u) << "room came, and it did not";
	EXPECT_EQ(Stats().Refused, 0u);
}

TEST_F(FGeometryMemoryTest, WhatNeverFitsHoldsNobodyUp)
{
	Set("r.RT.Build.MemoryMB", "2");
	const FRTGeometryRef Huge = Make("Mountain", 100000); // no data on the CPU
	Store->RaisePriority(Huge->GetSlot(), 100.0f);
	std::vector<FRTGeometryRef> Others;
	for (int I = 0; I < 40; ++I)
	{
		Others.clear(); // memory is about to come in every frame
		Others.push_back(Make("Other", 1000));
		ASSERT_TRUE(Frame());
		EXPECT_NE(GetAddress(Others[0]), 0u) << I;
	}
	EXPECT_EQ(GetAddress(Huge), 0u);
	EXPECT_EQ(Stats().Refused, 1u);
	EXPECT_EQ(CountLines("geometry \"Mountain\" (100000 triangles) is left out"), 1u);
	EXPECT_FALSE(Store->NeedsUpdate() && Stats().Pending > 0);
}

TEST_F(FGeometryMemoryTest, WhatMustBeBuiltHasItsScratchSetAside)
{
	Set("r.RT.Build.MemoryMB", "3");
	Set("r.RT.Build.CoarserLevels", "0");
	constexpr uint64_t SceneScratch = 1 << 20;
	IRTBuffer* Scratch = nullptr;
	ASSERT_TRUE(Frame());
	ASSERT_TRUE(Store->ReserveScratch(SceneScratch, Scratch));
	Frames(100); // nothing is built: it goes
	EXPECT_EQ(Device->GetMemoryStats().Scratch, 0u);
	std::vector<FRTGeometryRef> Geometries;
	for (int I = 0; I < 60; ++I)
	{
		Geometries.push_back(Make("Rock" + std::to_string(I), 1000));
		ASSERT_TRUE(Frame());
	}
	Frames(100);
	ASSERT_TRUE(Store->ReserveScratch(SceneScratch, Scratch));
	ASSERT_NE(Scratch, nullptr);
	EXPECT_GE(Scratch->GetDesc().Size, SceneScratch);
	EXPECT_LE(GetUsed(), 3u << 20);
	Frames(1);
	EXPECT_GT(Stats().Refused + Stats().Pending, 0u) << "the budget was never reached: the test proves nothing";
	EXPECT_LE(Stats().PeakBytes, 3u << 20);
}

TEST_F(FGeometryMemoryTest, ScratchGoesAlsoWhereNothingChanges)
{
	Set("r.RT.Build.Compaction", "0");
	const FRTGeometryRef Mountain = Make("Mountain", 100000);
	ASSERT_TRUE(Frame());
	EXPECT_GT(Device->GetMemoryStats().Scratch, 1u << 20);
	uint32_t Count = 0;
	for (; Store->NeedsUpdate() && Count < 1000; ++Count) { ASSERT_TRUE(Frame()); }
	EXPECT_LT(Device->GetMemoryStats().Scratch, 1u << 20);
	EXPECT_LT(Count, 1000u) << "and then there is nothing to do any more";
}

// ---------------------------------------------------------------------------------------------------- coarser levels

void ExpectSound(const FRTGeometry& Geometry, const std::vector<uint32_t>& Indices)
{
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	ASSERT_EQ(Geometry.GetParts().size(), Info.Sections.size());
	for (uint32_t Part = 0; Part < Geometry.GetParts().size(); ++Part)
	{
		const FRTGeometryPart& P = Geometry.GetParts()[Part];
		const FRTSectionInfo& Section = Info.Sections[Part];
		EXPECT_EQ(P.Section, Part);
		EXPECT_EQ(P.bOpaque, Section.bOpaque);
		EXPECT_GE(P.IndexCount, 3u);
		EXPECT_LT(P.IndexCount, Section.IndexCount);
		const std::set<uint32_t> Own(Info.CpuIndices + Section.FirstIndex, Info.CpuIndices + Section.FirstIndex + Section.IndexCount);
		for (uint32_t I = P.FirstIndex; I < P.FirstIndex + P.IndexCount; ++I)
		{
			EXPECT_TRUE(Own.count(Indices[I])) << "a vertex of another section";
		}
	}
}

TEST_F(FGeometryMemoryTest, CoarserLevelTakesThePlaceOfWhatDoesNotFit)
{
	Set("r.RT.Build.MemoryMB", "2");
	const FRTGeometryRef Terrain = MakeCpu("Terrain", 150); // 45,000 triangles, 4.5 MB
	const uint64_t Before = Terrain->GetPrimitiveCount();
	Settle();
	ASSERT_NE(GetAddress(Terrain), 0u);
	EXPECT_TRUE(Terrain->IsCoarse());
	EXPECT_LT(Terrain->GetPrimitiveCount(), Before / 2);
	EXPECT_GT(Terrain->GetPrimitiveCount(), Before / 20) << "far coarser than memory asks";
	EXPECT_LE(Stats().PeakBytes, 2u << 20);
	EXPECT_EQ(Stats().Coarse, 1u);
	EXPECT_EQ(CountLines("geometry \"Terrain\" does not fit"), 1u);
	std::vector<uint32_t> Indices(Terrain->GetIndices()->GetDesc().Size / 4);
	std::memcpy(Indices.data(), Mock().GetBytes(Terrain->GetIndices()), Indices.size() * 4);
	ExpectSound(*Terrain, Indices);
	const std::vector<uint32_t> Changed = Store->TakeChanged();
	EXPECT_EQ(std::count(Changed.begin(), Changed.end(), Terrain->GetSlot()), 1);
	const FRTMockGeometry Built = Mock().GetGeometry(Terrain->GetStructure());
	ASSERT_TRUE(Built.IsUsable());
	EXPECT_EQ(Built.Sections[1].Indices, Terrain->GetIndices());
}

TEST_F(FGeometryMemoryTest, CoarserLevelSurvivesLostFrames)
{
	Set("r.RT.Build.MemoryMB", "2");
	const FRTGeometryRef Terrain = MakeCpu("Terrain2", 150);
	const auto LoseFrame = [&] {
		ASSERT_TRUE(Frame(false, false));
		GiveWay();
	};
	ASSERT_TRUE(WaitUntil(
	    "the coarser level", [&] { return Stats().Coarse > 0; }, LoseFrame));
	for (int I = 0; I < 3; ++I) { ASSERT_TRUE(Frame(false, false)); }
	EXPECT_EQ(GetAddress(Terrain), 0u);
	ASSERT_TRUE(Frame());
	ASSERT_NE(GetAddress(Terrain), 0u);
	std::vector<uint32_t> Indices(Terrain->GetIndices()->GetDesc().Size / 4);
	std::memcpy(Indices.data(), Mock().GetBytes(Terrain->GetIndices()), Indices.size() * 4);
	ExpectSound(*Terrain, Indices);
}

TEST_F(FGeometryMemoryTest, OfflineCoarsensOnTheSpotTheLargestMost)
{
	Set("r.RT.Build.MemoryMB", "4");
	const FRTGeometryRef Large = MakeCpu("Large", 200), Small = MakeCpu("Small", 30);
	ASSERT_TRUE(Frame(true));
	EXPECT_NE(GetAddress(Large), 0u);
	EXPECT_NE(GetAddress(Small), 0u);
	EXPECT_TRUE(Large->IsCoarse());
	EXPECT_FALSE(Small->IsCoarse());
	EXPECT_LE(MostUsed, 4u << 20);
}

TEST_F(FGeometryMemoryTest, CoarserLevelsOffLeavesOut)
{
	Set("r.RT.Build.MemoryMB", "2");
	Set("r.RT.Build.CoarserLevels", "0");
	const FRTGeometryRef Terrain = MakeCpu("Plain", 150);
	Frames(20);
	EXPECT_EQ(GetAddress(Terrain), 0u);
	EXPECT_EQ(Stats().Refused, 1u);
	EXPECT_EQ(CountLines("geometry \"Plain\" (45000 triangles) is left out"), 1u);
	Set("r.RT.Build.MemoryMB", "0");
	Settle();
	EXPECT_NE(GetAddress(Terrain), 0u);
	EXPECT_FALSE(Terrain->IsCoarse());
}

TEST_F(FGeometryMemoryTest, GeometryMayGoWhileItIsMadeCoarser)
{
	Set("r.RT.Build.MemoryMB", "2");
	for (int I = 0; I < 5; ++I)
	{
		FRTGeometryRef Terrain = MakeCpu("Brief", 150);
		Frames(9 + I);
		Terrain.reset();
		Frames(1);            // without CpuOwner the data must outlive the next frame's beginning
		CpuPositions.clear(); // the sanitizer would see a task that still reads them
		CpuIndices.clear();
	}
	Frames(12);
	EXPECT_EQ(Device->GetMemoryStats().Geometry, 0u);
	EXPECT_EQ(Stats().Coarse, 0u);
}

// ---------------------------------------------------------------------------------------------------- failures

TEST_F(FGeometryMemoryTest, EveryFailingAllocationIsSurvived)
{
	for (const bool bBuildAll : {false, true})
	{
		for (uint32_t N = 1; N <= 24; ++N)
		{
			Open({});
			Shared = MakeBuffer("Shared", 4096);
			Set("r.RT.Build.MemoryMB", "3");
			std::vector<FRTGeometryRef> Geometries{
			    MakeCpu("T" + std::to_string(N), 150), Make("A", 3000), Make("B", 500, true), Make("C", 20)};
			Mock().FailAllocation(N);
			int Made = 0;
			const auto Step = [&] {
				Store->MarkDeformed(Geometries[2]);
				const FRTStatus Status = Frame(bBuildAll && Made == 0);
				EXPECT_TRUE(Status || Status.Code == ERTResult::OutOfDeviceMemory) << Status.Message;
				++Made;
				if (Stats().Pending > 0) { GiveWay(); }
			};
			// The coarser level too must meet the fault, however late its task is.
			ASSERT_TRUE(WaitUntil(
			    "all builds", [&] { return Made >= 60 && Stats().Pending == 0; }, Step));
			Mock().FailAllocation(0);
			Settle();
			for (const FRTGeometryRef& Geometry : Geometries)
			{
				EXPECT_NE(GetAddress(Geometry), 0u) << N << " " << Geometry->GetInfo().Name;
			}
			EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>());
		}
	}
}

TEST_F(FGeometryMemoryTest, OftenFailingAllocationsAreSurvived)
{
	for (uint32_t N = 2; N <= 9; ++N)
	{
		Open({});
		Shared = MakeBuffer("Shared", 4096);
		std::vector<FRTGeometryRef> Geometries;
		for (int I = 0; I < 20; ++I) { Geometries.push_back(Make("G" + std::to_string(I), 1000, I % 4 == 0)); }
		Mock().FailEveryAllocation(N);
		for (int I = 0; I < 30; ++I) { (void)Frame(); }
		Mock().FailEveryAllocation(0);
		Settle();
		for (const FRTGeometryRef& Geometry : Geometries) { EXPECT_NE(GetAddress(Geometry), 0u) << N; }
	}
}

TEST_F(FGeometryMemoryTest, LostDeviceLeavesTheStoreUsable)
{
	for (const ERTMockCall Kind : {ERTMockCall::CreateGeometry, ERTMockCall::CreateBuffer, ERTMockCall::CreateQueryPool,
	         ERTMockCall::BuildGeometry, ERTMockCall::CompactGeometry, ERTMockCall::Submit})
	{
		Open({});
		Shared = MakeBuffer("Shared", 4096);
		const FRTGeometryRef Geometry = Make("A", 100);
		Mock().LoseDeviceAt(Kind);
		for (int I = 0; I < 4; ++I)
		{
			const FRTStatus Status = Frame();
			EXPECT_TRUE(Status || Status.Code == ERTResult::DeviceLost) << Status.Message;
			(void)Store->NeedsUpdate();
		}
		FRTGeometryRef Another;
		EXPECT_TRUE(Store->Create(MakeInfo("B", 1), Another));
	}
}

} // namespace
} // namespace Lantern
