// FSceneStructure: which instances a frame needs, the tasks that gather them, and the build over them.
#include "Scene/SceneStructure.h"

#include <algorithm>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternScene/Instances/GatherBaseline.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarGather("r.RT.Scene.Gather", 1,
    "Selects how the instances of a frame are gathered. 0: by a plain loop over all objects, a baseline. 1: by buckets, in parallel. "
    "The two give equal instances.",
    {0, 1});
TRTConsoleVariable<bool> CVarHoist(
    "r.RT.Scene.Hoist", true, "Gathers instances by tasks beside the rest of the frame. Off: the frame waits while they are gathered.");

constexpr uint32_t FewestInstances = 64;
/// Frames for which an acceleration structure may be four times too large.
constexpr uint32_t ShrinkFrames = 240;
} // namespace

FSceneStructure::FSceneStructure(IRTDevice& InDevice, FGeometryStore& InGeometries, const FSceneObjects& InObjects)
    : Device(InDevice),
      Geometries(InGeometries),
      Objects(InObjects)
{}

FSceneStructure::~FSceneStructure() { GatherTasks.Wait(); }

// ---------------------------------------------------------------------------------------------------- gathering

FSceneStructure::FGatherKey FSceneStructure::MakeKey(const FGatherView& View, bool bCull, const glm::dvec3& Origin) const
{
	const FInstanceStore& Instances = Objects.GetInstances();
	FGatherKey Key;
	Key.Culling = FCullingSettings::FromConsole();
	Key.Culling.bEnabled &= bCull;
	// Without culling the view decides nothing but what is built first.
	if (Key.Culling.bEnabled || Instances.HasMissing()) { Key.View = View; }
	Key.Origin = Origin;
	Key.Revision = Instances.GetRevision();
	Key.Mode = CVarGather.GetOnRenderThread();
	return Key;
}

bool FSceneStructure::NeedsGather(const FGatherView& View, bool bCull, const glm::dvec3& Origin) const
{
	return bStructureStale || bInstancesStale || !(MakeKey(View, bCull, Origin) == GatheredKey);
}

void FSceneStructure::StartGather(const FGatherView& View, bool bCull, const glm::dvec3& Origin)
{
	const FGatherKey Key = MakeKey(View, bCull, Origin);
	GatherStatus = FRTStatus::Success();
	if (!bInstancesStale && Key == GatheredKey) { return; }
	bGathering = true;
	const FGatherKey Before = std::exchange(GatheredKey, Key);
	const auto Task = [this, Key, Before] { GatherStatus = Gather(Key, Before); };
	if (CVarHoist.GetOnRenderThread()) { GatherTasks.Run(Task); }
	else { Task(); }
}

FRTStatus FSceneStructure::Gather(const FGatherKey& Key, const FGatherKey& Before)
{
	FTraceScope Scope("Gather instances");
	const FInstanceStore& Instances = Objects.GetInstances();
	const FCullingRule Rule(Key.View, Key.Culling);
	const FMissingGeometrySink Missing = [this, &Key](
	                                         uint32_t Slot, float Pixels) { Geometries.RaisePriority(Slot, Pixels * Key.View.PixelSize); };
	uint32_t Count = Instances.GetCount();
	if (Key.Mode != 0)
	{
		Count = InstanceGather.Count(Instances, Rule, Missing);
		const bool bSame = !InstanceGather.HasChanged() && Before.Mode == Key.Mode && Before.Origin == Key.Origin;
		if (bSame && !bInstancesStale) { return FRTStatus::Success(); }
	}
	bInstancesStale = true; // until all of it is written
	IRTBuffer* Buffer = nullptr;
	if (FRTStatus S = Uploads.Reserve(Count, Buffer); !S) { return S; }
	auto* const Out = static_cast<FRTInstance*>(Buffer->GetMapped());
	if (Key.Mode == 0) { Count = GatherStraightforward(Instances, Objects.GetTable().All(), Rule, Key.Origin, Out, Missing); }
	else { InstanceGather.Write(Instances, Key.Origin, Out); }
	GatheredCount = Count;
	bInstancesStale = false;
	bStructureStale = true;
	return FRTStatus::Success();
}

FRTStatus FSceneStructure::FinishGather()
{
	if (!std::exchange(bGathering, false)) { return FRTStatus::Success(); }
	FTraceScope Scope("Wait for instances");
	GatherTasks.Wait();
	return GatherStatus;
}

// ---------------------------------------------------------------------------------------------------- building

FRTStatus FSceneStructure::Reserve(uint32_t InstanceCount)
{
	const uint32_t Capacity = Structure ? Structure->GetMaxInstances() : 0;
	const bool bTooLarge = Capacity / 4 > std::max(FewestInstances, InstanceCount);
	FramesTooLarge = bTooLarge ? FramesTooLarge + 1 : 0;
	if (Structure && Capacity >= InstanceCount && FramesTooLarge < ShrinkFrames) { return FRTStatus::Success(); }
	const uint64_t Most = std::min<uint64_t>(Device.GetCapabilities().MaxInstanceCount, MaxInstanceIndex);
	if (InstanceCount > Most)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%u objects are in the rays' scene; the device allows %llu", InstanceCount,
		    static_cast<unsigned long long>(Most));
	}
	FRTSceneDesc Desc;
	Desc.MaxInstances =
	    static_cast<uint32_t>(std::min<uint64_t>(Most, std::max<uint64_t>(FewestInstances, uint64_t(InstanceCount) * 3 / 2)));
	Desc.Name = "Scene";
	TRTRef<IRTScene> New;
	const FRTStatus Status = Device.CreateScene(Desc, New.ReleaseAndGetAddress());
	FramesTooLarge = 0;
	if (Status) { Structure = std::move(New); }
	// If memory is short, the structure that is too large stays in use.
	return Status.Code == ERTResult::OutOfDeviceMemory && Capacity >= InstanceCount && Structure ? FRTStatus::Success() : Status;
}

FRTStatus FSceneStructure::Build(IRTCommandList& List)
{
	if (FRTStatus S = Reserve(GatheredCount); !S) { return S; }
	IRTBuffer* Scratch = nullptr;
	if (FRTStatus S = Geometries.ReserveScratch(std::max<uint64_t>(1, Structure->GetBuildSizes().BuildScratchBytes), Scratch); !S)
	{
		return S;
	}
	const FRTBarrier Before{nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead};
	List.Barriers(&Before, 1);
	List.BuildScene(Structure.Get(), Uploads.Use(), 0, GatheredCount, Scratch, 0);
	const FRTBarrier After{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::TraceRead};
	List.Barriers(&After, 1);
	StructureCount = GatheredCount;
	bStructureStale = false;
	return FRTStatus::Success();
}

void FSceneStructure::EndFrame(bool bSubmitted, FRTFence Fence)
{
	Uploads.EndFrame(bSubmitted, Fence);
	if (!bSubmitted) { bStructureStale = true; }
}

} // namespace Lantern
