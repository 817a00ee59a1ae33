// FValidationTracker: resource states, builds and shader tables across submissions.
#include "ValidationTracker.h"

#include <algorithm>
#include <cstring>

namespace Lantern
{
namespace
{

/// A broken submission repeats itself: the first few messages are enough.
constexpr size_t MaxMessages = 16;

constexpr ERTAccess Writes =
    ERTAccess::StorageWrite | ERTAccess::RenderTarget | ERTAccess::DepthWrite | ERTAccess::CopyWrite | ERTAccess::BuildWrite;

} // namespace

FValidationTracker::FValidationTracker(FValidationState& InState, ERTQueue InQueue, const FRTFence* Waits, uint32_t WaitCount)
    : State(InState),
      Queue(InQueue)
{
	std::copy(std::begin(State.Waited[static_cast<size_t>(Queue)]), std::end(State.Waited[static_cast<size_t>(Queue)]), Waited);
	for (uint32_t i = 0; i < WaitCount; ++i)
	{
		FRTFence& Newest = Waited[static_cast<size_t>(GetFenceQueue(Waits[i]))];
		Newest = std::max(Newest, Waits[i]);
	}
}

void FValidationTracker::Add(std::string Message)
{
	if (Messages.size() < MaxMessages) { Messages.push_back(std::move(Message)); }
}

FAccessState& FValidationTracker::Get(const std::shared_ptr<FResourceTrack>& Resource)
{
	return Accesses.try_emplace(Resource, Resource->State).first->second;
}

void FValidationTracker::Run(const FValidationStep& Step)
{
	using EKind = FValidationStep::EKind;
	if (Step.Resource) { CheckQueues(Step); }
	switch (Step.Kind)
	{
	case EKind::Barrier: return Step.Resource ? Barrier(Step) : MemoryBarrier(Step);
	case EKind::Use: return Use(Step);
	case EKind::SetState: Get(Step.Resource) = {Step.After}; return;
	case EKind::CheckIndices: return CheckIndices(Step);
	case EKind::BuildGeometry: Built.insert(Step.Geometry.get()); return;
	case EKind::UpdateGeometry:
		if (!IsBuilt(Step.Geometry.get())) { Add(Step.What + ": update of " + Step.Geometry->Label + " before any build"); }
		return;
	case EKind::RequireBuilt:
		if (!IsBuilt(Step.Geometry.get())) { Add(Step.What + ": " + Step.Geometry->Label + " was never built"); }
		return;
	case EKind::WriteSize: Sizes.push_back(&Step); return;
	case EKind::BuildScene: return BuildScene(Step);
	case EKind::UpdateTable: Updated[Step.Table.get()] = Step.Count; return;
	case EKind::TraceRays: return TraceRays(Step);
	}
}

bool FValidationTracker::IsBusy(const FResourceTrack& Resource, bool bWrite) const
{
	for (uint32_t Other = 0; Other < QueueCount; ++Other)
	{
		const FRTFence Fence = bWrite ? Resource.LastUses[Other] : Resource.LastWrites[Other];
		const auto OtherQueue = static_cast<ERTQueue>(Other);
		if (OtherQueue == Queue || Fence == 0 || Fence <= Waited[Other]) { continue; }
		if (State.Inner->GetCompletedFence(OtherQueue) < Fence) { return true; }
	}
	return false;
}

void FValidationTracker::CheckQueues(const FValidationStep& Step)
{
	const bool bWrite = HasAny(Step.Before | Step.After, Writes);
	if (IsBusy(*Step.Resource, bWrite)) { Add(Step.What + ": another queue has not finished with " + Step.Resource->Label); }
	Touched[Step.Resource.get()] |= bWrite;
}

void FValidationTracker::Barrier(const FValidationStep& Step)
{
	FAccessState& Now = Get(Step.Resource);
	const FResourceTrack& Resource = *Step.Resource;
	const bool bDiscard = Step.Before == ERTAccess::None;
	const bool bUnused = !Resource.bTexture && Now.Access == ERTAccess::None;
	const bool bHostVisible =
	    Resource.Memory == ERTMemory::Upload || (Resource.Memory == ERTMemory::Readback && Now.Access == ERTAccess::HostRead);
	const bool bOverlaps = (Now.bMerged || Now.bImplicit) && HasAny(Now.Access, Step.Before);
	if (Now.bKnown && Now.Access != Step.Before && !bDiscard && !bUnused && !bHostVisible && !bOverlaps)
	{
		Add(Step.What + ": " + Resource.Label + " is in " + DescribeAccess(Now.Access) + ", the barrier's Before says " +
		    DescribeAccess(Step.Before));
	}
	Now = {Step.After};
}

void FValidationTracker::MemoryBarrier(const FValidationStep& Step)
{
	for (const std::weak_ptr<FResourceTrack>& Item : State.Buffers)
	{
		const std::shared_ptr<FResourceTrack> Resource = Item.lock();
		if (!Resource || IsBusy(*Resource, false)) { continue; }
		FAccessState& Now = Get(Resource);
		if (!HasAny(Now.Access, Step.Before)) { continue; }
		Now.Access = Step.After;
		Now.bImplicit = false;
		Now.bMerged = true;
	}
}

void FValidationTracker::Use(const FValidationStep& Step)
{
	const FResourceTrack& Resource = *Step.Resource;
	FAccessState& Now = Get(Step.Resource);
	const bool bWrite = HasAny(Step.After, Writes);
	if (!Now.bKnown || HasAny(Now.Access, Step.After)) { return; }
	if (!Resource.bTexture && Queue == ERTQueue::Transfer)
	{
		Now = {Step.After, true, true}; // no barriers there: all other work on it has finished, as CheckQueues found
		return;
	}
	if (!Resource.bTexture)
	{
		const bool bFree =
		    Now.Access == ERTAccess::None || Now.Access == ERTAccess::HostRead || (Resource.Memory == ERTMemory::Upload && !bWrite);
		const bool bReads = Now.bImplicit && !HasAny(Now.Access, Writes) && !bWrite;
		if (bFree || bReads)
		{
			Now.Access = bReads ? Now.Access | Step.After : Step.After;
			Now.bImplicit = true;
			return;
		}
	}
	Add(Step.What + ": " + Resource.Label + " is in " + DescribeAccess(Now.Access) + ", the call needs " + DescribeAccess(Step.After));
}

void FValidationTracker::CheckIndices(const FValidationStep& Step)
{
	const auto* Bytes = static_cast<const uint8_t*>(Step.Memory->GetMapped()) + Step.Offset;
	for (uint32_t i = 0; i < Step.Count; ++i)
	{
		uint32_t Index = 0;
		if (Step.IndexType == ERTIndexType::UInt16)
		{
			uint16_t Short = 0;
			std::memcpy(&Short, Bytes + i * 2ull, 2);
			Index = Short;
		}
		else { std::memcpy(&Index, Bytes + i * 4ull, 4); }
		if (Index >= Step.Limit)
		{
			return Add(Step.What + Print(": index %u (number %u), but there are %u vertices", Index, i, Step.Limit));
		}
	}
}

std::string FValidationTracker::CheckAddress(uint64_t Address, bool bRecording) const
{
	const auto Found = State.Geometries.find(Address);
	if (Found == State.Geometries.end())
	{
		// A list may be recorded before its instances are written.
		return bRecording ? std::string() : Print("points at 0x%llx, where no geometry is", static_cast<unsigned long long>(Address));
	}
	FGeometryTrack* Geometry = Found->second.get();
	const bool bKept = bRecording ? Geometry->Holders > 0 : Kept.contains(Geometry);
	if (Geometry->bDead && !bKept) { return "points at the released " + Geometry->Label; }
	// A list may be recorded before the one that builds, which is submitted before it.
	if (!bRecording && !IsBuilt(Geometry)) { return "points at " + Geometry->Label + ", which was never built"; }
	return {};
}

void FValidationTracker::BuildScene(const FValidationStep& Step)
{
	FSceneContent Content;
	Content.bBuilt = true;
	Content.bKnown = Step.Memory || Step.Count == 0;
	const auto* Bytes = Step.Memory ? static_cast<const uint8_t*>(Step.Memory->GetMapped()) + Step.Offset : nullptr;
	std::vector<uint64_t> Offsets;
	uint64_t LastGood = 0; // address 0 is an inactive instance, as in Vulkan
	for (uint32_t i = 0; Bytes && i < Step.Count; ++i)
	{
		FRTInstance Instance;
		std::memcpy(&Instance, Bytes + i * sizeof(Instance), sizeof(Instance));
		if (Instance.GeometryAddress != LastGood && Instance.GeometryAddress != 0)
		{
			const std::string Wrong = CheckAddress(Instance.GeometryAddress, false);
			if (!Wrong.empty()) { Add(Step.What + Print(": instance %u ", i) + Wrong); }
			LastGood = Wrong.empty() ? Instance.GeometryAddress : LastGood;
		}
		const uint32_t Offset = Instance.TableOffsetAndFlags & MaxInstanceIndex;
		const bool bHittable = (Instance.CustomIndexAndMask >> 24) != 0 && Instance.GeometryAddress != 0;
		if (!bHittable) { continue; }
		if (Offset / 64 >= Offsets.size()) { Offsets.resize(Offset / 64 + 1); }
		Offsets[Offset / 64] |= 1ull << (Offset % 64);
		if (Content.bAny && Offset <= Content.HighestOffset) { continue; }
		Content.bAny = true;
		Content.HighestOffset = Offset;
		Content.HighestInstance = i;
	}
	Content.Offsets = std::make_shared<const std::vector<uint64_t>>(std::move(Offsets));
	Scenes[Step.Scene.get()] = std::move(Content);
}

const FSceneTrack* FValidationTracker::FindOnlyScene(FSceneContent& OutContent) const
{
	const FSceneTrack* Only = nullptr;
	for (const std::weak_ptr<FSceneTrack>& Item : State.Scenes)
	{
		const std::shared_ptr<FSceneTrack> Scene = Item.lock();
		if (!Scene) { continue; }
		if (Only) { return nullptr; }
		Only = Scene.get();
		const auto Found = Scenes.find(Scene.get());
		OutContent = Found == Scenes.end() ? Scene->Content : Found->second;
	}
	return Only && OutContent.bKnown ? Only : nullptr;
}

void FValidationTracker::TraceRays(const FValidationStep& Step)
{
	FTableTrack& Table = *Step.Table;
	const auto Found = Updated.find(&Table);
	const uint32_t Generation = Found == Updated.end() ? Table.UpdatedGeneration : Found->second;
	if (Generation == 0) { Add(Step.What + ": " + Table.Label + " has never been updated on the device"); }
	else if (Generation < Step.Count)
	{
		Add(Step.What + ": " + Table.Label + " has got another pipeline, with no UpdateShaderTable since");
	}
	// Which scene the shaders trace is not seen. With a single scene it is certain.
	FSceneContent Content;
	const FSceneTrack* Only = FindOnlyScene(Content);
	CheckPipelineOf(Step, Only ? &Content : nullptr);
	const uint32_t Hits = Table.Records[static_cast<size_t>(ERTRecordKind::Hit)].GetCount();
	if (Only && Content.bAny && Content.HighestOffset >= Hits)
	{
		Add(Step.What + Print(": instance %u of %s reaches hit record %u, but %s has %u", Content.HighestInstance, Only->Label.c_str(),
		                    Content.HighestOffset, Table.Label.c_str(), Hits));
	}
}

void FValidationTracker::CheckPipelineOf(const FValidationStep& Step, const FSceneContent* Content)
{
	const FTableTrack& Table = *Step.Table;
	if (Step.Count == 1)
	{
		return; // no SetPipeline yet: nothing can be stale
	}
	for (const ERTRecordKind Kind : {ERTRecordKind::Miss, ERTRecordKind::Callable})
	{
		const FRecordTracks& Records = Table.Records[static_cast<size_t>(Kind)];
		for (uint32_t i = 0; i < Records.GetCount(); ++i)
		{
			if (Records.IsStale(i, Step.Count))
			{
				return Add(Step.What + Print(": %s record %u of %s was not set again after SetPipeline",
				                           Kind == ERTRecordKind::Miss ? "miss" : "callable", i, Table.Label.c_str()));
			}
		}
	}
	CheckHits(Step, Content);
}

void FValidationTracker::CheckHits(const FValidationStep& Step, const FSceneContent* Content)
{
	const FTableTrack& Table = *Step.Table;
	const FRecordTracks& Hits = Table.Records[static_cast<size_t>(ERTRecordKind::Hit)];
	const auto Report = [&](uint32_t Index) {
		Add(Step.What + Print(": hit record %u of %s was not set again after SetPipeline", Index, Table.Label.c_str()));
	};
	if (Content && Content->Offsets)
	{
		const uint64_t Most = std::min<uint64_t>(Hits.GetCount(), Content->Offsets->size() * 64);
		for (uint32_t i = 0; i < Most; ++i)
		{
			if (((*Content->Offsets)[i / 64] >> (i % 64) & 1) && Hits.IsStale(i, Step.Count)) { return Report(i); }
		}
		return;
	}
	// What rays reach is not known. But if no record was set again, they reach stale ones.
	uint32_t Stale = ~0u;
	for (uint32_t i = 0; i < Hits.GetCount(); ++i)
	{
		if (Hits.Get(i) >= Step.Count) { return; }
		Stale = Hits.IsStale(i, Step.Count) && Stale == ~0u ? i : Stale;
	}
	if (Stale != ~0u) { Report(Stale); }
}

void FValidationTracker::Commit(FRTFence Fence)
{
	std::copy(std::begin(Waited), std::end(Waited), State.Waited[static_cast<size_t>(Queue)]);
	for (auto& [Resource, Access] : Accesses) { Resource->State = Access; }
	for (const auto& [Resource, bWritten] : Touched)
	{
		const auto Index = static_cast<size_t>(Queue);
		Resource->LastUses[Index] = Fence;
		if (bWritten) { Resource->LastWrites[Index] = Fence; }
	}
	for (auto& [Scene, Content] : Scenes) { Scene->Content = Content; }
	for (FGeometryTrack* Geometry : Built) { Geometry->bBuilt = true; }
	for (auto& [Table, Generation] : Updated) { Table->UpdatedGeneration = Generation; }
	for (const FValidationStep* Step : Sizes)
	{
		FQueryTrack::FQuery& Query = Step->Queries->Queries[Step->Count];
		Query.Geometry = Step->Geometry;
		Query.Fence = Fence;
	}
}

} // namespace Lantern
