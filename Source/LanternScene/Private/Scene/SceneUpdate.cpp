// FSceneUpdate: the order in which a frame takes over changes and records uploads and builds.
#include "Scene/SceneUpdate.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "Geometry/MergeAdvice.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "Opacity/OpacityUse.h"

namespace Lantern
{

namespace
{
/// Objects that merging must save to be worth a line in the log.
constexpr uint32_t LeastMergeSaving = 64;

void AdviseMerging(const FSceneObjects& Objects)
{
	const FMergeAdvice Advice = FindMergeable([&Objects](const std::function<void(const FRTObjectInfo&)>& Visit) {
		for (uint32_t Slot = 0; Slot < Objects.GetSlotCount(); ++Slot)
		{
			if (const FRTObjectInfo* const Object = Objects.Find(Slot)) { Visit(*Object); }
		}
	});
	if (Advice.Objects - Advice.Materials < LeastMergeSaving) { return; }
	LogInfo(
	    "Scene: {} of {} objects are meshes of one section below {} triangles, used once, that share their material with others. Merged "
	    "by material they would be {}: {} acceleration structures and instances fewer.",
	    Advice.Objects, Objects.GetInstances().GetCount(), FMergeAdvice::SmallTriangles, Advice.Materials,
	    Advice.Objects - Advice.Materials);
}

/// Tells whether only its material program knows the shape of a surface: it is a box, or has an alpha test of its own.
bool HasOwnShape(const FHitProgram& Program)
{
	return Program.Class == ERTHitClass::Procedural || (Program.Class == ERTHitClass::Masked && Program.Program != StandardProgram);
}
} // namespace

// ---------------------------------------------------------------------------------------------------- what changed

const FSceneFacts& FSceneUpdate::RefreshFacts()
{
	FSectionTable& Sections = Parts.Materials.GetSections();
	UpdateOpacity(); // which hit programs there are depends on it
	Facts.Objects = Parts.Objects.GetInstances().GetCount();
	Facts.DynamicGeometries = Parts.Geometries.GetDynamicCount();
	Facts.bCharacters = Parts.Objects.GetCharacterCount() > 0;
	Facts.bToon = Parts.Objects.GetToons().GetCount() > 0;
	Facts.bToonLayer = Parts.Objects.GetToons().GetOccludedCount() > 0;
	const bool bListed = Parts.Emissive.IsUsable();
	Facts.EmissiveTriangles = bListed ? Parts.Emissive.GetTriangleCount() : 0;
	Facts.EmissiveClusters = bListed ? Parts.Emissive.GetClusters().Num() : 0;
	Facts.bMasked = Sections.GetMaskedRangeCount() > 0;
	Facts.bOwnShapes = std::any_of(Sections.GetHitPrograms().begin(), Sections.GetHitPrograms().end(), HasOwnShape);
	Facts.bEmissive = Sections.GetEmissiveRangeCount() > 0;
	Facts.bTransmissive = Sections.GetTransmissiveRangeCount() > 0;
	Facts.bDiffuseTransmission = Sections.GetDiffuseTransmissionRangeCount() > 0;
	Facts.bScattering = Sections.GetScatteringRangeCount() > 0;
	Facts.bLightEmission = Sections.GetLightEmissionRangeCount() > 0;
	RefreshLightFacts();
	return Facts;
}

void FSceneUpdate::RefreshLightFacts()
{
	const FLightStore& Lights = Parts.Lights.GetStore();
	Facts.Lights = Lights.GetCount();
	Facts.ShadowedLights = Lights.GetShadowedCount();
	Facts.FiniteLights = Lights.GetFiniteCount();
	Facts.FogLights = Lights.GetFogCount();
	Facts.bAreaLights = Lights.GetExtendedCount() > 0;
	Facts.bLightProfiles = Lights.GetProfiledCount() > 0 || Parts.Lights.GetProfiles().HasRetired(); // of a lamp that has just gone
	Facts.bSun = Parts.Lights.HasSun();
	const bool bSunOff = Facts.bSun && (Parts.Lights.GetSun().Channels & CHANNELS_DEFAULT) == 0;
	const bool bOff = bSunOff || Lights.GetOffChannelCount() > 0 || Parts.Objects.GetOffChannelCount() > 0;
	Facts.bLightChannels = bOff && (Facts.bSun || Facts.Lights > 0);
	Facts.bSky = Parts.Lights.HasSky();
	Facts.bSkyProgram = Parts.Lights.GetSkyProgram().has_value();
	Facts.bSkyMap = Facts.bSky && Parts.Lights.HasSkyMap() && !Facts.bSkyProgram;
}

bool FSceneUpdate::NeedsUpdate(const FGatherView& View, const FSceneUse& InUse) const
{
	const FSectionTable& Sections = Parts.Materials.GetSections();
	const glm::dvec3 NewOrigin = SnapOrigin(View.Position);
	const bool bGeometry = Parts.Geometries.NeedsUpdate() || NeedsOpacityUpdate(Parts.Materials.GetContext(), Sections, Parts.Geometries);
	const bool bGather = Bindings.NeedsUpdate(Sections) || bGeometry || Structure.NeedsGather(View, InUse.bCull, NewOrigin);
	return Parts.Geometries.HasReleased() || Parts.Objects.GetMotions().NeedsUpdate(InUse.bMotion) || (InUse.bRays && bGather) ||
	       (InUse.bLightSampling && Parts.Emissive.NeedsUpdate()) || AreTablesDirty() || NewOrigin != Origin;
}

glm::dvec3 FSceneUpdate::SnapOrigin(glm::dvec3 Camera) const
{
	// A camera that goes to and fro across a border of the grid must not move the origin each time.
	const glm::dvec3 Away = glm::abs(Camera - Origin);
	return std::max({Away.x, Away.y, Away.z}) <= 0.75 * OriginStep ? Origin : FindOrigin(Camera);
}

void FSceneUpdate::MoveOrigin(glm::dvec3 Camera)
{
	const glm::dvec3 Snapped = SnapOrigin(Camera);
	if (Snapped == Origin) { return; }
	Origin = Snapped;
}

void FSceneUpdate::TakeGeometryChanges()
{
	for (const uint32_t Slot : Parts.Geometries.TakeChanged())
	{
		const FRTGeometry* const Geometry = Parts.Geometries.Get(Slot);
		if (!Geometry) { continue; }
		Parts.Materials.GetSections().GeometryChanged(*Geometry);
		if (!Geometry->IsCoarse()) { continue; }
		Parts.Emissive.MarkLists(); // they are no longer those that light sampling lists
		Parts.Objects.GetCasterChanges().AddAnywhere();
	}
}

void FSceneUpdate::UpdateOpacity()
{
	UpdateOpacityUse(Parts.Materials.GetContext(), Parts.Materials.GetSections(), Parts.Geometries);
	TakeGeometryChanges();
}

FRTStatus FSceneUpdate::Begin(const FGatherView& View, const FSceneUse& InUse)
{
	FTraceScope Scope("Scene update");
	(void)Structure.FinishGather(); // of a frame that was given up
	Stats = {};
	Use = InUse;
	MoveOrigin(View.Position);
	Parts.Geometries.FreeReleased();
	Parts.Objects.GetPivots().Update(Origin);
	UpdateOpacity();
	bGeometryWork = Use.bRays && Parts.Geometries.NeedsUpdate();
	bGeometriesBegun = Use.bRays;
	bStructuresRecorded = false;
	if (Use.bRays)
	{
		if (FRTStatus S = Parts.Geometries.BeginFrame(Use.bBuildAll); !S) { return S; }
	}
	TakeGeometryChanges();
	FSectionTable& Sections = Parts.Materials.GetSections();
	FInstanceStore& Instances = Parts.Objects.GetInstances();
	if (Bindings.Update(Sections, Parts.Geometries, Instances)) { Parts.Objects.GetCasterChanges().AddAnywhere(); }
	Instances.Refresh();
	Parts.Objects.GetMotions().Update(Use.bMotion);
	if (Use.bLightSampling && Parts.Emissive.NeedsUpdate())
	{
		if (FRTStatus S = Parts.Emissive.Update(Parts.Device, Parts.Objects, Parts.Materials); !S) { return S; }
	}
	RefreshFacts();
	if (!Use.bRays) { return FRTStatus::Success(); }
	if (FRTStatus S = Bindings.CheckLimits(Sections); !S) { return S; }
	if (!bAdvised && Instances.GetCount() > 0)
	{
		bAdvised = true;
		AdviseMerging(Parts.Objects);
	}
	Structure.StartGather(View, Use.bCull, Origin);
	return FRTStatus::Success();
}

// ---------------------------------------------------------------------------------------------------- recording

template <class FVisit>
void FSceneUpdate::VisitTables(FVisit Visit) const
{
	Visit(Parts.Materials.GetTable());
	Visit(Parts.Objects.GetTable());
	Visit(Parts.Lights.GetStore().GetTable());
	Visit(Parts.Lights.GetProfiles().GetHeaders());
	Visit(Parts.Lights.GetProfiles().GetTexels());
	Visit(Parts.Objects.GetChannels());
	Parts.Objects.GetToons().VisitTables(Visit);
	Visit(Parts.Emissive.GetClusters());
	Visit(Parts.Emissive.GetRanges());
	Visit(Parts.Materials.GetSections().GetTable());
	Visit(Parts.Objects.GetMotions().GetTable());
}

bool FSceneUpdate::AreTablesDirty() const
{
	bool bDirty = false;
	VisitTables([&](const FGpuTableBase& Table) { bDirty |= Table.IsDirty(); });
	return bDirty;
}

FRTStatus FSceneUpdate::RecordTables(IRTCommandList& List, FFrameUploads& Uploads)
{
	if (!AreTablesDirty()) { return FRTStatus::Success(); }
	const FRTBarrier Before{nullptr, nullptr, UploadedAccess, ERTAccess::CopyWrite};
	List.Barriers(&Before, 1);
	FRTStatus First;
	uint64_t Bytes = 0;
	VisitTables([&](auto& Table) {
		const FRTStatus Status = Table.Flush(Parts.Device, List, Uploads);
		if (First) { First = Status; }
		Bytes += Table.GetCopiedBytes();
	});
	if (!First) { return First; }
	Stats.BytesCopied = Bytes;
	const FRTBarrier After{nullptr, nullptr, ERTAccess::CopyWrite, UploadedAccess};
	List.Barriers(&After, 1);
	return FRTStatus::Success();
}

FRTStatus FSceneUpdate::RecordStructures(IRTCommandList& List)
{
	if (!Use.bRays) { return FRTStatus::Success(); }
	bStructuresRecorded = true;
	if (FRTStatus S = Parts.Geometries.Record(List); !S) { return S; }
	Stats.GeometriesBuilt = Parts.Geometries.GetStats().Built + Parts.Geometries.GetStats().Rebuilt;
	Stats.GeometriesRefitted = Parts.Geometries.GetStats().Refitted;
	if (FRTStatus S = Structure.FinishGather(); !S) { return S; }
	// Bounds of what was refitted are others, though its instances are not.
	const bool bBuilt = Stats.GeometriesBuilt + Stats.GeometriesRefitted > 0;
	if (!Structure.IsStale() && !bBuilt) { return FRTStatus::Success(); }
	if (FRTStatus S = Structure.Build(List); !S) { return S; }
	Stats.InstancesWritten = Structure.GetInstanceCount();
	return FRTStatus::Success();
}

void FSceneUpdate::EndFrame(bool bSubmitted, FRTFence Fence)
{
	(void)Structure.FinishGather(); // of a frame that ended early
	Structure.EndFrame(bSubmitted, Fence);
	if (std::exchange(bGeometriesBegun, false)) { Parts.Geometries.EndFrame(bSubmitted && bStructuresRecorded); }
	if (!bSubmitted)
	{
		VisitTables([](auto& Table) { Table.Invalidate(); });
	}
	Parts.Objects.EndFrame(bSubmitted);
	Parts.Emissive.EndFrame(bSubmitted);
	Parts.Lights.GetProfiles().EndFrame(bSubmitted);
}

} // namespace Lantern
