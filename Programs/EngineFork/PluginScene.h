// The plugin at work in the engine: its device, its renderer, the engine's boxes in it, one frame after another.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "ForkRaster.h"
#include "ForkScene.h"
#include "ForkVulkan.h"
#include "LanternModule/ModuleVulkan.h"

namespace Fork
{

/// Empty if Status is fine, else its message after What.
FError ToError(const Lantern::FRTStatus& Status, const char* What);

class FPluginScene
{
public:
	/// Device must have been created with what IRTModuleVulkan::GetRequirements asked for.
	FError Create(Lantern::IRTModule& Module, const FForkInstance& Instance, const FForkDevice& Owner,
	    const Lantern::IRTVulkanRequirements& Requirements);
	FError AddScene(const FForkScene& Scene);
	/// Box: as AddScene counted them.
	FError MoveBox(size_t Box, const FBox& To);
	FError RemoveBox(size_t Box);
	/// Of the deformable boxes; their transforms stay.
	FError ScaleVertices(float Scale);
	/// What of it is asked for by bCastsShadow and bCutOut.
	FError SetBox(size_t Box, const FBox& To);
	FError ImportGBuffer(const FForkRaster& Raster, VkExtent2D Size);
	void ReleaseGBuffer(); ///< before the raster's images go
	/// Records the plugin's work; Commands is recording and the G-buffer is in it. bCut: nothing is as it was in the frame
	/// before. Out: null textures where the plugin has nothing to show yet.
	FError Render(VkCommandBuffer Commands, const FCamera& Camera, bool bCut, Lantern::FRTModuleOutputs& Out);
	/// After the commands were submitted.
	FError FinishFrame();
	/// The last frame had all its shaders and acceleration structures.
	bool IsComplete() const { return bComplete; }
	Lantern::IRTDevice& GetDevice() { return *Device; }

private:
	FError AddBoxMesh(bool bDeformable, Lantern::ERTMeshHandle& Out);
	FError AddMaterials();
	FError AddBox(const FBox& Box);

	Lantern::TRTRef<Lantern::IRTDevice> Device; // declared first: goes last
	Lantern::TRTRef<Lantern::IRTModuleRenderer> Renderer;
	Lantern::ERTMeshHandle RigidMesh{}, DeformableMesh{};
	Lantern::ERTMaterialHandle Solid{}, CutOut{};
	std::vector<Lantern::ERTObjectHandle> Boxes;
	Lantern::TRTRef<Lantern::IRTTexture> Depth, Normals;
	Lantern::TRTRef<Lantern::IRTCommandList> List;
	std::chrono::steady_clock::time_point LastFrame{};
	bool bComplete = false;
};

} // namespace Fork
