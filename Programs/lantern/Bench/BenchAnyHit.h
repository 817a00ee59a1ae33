// lantern bench anyhit: alpha tests under rays, with classified triangles and without.
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

struct FBenchAnyHitOptions
{
	FDeviceOptions Device;
	std::vector<std::string> Scenes; ///< empty: black_forest if it is found, and the courtyard
	std::string Size;                ///< WIDTHxHEIGHT; empty: 1280×720, on a CPU device 640×360
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Counts alpha tests with the triangles of alpha-tested geometry classified by opacity, and without. Prints a table, and writes it as JSON
/// if asked. ExitCheckFailed if the two pictures differ in a pixel.
int RunBenchAnyHit(const FBenchAnyHitOptions& Options);

} // namespace Lantern
