// lantern bench frame: what the render thread spends on a frame of an open world, and what each stage takes off it.
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
	bool bMock = false;   ///< a pretended device: the plugin's own work alone
	uint32_t Rounds = 12; ///< of all stages in turn
	std::string Size;     ///< WIDTHxHEIGHT; empty: 1280×720, on a CPU device 64×36
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON where asked.
int RunBenchFrame(const FBenchFrameOptions& Options);

} // namespace Lantern
