// lantern bench frame: time of the render thread for a frame of an open world, and how much each stage saves.
#pragma once

#include <string>

#include "Bench/BenchFrameWorld.h"
#include "Options.h"

namespace Lantern
{

struct FBenchFrameOptions
{
	FDeviceOptions Device;
	FBenchWorldOptions World;
	bool bMock = false;   ///< the mock device: measures the plugin's own work alone
	uint32_t Rounds = 12; ///< each runs all stages in turn
	std::string Size;     ///< WIDTHxHEIGHT; empty: 1280×720, on a CPU device 64×36
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked.
int RunBenchFrame(const FBenchFrameOptions& Options);

} // namespace Lantern
