// lantern stability: cases in which methods fail, with limits and planted faults.
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

struct FStabilityOptions
{
	FDeviceOptions Device;
	std::vector<int> Cases;           ///< empty: all
	std::vector<std::string> Methods; ///< names or titles; empty: all that the device can run
	uint32_t Seeds = 0;               ///< 0: 5, or 2 with bQuick
	uint32_t Samples = 0;             ///< samples of references; 0: 4,096, or 256 with bQuick
	bool bQuick = false;
	bool bAllStrips = false; ///< strips also of what holds
	bool bList = false;
	std::string Output; ///< folder for strips
	std::string Json, Known;
	void AddTo(CLI::App& App);
};

/// Prints a table. ExitCheckFailed if a case does not hold, its planted fault does not fail, or a known shortfall is none.
int RunStability(const FStabilityOptions& Options);

} // namespace Lantern
