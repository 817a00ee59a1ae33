// lantern bench first: what does the first frame of a renderer take of the render thread, against a later one?
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

struct FBenchFirstFrameOptions
{
	uint32_t Objects = 100; ///< there before the first frame, each with a mesh of its own
	uint32_t Rounds = 9;    ///< renderers, one after another
	bool bMock = false;
	bool bCold = false;                ///< no cache of compiled shaders
	bool bOtherThread = false;         ///< frames are not the main thread's
	std::vector<std::string> Settings; ///< NAME=VALUE
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints the times of first and later frames, and writes them as JSON if asked. Returns an exit status.
int RunBenchFirstFrame(const FBenchFirstFrameOptions& Options);

} // namespace Lantern
