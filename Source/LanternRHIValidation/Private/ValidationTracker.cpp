#include "ValidationTracker.h"

#include <cstring>

namespace Lantern
{
namespace
{

/// A broken submission repeats itself; the first few messages say it.
constexpr size_t MaxMessages = 16;

constexpr ERTAccess Writes = ERTAccess::StorageWrite | ERTAccess::RenderTarget | ERTAccess::DepthWrite |
                             ERTAccess::CopyWrite | ERTAccess::BuildWrite;

} // namespace

void FValidationTracker::Add(std::string Message)
{
	if (Messages.size() < MaxMessages)
	{
		Messages.push_back(std::move(Message));
	}
}

FAccessState& FValidationTracker::Get(const std::shared_ptr<FResourceTrack>& Resource)
{
	return Accesses.try_emplace(Resource, Resource->State).first->second;
}

void FValidationTracker::Run(const FValidationStep& Step)
{
	using EKind = FValidationStep::EKind;
	switch (Step.Kind)
	{
	case EKind::Barrier: return Step.Resource ? Barrier(Step) : MemoryBarrier(Step);
	case EKind::Use: return Use(Step);
	case EKind::SetState: Get(Step.Resource) = {Step.After}; return;
	case EKind::CheckIndices: return CheckIndices(Step);
	case EKind::BuildGeometry: Built.insert(Step.Geometry.get()); return;
	case EKind::UpdateGeometry:
		if (!IsBuilt(Step.Geometry.get()))
		{
			Add(Step.What + ": update of " + Step.Geometry->Label + " before any build");
		}
		return;
	case EKind::BuildScene: return BuildScene(Step);
	case EKind::UpdateTable: Updated.insert(Step.Table.get()); return;
	case EKind::TraceRays: return TraceRays(Step);
	}
}

void FValidationTracker::Barrier(const FValidationStep& Step)
{
	FAccessState& Now = Get(Step.Resource);
	const FResourceTrack& Resource = *Step.Resource;
	const bool bDiscard = Step.Before == ERTAccess::None;
	const bool bUnused = !Resource.bTexture && Now.Access == ERTAccess::None;
	const bool bHostVisible = Resource.Memory == ERTMemory::Upload ||
	                          (Resource.Memory == ERTMemory::Readback && Now.Access == ERTAccess::HostRead);
	const bool bOverlaps = (Now.bMerged || Now.bImplicit) && HasAny(Now.Access, Step.Before);
	if (Now.bKnown && Now.Access != Step.Before && !bDiscard && !bUnused && !bHostVisible && !bOverlaps)
	{
		Add(Step.What + ": " + Resource.Label + " is in " + DescribeAccess(Now.Access) +
		    ", the barrier's Before says " + DescribeAccess(Step.Before));
	}
	Now = {Step.After};
}

void FValidationTracker::MemoryBarrier(const FValidationStep& Step)
{
	for (const std::weak_ptr<FResourceTrack>& Item : State.Buffers)
	{
		const std::shared_ptr<FResourceTrack> Resource = Item.lock();
		if (!Resource)
		{
			continue;
		}
		FAccessState& Now = Get(Resource);
		if (!HasAny(Now.Access, Step.Before))
		{
			continue;
		}
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
	if (!Now.bKnown || HasAny(Now.Access, Step.After))
	{
		return;
	}
	if (!Resource.bTexture)
	{
		const bool bFree = Now.Access == ERTAccess::None || Now.Access == ERTAccess::HostRead ||
		                   (Resource.Memory == ERTMemory::Upload && !bWrite);
		const bool bReads = Now.bImplicit && !HasAny(Now.Access, Writes) && !bWrite;
		if (bFree || bReads)
		{
			Now.Access = bReads ? Now.Access | Step.After : Step.After;
			Now.bImplicit = true;
			return;
		}
	}
	Add(Step.What + ": " + Resource.Label + " is in " + DescribeAccess(Now.Access) + ", the call needs " +
	    DescribeAccess(Step.After));
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
		else
		{
			std::memcpy(&Index, Bytes + i * 4ull, 4);
		}
		if (Index >= Step.Limit)
		{
			return Add(Step.What + Print(": index %u (number %u), but there are %u vertices", Index, i, Step.Limit));
		}
	}
}

void FValidationTracker::CheckInstance(const FValidationStep& Step, uint32_t Index, const FRTInstance& Instance)
{
	if (Instance.GeometryAddress == 0)
	{
		return;
	} // inactive, as Vulkan has it
	const auto Found = State.Geometries.find(Instance.GeometryAddress);
	if (Found == State.Geometries.end())
	{
		return Add(Step.What + Print(": instance %u points at 0x%llx, where no geometry is", Index,
		                             static_cast<unsigned long long>(Instance.GeometryAddress)));
	}
	FGeometryTrack* Geometry = Found->second.get();
	if (Geometry->bDead && !Kept.contains(Geometry))
	{
		return Add(Step.What + Print(": instance %u points at the released %s", Index, Geometry->Label.c_str()));
	}
	if (!IsBuilt(Geometry))
	{
		Add(Step.What + Print(": instance %u points at %s, which was never built", Index, Geometry->Label.c_str()));
	}
}

void FValidationTracker::BuildScene(const FValidationStep& Step)
{
	FSceneContent Content;
	Content.bBuilt = true;
	Content.bKnown = Step.Memory || Step.Count == 0;
	const auto* Bytes = Step.Memory ? static_cast<const uint8_t*>(Step.Memory->GetMapped()) + Step.Offset : nullptr;
	for (uint32_t i = 0; Bytes && i < Step.Count; ++i)
	{
		FRTInstance Instance;
		std::memcpy(&Instance, Bytes + i * sizeof(Instance), sizeof(Instance));
		CheckInstance(Step, i, Instance);
		const uint32_t Offset = Instance.TableOffsetAndFlags & MaxInstanceIndex;
		const bool bHittable = (Instance.CustomIndexAndMask >> 24) != 0 && Instance.GeometryAddress != 0;
		if (!bHittable || (Content.bAny && Offset <= Content.HighestOffset))
		{
			continue;
		}
		Content.bAny = true;
		Content.HighestOffset = Offset;
		Content.HighestInstance = i;
	}
	Scenes[Step.Scene.get()] = Content;
}

void FValidationTracker::TraceRays(const FValidationStep& Step)
{
	FTableTrack& Table = *Step.Table;
	if (!Table.bUpdated && !Updated.contains(&Table))
	{
		Add(Step.What + ": " + Table.Label + " has never been updated on the device");
	}
	// Which scene the shaders trace is not seen; with a single one it is certain.
	const FSceneTrack* Only = nullptr;
	FSceneContent Content;
	for (const std::weak_ptr<FSceneTrack>& Item : State.Scenes)
	{
		const std::shared_ptr<FSceneTrack> Scene = Item.lock();
		if (!Scene)
		{
			continue;
		}
		if (Only)
		{
			return;
		}
		Only = Scene.get();
		const auto Found = Scenes.find(Scene.get());
		Content = Found == Scenes.end() ? Scene->Content : Found->second;
	}
	if (!Only || !Content.bKnown || !Content.bAny)
	{
		return;
	}
	const std::vector<ERecordState>& Hits = Table.Records[static_cast<size_t>(ERTRecordKind::Hit)];
	if (Content.HighestOffset >= Hits.size())
	{
		return Add(Step.What + Print(": instance %u of %s reaches hit record %u, but %s has %zu",
		                             Content.HighestInstance, Only->Label.c_str(), Content.HighestOffset,
		                             Table.Label.c_str(), Hits.size()));
	}
	if (Hits[Content.HighestOffset] == ERecordState::Never)
	{
		Add(Step.What + Print(": instance %u of %s reaches hit record %u of %s, which was never set",
		                      Content.HighestInstance, Only->Label.c_str(), Content.HighestOffset,
		                      Table.Label.c_str()));
	}
}

void FValidationTracker::Commit()
{
	for (auto& [Resource, Access] : Accesses)
	{
		Resource->State = Access;
	}
	for (auto& [Scene, Content] : Scenes)
	{
		Scene->Content = Content;
	}
	for (FGeometryTrack* Geometry : Built)
	{
		Geometry->bBuilt = true;
	}
	for (FTableTrack* Table : Updated)
	{
		Table->bUpdated = true;
	}
}

} // namespace Lantern
