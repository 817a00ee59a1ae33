// The calls of IRTModuleRenderer that change the scene, from any thread. Arguments are checked and handles given at once. What
// follows for the scene is a command, which a frame takes over.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "LanternModule/Module.h"
#include "ModuleWorld.h"
#include "SceneCommands.h"
#include "SceneValues.h"
#include "SlotTable.h"

namespace Lantern
{

class FLandscapePatch;

/// Threads: any.
class FSceneCalls
{
public:
	/// Uploads takes the meshes. It outlives this.
	FSceneCalls(IRTDevice& InDevice, const FModuleWorld& InWorld, FBufferUploads& InUploads);
	FSceneCalls(const FSceneCalls&) = delete;
	FSceneCalls& operator=(const FSceneCalls&) = delete;

	// As in IRTModuleRenderer.
	FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out);
	FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material);
	FRTStatus RemoveMaterial(ERTMaterialHandle Handle);
	FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out);
	FRTStatus AddLandscape(const FRTModuleLandscape& Patch, ERTMeshHandle* Out);
	FRTStatus SetLandscapeHeights(ERTMeshHandle Handle, const FRTModuleHeights& Heights);
	FRTStatus UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals);
	FRTStatus GetMeshBuffer(ERTMeshHandle Handle, FRTModuleMeshBuffer* Out);
	FRTStatus MarkMeshDeformed(ERTMeshHandle Handle);
	FRTStatus RemoveMesh(ERTMeshHandle Handle);
	FRTStatus AddObjects(const FRTModuleObject* Added, uint32_t Count, ERTObjectHandle* Out);
	FRTStatus SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]);
	FRTStatus SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Handles, uint32_t Count);
	FRTStatus SetObjectMesh(ERTObjectHandle Handle, ERTMeshHandle Mesh, const ERTMaterialHandle* Handles, uint32_t Count);
	FRTStatus SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow);
	FRTStatus SetObjectVisible(ERTObjectHandle Handle, bool bVisible);
	FRTStatus SetObjectChannels(ERTObjectHandle Handle, uint8_t Channels);
	FRTStatus SetObjectToon(ERTObjectHandle Handle, const FRTModuleToon* Toon);
	FRTStatus RemoveObject(ERTObjectHandle Handle);
	FRTStatus AddLight(const FRTModuleLight& Light, ERTLightHandle* Out);
	FRTStatus SetLight(ERTLightHandle Handle, const FRTModuleLight& Light);
	FRTStatus RemoveLight(ERTLightHandle Handle);
	FRTStatus AddIesProfile(const FRTModuleIesProfile& Profile, ERTIesHandle* Out, FRTModuleIesInfo* Info);
	FRTStatus RemoveIesProfile(ERTIesHandle Handle);
	FRTStatus SetSun(const FRTModuleSun& Sun);
	FRTStatus SetSky(const float Radiance[3]);
	FRTStatus SetSkyMap(const FRTModuleSkyMap* Map);
	FRTStatus SetSkyProgram(const FRTModuleSkyProgram* Program);

	/// Moves the commands that a frame takes over to the end of Out, in order. Updates of what the scene has come all, arrivals
	/// and departures as many as MostArrivals says; 0: all of them. A new mesh counts as several. Returns whether some are left.
	bool Take(uint32_t MostArrivals, std::vector<FSceneCommand>& Out);
	/// Leaves the old device. All that lives arrives anew: meshes as Source gives them, the rest as the handles, Values and the
	/// commands that no frame has taken say. On an error nothing has changed.
	FRTStatus TakeOver(IRTDevice& NewDevice, FBufferUploads& NewUploads, const FRTModuleMeshSource& Source, FSceneValues Values);

private:
	/// Number of the last arrival or departure that concerns a thing. Before the scene has it, updates of the thing wait, too.
	using FTicket = uint64_t;
	struct FMaterial
	{
		FMaterialTextures Textures;
		bool bMasked = false;
		uint32_t Users = 0; ///< sections of objects
		/// Users among these whose section cannot be alpha-tested, by mesh and section.
		std::map<std::pair<ERTMeshHandle, uint32_t>, uint32_t> OpaqueUsers;
		FTicket Ticket = 0;
	};
	struct FMesh
	{
		std::string Name;
		std::vector<bool> IsOpaque;                 ///< by section: cannot be alpha-tested
		FDeformableMeshRef Deformable;              ///< null: the mesh is rigid, or its vertices are the engine's own
		std::shared_ptr<FLandscapePatch> Landscape; ///< null: the mesh is not made of heights
		bool bDeformable = false;
		bool bStreamed = false; ///< the vertices are the engine's own
		FBufferUploadRef Upload;
		bool bHasBounds = false; ///< the engine gave some
		uint32_t Users = 0;      ///< objects
		FTicket Ticket = 0;
	};
	struct FObject
	{
		ERTMeshHandle Mesh = ERTMeshHandle::None;
		std::vector<ERTMaterialHandle> Materials;
		FRTObjectTraits Traits;
		std::shared_ptr<const FToonStyle> Toon;
		ERTModuleMobility Mobility = ERTModuleMobility::Movable;
		FTicket Ticket = 0;
	};
	struct FLight
	{
		ERTIesHandle Profile = ERTIesHandle::None;
		FTicket Ticket = 0;
	};
	struct FProfile
	{
		std::shared_ptr<const FProfileGrid> Grid;
		uint32_t Users = 0; ///< lights
		FTicket Ticket = 0;
	};
	/// The last mesh that was removed from a slot: who still has its handle is told the name.
	struct FRemovedMesh
	{
		ERTMeshHandle Handle = ERTMeshHandle::None;
		std::string Name;
	};

	// All of these need Mutex.
	FRTStatus CheckObject(const FRTModuleObject& Object);
	ERTObjectHandle AddOne(const FRTModuleObject& Object);
	FRTStatus SetMask(const char* Function, ERTObjectHandle Handle, bool FRTObjectTraits::*Member, bool bValue);
	FRTStatus CheckDeformable(const char* Function, ERTMeshHandle Handle);
	FRTStatus CheckOwnVertices(const char* Function, ERTMeshHandle Handle);
	FRTStatus CheckMaterials(const FMesh& Mesh, const ERTMaterialHandle* Handles, uint32_t Count);
	/// Lets the light have the profile, which is None or known, in place of what it has. Returns the profile's ticket.
	FTicket SetProfile(FLight& Light, ERTIesHandle Profile);
	void AddUsers(const FObject& Object);
	void RemoveUsers(const FObject& Object);
	FRTStatus CheckUsers(const FMaterial& Material);
	FRTStatus RefuseMesh(const char* Function, ERTMeshHandle Handle) const;
	std::vector<uint32_t> GetSlots(const std::vector<ERTMaterialHandle>& Handles) const;
	FTicket AddArrival(FSceneCommand Command);
	/// Returns how many arrivals fit into Most, and at least one.
	size_t CountArrivals(uint32_t Most) const;
	/// Needs: ticket of whatever the command names.
	void AddUpdate(FSceneCommand Command, FTicket Needs, FTicket& InOutTicket);

	/// Makes a mesh on the device. Needs DeviceMutex.
	FRTStatus MakeMesh(IRTDevice& On, FBufferUploads& By, const FRTModuleMesh& Mesh, FMesh& Out, FAddMeshCommand& OutCommand);
	FRTStatus MakeCopiedMesh(IRTDevice& On, const FRTModuleMesh& Mesh, FMesh& Out, FAddMeshCommand& OutCommand);
	static FRTStatus MakeStreamedMesh(IRTDevice& On, const FRTModuleMesh& Mesh, FAddMeshCommand& OutCommand);
	ERTMeshHandle AddOne(FMesh Added, FAddMeshCommand Command);
	FRTStatus SetVertices(ERTMeshHandle Handle, FDeformableMesh& Deformable, const float* Positions, const float* Normals);
	FRTStatus MakeAgain(
	    IRTDevice& On, FBufferUploads& By, const FRTModuleMesh& Given, const FMesh& Old, FMesh& Out, FAddMeshCommand& OutCommand);
	void AddAll(const FSceneValues& Values);

	const FModuleWorld World;
	std::shared_mutex DeviceMutex; ///< of the next two; shared while a mesh is made or gets vertices. Locked before Mutex
	IRTDevice* Device;
	FBufferUploads* Uploads;
	const uint32_t Tag; ///< in all handles, by which those of another renderer are known
	std::mutex Mutex;   ///< of everything below
	TSlotTable<FMaterial, ERTMaterialHandle> Materials{Tag};
	TSlotTable<FMesh, ERTMeshHandle> Meshes{Tag};
	std::vector<FRemovedMesh> RemovedMeshes; ///< by slot
	TSlotTable<FObject, ERTObjectHandle> Objects{Tag};
	TSlotTable<FLight, ERTLightHandle> Lights{Tag};
	TSlotTable<FProfile, ERTIesHandle> Profiles{Tag};
	FMaterialTextures SkyTextures; ///< of the map that was set last
	uint32_t ObjectCount = 0, LightCount = 0, ProfileCount = 0;
	std::deque<FSceneCommand> Arrivals; ///< and departures, and updates that wait for them
	std::vector<FSceneCommand> Updates;
	FTicket LastArrival = 0, LastTaken = 0; ///< counts Arrivals: added and taken so far
};

} // namespace Lantern
