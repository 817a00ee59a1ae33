// A small engine around the plugin's library, for benchmarks of the module: it loads the library, and makes frames without raster.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "LanternModule/Module.h"

namespace Lantern
{

class FBenchModuleEngine
{
public:
	~FBenchModuleEngine();
	struct FOptions
	{
		IRTDevice* Mock = nullptr; ///< null: a device of the library's own
		bool bValidate = false;
		bool bCache = true; ///< compiled shaders are kept between runs
		std::vector<std::string> Settings = {};
		FSignalSet Wanted = {ESignal::SunShadow};
	};
	/// Loads the library that lies beside the program.
	FRTStatus Open(const FOptions& InOptions);
	IRTModuleRenderer& GetRenderer() { return *Renderer; }
	IRTDevice& GetDevice() { return *Device; }

	struct FFrameTime
	{
		double Milliseconds = 0.0;          ///< of RenderFrame and EndFrame
		double ProcessorMilliseconds = 0.0; ///< of the thread
		bool bComplete = false;
	};
	/// Renders a frame and submits it. At most three are in flight; the wait for the oldest is not counted.
	FRTStatus Frame(FFrameTime& Out);

private:
	static constexpr size_t FramesInFlight = 3;
	struct FSlot
	{
		TRTRef<IRTCommandList> List;
		FRTFence Fence = 0;
	};
	FRTStatus Load();
	FRTStatus MakeTextures();
	FRTStatus BeginList(FSlot& Slot);
	FRTStatus FillTextures(IRTCommandList& List);

	void* Library = nullptr;
	TRTRef<IRTModule> Module;
	TRTRef<IRTDevice> Device;
	TRTRef<IRTModuleRenderer> Renderer;
	TRTRef<IRTTexture> Depth, Normals, BaseColor, Material;
	FOptions Options;
	std::array<FSlot, FramesInFlight> Slots;
	uint64_t FrameIndex = 0;
};

} // namespace Lantern
