// lantern bench shaders: what it costs to compile each shader that frames of a scene may need, dearest first. A driver may
// compile when a pipeline is made or when it is first used (lavapipe: 25 s of a first frame, before this was measured).
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

struct FBenchShadersOptions
{
	FDeviceOptions Device;
	std::vector<std::string> Scenes = {"courtyard"};
	std::string Match;       ///< part of a name; empty: all
	double MaxSeconds = 0.0; ///< of the driver, for one pipeline; 0: no limit
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON where asked. ExitCheckFailed where a pipeline takes longer than MaxSeconds.
int RunBenchShaders(const FBenchShadersOptions& Options);

} // namespace Lantern
