// lantern bench sbt: the cost of keeping the shader table current, by how much has changed.
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

struct FBenchTablesOptions
{
	FDeviceOptions Device;
	bool bMock = false;
	std::vector<uint32_t> Objects = {1000, 10'000, 100'000};
	uint32_t Repetitions = 31;
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints a table, and writes it as JSON if asked. ExitCheckFailed if a static frame copied anything.
int RunBenchTables(const FBenchTablesOptions& Options);

} // namespace Lantern
