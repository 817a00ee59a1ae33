// rtScene: the objects valid this frame, their materials and lights, and the acceleration structure over them.
//
// World positions are double precision; what the GPU sees is relative to an origin that follows the camera in
// steps of OriginStep, so that fp32 keeps ≤ 0.1 mm within a kilometre of the camera anywhere in the world. Objects are
// stored relative to their own cell of the world, so that a moving origin rewrites none of them: of tables, it costs that of
// punctual lights.
//
// Costs follow changes: an update in which neither scene nor view changed does nothing, and one object that changes
// costs the same in a scene of a million.
//
// Threads: one at a time. Order of a frame: changes → BeginUpdate → (no changes) → RecordUpdate → passes → submit →
// EndFrame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/Instances/Gather.h"
#include "LanternScene/Instances/InstanceUploads.h"
#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Scene/Object.h"
#include "LanternScene/Scene/ObjectMotion.h"
#include "LanternScene/Scene/ObjectPivots.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "SceneTypes.h"

namespace Lantern
{

/// What the scene has. A pass that serves none of it records nothing.
struct FSceneFacts
{
	uint32_t Objects = 0;
	uint32_t DynamicGeometries = 0;
	uint32_t Lights = 0;
	uint32_t EmissiveTriangles = 0;
	bool bMasked = false; ///< some object has an alpha-tested material (and r.RT.AlphaTest is on)
	/// Some surface's shape only its material program knows: boxes, or an alpha test that is not the standard one.
	bool bOwnShapes = false;
	bool bEmissive = false;
	bool bSun = false;
	bool bSky = false;
	friend bool operator==(const FSceneFacts&, const FSceneFacts&) = default;
};

/// The sun, as FSceneConstants has it but in plain units.
struct FSunLight
{
	glm::dvec3 Direction{0, -1, 0}; ///< in which its light travels; need not be unit length
	glm::vec3 Color{1};
	float Irradiance = 0.0f;      ///< on a plane that faces it, lux; 0: no sun
	float AngularDiameter = 0.0f; ///< radians; 0: hard shadows
};

/// A punctual light in the world.
struct FSceneLight
{
	FLightData Data; ///< Position is filled in from WorldPosition
	glm::dvec3 WorldPosition{0};
};

/// What the passes of a frame want of the scene beside its tables.
struct FSceneUse
{
	bool bRays = true;           ///< acceleration structures: without rays none is made, built or refitted
	bool bLightSampling = false; ///< the list of emissive triangles
	bool bCull = true;           ///< false: rays see every object (the reference)
	bool bBuildAll = true;       ///< no budget for builds: all that wait are built now (offline pictures)
	bool bMotion = false;        ///< where objects were in the frame before (FSceneConstants::ObjectMotions)
};

struct FSceneUpdateStats
{
	uint32_t GeometriesBuilt = 0, GeometriesRefitted = 0; ///< builds include rebuilds
	uint32_t InstancesWritten = 0;                        ///< 0: the acceleration structure over them stayed as it was
	uint64_t BytesCopied = 0;                             ///< to tables on the GPU
};

class FRTScene
{
public:
	static constexpr double OriginStep = Lantern::OriginStep; // metres

	explicit FRTScene(IRTDevice& Device);
	~FRTScene();
	FRTScene(const FRTScene&) = delete;
	FRTScene& operator=(const FRTScene&) = delete;

	/// Queues the build: it runs in an update of a frame with rays, see FGeometryStore; until then its objects are not in
	/// the rays' scene. Errors as FGeometryStore::Create.
	FRTStatus CreateGeometry(FRTGeometryInfo Info, FRTGeometryRef& Out);
	FGeometryStore& GetGeometries() { return Geometries; }
	/// A dynamic geometry's vertices are new in this frame: it is refitted, or rebuilt every
	/// r.RT.Skinning.RebuildInterval frames.
	void MarkDeformed(const FRTGeometryRef& Geometry);

	/// Program: of FMaterialPrograms.
	uint32_t AddMaterial(const FMaterialData& Material, uint32_t Program = StandardProgram);
	void SetMaterial(uint32_t Index, const FMaterialData& Material);
	void SetMaterialProgram(uint32_t Index, uint32_t Program);
	uint32_t GetMaterialProgram(uint32_t Index) const { return MaterialPrograms[Index]; }
	/// No object may have it. Its index is given to a material that comes later.
	void RemoveMaterial(uint32_t Index);
	const TGpuTable<FMaterialData>& GetMaterials() const { return Materials; }

	/// An invalid id, said once, where the scene has MaxInstanceIndex objects already.
	FRTObjectId AddObject(FRTObjectInfo Info);
	/// At any time, also while frames that see it are in flight.
	void RemoveObject(FRTObjectId Id);
	void SetTransform(FRTObjectId Id, const glm::dmat4& Transform);
	void SetMaterials(FRTObjectId Id, std::vector<uint32_t> SectionMaterials);
	const FRTObjectInfo& GetObject(FRTObjectId Id) const;
	/// For a walk over all objects: slots below the count, of which some may be empty (null).
	uint32_t GetObjectSlotCount() const { return static_cast<uint32_t>(Objects.size()); }
	const FRTObjectInfo* FindObject(uint32_t Slot) const { return Objects[Slot].bAlive ? &Objects[Slot].Info : nullptr; }
	/// Of its first section in FSectionData[]; the object's own data is at Id.Index in FObjectData[].
	uint32_t GetFirstSection(FRTObjectId Id) const;

	void SetLights(std::vector<FSceneLight> Lights);
	const std::vector<FSceneLight>& GetLights() const { return Lights; }
	void SetSun(const FSunLight& Sun);
	const FSunLight& GetSun() const { return Sun; }
	void SetSky(glm::vec3 Radiance);
	glm::vec3 GetSky() const { return Sky; }
	/// 0: the scene's materials; 1: each a Lambert of its base colour; 2: each a Lambert of 0.5, alpha tests off.
	void SetMaterialOverride(uint32_t Override);
	void SetAlphaTest(bool bEnabled);
	/// Objects with a section of one of these programs are left out of the rays' scene: its shaders are missing, and no
	/// stand-in is wanted. Replaces the set before; costs something only where it differs.
	void SetMissingPrograms(std::vector<FHitProgram> Programs);

	/// Brings the facts up to date with all changes so far; BeginUpdate does it too.
	const FSceneFacts& RefreshFacts();
	const FSceneFacts& GetFacts() const { return Facts; } ///< as of the last RefreshFacts
	/// Before BeginUpdate: whether the two would have anything to do. False where neither scene nor view changed.
	bool NeedsUpdate(const FGatherView& View, const FSceneUse& Use) const;
	glm::dvec3 GetOrigin() const { return Origin; }
	/// World to what shaders use.
	glm::vec3 ToRelative(glm::dvec3 World) const { return glm::vec3(World - Origin); }

	/// Frame start: takes over all changes so far and starts gathering instances. The view's position moves the origin,
	/// which is the frame's from now on. Until RecordUpdate the scene must not change.
	FRTStatus BeginUpdate(const FGatherView& View, const FSceneUse& Use);
	/// After BeginUpdate: records uploads, builds and refits into List. On error the list must not be submitted.
	FRTStatus RecordUpdate(IRTCommandList& List, FFrameUploads& Uploads);
	/// RecordUpdate in two halves, in this order: the tables, which all passes read and which never wait for gathering, and
	/// the acceleration structures, which only rays need. With FSceneUse::bRays both must be called.
	FRTStatus RecordTables(IRTCommandList& List, FFrameUploads& Uploads);
	FRTStatus RecordStructures(IRTCommandList& List, FFrameUploads& Uploads);
	/// After BeginUpdate: whether RecordTables would record anything.
	bool NeedsTables() const { return AreTablesDirty(); }
	/// After BeginUpdate: whether RecordStructures may find anything to record. Waits for nothing.
	bool NeedsStructures() const { return FrameUse.bRays && (bGathering || bGeometryWork || bStructureStale); }
	/// BeginUpdate and RecordUpdate in turn.
	FRTStatus Update(IRTCommandList& List, FFrameUploads& Uploads, const FGatherView& View, const FSceneUse& Use);
	/// After RecordUpdate: the block that passes read.
	FSceneConstants GetConstants() const;
	IRTScene* GetStructure() const { return Structure.Get(); }
	const FObjectMotions& GetMotions() const { return Motions; }
	FSectionTable& GetSections() { return Sections; }
	const FInstanceStore& GetInstances() const { return Instances; }
	/// Instances of the acceleration structure as it is.
	uint32_t GetInstanceCount() const { return StructureCount; }
	const FSceneUpdateStats& GetStats() const { return Stats; }
	/// After RecordUpdate. bSubmitted: what was removed before it can go. Otherwise what it recorded never runs, also if it
	/// failed half-way: the next update records all of it again. Fence: of the submission, so that memory is used again
	/// when it is done; 0: unknown.
	void EndFrame(bool bSubmitted = true, FRTFence Fence = 0);
	/// How many hit records each section has: one for each ray type in use. Set by whoever owns the RTPSO.
	void SetRayTypes(uint32_t Count);

private:
	struct FObject
	{
		FRTObjectInfo Info;
		uint32_t Generation = 0;
		FSectionRangeId Range = 0;
		bool bAlive = false;
	};
	/// All that the instances written depend on beside the content of the store.
	struct FGatherKey
	{
		FGatherView View;
		FCullingSettings Culling;
		glm::dvec3 Origin{0};
		uint64_t Revision = 0;
		int32_t Mode = -1;
		friend bool operator==(const FGatherKey&, const FGatherKey&) = default;
	};
	FObject& Resolve(FRTObjectId Id);
	const FObject& Resolve(FRTObjectId Id) const;
	uint32_t TakeObjectSlot();
	void FreeObjectSlot(uint32_t Index);
	void WriteObject(uint32_t Index);
	void MarkEmissive(FSectionRangeId Range);
	uint32_t FirstSectionOf(const FObject& Object) const { return Sections.GetRange(Object.Range).First; }
	void UpdateLights();
	void ListEmissiveObjects();
	void UpdateEmissiveTriangles();
	double AddEmissiveTriangles(
	    uint32_t Object, double Power, std::vector<FEmissiveTriangle>& Triangles, std::vector<double>& Cumulative) const;
	void AdviseMerging();
	// SceneUpdate.cpp
	glm::dvec3 SnapOrigin(glm::dvec3 Camera) const;
	void MoveOrigin(glm::dvec3 Camera);
	bool AreTablesDirty() const;
	void UpdateBindings();
	void UpdateOpacity();
	void TakeGeometryChanges();
	void BindRange(FSectionRangeId Id);
	FGatherKey MakeGatherKey(const FGatherView& View, bool bCull) const;
	void StartGather(const FGatherView& View);
	FRTStatus GatherInstances(const FGatherKey& Key, const FGatherKey& Before);
	FRTStatus FinishGather();
	FRTStatus CheckLimits() const;
	FRTStatus ReserveStructure(uint32_t InstanceCount);
	FRTStatus BuildStructure(IRTCommandList& List);
	void Rerecord();

	IRTDevice& Device;
	glm::dvec3 Origin{0};
	FGeometryStore Geometries{Device};
	std::vector<FObject> Objects;
	std::vector<uint32_t> FreeObjects;                  // a heap, the lowest first, so that the table's end falls free
	uint32_t GenerationFloor = 0;                       // of slots that the table never had, or has lost
	std::vector<FRTGeometryRef> Retired, RetiredBefore; // see EndFrame
	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> MaterialPrograms;
	std::vector<uint32_t> FreeMaterials;
	FSectionContext SectionContext{Materials, MaterialPrograms};
	FSectionTable Sections{SectionContext};
	std::vector<FHitProgram> MissingPrograms; // sorted
	TGpuTable<FObjectData> ObjectData{"Objects"};
	FObjectMotions Motions{ObjectData};
	FObjectPivots Pivots;
	TGpuTable<FLightData> LightData{"Lights"};
	TGpuTable<FEmissiveTriangle> EmissiveTriangles{"EmissiveTriangles"};
	std::vector<uint32_t> EmissiveObjects;
	std::vector<FSceneLight> Lights;
	FSunLight Sun;
	glm::vec3 Sky{0};
	float EmissivePower = 0.0f;
	uint32_t RayTypes = 1;
	FSceneFacts Facts;
	FSceneUpdateStats Stats;
	FSceneUse FrameUse;

	FInstanceStore Instances;
	FInstanceGather Gather;
	FInstanceUploads InstanceUploads{Device};
	FGatherKey GatheredKey;
	// The tasks of a gather write these; they are read when it is finished.
	FRTStatus GatherStatus;
	uint32_t GatheredCount = 0;
	bool bInstancesStale = true; // the newest instances written are not what GatheredKey says
	bool bStructureStale = true; // the acceleration structure is not over the newest instances, or was never built
	bool bGathering = false;

	TRTRef<IRTScene> Structure;
	uint32_t StructureCount = 0;
	uint32_t FramesTooLarge = 0;
	bool bGeometryWork = false;       // this frame builds or refits
	bool bGeometriesBegun = false;    // this frame, and not ended
	bool bStructuresRecorded = false; // this frame
	bool bBindAll = false;
	bool bAdvised = false;
	bool bLightsChanged = true, bEmissiveChanged = true, bEmissiveObjectsChanged = true;
	FTaskGroup GatherTasks; // last: it waits for what uses the others
};

} // namespace Lantern
