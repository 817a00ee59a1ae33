// Shader-table arithmetic on the mock, under the alignments that devices have or may have.
#include "MockTestTools.h"

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
	for (const ERTRecordKind Kind :
	     {ERTRecordKind::RayGen, ERTRecordKind::Miss, ERTRecordKind::Hit, ERTRecordKind::Callable})
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
	for (const uint32_t Index : {10u, 11u, 12u, 50u, 11u})
	{
		Table->SetRecord(ERTRecordKind::Hit, Index, 2, nullptr, 0);
	}
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
                         testing::Values(FAlignments{32, 32, 64}, FAlignments{32, 16, 32}, FAlignments{32, 64, 64},
                                         FAlignments{64, 64, 256}),
                         [](const auto& Info)
                         {
	                         return "Handle" + std::to_string(Info.param.HandleSize) + "Align" +
	                                std::to_string(Info.param.HandleAlignment) + "Base" +
	                                std::to_string(Info.param.BaseAlignment);
                         });

} // namespace
} // namespace Lantern
