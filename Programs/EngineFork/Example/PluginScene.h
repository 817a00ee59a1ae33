// The plugin at work in the engine: its renderer, the engine's boxes in it, one frame after another.
#pragma once

#include <memory>
#include <vector>

#include "Example/PluginDevice.h"
#include "Example/PluginMeshes.h"

namespace Fork
{

class FPluginScene
{
public:
	/// Creates the renderer on a device and adds all of Scene.
	FError Create(Lantern::IRTModule& Module, const FPluginDevice& InOn, const FForkScene& Scene);
	/// Goes on with all of the scene on another device. Between frames.
	FError Recreate(const FPluginDevice& InOn);
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
	/// Takes Lamp and all of FForkScene that begins with Lamp or bLamp over.
	FError SetLamp(const FForkScene& Scene);
	/// Adds FForkScene::Pane, or takes it away.
	FError SetPane(const FForkScene& Scene);
	/// By which the light mask names the lamp.
	uint32_t GetLampNumber() const { return Lantern::GetLightNumber(Lamp); }
	/// Where the engine's GPU writes the reed's positions for the plugin; 0 while the reed is on its way there.
	FError FindReedPositions(VkDeviceAddress& Out);
	/// The frame's commands have written them.
	FError MarkReedSkinned();
	/// Records the plugin's work. Commands must be recording and must have drawn the G-buffer. bCut: this frame has nothing in common
	/// with the frame before. A texture of Out is null while the plugin has nothing to show in it.
	FError Render(VkCommandBuffer Commands, const FForkFrame& Frame, bool bCut, Lantern::FRTModuleOutputs& Out);
	/// Must be called after Commands were submitted.
	FError FinishFrame();
	/// True if the last frame had all its shaders and acceleration structures.
	bool IsComplete() const { return bComplete; }

	Lantern::FSignalSet Wanted{Lantern::ESignal::SunShadow, Lantern::ESignal::AmbientOcclusion}; ///< of the next frames
	bool bLightMask = false; ///< of the next frames: the engine shades the lamp and asks the plugin what sees it

private:
	struct FPlacedBox
	{
		Lantern::ERTObjectHandle Object{};
		Lantern::ERTMeshHandle OwnMesh{}; ///< None: it has one of the shared meshes
	};
	FError AddBoxMesh(bool bDeformable, Lantern::ERTMeshHandle& Out);
	FError AddMaterials();
	Lantern::FRTModuleMaterial MakeCutOut() const;
	FError AddBox(const FBox& Box, Lantern::ERTMeshHandle OwnMesh = Lantern::ERTMeshHandle::None);
	FError AddReed(const FReed& Reed);
	FError AddProfile();
	bool GiveMesh(Lantern::ERTMeshHandle Mesh, Lantern::FRTModuleMesh* Out);

	const FPluginDevice* On = nullptr;
	Lantern::TRTRef<Lantern::IRTModuleRenderer> Renderer;
	Lantern::ERTMeshHandle RigidMesh{}, DeformableMesh{}, ReedMesh{}, PaneMesh{};
	Lantern::ERTObjectHandle Reed{}, Pane{};
	Lantern::ERTMaterialHandle Solid{}, CutOut{}, Glass{};
	Lantern::ERTLightHandle Lamp{};
	Lantern::ERTIesHandle Profile{};
	std::vector<FPlacedBox> Boxes;
	Lantern::TRTRef<Lantern::IRTCommandList> List;
	float VertexScale = 1.0f;              ///< of the deformable boxes
	std::unique_ptr<FMeshArrays> Deformed; ///< given to Recreate
	bool bComplete = false;
};

} // namespace Fork
