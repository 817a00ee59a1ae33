// FSceneUpdate runs the frame of a scene: it takes over what changed, starts the gather, and records tables and
// acceleration structures. FRTScene documents the order of calls.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/Scene/EmissiveTriangles.h"
#include "LanternScene/Scene/Scene.h"
#include "LanternScene/Scene/SceneLights.h"
#include "LanternScene/Scene/SceneMaterials.h"
#include "LanternScene/Scene/SceneObjects.h"
#include "Scene/RangeBindings.h"
#include "Scene/SceneStructure.h"

namespace Lantern
{

/// The parts of a scene that an update reads and brings up to date.
struct FSceneParts
{
	IRTDevice& Device;
	FGeometryStore& Geometries;
	FSceneMaterials& Materials;
	FSceneObjects& Objects;
	FSceneLights& Lights;
	FEmissiveTriangles& Emissive;
};

/// Threads: one at a time. Functions of FRTScene forward to those of equal meaning here.
class FSceneUpdate
{
public:
	/// The parts outlive this.
	explicit FSceneUpdate(const FSceneParts& InParts) : Parts(InParts), Structure(Parts.Device, Parts.Geometries, Parts.Objects) {}
	FSceneUpdate(const FSceneUpdate&) = delete;
	FSceneUpdate& operator=(const FSceneUpdate&) = delete;

	FRangeBindings& GetBindings() { return Bindings; }
	const FSceneFacts& RefreshFacts();
	/// Brings those facts up to date that follow from the lights alone.
	void RefreshLightFacts();
	const FSceneFacts& GetFacts() const { return Facts; }

	const glm::dvec3& GetOrigin() const { return Origin; }
	bool NeedsUpdate(const FGatherView& View, const FSceneUse& Use) const;
	FRTStatus Begin(const FGatherView& View, const FSceneUse& InUse);
	bool AreTablesDirty() const;
	FRTStatus RecordTables(IRTCommandList& List, FFrameUploads& Uploads);
	bool NeedsStructures() const { return Use.bRays && (Structure.IsGathering() || bGeometryWork || Structure.IsStale()); }
	FRTStatus RecordStructures(IRTCommandList& List);
	void EndFrame(bool bSubmitted, FRTFence Fence);

	const FSceneStructure& GetStructure() const { return Structure; }
	const FSceneUpdateStats& GetStats() const { return Stats; }

private:
	template <class FVisit>
	void VisitTables(FVisit Visit) const;
	glm::dvec3 SnapOrigin(glm::dvec3 Camera) const;
	void MoveOrigin(glm::dvec3 Camera);
	void UpdateOpacity();
	void TakeGeometryChanges();

	const FSceneParts Parts;
	FRangeBindings Bindings;
	FSceneStructure Structure;
	glm::dvec3 Origin{0};
	FSceneFacts Facts;
	FSceneUpdateStats Stats;
	FSceneUse Use;                    // of this frame
	bool bGeometryWork = false;       // this frame builds or refits
	bool bGeometriesBegun = false;    // this frame, and not ended
	bool bStructuresRecorded = false; // this frame
	bool bAdvised = false;
};

} // namespace Lantern
