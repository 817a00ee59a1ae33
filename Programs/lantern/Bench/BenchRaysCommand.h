// lantern bench rays: the sun shadow pass against a hand-written dispatch.
#pragma once

#include "Bench/BenchRun.h"

namespace Lantern
{

/// Scenes: those beside the courtyard. Without any, Sponza and black_forest if they are found.
struct FBenchRaysOptions : FSceneBenchOptions
{
	uint32_t Repetitions = 21;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked. ExitCheckFailed if the two do not trace the same rays.
int RunBenchRays(const FBenchRaysOptions& Options);

} // namespace Lantern
