// FMockDevice: capabilities, submission, fences and the end of the device.
#include "MockDeviceImpl.h"

#include "MockCommandList.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdio>

namespace Lantern
{
namespace
{

FRTCapabilities MakeCapabilities(const FRTMockDesc& Desc)
{
	FRTCapabilities Caps;
	std::snprintf(Caps.DeviceName, sizeof(Caps.DeviceName), "Mock");
	std::snprintf(Caps.DriverName, sizeof(Caps.DriverName), "LanternRHIMock");
	Caps.bIsCpu = true;
	Caps.Rung = Desc.Rung;
	Caps.bRayQuery = Desc.bRayQuery && Desc.Rung >= ERTRung::RayQuery;
	Caps.bRayTracingPipeline = Desc.Rung >= ERTRung::Pipeline;
	Caps.bPipelineLibraries = Desc.bPipelineLibraries && Caps.bRayTracingPipeline;
	Caps.bLibraryOnlyPipelines = Desc.bLibraryOnlyPipelines && Caps.bPipelineLibraries;
	Caps.bReorder = Desc.Rung >= ERTRung::Reorder;
	Caps.bMicromap = Desc.Rung >= ERTRung::Micromap;
	Caps.bPositionFetch = Desc.Rung != ERTRung::None;
	Caps.bTimestamps = true;
	Caps.bTransferQueue = Desc.bTransferQueue;
	Caps.bAsyncComputeQueue = Desc.bAsyncComputeQueue;
	Caps.bIndirectTrace = Desc.bIndirectTrace && Caps.bRayTracingPipeline;
	Caps.ShaderGroupHandleSize = Desc.HandleSize;
	Caps.ShaderGroupHandleAlignment = Desc.HandleAlignment;
	Caps.ShaderGroupBaseAlignment = Desc.BaseAlignment;
	Caps.MaxShaderGroupStride = 4096;
	Caps.MaxRayRecursionDepth = Caps.bRayTracingPipeline ? 31 : 0;
	Caps.ScratchAlignment = Desc.ScratchAlignment;
	Caps.MaxInstanceCount = MaxInstanceIndex;
	Caps.MaxPrimitiveCount = (1u << 29) - 1;
	Caps.MaxTextureDimension = Desc.MaxTextureDimension;
	Caps.MaxPushConstantBytes = Desc.MaxPushConstantBytes;
	Caps.MaxBindlessTextures = Desc.MaxBindlessTextures;
	Caps.DeviceMemoryBytes = Desc.DeviceMemoryBytes;
	Caps.TimestampPeriodNs = 1.0;
	return Caps;
}

} // namespace

FMockDevice::FMockDevice(std::shared_ptr<FMockState> InState) : Mock(*InState), State(std::move(InState)) {}

void FMockDevice::OnFinalRelease()
{
	State->Complete(~0ull);
	delete this;
}

FRTStatus FMockDevice::Start(ERTMockCall Kind, const char* Name, const FRTMockNumbers& Numbers)
{
	return State->Log(Kind, Name ? Name : "", Numbers);
}

FRTStatus FMockDevice::Enqueue(
    ERTMockCall Kind, IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	FMockSubmission Submission;
	const ERTQueue Queue = Count > 0 ? static_cast<FMockCommandList*>(Lists[0])->GetQueue() : ERTQueue::Graphics;
	FRTStatus Recording;
	for (uint32_t i = 0; i < Count; ++i)
	{
		auto* List = static_cast<FMockCommandList*>(Lists[i]);
		Recording = Recording ? List->GetStatus() : Recording;
		assert(Kind == ERTMockCall::NotifyExternalSubmit ? List->IsImported() : List->IsEnded());
		assert(List->GetQueue() == Queue && "lists of two queues");
		Submission.Lists.emplace_back(List);
	}
	if (Count > 1)
	{
		std::vector<uint64_t> Recordings;
		for (const TRTRef<FMockCommandList>& List : Submission.Lists) { Recordings.push_back(List->GetRecording()); }
		State->OrderCalls(Recordings);
	}
	// A list that the engine has submitted runs, whatever is wrong with it.
	if (!Recording && Kind != ERTMockCall::NotifyExternalSubmit) { return Recording; }
	FRTMockCall Call;
	Call.Kind = Kind;
	Call.Numbers = {Count, Mock.GetLastFence() + 1, uint64_t(Queue)};
	const auto* const WaitBytes = reinterpret_cast<const uint8_t*>(Waits);
	Call.Bytes.assign(WaitBytes, WaitBytes + WaitCount * sizeof(FRTFence));
	const FRTStatus Status = State->Log(std::move(Call));
	if (!Status) { return Status; }
	for (TRTRef<FMockCommandList>& List : Submission.Lists) { List->MarkSubmitted(); }
	FRTFence Fence = 0;
	bool bManual = false;
	{
		std::lock_guard Lock(State->Mutex);
		Fence = Submission.Fence = ++State->LastSubmitted;
		bManual = State->bManual;
		State->Pending.Push(Fence, std::move(Submission));
	}
	if (OutFence) { *OutFence = MakeFence(Queue, Fence); }
	if (bManual) { State->Collect(); }
	else { State->Complete(Fence); }
	return Recording;
}

FRTStatus FMockDevice::Submit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	return Enqueue(ERTMockCall::Submit, Lists, Count, OutFence, Waits, WaitCount);
}

FRTStatus FMockDevice::NotifyExternalSubmit(
    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	return Enqueue(ERTMockCall::NotifyExternalSubmit, Lists, Count, OutFence, Waits, WaitCount);
}

FRTFence FMockDevice::GetCompletedFence(ERTQueue Queue)
{
	std::lock_guard Lock(State->Mutex);
	return State->Completed > 0 ? MakeFence(Queue, State->Completed) : 0;
}

FRTStatus FMockDevice::WaitFor(FRTFence Fence, uint64_t TimeoutNs)
{
	FRTStatus Status = Start(ERTMockCall::WaitFor, "", {Fence, TimeoutNs});
	if (!Status) { return Status; }
	const uint64_t Value = GetFenceValue(Fence);
	{
		std::lock_guard Lock(State->Mutex);
		assert(Value <= State->LastSubmitted && "a fence that no submission returned");
		if (Value > State->Completed)
		{
			++State->BlockingWaits;
			if (State->bManual && TimeoutNs != ~0ull)
			{
				return FRTStatus::Error(
				    ERTResult::Timeout, "fence %llu has not been reached (mock)", static_cast<unsigned long long>(Value));
			}
		}
	}
	State->Complete(Value);
	return FRTStatus::Success();
}

FRTStatus FMockDevice::WaitIdle()
{
	FRTStatus Status = Start(ERTMockCall::WaitIdle, "");
	if (!Status) { return Status; }
	{
		std::lock_guard Lock(State->Mutex);
		State->BlockingWaits += State->Pending.IsEmpty() ? 0 : 1;
	}
	State->Complete(~0ull);
	return FRTStatus::Success();
}

FRTBuildSizes FMockDevice::GetGeometrySizes(const FRTGeometryDesc& Desc)
{
	FRTGeometryDesc Whole = Desc;
	Whole.CompactedBytes = 0;
	return State->Desc.Rung == ERTRung::None ? FRTBuildSizes{} : FMockGeometry::ComputeSizes(Whole);
}

FRTMemoryStats FMockDevice::GetMemoryStats() const
{
	std::lock_guard Lock(State->Mutex);
	return State->Memory;
}

FRTStatus CreateMockDevice(const FRTMockDesc& Desc, IRTDevice** Out)
{
	const uint32_t Alignments[] = {Desc.HandleAlignment, Desc.BaseAlignment, Desc.ScratchAlignment};
	const bool bPowers = std::all_of(std::begin(Alignments), std::end(Alignments), [](uint32_t A) { return std::has_single_bit(A); });
	if (!bPowers || Desc.HandleSize < 32)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "mock: alignments must be powers of two and handles have at least 32 bytes");
	}
	auto State = std::make_shared<FMockState>();
	State->Desc = Desc;
	State->Capabilities = MakeCapabilities(Desc);
	State->Sampled.SetCapacity(Desc.MaxBindlessTextures);
	State->Storage.SetCapacity(Desc.MaxBindlessTextures);
	State->Samplers.SetCapacity(Desc.MaxSamplers);
	State->Scenes.SetCapacity(Desc.MaxScenes);
	*Out = new FMockDevice(std::move(State));
	return FRTStatus::Success();
}

FRTMock& GetMock(IRTDevice* Device)
{
	auto* Mine = dynamic_cast<FMockDevice*>(Device);
	assert(Mine && "not a mock device, or wrapped");
	return Mine->Mock;
}

} // namespace Lantern
