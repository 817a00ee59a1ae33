// rtScene: the objects valid this frame, their materials and lights, and the acceleration structure over them.
//
// World positions are double precision. The GPU sees positions relative to an origin that follows the camera in steps of
// OriginStep. Within a kilometre of the camera, the error of fp32 is then ≤ 0.1 mm. Objects are stored relative to their own cell of
// the world, and lights in steps of the whole world. No table is rewritten when the origin moves.
//
// Costs follow changes. An update in which neither scene nor view changed does nothing. One object that changes costs no
// more in a scene of a million.
//
// Threads: one at a time. Order of a frame: changes → BeginUpdate → (no changes) → RecordUpdate → passes → submit →
// EndFrame.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/Instances/Culling.h"
#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Scene/EmissiveTriangles.h"
#include "LanternScene/Scene/Object.h"
#include "LanternScene/Scene/ObjectMotion.h"
#include "LanternScene/Scene/SceneLights.h"
#include "LanternScene/Scene/SceneMaterials.h"
#include "LanternScene/Scene/SceneObjects.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "SceneTypes.h"

namespace Lantern
{

class FSceneUpdate;

/// What the scene has. A pass that serves none of it records nothing.
struct FSceneFacts
{
	uint32_t Objects = 0;
	uint32_t DynamicGeometries = 0;
	uint32_t Lights = 0;         ///< without sun and emissive triangles
	uint32_t ShadowedLights = 0; ///< of them, those that cast shadows: see FLightStore::SetCastingKinds
	uint32_t FiniteLights = 0;   ///< of them, those with a range: see ReachesEverywhere
	uint32_t FogLights = 0;      ///< of them, those that fog scatters
	bool bAreaLights = false;    ///< some of them have an extent: see HasExtent
	bool bLightProfiles = false; ///< some of them have a profile
	bool bLightChannels = false; ///< some light, the sun or some object is not of channel 0, by which each would light all
	uint32_t EmissiveTriangles = 0;
	uint32_t EmissiveClusters = 0; ///< that they are divided into: FEmissiveCluster
	bool bMasked = false;          ///< some object has an alpha-tested material (and r.RT.AlphaTest is on)
	/// Only its material program knows the shape of some surface. It is a box, or its alpha test is not the standard one. So is what light
	/// shines through, if it has a program.
	bool bOwnShapes = false;
	bool bEmissive = false;
	bool bTransmissive = false;        ///< light shines through some material
	bool bDiffuseTransmission = false; ///< some material scatters light through to its other side
	bool bScattering = false;          ///< light is scattered within some solid
	bool bLightEmission = false;       ///< some of it lights otherwise than it looks: FMaterialData::LightEmissive
	bool bSun = false;
	bool bSky = false;
	bool bSkyMap = false;     ///< it is a texture
	bool bSkyProgram = false; ///< it is a program's
	/// Whatever asks for its radiance runs the program. Set by the renderer.
	bool bSkyInPlace = false;
	bool bCharacters = false; ///< some objects are not shadowed by characters: FRTObjectTraits
	bool bToon = false;       ///< light falls on some objects as on a drawing: FToonStyle
	bool bToonLayer = false;  ///< some of them have an Occlusion
	bool bBackPixels = false; ///< the frame's host has FGBuffer::BackAlbedo; set by the renderer
	bool bHostShadow = false; ///< the frame's host has a shadow map of the sun; set by the renderer
	/// The frame's host reads the light mask, and there is a light for it. Set by the renderer.
	bool bLightMask = false;
	bool bMaskAlone = false; ///< and nobody reads the signals of local lights
	friend bool operator==(const FSceneFacts&, const FSceneFacts&) = default;
};

/// What the passes of a frame need of the scene beside its tables.
struct FSceneUse
{
	bool bRays = true;           ///< acceleration structures: without rays none is made, built or refitted
	bool bLightSampling = false; ///< emissive triangles: GetEmissiveWork says what to record for them
	bool bCull = true;           ///< false: rays see every object (the reference)
	bool bBuildAll = true;       ///< builds all pending geometry now, without a budget (offline pictures)
	bool bMotion = false;        ///< where objects were in the frame before (FSceneConstants::ObjectMotions)
};

struct FSceneUpdateStats
{
	uint32_t GeometriesBuilt = 0, GeometriesRefitted = 0; ///< builds include rebuilds
	uint32_t InstancesWritten = 0;                        ///< 0: the acceleration structure over instances stayed as it was
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

	/// Queues the build, see FGeometryStore. It runs in an update of a frame with rays; until then rays do not see the
	/// geometry's objects. Errors are those of FGeometryStore::Create.
	FRTStatus CreateGeometry(FRTGeometryInfo Info, FRTGeometryRef& Out) { return Geometries.Create(std::move(Info), Out); }
	FGeometryStore& GetGeometries() { return Geometries; }
	/// Tells that the buffers of a geometry with FRTGeometryInfo::bWaitsForData are filled. The lists that later updates record into
	/// must find the data.
	void MarkFilled(const FRTGeometryRef& Geometry);
	/// Tells that a dynamic geometry's vertices are new in this frame. The geometry is refitted, or rebuilt every
	/// r.RT.Skinning.RebuildInterval frames.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// Replaces the bounds of a dynamic geometry: see FRTGeometryInfo::BoundsRadius. O(objects that have it).
	void SetBounds(const FRTGeometryRef& Geometry, const FBoundingSphere& Bounds) { Objects.SetBounds(Geometry, Bounds); }

	/// Returns how many materials, geometries and objects a host that streams should add or remove before a frame; 0: any number.
	/// Render thread.
	static uint32_t GetMostArrivals();

	/// Returns the material's index. Program is an index of FMaterialPrograms.
	uint32_t AddMaterial(const FMaterialData& Material, uint32_t Program = StandardProgram) { return Materials.Add(Material, Program); }
	void SetMaterial(uint32_t Index, const FMaterialData& Material);
	void SetMaterialProgram(uint32_t Index, uint32_t Program);
	uint32_t GetMaterialProgram(uint32_t Index) const { return Materials.GetProgram(Index); }
	/// Frees the index for a material that comes later. No object may use the material.
	void RemoveMaterial(uint32_t Index) { Materials.Remove(Index); }
	const TGpuTable<FMaterialData>& GetMaterials() const { return Materials.GetTable(); }

	/// Returns an invalid id, and logs that once, if the scene has MaxInstanceIndex + 1 objects already.
	FRTObjectId AddObject(FRTObjectInfo Info) { return Objects.Add(std::move(Info)); }
	/// May be called at any time, also while frames that see the object are in flight.
	void RemoveObject(FRTObjectId Id) { Objects.Remove(Id); }
	void SetTransform(FRTObjectId Id, const glm::dmat4& Transform) { Objects.SetTransform(Id, Transform); }
	void SetMaterials(FRTObjectId Id, std::vector<uint32_t> SectionMaterials) { Objects.SetMaterials(Id, std::move(SectionMaterials)); }
	/// Replaces geometry and materials, one for each section. The object's motion stays; its shape jumps. Rays see the object once the
	/// geometry is built.
	void SetGeometry(FRTObjectId Id, FRTGeometryRef Geometry, std::vector<uint32_t> SectionMaterials)
	{
		Objects.SetGeometry(Id, std::move(Geometry), std::move(SectionMaterials));
	}
	/// Replaces FRTObjectInfo::Mask. The object's motion stays.
	void SetMask(FRTObjectId Id, uint8_t Mask) { Objects.SetMask(Id, Mask); }
	void SetChannels(FRTObjectId Id, uint8_t Channels) { Objects.SetChannels(Id, Channels); }
	void SetToon(FRTObjectId Id, std::shared_ptr<const FToonStyle> Style) { Objects.SetToon(Id, std::move(Style)); }
	const FRTObjectInfo& GetObject(FRTObjectId Id) const { return Objects.Get(Id); }
	/// Returns the number of slots to visit in a walk over all objects. FindObject returns null for the free ones.
	uint32_t GetObjectSlotCount() const { return Objects.GetSlotCount(); }
	const FRTObjectInfo* FindObject(uint32_t Slot) const { return Objects.Find(Slot); }
	/// Returns the index of the object's first section in FSectionData[]. The object's own data is at Id.Index in FObjectData[].
	uint32_t GetFirstSection(FRTObjectId Id) const { return Objects.GetFirstSection(Id); }

	/// Returns an invalid id, and logs that once, if the scene has FLightStore::MaxLights already. O(1), as SetLight and RemoveLight.
	FLightId AddLight(const FSceneLight& Light);
	void SetLight(FLightId Id, const FSceneLight& Light);
	void RemoveLight(FLightId Id);
	const FLightStore& GetLights() const { return Lights.GetStore(); }
	/// Adds what FSceneLight::Profile names. Returns 0, and logs that once, if there is no room for more.
	uint32_t AddLightProfile(const FProfileGrid& Grid) { return Lights.GetProfiles().Add(Grid); }
	/// No light may have it.
	void RemoveLightProfile(uint32_t Profile) { Lights.GetProfiles().Remove(Profile); }
	void SetSun(const FSunLight& Sun);
	const FSunLight& GetSun() const { return Lights.GetSun(); }
	void SetSky(glm::vec3 Radiance);
	glm::vec3 GetSky() const { return Lights.GetSky(); }
	/// Makes a texture the sky in place of SetSky's radiance, or not any more. Whoever gives it keeps it while frames may read it.
	void SetSkyMap(const FSkyMap& Map);
	/// Makes a program the sky, or not any more: see FSceneLights. A change of what it gets compiles nothing.
	void SetSkyProgram(const std::optional<FSkyProgram>& Program);
	const std::optional<FSkyProgram>& GetSkyProgram() const { return Lights.GetSkyProgram(); }
	FSkyData MakeSkyData() const { return Lights.MakeSkyData(); }
	/// 0: the scene's materials; 1: each a Lambert of its base colour; 2: each a Lambert of 0.5, alpha tests off.
	void SetMaterialOverride(uint32_t Override);
	void SetAlphaTest(bool bEnabled);
	/// Off: no light shines through any material.
	void SetTransmission(bool bEnabled);
	/// See FLightStore::SetCastingKinds.
	void SetCastingLights(uint32_t Kinds);
	/// Hides objects with a section of one of these programs from rays: the program's shaders are missing, and no stand-in is
	/// wanted. Replaces the set before, and costs something only if the sets differ.
	void SetMissingPrograms(std::vector<FHitProgram> Programs);

	/// Brings the facts up to date with all changes so far. BeginUpdate does so too.
	const FSceneFacts& RefreshFacts();
	const FSceneFacts& GetFacts() const; ///< as of the last RefreshFacts
	/// Says whose frame the next one is: FObjectMotions::SetViewer.
	bool SetViewer(uint64_t Viewer) { return Objects.GetMotions().SetViewer(Viewer); }
	/// Tells, before BeginUpdate, whether BeginUpdate and RecordUpdate would do anything. False if neither scene nor view changed.
	bool NeedsUpdate(const FGatherView& View, const FSceneUse& Use) const;
	glm::dvec3 GetOrigin() const;
	/// Converts a world position to the coordinates of shaders.
	glm::vec3 ToRelative(glm::dvec3 World) const { return glm::vec3(World - GetOrigin()); }

	/// Starts a frame: takes over all changes so far and starts gathering instances. The view's position moves the origin,
	/// which is the frame's from now on. The scene must not change until RecordUpdate.
	FRTStatus BeginUpdate(const FGatherView& View, const FSceneUse& Use);
	/// Records uploads, builds and refits into List, after BeginUpdate. On error the list must not be submitted.
	FRTStatus RecordUpdate(IRTCommandList& List, FFrameUploads& Uploads);
	/// Records the first half of RecordUpdate: tables, which all passes read and which never wait for gathering.
	FRTStatus RecordTables(IRTCommandList& List, FFrameUploads& Uploads);
	/// Records the second half of RecordUpdate, after RecordTables: acceleration structures, which only rays need. With
	/// FSceneUse::bRays both halves must be recorded.
	FRTStatus RecordStructures(IRTCommandList& List, FFrameUploads& Uploads);
	/// Divides this frame's builds and refits, as FGeometryStore::Plan. After BeginUpdate, before RecordStructures.
	uint32_t PlanBuilds(uint32_t MostParts);
	/// Records a part of PlanBuilds, as FGeometryStore::RecordPart. From any thread.
	void RecordBuilds(IRTCommandList& List, uint32_t Part) const;
	/// Tells, after BeginUpdate, whether RecordTables would record anything.
	bool NeedsTables() const;
	/// Tells, after BeginUpdate, whether RecordStructures may find anything to record. Waits for nothing.
	bool NeedsStructures() const;
	/// Calls BeginUpdate, then RecordUpdate.
	FRTStatus Update(IRTCommandList& List, FFrameUploads& Uploads, const FGatherView& View, const FSceneUse& Use);
	/// Returns what the GPU has to find out of emissive triangles in this frame, after RecordTables. After BeginUpdate; the list of
	/// EndFrame says whether it was done.
	FEmissiveWork GetEmissiveWork() const { return Emissive.GetWork(); }
	/// FEmissiveTriangles::GetChangeCount.
	uint64_t GetEmissiveChangeCount() const { return Emissive.GetChangeCount(); }
	/// Returns, after RecordUpdate, the block of constants that passes read.
	FSceneConstants GetConstants() const;
	/// Returns the acceleration structure over the instances (TLAS); null before the first frame with rays.
	IRTScene* GetStructure() const;
	const FObjectMotions& GetMotions() const { return Objects.GetMotions(); }
	/// Returns where shadows may have changed, as of the last BeginUpdate and MarkDeformed.
	const FCasterChanges& GetCasterChanges() const { return Objects.GetCasterChanges(); }
	/// Returns which objects look otherwise, as of the last change.
	const FAppearanceChanges& GetAppearanceChanges() const { return Objects.GetAppearanceChanges(); }
	FSectionTable& GetSections() { return Materials.GetSections(); }
	const FInstanceStore& GetInstances() const { return Objects.GetInstances(); }
	/// Returns the number of instances in the acceleration structure as it is.
	uint32_t GetInstanceCount() const;
	const FSceneUpdateStats& GetStats() const;
	/// Ends the frame, after RecordUpdate. If bSubmitted, what was removed before the frame can go. Otherwise what the frame
	/// recorded never runs, even if it failed half-way, and the next update records all of it again. Fence is that of the
	/// submission, so that memory is used again when it is done; 0: unknown.
	void EndFrame(bool bSubmitted = true, FRTFence Fence = 0);
	/// Sets how many hit records each section has: one for each ray type in use. The owner of the RTPSO calls this.
	void SetRayTypes(uint32_t Count);

private:
	FGeometryStore Geometries;
	FEmissiveTriangles Emissive;
	FSceneMaterials Materials{Emissive};
	FSceneObjects Objects{Materials.GetSections(), Emissive};
	FSceneLights Lights;
	std::unique_ptr<FSceneUpdate> Frame; // last: its tasks read the others
};

} // namespace Lantern
