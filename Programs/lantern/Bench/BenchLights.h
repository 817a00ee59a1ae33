// lantern bench lights: the render thread's time for lights that come, move and go, against how many there are. It needs no device,
// except to measure frames.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Bench/BenchLightFrames.h"

namespace CLI
{
class App;
}

namespace Lantern
{

struct FBenchLightsOptions
{
	std::vector<uint32_t> Sizes = {100, 10'000, 1'000'000};
	uint32_t Moved = 100;   ///< lights that change in a frame
	uint32_t Frames = 400;  ///< of each measurement
	bool bPictures = false; ///< measures frames with lights instead
	FBenchLightFramesOptions Pictures;
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked.
int RunBenchLights(const FBenchLightsOptions& Options);

} // namespace Lantern
