#include "StandInFeedback.h"

#include <algorithm>
#include <iterator>

namespace Lantern
{

namespace
{
constexpr ERTAccess ShaderAccess = ERTAccess::ShaderRead | ERTAccess::StorageWrite;
/// Of the scene, in one frame: 20 µs.
constexpr uint32_t ObjectsPerFrame = 2048;
} // namespace

FProgramPriority& FStandInFeedback::PriorityOf(uint32_t Program)
{
	if (Program >= Priorities.size()) { Priorities.resize(Program + 1); }
	return Priorities[Program];
}

FRTStatus FStandInFeedback::Reserve(uint32_t Count)
{
	Materials = Count;
	if (Count > Capacity)
	{
		const uint32_t Wanted = std::max(256u, Count + Count / 2);
		const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest;
		Capacity = 0;
		if (FRTStatus S = Device.CreateBuffer({Wanted * 4ull, Usage, ERTMemory::Device, "StandInHits"}, Counts.ReleaseAndGetAddress()); !S)
		{
			return S;
		}
		Capacity = Wanted;
	}
	FReadback& Readback = Readbacks[Current];
	if (Readback.Buffer && Readback.Buffer->GetDesc().Size >= Capacity * 4ull) { return FRTStatus::Success(); }
	return Device.CreateBuffer(
	    {Capacity * 4ull, ERTBufferUsage::CopyDest, ERTMemory::Readback, "StandInReadback"}, Readback.Buffer.ReleaseAndGetAddress());
}

FRTStatus FStandInFeedback::Begin(const FRTScene& Scene, glm::dvec3 Camera, bool bMissing)
{
	bActive = false;
	if (!bMissing) { return FRTStatus::Success(); }
	TakeCounts(Scene);
	LookAtObjects(Scene, Camera);
	Current = (Current + 1) % std::size(Readbacks);
	if (Readbacks[Current].bPending) { return FRTStatus::Success(); } // the GPU is further behind than it can be
	const uint32_t Count = Scene.GetMaterials().Num();
	if (Count == 0) { return FRTStatus::Success(); }
	if (FRTStatus S = Reserve(Count); !S) { return S; }
	bActive = true;
	return FRTStatus::Success();
}

void FStandInFeedback::TakeCounts(const FRTScene& Scene)
{
	const FRTFence Done = Device.GetCompletedFence();
	for (size_t Step = 1; Step <= std::size(Readbacks); ++Step) // oldest first
	{
		FReadback& Readback = Readbacks[(Current + Step) % std::size(Readbacks)];
		if (!Readback.bPending || Readback.Fence > Done) { continue; }
		Readback.bPending = false;
		for (FProgramPriority& Priority : Priorities) { Priority.StandInHits = 0; }
		const auto* const Hits = static_cast<const uint32_t*>(Readback.Buffer->GetMapped());
		const uint32_t Known = std::min(Readback.Materials, Scene.GetMaterials().Num());
		for (uint32_t Material = 0; Material < Known; ++Material)
		{
			if (Hits[Material] > 0) { PriorityOf(Scene.GetMaterialProgram(Material)).StandInHits += Hits[Material]; }
		}
	}
}

void FStandInFeedback::LookAtObjects(const FRTScene& Scene, glm::dvec3 Camera)
{
	const uint32_t Slots = Scene.GetObjectSlotCount();
	for (const uint32_t End = std::min(Slots, NextObject + ObjectsPerFrame); NextObject < End; ++NextObject)
	{
		const FRTObjectInfo* const Object = Scene.FindObject(NextObject);
		if (!Object) { continue; }
		const float Distance = static_cast<float>(glm::distance(glm::dvec3(Object->Transform[3]), Camera));
		for (const uint32_t Material : Object->Materials)
		{
			const uint32_t Program = Scene.GetMaterialProgram(Material);
			if (Program >= Nearest.size()) { Nearest.resize(Program + 1, FProgramPriority().Distance); }
			Nearest[Program] = std::min(Nearest[Program], Distance);
		}
	}
	if (NextObject < Slots) { return; }
	for (uint32_t Program = 0; Program < Nearest.size(); ++Program) { PriorityOf(Program).Distance = Nearest[Program]; }
	Nearest.clear();
	NextObject = 0;
}

void FStandInFeedback::AddClear(FFrameGraph& Graph)
{
	if (!bActive) { return; }
	Graph.AddPass("ClearStandInHits", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [Buffer = Counts, Bytes = Materials * 4ull](FPassContext& Pass) {
			// Passes that trace reach the counts by their address: the graph does not see them.
			const FRTBarrier Before{Buffer.Get(), nullptr, ERTAccess::CopyRead, ERTAccess::CopyWrite};
			const FRTBarrier After{Buffer.Get(), nullptr, ERTAccess::CopyWrite, ShaderAccess};
			Pass.Commands().Barriers(&Before, 1);
			Pass.Commands().FillBuffer(Buffer.Get(), 0, Bytes, 0);
			Pass.Commands().Barriers(&After, 1);
		};
	});
}

void FStandInFeedback::AddRead(FFrameGraph& Graph)
{
	if (!bActive) { return; }
	Readbacks[Current].Materials = Materials;
	Graph.AddPass("ReadStandInHits", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [From = Counts, To = Readbacks[Current].Buffer, Bytes = Materials * 4ull](FPassContext& Pass) {
			const FRTBarrier Before[] = {
			    {From.Get(), nullptr, ShaderAccess, ERTAccess::CopyRead}, {To.Get(), nullptr, ERTAccess::HostRead, ERTAccess::CopyWrite}};
			const FRTBarrier After{To.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead};
			Pass.Commands().Barriers(Before, 2);
			Pass.Commands().CopyBuffer(To.Get(), 0, From.Get(), 0, Bytes);
			Pass.Commands().Barriers(&After, 1);
		};
	});
}

void FStandInFeedback::Submitted(FRTFence Fence)
{
	if (bActive && Fence != 0)
	{
		Readbacks[Current].Fence = Fence;
		Readbacks[Current].bPending = true;
	}
	bActive = false;
}

} // namespace Lantern
