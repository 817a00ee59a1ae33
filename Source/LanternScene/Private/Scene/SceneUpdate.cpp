// One frame of a scene: what changed is taken over, instances are gathered as tasks, and uploads and builds recorded.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternScene/Scene/Scene.h"
#include "Opacity/OpacityUse.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarGather("r.RT.Scene.Gather", 1,
    "How the instances of a frame are gathered. 0: by a plain loop over all "
    "objects. 1: by buckets, in parallel. Both give the "
    "same instances.",
    {0, 1});
TRTConsoleVariable<bool> CVarHoist(
    "r.RT.Scene.Hoist", true, "Instances are gathered by tasks beside the rest of the frame. Off: at once, while the frame waits.");

constexpr uint32_t FewestInstances = 64;
/// Frames for which an acceleration structure may be four times too large.
constexpr uint32_t ShrinkFrames = 240;
} // namespace

// ---------------------------------------------------------------------------------------------------- what changed

bool FRTScene::AreTablesDirty() const
{
	return Materials.IsDirty() || ObjectData.IsDirty() || LightData.IsDirty() || EmissiveTriangles.IsDirty() ||
	       Sections.GetTable().IsDirty() || Motions.GetTable().IsDirty();
}

bool FRTScene::NeedsUpdate(const FGatherView& View, const FSceneUse& Use) const
{
	const bool bGeometry = Geometries.NeedsUpdate() || NeedsOpacityUpdate(SectionContext, Sections, Geometries);
	const bool bBind = bBindAll || Sections.HasChangedRanges();
	const bool bGather = bStructureStale || bInstancesStale || bBind || bGeometry || !(MakeGatherKey(View, Use.bCull) == GatheredKey);
	return bLightsChanged || Motions.NeedsUpdate(Use.bMotion) || (Use.bRays && bGather) || (Use.bLightSampling && bEmissiveChanged) ||
	       AreTablesDirty() || SnapOrigin(View.Position) != Origin;
}

glm::dvec3 FRTScene::SnapOrigin(glm::dvec3 Camera) const
{
	// A camera that goes to and fro across a border of the grid must not move the origin each time.
	const glm::dvec3 Away = glm::abs(Camera - Origin);
	return std::max({Away.x, Away.y, Away.z}) <= 0.75 * OriginStep ? Origin : FindOrigin(Camera);
}

void FRTScene::MoveOrigin(glm::dvec3 Camera)
{
	const glm::dvec3 Snapped = SnapOrigin(Camera);
	if (Snapped == Origin) { return; }
	Origin = Snapped;
	bLightsChanged = true;
}

void FRTScene::BindRange(FSectionRangeId Id)
{
	const FSectionRange& Range = Sections.GetRange(Id);
	FInstanceBinding Binding;
	if (Range.Geometry)
	{
		// Facing can be switched off for instances, not for sections: mixed objects are culled.
		const uint32_t Flags = (Range.bMasked ? 0u : InstanceForceOpaque) | (Range.bDoubleSided ? InstanceCullDisable : 0u);
		Binding.TableOffsetAndFlags = ((Range.First * RayTypes) & 0xffffffu) | (Flags << 24);
		Binding.GeometrySlot = Range.Geometry->GetSlot();
		Binding.GeometryAddress = Geometries.GetAddress(Binding.GeometrySlot);
		const size_t Parts = MissingPrograms.empty() ? 0 : Range.Geometry->GetParts().size();
		for (uint32_t Part = 0; Part < Parts; ++Part)
		{
			if (std::binary_search(MissingPrograms.begin(), MissingPrograms.end(), Sections.GetHitProgram(Range.First + Part)))
			{
				Binding = {}; // for want of shaders, not of its structure
				break;
			}
		}
	}
	Instances.SetBinding(Id, Binding);
}

void FRTScene::TakeGeometryChanges()
{
	for (const uint32_t Slot : Geometries.TakeChanged())
	{
		const FRTGeometry* const Geometry = Geometries.Get(Slot);
		if (!Geometry) { continue; }
		Sections.GeometryChanged(*Geometry);
		bEmissiveChanged |= Geometry->IsCoarse(); // its triangles are no longer those that light sampling lists
	}
}

void FRTScene::UpdateBindings()
{
	TakeGeometryChanges();
	const std::vector<FSectionRangeId> Changed = Sections.TakeChangedRanges();
	if (std::exchange(bBindAll, false))
	{
		for (FSectionRangeId Id = 0; Id < Sections.GetRangeCapacity(); ++Id) { BindRange(Id); }
		return;
	}
	for (const FSectionRangeId Id : Changed) { BindRange(Id); }
}

void FRTScene::UpdateOpacity()
{
	UpdateOpacityUse(SectionContext, Sections, Geometries);
	TakeGeometryChanges();
}

FRTStatus FRTScene::BeginUpdate(const FGatherView& View, const FSceneUse& Use)
{
	FTraceScope Scope("Scene update");
	(void)FinishGather(); // of a frame that was given up
	Stats = {};
	FrameUse = Use;
	MoveOrigin(View.Position);
	Pivots.Update(Origin);
	UpdateOpacity();
	bGeometryWork = Use.bRays && Geometries.NeedsUpdate();
	bGeometriesBegun = Use.bRays;
	bStructuresRecorded = false;
	if (Use.bRays)
	{
		if (FRTStatus S = Geometries.BeginFrame(Use.bBuildAll); !S) { return S; }
	}
	UpdateBindings();
	Instances.Refresh();
	Motions.Update(Use.bMotion);
	if (bLightsChanged) { UpdateLights(); }
	if (Use.bLightSampling && bEmissiveChanged) { UpdateEmissiveTriangles(); }
	RefreshFacts();
	if (!Use.bRays) { return FRTStatus::Success(); }
	if (FRTStatus S = CheckLimits(); !S) { return S; }
	if (!bAdvised && Instances.GetCount() > 0) { AdviseMerging(); }
	StartGather(View);
	return FRTStatus::Success();
}

// ---------------------------------------------------------------------------------------------------- gathering

FRTScene::FGatherKey FRTScene::MakeGatherKey(const FGatherView& View, bool bCull) const
{
	FGatherKey Key;
	Key.Culling = FCullingSettings::FromConsole();
	Key.Culling.bEnabled &= bCull;
	// Without culling the view decides nothing but what is built first.
	if (Key.Culling.bEnabled || Instances.HasMissing()) { Key.View = View; }
	Key.Origin = SnapOrigin(View.Position);
	Key.Revision = Instances.GetRevision();
	Key.Mode = CVarGather.GetOnRenderThread();
	return Key;
}

void FRTScene::StartGather(const FGatherView& View)
{
	const FGatherKey Key = MakeGatherKey(View, FrameUse.bCull);
	GatherStatus = FRTStatus::Success();
	if (!bInstancesStale && Key == GatheredKey) { return; }
	bGathering = true;
	const FGatherKey Before = std::exchange(GatheredKey, Key);
	const auto Task = [this, Key, Before] { GatherStatus = GatherInstances(Key, Before); };
	if (CVarHoist.GetOnRenderThread()) { GatherTasks.Run(Task); }
	else { Task(); }
}

FRTStatus FRTScene::GatherInstances(const FGatherKey& Key, const FGatherKey& Before)
{
	FTraceScope Scope("Gather instances");
	const FCullingRule Rule(Key.View, Key.Culling);
	const FMissingGeometrySink Missing = [this, &Key](uint32_t Slot, float Pixels) {
		Geometries.RaisePriority(Slot, Pixels / static_cast<float>(std::max(1u, Key.View.Height)));
	};
	uint32_t Count = Instances.GetCount();
	if (Key.Mode != 0)
	{
		Count = Gather.Count(Instances, Rule, Missing);
		const bool bSame = !Gather.HasChanged() && Before.Mode == Key.Mode && Before.Origin == Key.Origin;
		if (bSame && !bInstancesStale) { return FRTStatus::Success(); }
	}
	bInstancesStale = true; // until all of it is written
	IRTBuffer* Buffer = nullptr;
	if (FRTStatus S = InstanceUploads.Reserve(Count, Buffer); !S) { return S; }
	auto* const Out = static_cast<FRTInstance*>(Buffer->GetMapped());
	if (Key.Mode == 0) { Count = GatherStraightforward(Instances, ObjectData.All().data(), Rule, Key.Origin, Out, Missing); }
	else { Gather.Write(Instances, Key.Origin, Out); }
	GatheredCount = Count;
	bInstancesStale = false;
	bStructureStale = true;
	return FRTStatus::Success();
}

// What the tasks are done with.
FRTStatus FRTScene::FinishGather()
{
	if (!std::exchange(bGathering, false)) { return FRTStatus::Success(); }
	FTraceScope Scope("Wait for instances");
	GatherTasks.Wait();
	return GatherStatus;
}

// ---------------------------------------------------------------------------------------------------- recording

FRTStatus FRTScene::CheckLimits() const
{
	// An instance names its first hit record with 24 bits.
	if (uint64_t(Sections.GetCapacity()) * RayTypes <= MaxInstanceIndex) { return FRTStatus::Success(); }
	return FRTStatus::Error(ERTResult::Unsupported, "the scene has %u sections; %u ray types allow %u", Sections.GetCapacity(), RayTypes,
	    MaxInstanceIndex / RayTypes);
}

FRTStatus FRTScene::ReserveStructure(uint32_t InstanceCount)
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
	// For want of memory the one that is too large serves on.
	return Status.Code == ERTResult::OutOfDeviceMemory && Capacity >= InstanceCount && Structure ? FRTStatus::Success() : Status;
}

FRTStatus FRTScene::BuildStructure(IRTCommandList& List)
{
	if (FRTStatus S = ReserveStructure(GatheredCount); !S) { return S; }
	IRTBuffer* Scratch = nullptr;
	if (FRTStatus S = Geometries.ReserveScratch(std::max<uint64_t>(1, Structure->GetBuildSizes().BuildScratchBytes), Scratch); !S)
	{
		return S;
	}
	const FRTBarrier Before{nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead};
	List.Barriers(&Before, 1);
	List.BuildScene(Structure.Get(), InstanceUploads.Use(), 0, GatheredCount, Scratch, 0);
	const FRTBarrier After{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::TraceRead};
	List.Barriers(&After, 1);
	Stats.InstancesWritten = StructureCount = GatheredCount;
	bStructureStale = false;
	return FRTStatus::Success();
}

FRTStatus FRTScene::RecordTables(IRTCommandList& List, FFrameUploads& Uploads)
{
	if (!AreTablesDirty()) { return FRTStatus::Success(); }
	const FRTBarrier Before{nullptr, nullptr, UploadedAccess, ERTAccess::CopyWrite};
	List.Barriers(&Before, 1);
	for (FRTStatus S : {Materials.Flush(Device, List, Uploads), ObjectData.Flush(Device, List, Uploads),
	         LightData.Flush(Device, List, Uploads), EmissiveTriangles.Flush(Device, List, Uploads),
	         Sections.GetTable().Flush(Device, List, Uploads), Motions.GetTable().Flush(Device, List, Uploads)})
	{
		if (!S) { return S; }
	}
	Stats.BytesCopied = Materials.GetCopiedBytes() + ObjectData.GetCopiedBytes() + LightData.GetCopiedBytes() +
	                    EmissiveTriangles.GetCopiedBytes() + Sections.GetTable().GetCopiedBytes() + Motions.GetTable().GetCopiedBytes();
	const FRTBarrier After{nullptr, nullptr, ERTAccess::CopyWrite, UploadedAccess};
	List.Barriers(&After, 1);
	return FRTStatus::Success();
}

FRTStatus FRTScene::RecordUpdate(IRTCommandList& List, FFrameUploads& Uploads)
{
	const FRTStatus Status = RecordTables(List, Uploads);
	return Status ? RecordStructures(List, Uploads) : Status;
}

FRTStatus FRTScene::RecordStructures(IRTCommandList& List, FFrameUploads&)
{
	if (!FrameUse.bRays) { return FRTStatus::Success(); }
	bStructuresRecorded = true;
	if (FRTStatus S = Geometries.Record(List); !S) { return S; }
	Stats.GeometriesBuilt = Geometries.GetStats().Built + Geometries.GetStats().Rebuilt;
	Stats.GeometriesRefitted = Geometries.GetStats().Refitted;
	if (FRTStatus S = FinishGather(); !S) { return S; }
	// Bounds of what was refitted are others, though its instances are not.
	const bool bBuilt = Stats.GeometriesBuilt + Stats.GeometriesRefitted > 0;
	return bStructureStale || bBuilt ? BuildStructure(List) : FRTStatus::Success();
}

FRTStatus FRTScene::Update(IRTCommandList& List, FFrameUploads& Uploads, const FGatherView& View, const FSceneUse& Use)
{
	if (FRTStatus S = BeginUpdate(View, Use); !S) { return S; }
	return RecordUpdate(List, Uploads);
}

void FRTScene::Rerecord()
{
	Materials.Invalidate();
	ObjectData.Invalidate();
	LightData.Invalidate();
	EmissiveTriangles.Invalidate();
	Sections.GetTable().Invalidate();
	Motions.GetTable().Invalidate();
	bStructureStale = true;
}

void FRTScene::EndFrame(bool bSubmitted, FRTFence Fence)
{
	(void)FinishGather(); // of a frame that ended early
	InstanceUploads.EndFrame(bSubmitted, Fence);
	if (std::exchange(bGeometriesBegun, false)) { Geometries.EndFrame(bSubmitted && bStructuresRecorded); }
	Motions.EndFrame(bSubmitted);
	if (!bSubmitted) { return Rerecord(); }
	RetiredBefore = std::move(Retired);
	Retired.clear();
}

} // namespace Lantern
