// lantern bench sbt: what it costs to keep the shader table, by how much changed.
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

/// Prints a table, and writes it as JSON where asked. ExitCheckFailed where a static frame copied anything.
int RunBenchTables(const FBenchTablesOptions& Options);

} // namespace Lantern
