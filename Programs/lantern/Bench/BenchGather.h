// lantern bench gather: finds the instances of a large world for a frame's acceleration structure. A loop over all objects is the
// yardstick. It needs no device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace Lantern
{

struct FBenchGatherOptions
{
	std::vector<uint32_t> Sizes = {10'000, 150'000, 1'000'000};
	uint32_t Frames = 400; ///< of each measurement
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked. ExitCheckFailed if the two do not find the same instances.
int RunBenchGather(const FBenchGatherOptions& Options);

} // namespace Lantern
