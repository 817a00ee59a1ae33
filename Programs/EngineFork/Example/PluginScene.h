// The plugin at work in the engine: its device, its renderer, the engine's boxes in it, one frame after another.
#pragma once

#include <chrono>
#include <vector>

#include "Example/ForkRaster.h"
#include "Example/ForkScene.h"
#include "Example/ForkVulkan.h"
#include "LanternModule/ModuleVulkan.h"

namespace Fork
{

class FPluginScene
{
public:
	/// Owner must have been created with Requirements, which come from IRTModuleVulkan::GetRequirements.
	FError Create(Lantern::IRTModule& Module, const FForkInstance& Instance, const FForkDevice& Owner,
	    const Lantern::IRTVulkanRequirements& Requirements);
	FError AddScene(const FForkScene& Scene);
	/// Box is an index into FForkScene::Boxes.
	FError MoveBox(size_t Box, const FBox& To);
	/// Adds a box with a mesh of its own, behind the others, while frames go on.
	FError StreamIn(const FBox& Box);
	/// Removes a box, and its mesh if that is its own. The indices of later boxes become smaller by one.
	FError RemoveBox(size_t Box);
	/// Scales the vertices of the deformable boxes; their transforms stay.
	FError ScaleVertices(float Scale);
	/// Takes bCastsShadow and bCutOut over from To.
	FError SetBox(size_t Box, const FBox& To);
	/// Where the engine's GPU writes the reed's positions for the plugin; 0 while the reed is on its way there.
	FError FindReedPositions(VkDeviceAddress& Out);
	/// The frame's commands have written them.
	FError MarkReedSkinned();
	/// For the next view.
	FError ImportGBuffer(const FForkRaster& Raster, VkExtent2D Size);
	void ReleaseGBuffer(); ///< must be called before the images of the raster are destroyed
	/// Records the plugin's work. Commands must be recording and must have drawn the G-buffer. bCut: this frame has nothing in common
	/// with the frame before. A texture of Out is null while the plugin has nothing to show in it.
	FError Render(VkCommandBuffer Commands, const FCamera& Camera, uint32_t View, bool bCut, Lantern::FRTModuleOutputs& Out);
	/// Must be called after Commands were submitted.
	FError FinishFrame();
	/// True if the last frame had all its shaders and acceleration structures.
	bool IsComplete() const { return bComplete; }

private:
	struct FPlacedBox
	{
		Lantern::ERTObjectHandle Object{};
		Lantern::ERTMeshHandle OwnMesh{}; ///< None: it has one of the shared meshes
	};
	FError AddBoxMesh(bool bDeformable, Lantern::ERTMeshHandle& Out);
	FError AddMaterials();
	FError AddBox(const FBox& Box, Lantern::ERTMeshHandle OwnMesh = Lantern::ERTMeshHandle::None);
	FError AddReed(const FReed& Reed);

	Lantern::TRTRef<Lantern::IRTDevice> Device; // declared first, so that it is released last
	Lantern::TRTRef<Lantern::IRTModuleRenderer> Renderer;
	Lantern::ERTMeshHandle RigidMesh{}, DeformableMesh{}, ReedMesh{};
	Lantern::ERTObjectHandle Reed{};
	Lantern::ERTMaterialHandle Solid{}, CutOut{};
	std::vector<FPlacedBox> Boxes;
	struct FGBuffer
	{
		Lantern::TRTRef<Lantern::IRTTexture> Depth, Normals;
	};
	std::vector<FGBuffer> GBuffers; ///< by view
	Lantern::TRTRef<Lantern::IRTCommandList> List;
	std::chrono::steady_clock::time_point LastFrame{};
	float DeltaSeconds = 0.0f; ///< of the frame, for all its views
	bool bComplete = false;
};

} // namespace Fork
