// A loaded scene on the GPU: buffers, textures, and one object of the plugin's scene for each node with a mesh.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "LanternHost/DrawBlocks.h"
#include "LanternHost/SceneDescription.h"
#include "LanternHost/SceneHash.h"
#include "LanternHost/SceneOpacity.h"
#include "LanternRenderer/Frame.h"

namespace Lantern
{

class FHostScene
{
public:
	/// Uploads a description. Drops its texels once they are on the GPU; keeps its meshes for light sampling. Progress gets 0 … 1
	/// and may be empty.
	static FRTStatus Create(
	    FRenderer& Renderer, FSceneDescription Description, const std::function<void(float)>& Progress, std::unique_ptr<FHostScene>& Out);

	FRTScene& GetScene() { return Scene; }
	const FSceneDescription& GetDescription() const { return Description; }
	/// Returns the hash of the description as Create received it, texels included.
	const FContentHash& GetContentHash() const { return ContentHash; }
	/// Moves objects, lights and joints to Time (seconds). Returns what the next frame must skin.
	std::vector<FSkinningInputs> SetTime(double Time);
	bool IsAnimated() const;
	const FScenePose& GetPose() const { return Pose; }
	/// Switches the scene's own lights; on by default. If they are off, only lights of the command line remain.
	void SetSceneLights(bool bEnabled);
	bool HasSceneLights() const { return bSceneLights; }
	/// Returns the scene's first directional light. It shines only as the sun, with shadows. Other ones are punctual lights.
	std::optional<FSunLight> GetOwnSun() const;
	void SetSun(const FSunLight& Sun) { Scene.SetSun(Sun); }
	/// Returns a near distance that fits the scene's size, metres, at most 0.05.
	float NearPlane() const;
	/// Returns the view of the file's first camera, else one that sees all of the scene.
	FView MakeDefaultView(uint32_t Width, uint32_t Height) const;

	/// One draw call of the raster: a section of a mesh, for all objects whose material has one kind of pipeline.
	struct FDrawBatch
	{
		IRTBuffer* Indices = nullptr;
		uint32_t FirstIndex = 0, IndexCount = 0;
		uint32_t Section = 0; ///< index within the object
		bool bMasked = false, bDoubleSided = false;
		bool bBlended = false;               ///< the raster shows what it covers wholly, and rays the rest
		bool bTransmissive = false;          ///< light shines through it
		uint32_t Program = StandardProgram;  ///< of the material when the scene was loaded
		uint32_t FirstPlace = 0, Places = 0; ///< range in a list of all objects by batch
		friend bool operator==(const FDrawBatch&, const FDrawBatch&) = default;
	};
	/// What the pipelines of batches differ in, beside what a frame decides.
	struct FDrawKind
	{
		uint32_t Program = StandardProgram;
		bool bMasked = false, bDoubleSided = false, bBlended = false;
		friend auto operator<=>(const FDrawKind&, const FDrawKind&) = default;
	};
	/// An object as the raster sees it. Its index is that of the instance.
	struct FDraw
	{
		FRTObjectId Object;
		uint32_t FirstBatch = 0, BatchCount = 0; ///< into GetBatchIndices()
	};
	const std::vector<FDraw>& GetDraws() const { return Draws; }
	FDrawBlocks& GetDrawBlocks() { return DrawBlocks; }
	const FDrawBlocks& GetDrawBlocks() const { return DrawBlocks; }
	const std::vector<FDrawBatch>& GetBatches() const { return Batches; }
	const std::set<FDrawKind>& GetDrawKinds() const { return DrawKinds; } ///< those of all batches
	const std::vector<uint32_t>& GetBatchIndices() const { return BatchIndices; }
	uint32_t GetPlaceCount() const { return PlaceCount; } ///< over all batches

	/// Returns the number of instances: nodes with meshes, in order.
	size_t GetInstanceCount() const { return Instances.size(); }
	int32_t GetNode(size_t Instance) const { return Instances[Instance].Node; }
	FRTObjectId GetObject(size_t Instance) const { return Instances[Instance].Object; } ///< of GetScene()
	bool IsSkinned(size_t Instance) const { return Instances[Instance].Skinned != nullptr; }
	/// Moves one object independently of animations. Moving it in GetScene() directly would not move it in the raster.
	void SetTransform(size_t Instance, const glm::dmat4& Transform);
	/// Deforms a skinned instance in the next frame. Joints: as EvaluateJoints returns them.
	FSkinningInputs MakeSkinning(size_t Instance, std::vector<glm::mat4> Joints) const;
	/// Returns the classification of alpha-tested triangles, without the pieces themselves, which are on the GPU.
	const FSceneOpacity& GetOpacity() const { return Opacity; }
	/// Returns the texture of an image of FSceneDescription::Images, in ShaderRead.
	IRTTexture* GetImage(int32_t Image) const { return Images[static_cast<size_t>(Image)].Get(); }

private:
	struct FMeshBuffers
	{
		TRTRef<IRTBuffer> Positions, Attributes, Indices, Weights, PiecePositions, PieceIndices;
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
	FRTStatus CreateObjects(FUploader& Uploader);
	FRTStatus CreateSkinnedGeometry(FUploader& Uploader, uint32_t Mesh, FRTGeometryRef& Out);
	FRTGeometryInfo MakeGeometryInfo(uint32_t Mesh) const;
	FRTStatus GetSampler(const FHostTexture& Texture, uint32_t& OutIndex);
	FRTStatus AddMaterials(FMaterialPrograms& Programs);
	void AddDraw(const FInstance& Instance, const FRTObjectInfo& Info);
	uint32_t FindBatches(uint32_t Mesh, const std::vector<uint32_t>& Materials, const FRTGeometry& Geometry);
	FDrawSphere MakeDrawSphere(size_t Instance) const;
	void BuildDrawBlocks();
	void UpdateLights();
	FSceneLight MakeLight(uint32_t Node) const;
	int32_t FindOwnSun() const; // node, or -1

	IRTDevice& Device;
	FRTScene Scene;
	FSceneDescription Description;
	FContentHash ContentHash;
	FScenePose Pose;
	double LightTime = 0.0; ///< seconds
	std::vector<TRTRef<IRTTexture>> Images;
	std::vector<glm::vec3> ImageMeans; // linear
	std::vector<std::pair<uint32_t, TRTRef<IRTSampler>>> Samplers;
	std::vector<FMeshBuffers> Meshes;
	FSceneOpacity Opacity;
	std::vector<FInstance> Instances;
	std::vector<FDraw> Draws;
	FDrawBlocks DrawBlocks;
	std::vector<FDrawBatch> Batches;
	std::set<FDrawKind> DrawKinds;
	std::vector<uint32_t> BatchIndices;
	uint32_t PlaceCount = 0;
	std::map<std::pair<uint32_t, std::vector<uint32_t>>, uint32_t> BatchesOf; // mesh and materials to first index
	std::map<uint32_t, std::vector<uint32_t>> BatchesOfMesh;
	std::map<std::vector<uint32_t>, uint32_t> BatchLists; // to first index
	bool bSceneLights = true;
	std::vector<FLightId> LightIds; // by node; none while they are off
	std::vector<uint32_t> Profiles; // numbers in the scene, by index in the description
};

} // namespace Lantern
