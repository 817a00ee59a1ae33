// Shader tables: strides, updates, growth and the swap of the pipeline.
#include "ContractShaders.h"

namespace Lantern
{
namespace
{

class FTableContract : public FContract
{
protected:
	void SetUp() override
	{
		FContract::SetUp();
		if (HasFatalFailure()) { return; }
		if (!Caps().bRayTracingPipeline) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
		Pipeline = MakeRayPipeline(Device());
	}
	void TearDown() override
	{
		Pipeline.Reset();
		FContract::TearDown();
	}
	TRTRef<IRTShaderTable> MakeTable(uint32_t HitCount, uint32_t DataBytes)
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline.Get();
		Desc.RayGenCount = 2;
		Desc.MissCount = 2;
		Desc.HitCount = HitCount;
		Desc.CallableCount = 1;
		Desc.RecordDataBytes = DataBytes;
		Desc.Name = "Table";
		TRTRef<IRTShaderTable> Out;
		EXPECT_OK(Device().CreateShaderTable(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}

	TRTRef<IRTPipeline> Pipeline;
};

TEST_P(FTableContract, StridesAreAligned)
{
	for (const uint32_t DataBytes : {0u, 4u, 17u, MaxRecordDataBytes})
	{
		const auto Table = MakeTable(7, DataBytes);
		const uint64_t Hit = Table->GetRecordStride(ERTRecordKind::Hit);
		EXPECT_EQ(Hit % Caps().ShaderGroupHandleAlignment, 0u);
		EXPECT_GE(Hit, Caps().ShaderGroupHandleSize + DataBytes);
		EXPECT_LT(Hit, Caps().ShaderGroupHandleSize + DataBytes + Caps().ShaderGroupHandleAlignment) << "no waste";
		for (const ERTRecordKind Kind : {ERTRecordKind::RayGen, ERTRecordKind::Miss, ERTRecordKind::Callable})
		{
			EXPECT_EQ(Table->GetRecordStride(Kind) % Caps().ShaderGroupHandleAlignment, 0u);
			EXPECT_GE(Table->GetRecordStride(Kind), Caps().ShaderGroupHandleSize);
		}
		EXPECT_GE(Table->GetSizeBytes(), 7 * Hit + 5 * Caps().ShaderGroupHandleSize);
		EXPECT_EQ(Table->GetDesc().HitCount, 7u);
		EXPECT_EQ(Table->GetDesc().Pipeline, Pipeline.Get());
		EXPECT_STREQ(Table->GetDesc().Name, "Table");
	}
}

TEST_P(FTableContract, EmptyRegions)
{
	FRTShaderTableDesc Desc;
	Desc.Pipeline = Pipeline.Get();
	Desc.Name = "RayGenOnly";
	TRTRef<IRTShaderTable> Table;
	ASSERT_OK(Device().CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
	Table->SetRecord(ERTRecordKind::RayGen, 0, GroupTrace, nullptr, 0);
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	Run(List.Get());
}

TEST_P(FTableContract, UpdatesManyTimesInFlight)
{
	const auto Table = MakeTable(1000, 16);
	FRTFence Last = 0;
	for (uint32_t Frame = 0; Frame < 8; ++Frame)
	{
		const uint32_t Data[4] = {Frame};
		for (uint32_t i = Frame; i < 1000; i += 8) { Table->SetRecord(ERTRecordKind::Hit, i, GroupHit, Data, 16); }
		const auto List = Make.List();
		List->UpdateShaderTable(Table.Get());
		List->UpdateShaderTable(Table.Get()); // nothing left to do
		Last = Make.Submit(List.Get());
	}
	Wait(Last);
}

TEST_P(FTableContract, KeepsItsPipelineAndItsList)
{
	auto Table = MakeTable(1, 0);
	Pipeline.Reset();
	Table->SetRecord(ERTRecordKind::Hit, 0, GroupHit, nullptr, 0);
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	Table.Reset();
	Device().CollectGarbage();
	Run(List.Get());
}

TEST_P(FTableContract, UpdatedBytesFollowWhatChanged)
{
	const auto Table = MakeTable(10'000, 16);
	const std::vector<uint32_t> Groups(10'000, GroupHit);
	const auto Update = [&] {
		const auto List = Make.List();
		List->UpdateShaderTable(Table.Get());
		Run(List.Get());
		return Table->GetUpdatedBytes();
	};
	Table->SetHitRecords(0, 10'000, Groups.data(), nullptr);
	const uint64_t Full = Update();
	EXPECT_GE(Full, 10'000ull * Caps().ShaderGroupHandleSize);
	EXPECT_EQ(Update(), 0u) << "nothing changed";
	Table->SetRecord(ERTRecordKind::Hit, 5000, GroupMasked, nullptr, 0);
	const uint64_t One = Update();
	EXPECT_GT(One, 0u);
	EXPECT_LE(One, 2 * Table->GetRecordStride(ERTRecordKind::Hit));
	Table->Invalidate();
	EXPECT_GE(Update(), Full);
}

TEST_P(FTableContract, ReserveGrowsAndNeverShrinks)
{
	const auto Table = MakeTable(4, 8);
	const uint64_t Size = Table->GetSizeBytes();
	const uint64_t Stride = Table->GetRecordStride(ERTRecordKind::Hit);
	const uint32_t Same[4] = {1, 2, 3, 0}, More[4] = {2, 5, 1000, 1};
	ASSERT_OK(Table->Reserve(Same));
	EXPECT_EQ(Table->GetDesc().HitCount, 4u);
	EXPECT_EQ(Table->GetSizeBytes(), Size);
	ASSERT_OK(Table->Reserve(More));
	EXPECT_EQ(Table->GetDesc().RayGenCount, 2u);
	EXPECT_GE(Table->GetDesc().MissCount, 5u);
	EXPECT_GE(Table->GetDesc().HitCount, 1000u);
	EXPECT_GE(Table->GetSizeBytes(), 1000 * Stride);
	EXPECT_EQ(Table->GetRecordStride(ERTRecordKind::Hit), Stride);
	EXPECT_EQ(Table->GetDesc().Pipeline, Pipeline.Get());
	Table->SetRecord(ERTRecordKind::Hit, 999, GroupHit, nullptr, 0);
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	Run(List.Get());
}

TEST_P(FTableContract, ManyGrowthsInFlightWaitForNothing)
{
	const auto Table = MakeTable(1, 4);
	FRTFence Last = 0;
	uint32_t Counts[4] = {2, 2, 1, 1};
	for (uint32_t Frame = 0; Frame < 10; ++Frame)
	{
		Counts[2] *= 2;
		ASSERT_OK(Table->Reserve(Counts));
		Table->SetRecord(ERTRecordKind::Hit, Counts[2] - 1, GroupHit, &Frame, 4);
		ASSERT_OK(Table->Stage());
		const auto List = Make.List();
		List->UpdateShaderTable(Table.Get());
		Last = Make.Submit(List.Get());
	}
	Wait(Last);
}

TEST_P(FTableContract, SetsItsPipelineFree)
{
	const auto Table = MakeTable(4, 0);
	const auto Next = MakeRayPipeline(Device());
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	Table->SetPipeline(Next.Get());
	EXPECT_EQ(Table->GetDesc().Pipeline, Next.Get());
	// The list that was recorded with it, and the table, may be all that keeps it.
	Pipeline.Reset();
	Run(List.Get());
	const auto Another = Make.List();
	Another->UpdateShaderTable(Table.Get());
	Run(Another.Get());
}

INSTANTIATE_TEST_SUITE_P(RHI, FTableContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
