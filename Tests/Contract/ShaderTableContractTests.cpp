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
		if (HasFatalFailure())
		{
			return;
		}
		if (!Caps().bRayTracingPipeline)
		{
			GTEST_SKIP() << "the device has no ray-tracing pipelines";
		}
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
		for (uint32_t i = Frame; i < 1000; i += 8)
		{
			Table->SetRecord(ERTRecordKind::Hit, i, GroupHit, Data, 16);
		}
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

INSTANTIATE_TEST_SUITE_P(RHI, FTableContract,
                         testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan,
                                         EContractRHI::VulkanValidated),
                         [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
