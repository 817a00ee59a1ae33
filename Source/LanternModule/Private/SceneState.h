// The module's scene as the render thread has it: commands change FRTScene, uploads fill its meshes, and new vertices go to the GPU.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "LanternScene/Memory/BufferUploads.h"
#include "LanternScene/Memory/Upload.h"
#include "LanternScene/Scene/Scene.h"
#include "SceneCommands.h"
#include "SceneValues.h"

namespace Lantern
{

/// Threads: render thread.
class FSceneState
{
public:
	/// The arguments outlive this.
	FSceneState(IRTDevice& Device, FRTScene& InScene, FBufferUploads& InUploads) : Scene(InScene), Uploads(InUploads), VertexUploads(Device)
	{}
	FSceneState(const FSceneState&) = delete;
	FSceneState& operator=(const FSceneState&) = delete;

	/// Changes the scene as the commands say, and empties them. Costs follow the commands, not the scene.
	void Apply(std::vector<FSceneCommand>& Commands);
	/// Records copies of new meshes and vertices. On an error List must not be submitted.
	FRTStatus Record(IRTCommandList& List);
	/// Returns whether the engine's GPU has written vertices for this frame.
	bool HasEngineVertices() const { return bEngineVertices; }
	/// Fence: that of the list; 0: it never runs, and all of it is recorded again.
	void EndFrame(FRTFence Fence);
	/// Describes what commands have made so far.
	FSceneValues Describe() const;
	/// Meshes that the last Record looked at for new vertices.
	uint32_t GetVisitedMeshes() const { return VisitedMeshes; }

private:
	struct FMesh
	{
		FRTGeometryRef Geometry; ///< null: the geometry could not be made; the log has said so
		FBufferUploadRef Upload;
		FDeformableMeshRef Deformable; ///< null: the mesh is rigid
		bool bDeformed = false;        ///< is in Deformed
	};
	void Do(FMaterialCommand& Command);
	void Do(FAddMeshCommand& Command);
	void Do(FRemoveMeshCommand& Command);
	void Do(FAddObjectCommand& Command);
	void Do(FRemoveObjectCommand& Command);
	void Do(FTransformCommand& Command);
	void Do(FMaskCommand& Command);
	void Do(FChannelsCommand& Command);
	void Do(FToonCommand& Command);
	void Do(FObjectMaterialsCommand& Command);
	void Do(FObjectMeshCommand& Command);
	void Do(FVerticesCommand& Command);
	void Do(FDeformedCommand& Command);
	void Do(FProfileCommand& Command);
	void Do(FLightCommand& Command);
	void Do(FSunLight& Command) { Scene.SetSun(Command); }
	void Do(FSkyCommand& Command) { Scene.SetSky(Command.Radiance); }
	void Do(FSkyMapCommand& Command);
	void Do(FSkyProgramCommand& Command) { Scene.SetSkyProgram(Command.Program); }
	/// A change of mesh that waits until rays can see the new one.
	struct FMeshChange
	{
		FRTGeometryRef Geometry;
		std::vector<uint32_t> Materials; ///< indices in the scene
	};
	/// Makes the changes that can be seen now, and those of objects that show Material, which goes. ~0: none does.
	void ChangeMeshes(uint32_t Material);
	std::vector<uint32_t> GetMaterials(const std::vector<uint32_t>& Slots) const;
	void MarkDeformed(uint32_t Slot);
	FRTStatus RecordVertices(IRTCommandList& List);

	FRTScene& Scene;
	FBufferUploads& Uploads;
	FFrameUploads VertexUploads;
	// By slot.
	std::vector<uint32_t> Materials;             ///< index in the scene
	std::deque<FMesh> Meshes;                    ///< which grows without moving what is there
	std::vector<FRTObjectId> Objects;            ///< invalid: its mesh has no geometry
	std::map<uint32_t, FMeshChange> MeshChanges; ///< by slot of the object
	std::vector<FLightId> Lights;
	std::vector<uint32_t> Profiles; ///< number in the scene; 0: the scene has no room for it
	bool bEngineVertices = false;
	std::vector<uint32_t> Deformed, RecordedVertices; ///< slots of meshes with new vertices; of those in this frame
	std::vector<FBufferUploadRef> Filled;
	/// Replaced since the last EndFrame: the list in the making may sample them, and a device that lets go of a bindless
	/// index counts from the last submission.
	std::vector<FMaterialTextures> ReplacedTextures;
	uint32_t VisitedMeshes = 0;
};

} // namespace Lantern
