// A small engine that uses Lantern on a VkDevice of its own: an example to read.
//
// PluginLoader finds, loads and initializes the plugin. ForkEngine creates a VkDevice with what the plugin needs, and runs frames.
// PluginScene hands scene, G-buffer and command buffer to the plugin. The rest is the engine itself: ForkVulkan (device, images),
// ForkSkin (skinning), ForkRaster (G-buffer) and ForkScene (boxes, camera). The code in Judge/ checks the pictures and is no part of the example.
#pragma once

#include <array>
#include <tuple>

#include "Example/ForkThread.h"
#include "Example/PluginScene.h"

namespace Fork
{

inline constexpr VkExtent2D FrameSize{320, 180};
inline constexpr uint32_t PixelCount = FrameSize.width * FrameSize.height;

inline constexpr size_t ViewCount = std::tuple_size_v<decltype(FForkScene::Cameras)>;

/// Outputs of a view as the CPU reads them: PixelCount halves each, rows from the top. They are valid until the next frame.
struct FFrameMasks
{
	const uint16_t* SunShadow = nullptr;
	const uint16_t* AmbientOcclusion = nullptr;
};

/// Everything that lives on the device. The instance and the module must outlive it.
class FForkEngine
{
public:
	FForkEngine(Lantern::IRTModule& InModule, const FForkInstance& InInstance) : Module(InModule), Instance(InInstance) {}
	FForkEngine(const FForkEngine&) = delete;
	~FForkEngine();
	/// Takes the first device that the plugin can use, and creates it with what the plugin needs.
	FError CreateDevice();
	/// Creates the plugin's renderer, the G-buffer and the objects of Scene.
	FError LoadScene(const FForkScene& Scene);
	/// Draws each view's G-buffer and lets the plugin add its signals, on the calling thread: the render thread. The engine's thread
	/// for its RHI submits. Returns when the GPU is done. Masks of Out are null if the plugin gave none.
	FError RunFrame(const FForkScene& Scene, bool bCut, std::array<FFrameMasks, ViewCount>& Out);
	/// Tells the plugin what changes in the scene, from any thread: the game's.
	FPluginScene& GetPlugin() { return Plugin; }

private:
	FError SkinReed(const FReed& Reed);
	FError RunView(const FForkScene& Scene, size_t View, bool bCut, FFrameMasks& Out);
	FError CopyOutputs(const Lantern::FRTModuleOutputs& Outputs, VkDeviceSize Offset, FFrameMasks& Out) const;

	Lantern::IRTModule& Module;
	const FForkInstance& Instance;
	FForkDevice Device; // declared before what lives on it
	Lantern::TRTRef<Lantern::IRTVulkanRequirements> Requirements;
	FPluginScene Plugin;
	FForkSkin Skin;
	std::array<FForkRaster, ViewCount> Rasters;
	FForkBuffer Readback; // both masks of each view
	FForkThread RhiThread;
};

} // namespace Fork
