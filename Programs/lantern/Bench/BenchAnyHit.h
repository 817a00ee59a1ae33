// lantern bench anyhit
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
	std::vector<std::string> Scenes; ///< none: black_forest where it is found, and the courtyard
	std::string Size;                ///< WIDTHxHEIGHT; empty: 1280×720, on a CPU device 640×360
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Alpha tests under rays, with the triangles of alpha-tested geometry told apart by opacity and without. Prints a
/// table, and writes it as JSON where asked. ExitCheckFailed where the two pictures are not the same in every pixel.
int RunBenchAnyHit(const FBenchAnyHitOptions& Options);

} // namespace Lantern
