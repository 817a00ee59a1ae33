// A loaded scene handed to the plugin: buffers and textures on the GPU, an rtObject per mesh node.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "LanternHost/SceneDescription.h"
#include "LanternRenderer/Frame.h"

namespace Lantern
{

class FHostScene
{
public:
	/// Takes the description, drops its texels once they are on the GPU, keeps its meshes for light sampling.
	/// Progress may be empty; 0 … 1.
	static FRTStatus Create(FRenderer& Renderer, FSceneDescription Description, const std::function<void(float)>& Progress,
	                        std::unique_ptr<FHostScene>& Out);

	FRTScene& GetScene() { return Scene; }
	const FSceneDescription& GetDescription() const { return Description; }
	/// Moves objects, lights and joints to Time (seconds); returns what must be skinned in the next frame.
	std::vector<FSkinningInputs> SetTime(double Time);
	bool IsAnimated() const { return !Description.Animations.empty(); }
	const FScenePose& GetPose() const { return Pose; }
	/// Off: only what the command line gives lights the scene. On by default.
	void SetSceneLights(bool bEnabled);
	/// The scene's first directional light, if there is one: it shines as the sun, with shadows, or not at all.
	std::optional<FSunLight> GetOwnSun() const;
	void SetSun(const FSunLight& Sun) { Scene.SetSun(Sun); }
	/// Metres; fits the scene's size, at most 5 cm.
	float NearPlane() const;
	/// The file's first camera, else one that sees all of the scene.
	FView MakeDefaultView(uint32_t Width, uint32_t Height) const;

	struct FDraw
	{
		FRTObjectId Object;
		uint32_t Section = 0; ///< of the object
		IRTBuffer* Indices = nullptr;
		uint32_t FirstIndex = 0, IndexCount = 0;
		bool bMasked = false, bDoubleSided = false;
		glm::vec3 Center{0}; ///< of the mesh's bounding sphere, object space
		float Radius = 0.0f; ///< infinite where it deforms
	};
	const std::vector<FDraw>& GetDraws() const { return Draws; }
	/// Of FSceneDescription::Images, on the GPU in ShaderRead.
	IRTTexture* GetImage(int32_t Image) const { return Images[static_cast<size_t>(Image)].Get(); }

private:
	struct FMeshBuffers
	{
		TRTRef<IRTBuffer> Positions, Attributes, Indices, Weights;
		FRTGeometryRef Geometry; // null for skinned meshes: each of their objects has its own
	};
	struct FInstance
	{
		int32_t Node = -1;
		FRTObjectId Object;
		FRTGeometryRef Skinned; // null unless skinned
	};
	explicit FHostScene(IRTDevice& InDevice) : Device(InDevice), Scene(InDevice) {}
	FRTStatus UploadTextures(FUploader& Uploader, const std::function<void(float)>& Progress);
	FRTStatus UploadMeshes(FUploader& Uploader);
	FRTStatus UploadMesh(FUploader& Uploader, uint32_t Mesh);
	FRTStatus CreateObjects();
	FRTStatus CreateSkinnedGeometry(uint32_t Mesh, FRTGeometryRef& Out);
	FRTGeometryInfo MakeGeometryInfo(uint32_t Mesh) const;
	FRTStatus GetSampler(const FHostTexture& Texture, uint32_t& OutIndex);
	FRTStatus AddMaterials();
	void AddDraws(FRTObjectId Object, const FRTGeometry& Geometry, const FHostMesh& Mesh);
	void UpdateLights();
	int32_t FindOwnSun() const; // node, or -1

	IRTDevice& Device;
	FRTScene Scene;
	FSceneDescription Description;
	FScenePose Pose;
	std::vector<TRTRef<IRTTexture>> Images;
	std::vector<glm::vec3> ImageMeans; // linear
	std::vector<std::pair<uint32_t, TRTRef<IRTSampler>>> Samplers;
	std::vector<FMeshBuffers> Meshes;
	std::vector<FInstance> Instances;
	std::vector<FDraw> Draws;
	bool bSceneLights = true;
};

/// Raster of the scene into the G-buffer that Frame.h describes.
class FGBufferPass
{
public:
	explicit FGBufferPass(FRenderer& InRenderer) : Renderer(InRenderer) {}
	FGBuffer Add(FFrameContext& Context, const FHostScene& Scene);

private:
	IRTPipeline* GetPipeline(const FFrameContext& Context, bool bMasked, ERTCull Cull);
	FRenderer& Renderer;
	TRTRef<IRTPipeline> Pipelines[2][3];
};

} // namespace Lantern
