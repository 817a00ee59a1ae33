// What the command line says, as values that have been checked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include "LanternHost/SceneViews.h"

namespace CLI
{
class App;
}

namespace Lantern
{

/// Exit statuses.
inline constexpr int ExitDone = 0, ExitCheckFailed = 1, ExitUsage = 2, ExitNoDevice = 3, ExitBadInput = 4;

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
	/// A name in the views.json of the scene. ResolveView replaces it by the name of the view in use, or by nothing.
	std::string View;
	std::optional<FViewCamera> Camera;
	std::optional<FViewSun> Sun;
	std::optional<glm::vec3> Sky;
	bool bNoSceneLights = false;
	double Time = 0.0;
	uint32_t Seed = 0;
	void AddTo(CLI::App& App);
};

/// --view.
void AddViewOption(CLI::App& App, std::string& View);
/// Takes what the options leave open from the view that they name, or from the view `main` if they name neither view nor camera. Returns
/// an exit status, after saying what is wrong. Call it once, before the device is opened.
int ResolveView(FPictureOptions& Options);
/// For commands that take several scenes: View says nothing of built-in scenes.
int ResolveSceneView(FPictureOptions& Options);
/// Returns the name of the view for JSON, or null without one. Call after ResolveView.
nlohmann::json DescribeView(const FPictureOptions& Options);

/// --size: WIDTHxHEIGHT. Throws CLI::ValidationError.
void ParseSize(const std::string& Text, FPictureOptions& Options);
/// Parses COUNT comma-separated finite numbers.
std::optional<std::vector<double>> ParseNumbers(const std::string& Text, size_t Count);

} // namespace Lantern
