// lantern bench rays: the sun shadow pass against a hand-written dispatch.
#pragma once

#include <string>
#include <vector>

#include "Options.h"

namespace CLI
{
class App;
}

namespace Lantern
{

struct FBenchRaysOptions
{
	FDeviceOptions Device;
	std::vector<std::string> Scenes; ///< files beside the courtyard; empty: Sponza and black_forest if they are found
	std::string Size;                ///< WIDTHxHEIGHT; empty: 1280×720, on a CPU device 640×360
	std::string Json;
	uint32_t Repetitions = 21;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked. ExitCheckFailed if the two do not trace the same rays.
int RunBenchRays(const FBenchRaysOptions& Options);

} // namespace Lantern
