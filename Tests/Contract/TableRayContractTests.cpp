// What rays reach through shader tables that change: ranges, growth and swaps in flight, many threads.
#include "RayFixture.h"

#include <thread>

namespace Lantern
{
namespace
{

class FTableRays : public FRayContract
{
protected:
	/// A trace that was submitted and not waited for.
	struct FFrame
	{
		FRTFence Fence = 0;
		FContractPush Push;
		TRTRef<IRTBuffer> Output;
	};

	void SetUp() override
	{
		FRayContract::SetUp();
		// Frames stay in flight until they are collected.
		if (!HasFatalFailure() && !IsSkipped() && IsMock()) { GetMock(&Device()).SetManualFences(true); }
	}
	void TearDown() override
	{
		if (IsMock() && Make.Device) { GetMock(&Device()).SetManualFences(false); }
		Square = {};
		FRayContract::TearDown();
	}
	/// Builds squares side by side. That of pixel i has the table offset Offsets[i] and the custom index i.
	void LoadSquares(const std::vector<uint32_t>& Offsets)
	{
		Square = MakeSquares();
		const auto List = Make.List("Load");
		Build(List.Get(), Square);
		BuildScene(List.Get(), Scene.Get(), PlaceSquares(Offsets));
		Finish(Make.Submit(List.Get()));
	}
	std::vector<FRTInstance> PlaceSquares(const std::vector<uint32_t>& Offsets) const
	{
		std::vector<FRTInstance> Instances;
		for (uint32_t i = 0; i < Offsets.size(); ++i) { Instances.push_back(Place(Square, static_cast<float>(i), i, Offsets[i])); }
		return Instances;
	}
	void Finish(FRTFence Fence)
	{
		if (IsMock()) { GetMock(&Device()).CompleteUpTo(Fence); }
		Wait(Fence);
	}
	/// Offsets: those of a scene that replaces the one loaded; empty to keep it.
	FFrame Begin(uint32_t Width, const std::vector<uint32_t>& Offsets = {})
	{
		FFrame Frame;
		Frame.Output = Make.Buffer(Width * 4, ERTMemory::Readback, "Output");
		Frame.Push = MakePush();
		Frame.Push.Output = Frame.Output->GetDeviceAddress();
		const auto List = Make.List("Frame");
		if (!Offsets.empty())
		{
			const FRTBarrier Before = {nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildWrite, ERTAccess::BuildWrite};
			List->Barriers(&Before, 1);
			BuildScene(List.Get(), Scene.Get(), PlaceSquares(Offsets));
		}
		List->UpdateShaderTable(Table.Get());
		List->SetPipeline(Pipeline.Get());
		List->PushConstants(&Frame.Push, sizeof(Frame.Push));
		List->TraceRays(Table.Get(), 0, Width, 1, 1);
		Barrier(List.Get(), Frame.Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
		Frame.Fence = Make.Submit(List.Get());
		return Frame;
	}
	/// Call it in the order in which the frames were begun.
	FWords Collect(const FFrame& Frame)
	{
		Finish(Frame.Fence);
		const auto Width = static_cast<uint32_t>(Frame.Output->GetDesc().Size / 4);
		if (IsMock()) { return TraceOnMock(GetMock(&Device()), Table.Get(), Scene.Get(), Frame.Push, Width, 0); }
		const auto* Words = static_cast<const uint32_t*>(Frame.Output->GetMapped());
		return {Words, Words + Width};
	}
	void SetAllGroups(uint32_t Hit, uint32_t HitCount)
	{
		const uint32_t RayGens[] = {GroupTrace, GroupCall}, Misses[] = {GroupMissOne, GroupMissTwo};
		const uint32_t Callables[] = {GroupDouble, GroupSquare};
		const std::vector<uint32_t> Hits(HitCount, Hit);
		Table->SetGroups(ERTRecordKind::RayGen, 0, 2, RayGens);
		Table->SetGroups(ERTRecordKind::Miss, 0, 2, Misses);
		Table->SetGroups(ERTRecordKind::Callable, 0, 2, Callables);
		Table->SetGroups(ERTRecordKind::Hit, 0, HitCount, Hits.data());
	}

	FContractGeometry Square;
};

TEST_P(FTableRays, RangesAndGroups)
{
	MakeTable(12);
	LoadSquares({2, 5, 9, 11});
	std::vector<uint32_t> Groups(10, GroupHit), Data;
	for (uint32_t i = 0; i < 10; ++i) { Data.push_back(100 + i); }
	Table->SetHitRecords(2, 10, Groups.data(), Data.data());
	const auto Value = [](uint32_t Record, uint32_t Custom) { return HitValue(98 + Record, Custom, 0, 0); };
	EXPECT_EQ(Collect(Begin(5)), (FWords{Value(2, 0), Value(5, 1), Value(9, 2), Value(11, 3), MissOne}));
	// Handles alone change and change back: the data stays.
	const uint32_t Disc[] = {GroupMasked, GroupMasked}, Back[] = {GroupHit, GroupHit}, MissGroup = GroupMissTwo;
	Table->SetGroups(ERTRecordKind::Hit, 8, 2, Disc);
	Table->SetGroups(ERTRecordKind::Miss, 0, 1, &MissGroup);
	EXPECT_EQ(Collect(Begin(5))[4], MissTwo);
	Table->SetGroups(ERTRecordKind::Hit, 8, 2, Back);
	EXPECT_EQ(Collect(Begin(5)), (FWords{Value(2, 0), Value(5, 1), Value(9, 2), Value(11, 3), MissTwo}));
	Table->SetHitRecords(9, 1, Groups.data(), nullptr);
	EXPECT_EQ(Collect(Begin(5))[2], HitValue(0, 2, 0, 0)) << "no data: zeros";
}

TEST_P(FTableRays, RecordsNeverWrittenRunNoShader)
{
	MakeTable(3);
	LoadSquares({0, 1, 2});
	SetHit(1, 7);
	EXPECT_EQ(Collect(Begin(3)), (FWords{0, HitValue(7, 1, 0, 0), 0}));
}

TEST_P(FTableRays, FramesInFlightKeepTheirRecords)
{
	MakeTable(2);
	LoadSquares({0, 1});
	SetHit(1, 999);
	std::vector<FFrame> Frames;
	for (uint32_t i = 0; i < 8; ++i)
	{
		SetHit(0, i);
		Frames.push_back(Begin(2));
	}
	for (uint32_t i = 0; i < 8; ++i)
	{
		EXPECT_EQ(Collect(Frames[i]), (FWords{HitValue(i, 0, 0, 0), HitValue(999, 1, 0, 0)})) << "frame " << i;
	}
}

TEST_P(FTableRays, GrowthWhileFramesAreInFlight)
{
	MakeTable(2);
	LoadSquares({1});
	SetHit(0, 10);
	SetHit(1, 11);
	std::vector<FFrame> Frames;
	Frames.push_back(Begin(1));
	const uint32_t Counts[4] = {2, 4, 701, 3}, More[4] = {2, 9, 5000, 3};
	ASSERT_OK(Table->Reserve(Counts));
	SetHit(700, 12);
	Frames.push_back(Begin(3, {1, 700, 0}));
	ASSERT_OK(Table->Reserve(More));
	SetHit(1, 13);
	ASSERT_OK(Table->Stage());
	Frames.push_back(Begin(3));
	EXPECT_EQ(Collect(Frames[0]), FWords{HitValue(11, 0, 0, 0)});
	EXPECT_EQ(Collect(Frames[1]), (FWords{HitValue(11, 0, 0, 0), HitValue(12, 1, 0, 0), HitValue(10, 2, 0, 0)}));
	EXPECT_EQ(Collect(Frames[2]), (FWords{HitValue(13, 0, 0, 0), HitValue(12, 1, 0, 0), HitValue(10, 2, 0, 0)}));
}

TEST_P(FTableRays, ThePipelineIsSwappedByHandlesAlone)
{
	MakeTable(3);
	LoadSquares({0, 1, 2});
	for (uint32_t i = 0; i < 3; ++i) { SetHit(i, 20 + i); }
	const FFrame Before = Begin(4);
	const TRTRef<IRTPipeline> Old = Pipeline;
	Pipeline = MakeRayPipeline(Device());
	Table->SetPipeline(Pipeline.Get());
	SetAllGroups(GroupHit, 3);
	const FFrame After = Begin(4);
	SetHit(1, 77);
	const FFrame Last = Begin(4);
	const FWords Expected = {HitValue(20, 0, 0, 0), HitValue(21, 1, 0, 0), HitValue(22, 2, 0, 0), MissOne};
	EXPECT_EQ(Collect(Before), Expected);
	EXPECT_EQ(Collect(After), Expected);
	EXPECT_EQ(Collect(Last)[1], HitValue(77, 1, 0, 0));
}

TEST_P(FTableRays, ManyHandlesAtOnceLeaveTheDataAlone)
{
	constexpr uint32_t Count = 3000;
	MakeTable(Count);
	LoadSquares({1, 300, 1500, Count - 1});
	std::vector<uint32_t> Wrong(Count, GroupMasked), Right(Count, GroupHit), Data;
	for (uint32_t i = 0; i < Count; ++i) { Data.push_back(10 + i); }
	Table->SetHitRecords(0, Count, Wrong.data(), Data.data());
	const FFrame Before = Begin(5);
	const auto SetAll = [&](const std::vector<uint32_t>& Groups) {
		Table->SetGroups(ERTRecordKind::Hit, 0, static_cast<uint32_t>(Groups.size()), Groups.data());
	};
	const auto Expect = [&](const FFrame& Frame, uint32_t Third, const char* When) {
		EXPECT_EQ(Collect(Frame),
		    (FWords{HitValue(11, 0, 0, 0), HitValue(310, 1, 0, 0), HitValue(Third, 2, 0, 0), HitValue(9 + Count, 3, 0, 0), MissOne}))
		    << When;
	};
	SetAll(Right);
	const FFrame Alone = Begin(5);
	SetAll(Wrong);
	ASSERT_OK(Table->Stage());
	SetAll(Right);
	SetHit(1500, 77);
	const FFrame WithOne = Begin(5);
	SetAll(Wrong);
	ASSERT_OK(Table->Stage());
	Table->Invalidate();
	SetAll(Right);
	const FFrame AfterLoss = Begin(5);
	const uint32_t Counts[4] = {2, 4, 2 * Count, 3};
	SetAll(Wrong);
	ASSERT_OK(Table->Stage());
	ASSERT_OK(Table->Reserve(Counts));
	SetAll(Right);
	const FFrame Grown = Begin(5);
	Collect(Before);
	Expect(Alone, 1510, "alone");
	Expect(WithOne, 77, "beside a whole record");
	Expect(AfterLoss, 77, "after an update was lost");
	Expect(Grown, 77, "while the table grew");
}

TEST_P(FTableRays, AReleasedPipelineLivesAsLongAsItsFrames)
{
	MakeTable(1);
	LoadSquares({0});
	SetHit(0, 3);
	std::vector<FFrame> Frames;
	for (uint32_t i = 0; i < 4; ++i)
	{
		Frames.push_back(Begin(1));
		Pipeline = MakeRayPipeline(Device());
		Table->SetPipeline(Pipeline.Get());
		SetAllGroups(GroupHit, 1);
		Device().CollectGarbage();
	}
	Frames.push_back(Begin(1));
	for (const FFrame& Frame : Frames) { EXPECT_EQ(Collect(Frame), FWords{HitValue(3, 0, 0, 0)}); }
}

TEST_P(FTableRays, SwapAndGrowthAtOnce)
{
	MakeTable(2);
	LoadSquares({1});
	SetHit(1, 4);
	const FFrame Before = Begin(1);
	Pipeline = MakeRayPipeline(Device());
	Table->SetPipeline(Pipeline.Get());
	const uint32_t Counts[4] = {2, 2, 400, 2};
	ASSERT_OK(Table->Reserve(Counts));
	SetAllGroups(GroupHit, 2);
	SetHit(300, 5);
	const FFrame After = Begin(2, {1, 300});
	EXPECT_EQ(Collect(Before), FWords{HitValue(4, 0, 0, 0)});
	EXPECT_EQ(Collect(After), (FWords{HitValue(4, 0, 0, 0), HitValue(5, 1, 0, 0)}));
}

TEST_P(FTableRays, RecordsFromManyThreadsStagedByAnother)
{
	constexpr uint32_t Count = 6400, ThreadCount = 4;
	MakeTable(Count);
	std::vector<uint32_t> Offsets;
	for (uint32_t i = 0; i < 64; ++i) { Offsets.push_back(i * 100 + i); }
	LoadSquares(Offsets);
	for (uint32_t Round = 0; Round < 3; ++Round)
	{
		std::vector<std::thread> Threads;
		for (uint32_t Thread = 0; Thread < ThreadCount; ++Thread)
		{
			Threads.emplace_back([&, Thread] {
				// Neighbours are set by different threads.
				for (uint32_t i = Thread; i < Count; i += ThreadCount) { SetHit(i, (i + Round) & 0x7fff); }
			});
		}
		for (std::thread& Thread : Threads) { Thread.join(); }
		std::thread([&] { EXPECT_OK(Table->Stage()); }).join();
		const FWords Found = Collect(Begin(64));
		for (uint32_t i = 0; i < 64; ++i) { EXPECT_EQ(Found[i], HitValue((Offsets[i] + Round) & 0x7fff, i, 0, 0)) << "square " << i; }
	}
}

TEST_P(FTableRays, InvalidateAfterALostList)
{
	MakeTable(2);
	LoadSquares({0, 1});
	SetHit(0, 1);
	SetHit(1, 2);
	EXPECT_EQ(Collect(Begin(2)), (FWords{HitValue(1, 0, 0, 0), HitValue(2, 1, 0, 0)}));
	SetHit(1, 3);
	const uint32_t Counts[4] = {2, 2, 50, 2};
	ASSERT_OK(Table->Reserve(Counts));
	{
		const auto Lost = Make.List("Lost");
		Lost->UpdateShaderTable(Table.Get());
		EXPECT_OK(Lost->End());
	}
	Table->Invalidate();
	EXPECT_EQ(Collect(Begin(2)), (FWords{HitValue(1, 0, 0, 0), HitValue(3, 1, 0, 0)}));
}

INSTANTIATE_TEST_SUITE_P(RHI, FTableRays, testing::ValuesIn(RayRHIs), [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
