// What benchmarks have in common: options, device, scenes, and the file for their figures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "Bench/BenchProgress.h"
#include "Bench/BenchScenes.h"
#include "LanternRHI/RTInterfaces.h"
#include "Options.h"
#include "Session.h"

namespace Lantern
{

/// --quick, which calls SetQuick. Add it before the options that SetQuick changes, so that those which are given win.
void AddBenchQuick(CLI::App& App, const std::function<void()>& SetQuick);
void AddBenchJson(CLI::App& App, std::string& Json); ///< --json
/// --size. Text stays empty if the option is absent; Defaults says in the help what holds then.
void AddBenchSize(CLI::App& App, std::string& Text, const char* Defaults);

/// Runs Body and writes the figures that it puts into its argument to File, if File is not empty. Nothing is written without figures, or
/// if Body ends with another status than ExitDone or ExitCheckFailed. Returns an exit status.
int RunBench(const std::string& File, const std::function<int(nlohmann::json& Figures)>& Body);

/// Opens the session's device and runs Body with it. Returns an exit status.
int RunInBenchSession(const FDeviceOptions& Options, const std::function<int(FSession&)>& Body);

/// Runs Body with the mock device, after loading the settings. The mock records no calls. Returns an exit status.
int RunOnBenchMock(const FDeviceOptions& Options, const std::function<int(IRTDevice&)>& Body);

/// A mock device that records no calls.
FRTStatus CreateBenchMock(TRTRef<IRTDevice>& Out);

/// {"device": …, "driver": …}
nlohmann::json DescribeBenchDevice(const FRTCapabilities& Capabilities);

/// Whether the device traces rays by this path. If not, the log says so for the scene.
bool HasRayPath(const FRTCapabilities& Capabilities, bool bPipeline, const FBenchScene& Scene);

/// Options of a benchmark that measures scenes.
struct FSceneBenchOptions
{
	FDeviceOptions Device;
	std::vector<std::string> Scenes; ///< files; empty: the benchmark chooses
	std::string View;                ///< empty: the view main of scenes that have one
	std::string Size;                ///< WIDTHxHEIGHT; empty: 1280×720, on a CPU device 640×360
	std::string Json;
	bool bQuick = false; ///< a benchmark that chooses its scenes takes few
	/// Adds all of them except --json. ScenesHelp: help text of the scenes.
	void AddSceneOptions(CLI::App& App, const char* ScenesHelp);
};

/// A benchmark that measures scenes one after another.
struct FSceneBench
{
	std::function<void()> PrintHeader;
	std::function<std::vector<FBenchScene>()> ChooseScenes;
	/// Appends to Cases. Returns an exit status. Its steps have SceneWork together.
	std::function<int(FSession&, const FBenchScene&, FBenchProgress&, nlohmann::json& Cases)> Measure;
	std::string Name;
	double SceneWork = 1.0;
};

/// Measures all scenes, also after one has failed. Returns the first exit status that is not ExitDone.
int RunSceneBench(const FSceneBenchOptions& Options, const FSceneBench& Bench);

} // namespace Lantern
