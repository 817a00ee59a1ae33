// What the command line says, as values that have been checked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace CLI
{
class App;
}

namespace Lantern
{

/// Exit statuses.
inline constexpr int ExitDone = 0, ExitCheckFailed = 1, ExitUsage = 2, ExitNoDevice = 3, ExitBadInput = 4;

struct FCameraOption
{
	glm::dvec3 Position, Target;
	double FovY; ///< degrees
};

struct FSunOption
{
	double Irradiance;
	glm::dvec3 Direction;
	double Diameter; ///< degrees
};

/// Which device, and which console variables.
struct FDeviceOptions
{
	int Device = -1;
	bool bValidate = false;
	bool bTraceCalls = false; ///< each call of Vulkan is an event of the trace
	std::string Quality;
	std::vector<std::string> Sets;
	std::vector<std::string> Configs;
	void AddTo(CLI::App& App);
	void AddSettingsTo(CLI::App& App); ///< console variables only
};

/// Which picture.
struct FPictureOptions
{
	std::string Scene = "courtyard";
	std::string Output;
	std::string Json;
	uint32_t Width = 1280, Height = 720;
	std::optional<FCameraOption> Camera;
	std::optional<FSunOption> Sun;
	std::optional<glm::vec3> Sky;
	bool bNoSceneLights = false;
	double Time = 0.0;
	uint32_t Seed = 0;
	void AddTo(CLI::App& App);
};

/// --size: WIDTHxHEIGHT. Throws CLI::ValidationError.
void ParseSize(const std::string& Text, FPictureOptions& Options);
/// Parses COUNT comma-separated finite numbers.
std::optional<std::vector<double>> ParseNumbers(const std::string& Text, size_t Count);

} // namespace Lantern
