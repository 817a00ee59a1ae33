// lantern bench rtpso: what it costs to make a ray-tracing pipeline of many hit groups, and what frames notice of it.
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

struct FBenchPipelinesOptions
{
	FDeviceOptions Device;
	bool bMock = false;
	uint32_t Groups = 256;
	std::vector<uint32_t> Threads = {1, 2, 4, 8, 16};
	uint32_t Repetitions = 3;
	uint32_t Added = 9; ///< materials added one after another
	uint32_t MockCompileMs = 500;
	bool bHitchOnly = false;
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints tables, and writes them as JSON where asked.
int RunBenchPipelines(const FBenchPipelinesOptions& Options);

} // namespace Lantern
