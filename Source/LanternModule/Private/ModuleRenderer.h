// IRTModuleRenderer over FRTScene and FRenderer.
#pragma once

#include <memory>
#include <vector>

#include "LanternModule/Module.h"
#include "LanternRenderer/Frame.h"
#include "LanternScene/Scene.h"
#include "LanternScene/Upload.h"
#include "RefCounted.h"

namespace Lantern
{

class FModuleRenderer final : public TRefCounted<IRTModuleRenderer>
{
public:
	/// Owner outlives the renderer: the library must not go while it is in use.
	FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, FRendererDesc Desc);
	~FModuleRenderer() override;

	FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out) override;
	FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material) override;
	FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out) override;
	void RemoveMesh(ERTMeshHandle Handle) override;
	FRTStatus AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out) override;
	void SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]) override;
	void RemoveObject(ERTObjectHandle Handle) override;
	void SetSun(const FRTModuleSun& Sun) override;
	FRTStatus RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out) override;
	FRTStatus EndFrame(FRTFence* OutFence) override;

private:
	/// What a material refers to, kept while it does.
	struct FMaterialTextures
	{
		TRTRef<IRTTexture> Texture;
		TRTRef<IRTSampler> Sampler;
	};

	void AddPasses(const FRTModuleFrame& Frame);

	TRTRef<IRTModule> Owner;
	TRTRef<IRTDevice> Device;
	FRTScene Scene;
	FRenderer Renderer;
	FUploader Uploader;
	std::vector<FMaterialTextures> MaterialTextures;
	std::vector<FRTGeometryRef> Meshes;
	TRTRef<IRTCommandList> Recorded; ///< between RenderFrame and EndFrame
	TRTRef<IRTTexture> SunShadow;    ///< of the last frame
	uint32_t FrameIndex = 0;
};

} // namespace Lantern
