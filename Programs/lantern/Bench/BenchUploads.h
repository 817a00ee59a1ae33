// lantern bench uploads: a thread streams meshes into the module, as an engine would. What does the render thread notice?
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

struct FBenchUploadsOptions
{
	uint32_t Meshes = 10'000;
	uint32_t Triangles = 512; ///< of each mesh
	bool bMock = false;
	bool bValidate = false;
	bool bQuick = false;
	std::vector<std::string> Settings; ///< NAME=VALUE
	std::string Json;
	void AddTo(CLI::App& App);
};

/// Prints what frames take while nothing comes and while meshes come, and writes it as JSON if asked. Returns an exit status.
int RunBenchUploads(const FBenchUploadsOptions& Options);

} // namespace Lantern
