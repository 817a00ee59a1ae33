// A small engine that uses Lantern on a VkDevice of its own: an example to read.
//
// PluginLoader finds, loads and initializes the plugin. ForkEngine creates a VkDevice with what the plugin needs, and runs frames.
// PluginScene hands scene, G-buffer and command buffer to the plugin. PluginMap hands over a texture. ForkLight lights with what comes
// back, and ForkGlass puts glass in front of it; both are passes of ForkImagePass. The rest is the engine itself: ForkVulkan (device,
// images), ForkSkin (skinning), ForkRaster (G-buffer) and ForkScene (boxes, cameras, world). The code in Judge/ checks the pictures and is
// no part of the example.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "Example/ForkGlass.h"
#include "Example/ForkLight.h"
#include "Example/ForkThread.h"
#include "Example/PluginScene.h"

namespace Fork
{

inline constexpr uint32_t PixelCount = ViewSize.width * ViewSize.height; ///< of a view

/// What the CPU reads of a view: PixelCount of each, rows from the top. Valid until the next frame, and until ChangeDevice.
struct FFrameMasks
{
	const uint16_t* SunShadow = nullptr;        ///< halves; null if the plugin gave none
	const uint16_t* AmbientOcclusion = nullptr; ///< likewise
	const uint16_t* Lit = nullptr;              ///< four halves for each pixel, see FForkLight
};

/// The instance and the module must outlive it.
class FForkEngine
{
public:
	FForkEngine(Lantern::IRTModule& InModule, const FForkInstance& InInstance) : Module(InModule), Instance(InInstance) {}
	FForkEngine(const FForkEngine&) = delete;
	/// Takes the first device that the plugin can use, and creates it with what the plugin needs.
	FError CreateDevice();
	/// Creates the plugin's renderer, the G-buffer and the objects of Scene.
	FError LoadScene(const FForkScene& Scene);
	/// Goes on with another VkDevice, as after VK_ERROR_DEVICE_LOST: the plugin keeps its scene. Between frames.
	FError ChangeDevice();
	/// Draws each view's G-buffer, lets the plugin add its signals, and lights, on the calling thread: the render thread. The
	/// engine's thread for its RHI submits. Returns when the GPU is done. bCut: nothing of the frame before is in this one.
	FError RunFrame(const FForkScene& Scene, bool bCut, std::array<FFrameMasks, ViewCount>& Out);
	/// Tells the plugin what changes in the scene, from any thread: the game's.
	FPluginScene& GetPlugin() { return Plugin; }

private:
	/// All of the engine that a lost device takes with it.
	struct FOnDevice
	{
		FForkDevice Device; // declared before what lives on it
		Lantern::TRTRef<Lantern::IRTVulkanRequirements> Requirements;
		FForkSkin Skin;
		FForkRaster Raster;
		FForkLight Light;
		FForkGlass Glass;
		FPluginDevice Plugin; // released before the device
		FForkBuffer Readback; // masks and light of each view
		FError CreateThings();
	};
	FError CreateOnDevice(FOnDevice& Out) const;
	FError SkinReed(const FReed& Reed);
	FError RunView(const FForkFrame& Frame, bool bCut, FFrameMasks& Out);
	FError CopyOutputs(const Lantern::FRTModuleOutputs& Outputs, uint32_t View, FFrameMasks& Out) const;

	Lantern::IRTModule& Module;
	const FForkInstance& Instance;
	std::unique_ptr<FOnDevice> On; // released after the plugin's scene
	FPluginScene Plugin;
	std::optional<FForkScene> Before; ///< what the last frame showed
	FForkThread RhiThread;
};

} // namespace Fork
