// Rays on every RHI: on Vulkan they run, on the mock they are followed through its memory and table. Pixel (x, y) looks down -z
// at the unit square over it and says what it hit.
#pragma once

#include "MockRays.h"
#include "Support/ContractScene.h"

namespace Lantern
{

/// Devices on which rays can be followed. Behind the wrapper, the mock's memory is out of reach.
inline constexpr EContractRHI RayRHIs[] = {EContractRHI::Mock, EContractRHI::Vulkan, EContractRHI::VulkanValidated};

class FRayContract : public TSceneFixture<FContractShaders>
{
protected:
	void SetUp() override
	{
		TSceneFixture::SetUp();
		if (HasFatalFailure() || IsSkipped()) { return; }
		if (!Caps().bRayTracingPipeline) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
		Pipeline = MakeRayPipeline(Device());
		Scene = Make.Scene(64);
	}
	void TearDown() override
	{
		Pipeline.Reset();
		Scene.Reset();
		Table.Reset();
		TSceneFixture::TearDown();
	}
	/// Makes a table with ray generation records trace and call, miss records one and two, callable records double and square.
	/// Hit records have 4 bytes of data.
	void MakeTable(uint32_t HitCount)
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline.Get();
		Desc.RayGenCount = Desc.MissCount = Desc.CallableCount = 2;
		Desc.HitCount = HitCount;
		Desc.RecordDataBytes = 4;
		Desc.Name = "Table";
		ASSERT_OK(Device().CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
		Table->SetRecord(ERTRecordKind::RayGen, 0, GroupTrace, nullptr, 0);
		Table->SetRecord(ERTRecordKind::RayGen, 1, GroupCall, nullptr, 0);
		Table->SetRecord(ERTRecordKind::Miss, 0, GroupMissOne, nullptr, 0);
		Table->SetRecord(ERTRecordKind::Miss, 1, GroupMissTwo, nullptr, 0);
		Table->SetRecord(ERTRecordKind::Callable, 0, GroupDouble, nullptr, 0);
		Table->SetRecord(ERTRecordKind::Callable, 1, GroupSquare, nullptr, 0);
	}
	void SetHit(uint32_t Index, uint32_t Value, uint32_t Group = GroupHit)
	{
		Table->SetRecord(ERTRecordKind::Hit, Index, Group, &Value, 4);
	}
	FContractPush MakePush(uint32_t RayFlags = 0, uint32_t Mask = 0xff) const
	{
		FContractPush Push;
		Push.A = Scene->GetIndex();
		Push.B = RayFlags;
		Push.C = Mask;
		Push.E = 1;
		return Push;
	}
	/// Updates the table and traces Width rays in a row; ends, submits and waits for the list. Returns what each ray found.
	std::vector<uint32_t> Trace(IRTCommandList* List, uint32_t Width, FContractPush Push, uint32_t RayGen = 0)
	{
		const auto Output = Make.Buffer(Width * 4, ERTMemory::Readback, "Output");
		Push.Output = Output->GetDeviceAddress();
		List->UpdateShaderTable(Table.Get());
		List->SetPipeline(Pipeline.Get());
		List->PushConstants(&Push, sizeof(Push));
		List->TraceRays(Table.Get(), RayGen, Width, 1, 1);
		Barrier(List, Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
		Run(List);
		if (IsMock()) { return TraceOnMock(GetMock(&Device()), Table.Get(), Scene.Get(), Push, Width, RayGen); }
		const auto* Begin = static_cast<const uint32_t*>(Output->GetMapped());
		return {Begin, Begin + Width};
	}
	/// Traces with a list of its own into what is built.
	std::vector<uint32_t> Trace(uint32_t Width, const FContractPush& Push, uint32_t RayGen = 0)
	{
		const auto List = Make.List("Trace");
		return Trace(List.Get(), Width, Push, RayGen);
	}
	/// Builds geometries, then the scene.
	void Load(const std::vector<const FContractGeometry*>& Geometries, const std::vector<FRTInstance>& Instances)
	{
		const auto List = Make.List("Load");
		for (const FContractGeometry* Geometry : Geometries) { Build(List.Get(), *Geometry); }
		BuildScene(List.Get(), Scene.Get(), Instances);
		Run(List.Get());
	}
	using FWords = std::vector<uint32_t>;

	TRTRef<IRTPipeline> Pipeline;
	TRTRef<IRTScene> Scene;
	TRTRef<IRTShaderTable> Table;
};

} // namespace Lantern
