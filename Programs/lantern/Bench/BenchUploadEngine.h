// A small engine around the plugin's library, for benchmarks of the module: it loads the library, and makes frames without raster.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "LanternModule/Module.h"

namespace Lantern
{

class FBenchUploadEngine
{
public:
	~FBenchUploadEngine();
	/// Loads the library that lies beside the program. Mock: null for a device of the library's own.
	FRTStatus Open(IRTDevice* Mock, bool bValidate, const std::vector<std::string>& Settings);
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
	FRTStatus Load(const std::vector<std::string>& Settings);
	FRTStatus MakeTextures();
	FRTStatus BeginList(FSlot& Slot);
	FRTStatus FillTextures(IRTCommandList& List);

	void* Library = nullptr;
	TRTRef<IRTModule> Module;
	TRTRef<IRTDevice> Device;
	TRTRef<IRTModuleRenderer> Renderer;
	TRTRef<IRTTexture> Depth, Normals;
	std::array<FSlot, FramesInFlight> Slots;
	uint64_t FrameIndex = 0;
	bool bMock = false;
};

} // namespace Lantern
