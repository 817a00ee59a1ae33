// IRTModuleRenderer over FRTScene and FRenderer.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "DeformableMesh.h"
#include "LanternModule/Module.h"
#include "LanternRHICommon/RefCounted.h"
#include "LanternRenderer/Frame.h"
#include "LanternRenderer/HostProjection.h"
#include "LanternScene/Memory/Upload.h"
#include "LanternScene/Scene/Scene.h"
#include "ModuleWorld.h"
#include "SlotTable.h"

namespace Lantern
{

class FModuleRenderer final : public TRefCounted<IRTModuleRenderer>
{
public:
	/// Owner outlives the renderer: the library must not go while it is in use.
	FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, const FModuleWorld& InWorld, FRendererDesc Desc);
	~FModuleRenderer() override;

	FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out) override;
	FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material) override;
	FRTStatus RemoveMaterial(ERTMaterialHandle Handle) override;
	FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out) override;
	FRTStatus UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals) override;
	FRTStatus RemoveMesh(ERTMeshHandle Handle) override;
	FRTStatus AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out) override;
	FRTStatus SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]) override;
	FRTStatus SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Handles, uint32_t MaterialCount) override;
	FRTStatus SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow) override;
	FRTStatus RemoveObject(ERTObjectHandle Handle) override;
	FRTStatus SetSun(const FRTModuleSun& Sun) override;
	FRTStatus SetSky(const float Radiance[3]) override;
	FRTStatus RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out) override;
	FRTStatus EndFrame(FRTFence* OutFence) override;

private:
	/// What a material refers to, kept while it does.
	struct FMaterialTextures
	{
		TRTRef<IRTTexture> Texture;
		TRTRef<IRTSampler> Sampler;
	};
	struct FMaterial
	{
		uint32_t Index = 0; ///< in the scene
		FMaterialTextures Textures;
	};
	struct FMesh
	{
		FRTGeometryRef Geometry;
		std::unique_ptr<FDeformableMesh> Deformable; ///< null: the mesh is rigid
		uint32_t Users = 0;                          ///< objects
	};
	struct FObject
	{
		FRTObjectId Id;
		ERTMeshHandle Mesh = ERTMeshHandle::None;
	};
	/// The last mesh that was removed from a slot: who still has its handle is told the name.
	struct FRemovedMesh
	{
		ERTMeshHandle Handle = ERTMeshHandle::None;
		std::string Name;
	};

	/// What a frame's views are to the renderer.
	struct FFrameViews
	{
		FView View;
		std::optional<FView> Previous;
		FHostDepth Depth;
	};

	static uint32_t MakeTag();
	FRTStatus UploadMesh(const FRTModuleMesh& Mesh, const std::vector<FVertexAttributes>& Attributes, FRTGeometryInfo& Out);
	/// For a geometry's sections: Ok and their indices, or InvalidArgument.
	FRTStatus ResolveMaterials(
	    const FRTGeometryInfo& Geometry, const ERTMaterialHandle* Handles, uint32_t Count, std::vector<uint32_t>& Out);
	void AddUsers(const std::vector<uint32_t>& Used);
	void RemoveUsers(const std::vector<uint32_t>& Used);
	FRTStatus CheckUsers(uint32_t Material);
	/// Why Meshes does not find Handle.
	FRTStatus RefuseMesh(const char* Function, ERTMeshHandle Handle) const;
	void StoreMaterial(FMaterial& Material, const FRTModuleMaterial& From);
	FRTStatus RecordVertices(IRTCommandList& List);
	FRTStatus ReadViews(const FRTModuleFrame& Frame, FFrameViews& Out) const;
	FRTStatus RecordFrame(const FRTModuleFrame& Frame, const FFrameViews& Views);
	/// Fence: 0 when the list will never run.
	void FinishVertices(FRTFence Fence);
	void AddPasses(const FRTModuleFrame& Frame, const FFrameViews& Views);
	void HandToEngine(const FFrameOutputs& Made);
	void ReleaseOutputs();

	TRTRef<IRTModule> Owner;
	TRTRef<IRTDevice> Device;
	FModuleWorld World;
	FRTScene Scene;
	FRenderer Renderer;
	FUploader Uploader;
	FFrameUploads VertexUploads;
	const uint32_t Tag = MakeTag(); ///< in all handles, by which those of another renderer are known
	TSlotTable<FMaterial, ERTMaterialHandle> Materials{Tag};
	std::vector<uint32_t> MaterialUsers; ///< sections of objects, by the material's index in the scene
	/// Replaced since the last EndFrame: the list in the making may sample them, and a device that lets go of a bindless
	/// index counts from the last submission.
	std::vector<FMaterialTextures> ReplacedTextures;
	TSlotTable<FMesh, ERTMeshHandle> Meshes{Tag};
	std::vector<FRemovedMesh> RemovedMeshes; ///< by slot
	TSlotTable<FObject, ERTObjectHandle> Objects{Tag};
	TRTRef<IRTCommandList> Recorded;                     ///< between RenderFrame and EndFrame
	std::array<TRTRef<IRTTexture>, SignalCount> Outputs; ///< of the last frame
	uint32_t FrameIndex = 0;
};

} // namespace Lantern
