// lantern chart: error against time of all methods, as one page.
#pragma once

#include <string>
#include <vector>

#include "LanternMeasure/Chart/ChartPlan.h"
#include "Options.h"

namespace Lantern
{

struct FChartOptions
{
	FDeviceOptions Device;
	FPictureOptions Picture; ///< size, seed and view
	std::vector<std::string> Scenes;
	std::string Output, Json;
	uint32_t Frames = 20, WarmUp = 16, ReferenceSamples = 256;
	std::string Signals, Methods, Paths; ///< lists, separated by commas
	std::string MethodsFile;             ///< empty: Config/Methods.ini
	double BudgetMinutes = -1.0;         ///< < 0: 10 on CPU devices, none on others; 0: none
	std::string Shard;
	std::vector<std::string> Merge;
	void AddTo(CLI::App& App);
};

/// Returns an exit status.
int RunChart(const FChartOptions& Options);

} // namespace Lantern
