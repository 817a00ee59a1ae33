// lantern bench shaders: the cost of compiling each shader that frames of a scene may need, dearest first. A driver may compile when a
// pipeline is made or when it is first used. On lavapipe that took 25 s of a first frame, before this was measured.
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
	double MaxSeconds = 0.0; ///< limit of the driver's time for one pipeline; 0: no limit
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked. ExitCheckFailed if a pipeline takes longer than MaxSeconds.
int RunBenchShaders(const FBenchShadersOptions& Options);

} // namespace Lantern
