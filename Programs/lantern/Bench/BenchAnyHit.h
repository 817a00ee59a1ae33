// lantern bench anyhit: alpha tests under rays, with classified triangles and without.
#pragma once

#include "Bench/BenchRun.h"

namespace Lantern
{

/// Scenes: without any, black_forest if it is found, and the courtyard.
struct FBenchAnyHitOptions : FSceneBenchOptions
{
	void AddTo(CLI::App& App);
};

/// Counts alpha tests with the triangles of alpha-tested geometry classified by opacity, and without. Prints a table, and writes it as JSON
/// if asked. ExitCheckFailed if the two pictures differ in a pixel.
int RunBenchAnyHit(const FBenchAnyHitOptions& Options);

} // namespace Lantern
