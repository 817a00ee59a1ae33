// Parses and checks what the command line says.
#include "Options.h"

#include <charconv>
#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "LanternCore/Config/Config.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/BuiltinScenes.h"
#include "LanternImage/Image.h"

namespace Lantern
{

namespace
{
std::optional<double> ParseNumber(std::string_view Text)
{
	double Value = 0.0;
	const auto [End, Error] = std::from_chars(Text.data(), Text.data() + Text.size(), Value);
	if (Error != std::errc() || End != Text.data() + Text.size() || !std::isfinite(Value)) { return std::nullopt; }
	return Value;
}

std::vector<double> RequireNumbers(const char* Option, const std::string& Text, size_t Count, const char* Form)
{
	const auto Numbers = ParseNumbers(Text, Count);
	if (!Numbers) { throw CLI::ValidationError(Option, Quote(Text) + " is not of the form " + Form); }
	return *Numbers;
}

void RequireNone(const char* Option, const std::string& Text, const std::string& Complaint)
{
	if (!Complaint.empty()) { throw CLI::ValidationError(Option, Quote(Text) + ": " + Complaint); }
}

void ParseCamera(const std::string& Text, FPictureOptions& Options)
{
	const auto N = RequireNumbers("--camera", Text, 7, "px,py,pz,tx,ty,tz,fovY");
	const FViewCamera Camera{{N[0], N[1], N[2]}, {N[3], N[4], N[5]}, N[6]};
	RequireNone("--camera", Text, CheckViewCamera(Camera));
	Options.Camera = Camera;
}

void ParseSun(const std::string& Text, FPictureOptions& Options)
{
	const auto N = RequireNumbers("--sun", Text, 5, "E,dx,dy,dz,diameter");
	const FViewSun Sun{N[0], {N[1], N[2], N[3]}, N[4]};
	RequireNone("--sun", Text, CheckViewSun(Sun));
	Options.Sun = Sun;
}

void ParseSky(const std::string& Text, FPictureOptions& Options)
{
	const auto N = RequireNumbers("--sky", Text, 3, "r,g,b");
	RequireNone("--sky", Text, CheckViewSky({N[0], N[1], N[2]}));
	Options.Sky = glm::vec3(N[0], N[1], N[2]);
}
} // namespace

void ParseSize(const std::string& Text, FPictureOptions& Options)
{
	const size_t X = Text.find('x');
	const auto Width = ParseNumber(std::string_view(Text).substr(0, X));
	const auto Height = X == std::string::npos ? std::nullopt : ParseNumber(std::string_view(Text).substr(X + 1));
	const auto IsWhole = [](double Value) { return Value >= 0 && Value == std::floor(Value) && Value < 1e9; };
	if (!Width || !Height || !IsWhole(*Width) || !IsWhole(*Height))
	{
		throw CLI::ValidationError("--size", Quote(Text) + " is not of the form WIDTHxHEIGHT");
	}
	if (!IsImageSizeValid(static_cast<uint64_t>(*Width), static_cast<uint64_t>(*Height)))
	{
		throw CLI::ValidationError("--size", Quote(Text) + " is out of range: 1 to " + std::to_string(MaxImageDimension) +
		                                         " pixels each way, " + std::to_string(MaxImagePixels) + " in all");
	}
	Options.Width = static_cast<uint32_t>(*Width);
	Options.Height = static_cast<uint32_t>(*Height);
}

std::optional<std::vector<double>> ParseNumbers(const std::string& Text, size_t Count)
{
	std::vector<double> Numbers;
	size_t Begin = 0;
	while (Begin <= Text.size())
	{
		const size_t End = std::min(Text.find(',', Begin), Text.size());
		const auto Number = ParseNumber(std::string_view(Text).substr(Begin, End - Begin));
		if (!Number) { return std::nullopt; }
		Numbers.push_back(*Number);
		Begin = End + 1;
	}
	if (Numbers.size() != Count) { return std::nullopt; }
	return Numbers;
}

void FDeviceOptions::AddTo(CLI::App& App)
{
	App.add_option("--device", Device, "Device, as lantern info counts them")->check([](const std::string& Text) {
		const auto Number = ParseNumber(Text);
		const bool bIndex = Number && *Number >= 0 && *Number == std::floor(*Number) && *Number < 1e6;
		return bIndex ? std::string() : Quote(Text) + " is not the number of a device";
	});
	App.add_flag("--validate", bValidate, "Vulkan validation layers on; any message is an error");
	App.add_flag("--trace-calls", bTraceCalls, "Records a trace (r.RT.Trace) that shows each call of Vulkan as well");
	AddSettingsTo(App);
}

void FDeviceOptions::AddSettingsTo(CLI::App& App)
{
	App.add_option("--quality", Quality, "low, medium, high, epic or cinematic")->check([](const std::string& Text) {
		return ParseQuality(Text) ? std::string() : Quote(Text) + " is none of low, medium, high, epic, cinematic";
	});
	// One value each time, so that a scene may follow.
	App.add_option("--set", Sets, "NAME=VALUE: a console variable; repeatable")
	    ->expected(1)
	    ->take_all()
	    ->allow_extra_args(false)
	    ->check([](const std::string& Text) {
		    return Text.find('=') != std::string::npos ? std::string() : Quote(Text) + " is not of the form NAME=VALUE";
	    });
	App.add_option("--config", Configs, "An ini file; repeatable")->expected(1)->take_all()->allow_extra_args(false);
}

void AddViewOption(CLI::App& App, std::string& View)
{
	App.add_option("--view", View,
	       "NAME: camera and light from the views.json in the scene's folder or the one above it. Other options come after it. "
	       "Without a camera or a view: the view main if there is one")
	    ->check([](const std::string& Text) { return Text.empty() ? std::string("a view has a name") : std::string(); });
}

int ResolveView(FPictureOptions& Options)
{
	const bool bNamed = !Options.View.empty();
	if (!bNamed && Options.Camera) { return ExitDone; }
	const FSceneViews Views = IsBuiltinScene(Options.Scene) ? FSceneViews() : LoadSceneViews(Options.Scene);
	if (!Views.Error.empty()) { return LogError("{}", Views.Error), ExitBadInput; }
	for (const std::string& Warning : Views.Warnings) { LogWarning("{}", Warning); }
	const FSceneView* const View = Views.Find(bNamed ? Options.View : "main");
	if (bNamed && !View)
	{
		const std::string Known = Views.File.empty() ? "no views.json in its folder or the one above lists it"
		                                             : fmt::format("{} has {}", EscapePath(Views.File), Views.ListNames());
		return LogError("--view {}: {} has no such view; {}", Quote(Options.View), EscapePath(Options.Scene), Known), ExitUsage;
	}
	if (!View) { return ExitDone; }
	Options.View = View->Name;
	if (!Options.Camera) { Options.Camera = View->Camera; }
	if (!Options.Sun) { Options.Sun = View->Sun; }
	if (!Options.Sky && View->Sky) { Options.Sky = glm::vec3(*View->Sky); }
	Options.bNoSceneLights |= !View->bSceneLights;
	return ExitDone;
}

int ResolveSceneView(FPictureOptions& Options)
{
	if (IsBuiltinScene(Options.Scene)) { Options.View.clear(); }
	return ResolveView(Options);
}

nlohmann::json DescribeView(const FPictureOptions& Options)
{
	return Options.View.empty() ? nlohmann::json(nullptr) : nlohmann::json(EscapeText(Options.View));
}

void FPictureOptions::AddTo(CLI::App& App)
{
	App.add_option("SCENE", Scene, "A .gltf or .glb, or the name of a built-in scene");
	App.add_option("-o,--output", Output, "OUT.exr, .pfm (linear radiance) or .png (tone-mapped)");
	App.add_option("--json", Json, "Write the figures to this file");
	App.add_option_function<std::string>(
	    "--size", [this](const std::string& Text) { ParseSize(Text, *this); }, "WIDTHxHEIGHT, pixels");
	AddViewOption(App, View);
	App.add_option_function<std::string>(
	    "--camera", [this](const std::string& Text) { ParseCamera(Text, *this); }, "px,py,pz,tx,ty,tz,fovY: metres, vertical degrees");
	App.add_option_function<std::string>(
	    "--sun", [this](const std::string& Text) { ParseSun(Text, *this); },
	    "E,dx,dy,dz,diameter: irradiance on a facing plane, direction in which the light travels, degrees. "
	    "A file without light of its own gets a sun and a sky unless --sun or --sky is given");
	App.add_option_function<std::string>(
	    "--sky", [this](const std::string& Text) { ParseSky(Text, *this); }, "r,g,b: constant radiance");
	App.add_flag("--no-scene-lights", bNoSceneLights, "Leave the scene's punctual lights out");
	App.add_option("--time", Time, "Seconds of animation")->check([](const std::string& Text) {
		return ParseNumber(Text) ? std::string() : Quote(Text) + " is not a number of seconds";
	});
	App.add_option("--seed", Seed, "Of the random numbers");
}

} // namespace Lantern
