// lantern bench growth: how the time of a frame grows with objects, triangles, materials and pixels.
#pragma once

#include <string>

#include "Options.h"

namespace CLI
{
class App;
}

namespace Lantern
{

struct FBenchGrowthOptions
{
	FDeviceOptions Device;
	bool bMock = false;
	bool bQuick = false;
	uint32_t Frames = 21; ///< measured, of each point
	std::string Line;     ///< empty: all lines
	std::string Output;   ///< page; empty: none
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON and as a page with a chart if asked. Each line has the exponent that fits it.
int RunBenchGrowth(const FBenchGrowthOptions& Options);

} // namespace Lantern
