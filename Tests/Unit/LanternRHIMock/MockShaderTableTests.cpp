// Shader-table arithmetic on the mock, under the alignments that devices have or may have.
#include "Support/MockTestTools.h"

#include <thread>

namespace Lantern
{
namespace
{

struct FAlignments
{
	uint32_t HandleSize, HandleAlignment, BaseAlignment;
};

class FMockTableTests : public testing::TestWithParam<FAlignments>
{
protected:
	void SetUp() override
	{
		FRTMockDesc Desc;
		Desc.HandleSize = GetParam().HandleSize;
		Desc.HandleAlignment = GetParam().HandleAlignment;
		Desc.BaseAlignment = GetParam().BaseAlignment;
		ASSERT_OK(CreateMockDevice(Desc, Make.Device.ReleaseAndGetAddress()));
		Mock = &GetMock(Make.Device.Get());
		Pipeline = Make.RayTracing();
	}
	void Update(IRTShaderTable* Table)
	{
		const auto List = Make.List();
		List->UpdateShaderTable(Table);
		Make.Submit(List.Get());
	}

	FMockMaker Make;
	FRTMock* Mock = nullptr;
	TRTRef<IRTPipeline> Pipeline;
};

TEST_P(FMockTableTests, StridesAreAligned)
{
	const auto Table = Make.Table(Pipeline.Get(), 3, 20);
	for (const ERTRecordKind Kind : {ERTRecordKind::RayGen, ERTRecordKind::Miss, ERTRecordKind::Hit, ERTRecordKind::Callable})
	{
		EXPECT_EQ(Table->GetRecordStride(Kind) % GetParam().HandleAlignment, 0u);
		EXPECT_GE(Table->GetRecordStride(Kind), GetParam().HandleSize);
	}
	EXPECT_EQ(Table->GetRecordStride(ERTRecordKind::RayGen) % GetParam().BaseAlignment, 0u);
	EXPECT_GE(Table->GetRecordStride(ERTRecordKind::Hit), GetParam().HandleSize + 20u);
}

TEST_P(FMockTableTests, ResolvesWhatARayReaches)
{
	const auto Table = Make.Table(Pipeline.Get(), 8, 16);
	const uint32_t Data[4] = {1, 2, 3, 4};
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Hit, 7, 3, Data, sizeof(Data));
	Table->SetRecord(ERTRecordKind::Hit, 6, 2, Data, 4);
	Update(Table.Get());
	// Offset 3, geometry 2, two ray types: 3 + 2·2 + 0.
	const FRTMockRecord Leaf = Mock->ResolveHit(Table.Get(), Make.Instance(0, 3), 2, 0, 2);
	EXPECT_TRUE(Leaf.IsGood()) << Leaf.Error;
	EXPECT_EQ(Leaf.Index, 7u);
	EXPECT_EQ(Leaf.Group, 3u);
	EXPECT_EQ(Leaf.ClosestHit, "Leaf");
	EXPECT_EQ(Leaf.AnyHit, "LeafMask");
	EXPECT_EQ(0, std::memcmp(Leaf.Data.data(), Data, sizeof(Data)));
	const FRTMockRecord Stone = Mock->ResolveHit(Table.Get(), Make.Instance(0, 3), 1, 1, 2);
	EXPECT_EQ(Stone.ClosestHit, "Stone");
	EXPECT_EQ(Stone.Data, (std::vector<uint8_t>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
	const FRTMockRecord Beyond = Mock->ResolveHit(Table.Get(), Make.Instance(0, 3), 2, 1, 2);
	EXPECT_FALSE(Beyond.bInRange);
	EXPECT_EQ(Beyond.Error, "Table: record 8 of 8");
	EXPECT_TRUE(Mock->ResolveHit(Table.Get(), Make.Instance(0, 0), 0, 0, 1).bNull);
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::RayGen, 0).General, "RayGen");
}

TEST_P(FMockTableTests, InstanceFlagsDoNotReachTheIndex)
{
	const auto Table = Make.Table(Pipeline.Get(), 2);
	Table->SetRecord(ERTRecordKind::Hit, 1, 2, nullptr, 0);
	Update(Table.Get());
	FRTInstance Instance = Make.Instance(0, 1);
	Instance.TableOffsetAndFlags |= static_cast<uint32_t>(InstanceCullDisable) << 24;
	EXPECT_EQ(Mock->ResolveHit(Table.Get(), Instance, 0, 0, 1).ClosestHit, "Stone");
}

TEST_P(FMockTableTests, CopiesDirtyRangesOnly)
{
	const auto Table = Make.Table(Pipeline.Get(), 100);
	const uint64_t Stride = Table->GetRecordStride(ERTRecordKind::Hit);
	for (const uint32_t Index : {10u, 11u, 12u, 50u, 11u}) { Table->SetRecord(ERTRecordKind::Hit, Index, 2, nullptr, 0); }
	Update(Table.Get());
	Update(Table.Get());
	const auto Calls = Mock->FindCalls(ERTMockCall::UpdateShaderTable);
	ASSERT_EQ(Calls.size(), 2u);
	EXPECT_EQ(Calls[0].Numbers[0], 4 * Stride);
	EXPECT_EQ(Calls[0].Numbers[1], 2u);
	EXPECT_EQ(Calls[1].Numbers[0], 0u);
	for (const uint32_t Index : {10u, 11u, 12u, 50u})
	{
		EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, Index).IsGood()) << Index;
	}
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 13).bNull);
}

TEST_P(FMockTableTests, DeviceCopyLagsUntilTheFence)
{
	Mock->SetManualFences(true);
	const auto Table = Make.Table(Pipeline.Get(), 1);
	Table->SetRecord(ERTRecordKind::Hit, 0, 2, nullptr, 0);
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	// Written after the update was recorded: belongs to the next one.
	Table->SetRecord(ERTRecordKind::Hit, 0, 3, nullptr, 0);
	const FRTFence Fence = Make.Submit(List.Get());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 0).bNull);
	Mock->CompleteUpTo(Fence);
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 0).Group, 2u);
	Mock->SetManualFences(false);
	Update(Table.Get());
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 0).Group, 3u);
}

TEST_P(FMockTableTests, KeepsItsPipeline)
{
	const auto Table = Make.Table(Pipeline.Get(), 1);
	Pipeline.Reset();
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Destroy), 0u);
	Table->SetRecord(ERTRecordKind::Hit, 0, 2, nullptr, 0);
	Update(Table.Get());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 0).IsGood());
}

TEST_P(FMockTableTests, RangesOfRecordsAndOfGroups)
{
	const auto Table = Make.Table(Pipeline.Get(), 200, 12);
	const uint64_t Stride = Table->GetRecordStride(ERTRecordKind::Hit);
	std::vector<uint32_t> Groups(150), Data(150 * 3);
	for (uint32_t i = 0; i < 150; ++i)
	{
		Groups[i] = 2 + i % 2;
		Data[3 * i] = i;
	}
	Table->SetHitRecords(40, 150, Groups.data(), Data.data());
	Update(Table.Get());
	EXPECT_EQ(Table->GetUpdatedBytes(), 150 * Stride);
	std::swap(Groups[0], Groups[1]);
	Table->SetGroups(ERTRecordKind::Hit, 40, 2, Groups.data());
	Update(Table.Get());
	EXPECT_EQ(Table->GetUpdatedBytes(), 2 * Stride);
	for (uint32_t i = 0; i < 150; ++i)
	{
		const FRTMockRecord Record = Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 40 + i);
		ASSERT_TRUE(Record.IsGood()) << Record.Error;
		ASSERT_EQ(Record.Group, Groups[i]);
		ASSERT_EQ(0, std::memcmp(Record.Data.data(), &Data[3 * i], 12)) << "the data stays";
	}
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 39).bNull);
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 190).bNull);
	Table->SetHitRecords(40, 1, Groups.data(), nullptr);
	Update(Table.Get());
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 40).Data, std::vector<uint8_t>(12));
	Update(Table.Get());
	EXPECT_EQ(Table->GetUpdatedBytes(), 0u);
}

TEST_P(FMockTableTests, HostCopiesInFlightAreNotOverwritten)
{
	Mock->SetManualFences(true);
	const auto Table = Make.Table(Pipeline.Get(), 64, 4);
	std::vector<FRTFence> Fences;
	// More frames in flight than the table has copies.
	for (uint32_t Frame = 0; Frame < 6; ++Frame)
	{
		Table->SetRecord(ERTRecordKind::Hit, 7, 2, &Frame, 4);
		const auto List = Make.List();
		List->UpdateShaderTable(Table.Get());
		Fences.push_back(Make.Submit(List.Get()));
	}
	FRTMockTable Ring = Mock->GetTable(Table.Get());
	EXPECT_EQ(Ring.HostCopies, 6u);
	EXPECT_EQ(Ring.HostCopiesInUse, 6u);
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::MakeHostCopy), 3u) << "three there were";
	EXPECT_EQ(Mock->GetBlockingWaits(), 0u);
	for (uint32_t Frame = 0; Frame < 6; ++Frame)
	{
		Mock->CompleteUpTo(Fences[Frame]);
		const FRTMockRecord Record = Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 7);
		ASSERT_TRUE(Record.IsGood()) << Record.Error;
		EXPECT_EQ(Record.Data[0], Frame);
	}
	EXPECT_EQ(Mock->GetTable(Table.Get()).HostCopiesInUse, 0u);
	for (uint32_t Frame = 0; Frame < 6; ++Frame)
	{
		Table->SetRecord(ERTRecordKind::Hit, 7, 2, &Frame, 4);
		const auto List = Make.List();
		List->UpdateShaderTable(Table.Get());
		Mock->CompleteUpTo(Make.Submit(List.Get()));
	}
	EXPECT_EQ(Mock->GetTable(Table.Get()).HostCopiesMade, 6u) << "free ones are used again";
}

TEST_P(FMockTableTests, StagedOnceForTheNextUpdate)
{
	const auto Table = Make.Table(Pipeline.Get(), 8, 4);
	const uint32_t One = 1, Two = 2;
	Table->SetRecord(ERTRecordKind::Hit, 3, 2, &One, 4);
	ASSERT_OK(Table->Stage());
	Table->SetRecord(ERTRecordKind::Hit, 3, 2, &Two, 4);
	Table->SetRecord(ERTRecordKind::Hit, 4, 3, &One, 4);
	ASSERT_OK(Table->Stage());
	ASSERT_OK(Table->Stage());
	EXPECT_EQ(Mock->GetTable(Table.Get()).HostCopiesInUse, 1u);
	Update(Table.Get());
	const auto Calls = Mock->FindCalls(ERTMockCall::UpdateShaderTable);
	EXPECT_EQ(Calls[0].Numbers[0], 2 * Table->GetRecordStride(ERTRecordKind::Hit));
	EXPECT_EQ(Calls[0].Numbers[1], 1u) << "one range";
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::StageShaderTable), 2u);
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 3).Data[0], 2u);
	EXPECT_EQ(Mock->GetTraffic().Table, Calls[0].Numbers[0]);
}

TEST_P(FMockTableTests, GrowsWhileFramesAreInFlight)
{
	const auto Table = Make.Table(Pipeline.Get(), 4, 4);
	const uint32_t Old = 1, New = 2;
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Hit, 3, 2, &Old, 4);
	Table->SetRecord(ERTRecordKind::Callable, 0, 4, nullptr, 0);
	Update(Table.Get());
	Mock->SetManualFences(true);
	const auto Before = Make.List("Before"), After = Make.List("After");
	Before->SetPipeline(Pipeline.Get());
	Before->TraceRays(Table.Get(), 0, 1, 1, 1);
	const FRTFence First = Make.Submit(Before.Get());
	const uint32_t Counts[4] = {1, 3, 100, 1};
	ASSERT_OK(Table->Reserve(Counts));
	EXPECT_EQ(Table->GetDesc().HitCount, 100u);
	Table->SetRecord(ERTRecordKind::Hit, 99, 3, &New, 4);
	After->UpdateShaderTable(Table.Get());
	EXPECT_EQ(Table->GetUpdatedBytes(), Table->GetRecordStride(ERTRecordKind::Hit)) << "the rest moves on the device";
	After->SetPipeline(Pipeline.Get());
	After->TraceRays(Table.Get(), 0, 1, 1, 1);
	const FRTFence Second = Make.Submit(After.Get());
	Mock->CompleteUpTo(First);
	EXPECT_FALSE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 99).bInRange) << "the move is not reached yet";
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 3).IsGood());
	EXPECT_EQ(Mock->GetTable(Table.Get()).Moves, 0u);
	Mock->CompleteUpTo(Second);
	EXPECT_EQ(Mock->GetTable(Table.Get()).Moves, 1u);
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 3).Data[0], Old);
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 99).Data[0], New);
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Callable, 0).IsGood());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::RayGen, 0).IsGood());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 50).bNull);
	EXPECT_TRUE(Mock->GetErrors().empty());
	EXPECT_EQ(Mock->GetBlockingWaits(), 0u);
	// Old host copies go when they are free: one that fits is left of those in use.
	EXPECT_EQ(Make.Device->GetMemoryStats().ShaderTable, Table->GetSizeBytes() + Mock->GetTable(Table.Get()).HostBytes);
}

TEST_P(FMockTableTests, StagedRecordsSurviveGrowth)
{
	const auto Table = Make.Table(Pipeline.Get(), 4, 4);
	const uint32_t Value = 9;
	Table->SetRecord(ERTRecordKind::Hit, 3, 2, &Value, 4);
	ASSERT_OK(Table->Stage());
	const uint32_t Counts[4] = {5, 3, 100, 1};
	ASSERT_OK(Table->Reserve(Counts));
	ASSERT_OK(Table->Reserve(Counts)); // nothing to do
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::ReserveShaderTable), 1u);
	Update(Table.Get());
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 3).Data[0], Value);
}

TEST_P(FMockTableTests, FailedGrowthChangesNothing)
{
	const auto Table = Make.Table(Pipeline.Get(), 4, 4);
	Table->SetRecord(ERTRecordKind::Hit, 3, 2, nullptr, 0);
	const uint64_t Bytes = Make.Device->GetMemoryStats().Total, Size = Table->GetSizeBytes();
	Mock->FailAllocation(1);
	const uint32_t Counts[4] = {1, 1, 5, 1};
	EXPECT_EQ(Table->Reserve(Counts).Code, ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(Table->GetDesc().HitCount, 4u);
	EXPECT_EQ(Table->GetSizeBytes(), Size);
	EXPECT_EQ(Make.Device->GetMemoryStats().Total, Bytes);
	ASSERT_OK(Table->Reserve(Counts));
	// The host copies are too small now: a new one is an allocation of its own.
	Mock->FailAllocation(1);
	EXPECT_EQ(Table->Stage().Code, ERTResult::OutOfDeviceMemory);
	Mock->FailAllocation(1);
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	EXPECT_EQ(List->End().Code, ERTResult::OutOfDeviceMemory) << "the list says it at its end";
	Update(Table.Get());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 3).IsGood()) << "nothing was lost";
}

TEST_P(FMockTableTests, SwapOfThePipelineByHandles)
{
	Mock->SetManualFences(true);
	const auto New = Make.RayTracing("NewRTPSO");
	const auto Table = Make.Table(Pipeline.Get(), 3, 4);
	const uint32_t Groups[3] = {2, 3, 2}, RayGen = 0, Data[3] = {5, 6, 7};
	Table->SetGroups(ERTRecordKind::RayGen, 0, 1, &RayGen);
	Table->SetHitRecords(0, 3, Groups, Data);
	const auto Before = Make.List("Before"), After = Make.List("After");
	Before->UpdateShaderTable(Table.Get());
	Before->SetPipeline(Pipeline.Get());
	Before->TraceRays(Table.Get(), 0, 1, 1, 1);
	const FRTFence First = Make.Submit(Before.Get());
	Table->SetPipeline(New.Get());
	EXPECT_EQ(Table->GetDesc().Pipeline, New.Get());
	Table->SetGroups(ERTRecordKind::RayGen, 0, 1, &RayGen);
	Table->SetGroups(ERTRecordKind::Hit, 0, 2, Groups);
	After->UpdateShaderTable(Table.Get());
	After->SetPipeline(New.Get());
	After->TraceRays(Table.Get(), 0, 1, 1, 1);
	const FRTFence Second = Make.Submit(After.Get());
	Pipeline.Reset();
	Mock->CompleteUpTo(First);
	for (uint32_t i = 0; i < 3; ++i)
	{
		const FRTMockRecord Record = Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, i);
		EXPECT_TRUE(Record.IsGood()) << Record.Error;
		EXPECT_EQ(Record.Pipeline, "RTPSO") << "what is in flight keeps the old pipeline";
	}
	Mock->CompleteUpTo(Second);
	for (uint32_t i = 0; i < 2; ++i)
	{
		const FRTMockRecord Record = Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, i);
		EXPECT_TRUE(Record.IsGood()) << Record.Error;
		EXPECT_EQ(Record.Pipeline, "NewRTPSO");
		EXPECT_EQ(Record.Data[0], Data[i]);
	}
	const FRTMockRecord Stale = Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 2);
	EXPECT_TRUE(Stale.bStale);
	EXPECT_FALSE(Stale.IsGood());
	EXPECT_TRUE(Mock->GetErrors().empty());
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Destroy, "RTPSO"), 1u) << "gone with its fence";
}

TEST_P(FMockTableTests, RecordsOfAnotherLivingPipelineAreStale)
{
	const auto New = Make.RayTracing("NewRTPSO");
	const auto Table = Make.Table(Pipeline.Get(), 2);
	const uint32_t Groups[2] = {2, 3};
	Table->SetHitRecords(0, 2, Groups, nullptr);
	Update(Table.Get());
	Table->SetPipeline(New.Get());
	Table->SetGroups(ERTRecordKind::Hit, 1, 1, Groups);
	Update(Table.Get());
	const FRTMockRecord Stale = Mock->ResolveHit(Table.Get(), Make.Instance(0, 0), 0, 0, 1);
	EXPECT_TRUE(Stale.bStale);
	EXPECT_EQ(Stale.Error, "Table: record 0 has a handle of pipeline RTPSO");
	EXPECT_TRUE(Mock->ResolveHit(Table.Get(), Make.Instance(0, 1), 0, 0, 1).IsGood());
}

TEST_P(FMockTableTests, TracingANewPipelineBeforeItsUpdateIsAnError)
{
	const auto New = Make.RayTracing("NewRTPSO");
	const auto Table = Make.Table(Pipeline.Get(), 1);
	Update(Table.Get());
	Table->SetPipeline(New.Get());
	const auto List = Make.List();
	List->SetPipeline(New.Get());
	List->TraceRays(Table.Get(), 0, 4, 4, 1);
	Make.Submit(List.Get());
	EXPECT_EQ(Mock->GetErrors().size(), 1u);
}

TEST_P(FMockTableTests, InvalidateAfterAListThatWasNeverSubmitted)
{
	const auto Table = Make.Table(Pipeline.Get(), 4, 4);
	const uint32_t Value = 3;
	Table->SetRecord(ERTRecordKind::Hit, 1, 2, &Value, 4);
	Update(Table.Get());
	const uint32_t Counts[4] = {1, 1, 9, 1};
	ASSERT_OK(Table->Reserve(Counts));
	Table->SetRecord(ERTRecordKind::Hit, 8, 3, &Value, 4);
	{
		const auto Lost = Make.List("Lost");
		Lost->UpdateShaderTable(Table.Get());
	}
	Table->Invalidate();
	Update(Table.Get());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 1).IsGood());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 8).IsGood());
	EXPECT_TRUE(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 2).bNull);
	EXPECT_EQ(Mock->GetTable(Table.Get()).HostCopiesInUse, 0u);
}

TEST_P(FMockTableTests, RecordsFromManyThreads)
{
	constexpr uint32_t Count = 40'000;
	const auto Table = Make.Table(Pipeline.Get(), Count, 4);
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < 4; ++Thread)
	{
		Threads.emplace_back([&, Thread] {
			// Interleaved: neighbours share words of what is dirty.
			for (uint32_t i = Thread; i < Count; i += 4) { Table->SetRecord(ERTRecordKind::Hit, i, 2 + i % 2, &i, 4); }
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	Update(Table.Get());
	EXPECT_EQ(Table->GetUpdatedBytes(), Count * Table->GetRecordStride(ERTRecordKind::Hit));
	for (uint32_t i = 0; i < Count; ++i)
	{
		const FRTMockRecord Record = Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, i);
		ASSERT_TRUE(Record.IsGood() && Record.Group == 2 + i % 2 && std::memcmp(Record.Data.data(), &i, 4) == 0) << i;
	}
}

TEST_P(FMockTableTests, TracingBeforeAnyUpdateIsAnError)
{
	const auto Table = Make.Table(Pipeline.Get(), 1);
	const auto List = Make.List();
	List->SetPipeline(Pipeline.Get());
	List->TraceRays(Table.Get(), 0, 4, 4, 1);
	Make.Submit(List.Get());
	ASSERT_EQ(Mock->GetErrors().size(), 1u);
	EXPECT_EQ(Mock->GetErrors()[0], "Table: rays traced before any UpdateShaderTable");
}

INSTANTIATE_TEST_SUITE_P(Alignments, FMockTableTests,
    testing::Values(FAlignments{32, 32, 64}, FAlignments{32, 16, 32}, FAlignments{32, 64, 64}, FAlignments{64, 64, 256}),
    [](const auto& Info) {
	return "Handle" + std::to_string(Info.param.HandleSize) + "Align" + std::to_string(Info.param.HandleAlignment) + "Base" +
	       std::to_string(Info.param.BaseAlignment);
});

} // namespace
} // namespace Lantern
