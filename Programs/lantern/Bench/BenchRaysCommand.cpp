// lantern bench rays: options, the scenes, and the table of figures.
#include "Bench/BenchRaysCommand.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRays.h"
#include "Bench/BenchRun.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
/// Least fraction of pixels on which plugin and raw dispatch must agree. They round positions differently, so that a ray that only just
/// touches an edge may fall either way.
constexpr double LeastAgreement = 0.999;

std::vector<FBenchScene> ChooseScenes(const FBenchRaysOptions& Options)
{
	std::vector<FBenchScene> Scenes = {MakeBenchScene("courtyard")};
	for (const std::string& File : Options.Scenes)
	{
		if (File != Scenes.front().File) { Scenes.push_back(MakeBenchScene(File)); }
	}
	if (!Options.Scenes.empty() || Options.bQuick) { return Scenes; }
	for (const char* Path : {"sponza/Sponza.gltf", "black_forest/black_forest.gltf"})
	{
		if (const std::optional<FBenchScene> Scene = FindBenchScene(Path, "bench rays")) { Scenes.push_back(*Scene); }
	}
	return Scenes;
}

double GetProcessorRatio(const FRayCase& Case) { return Case.RawProcessor.GetMedian() / Case.PluginProcessor.GetMedian(); }

nlohmann::json MakeJson(const FRayCase& Case, bool bIsCpu)
{
	nlohmann::json Json = {{"name", Case.Name}, {"width", Case.Width}, {"height", Case.Height}, {"raw_mrays", Case.GetRawMrays()},
	    {"plugin_mrays", Case.GetPluginMrays()}, {"ratio", Case.GetRatio()}, {"queue_ratio", Case.GetQueueRatio()}, {"rays", Case.Rays},
	    {"agreement", Case.Agreement}, {"surface_ms", Case.Surface.ToJson()}, {"surface_share", Case.GetSurfaceShare()},
	    {"raw_ms", Case.Raw.ToJson()}, {"plugin_ms", Case.Plugin.ToJson()}, {"queue_ms", Case.Queue.ToJson()},
	    {"repetitions", Case.Raw.GetCount()}};
	if (bIsCpu) { Json["ratio_processor_time"] = GetProcessorRatio(Case); }
	return Json;
}

void PrintCase(const FRayCase& Case, bool bIsCpu)
{
	const auto Times = [](const FBenchTimes& T) { return fmt::format("{:.2f} [{:.2f}, {:.2f}]", T.GetMedian(), T.GetMin(), T.GetMax()); };
	fmt::print("{:<22} {:>9} {:>8} {:>9.3f} {:>12.3f} {:>6.3f} {:>6.3f}  {:>26} {:>26}  {:>13.3f}  {:.4f} %{}\n", Case.Name,
	    fmt::format("{}x{}", Case.Width, Case.Height), Case.Rays, Case.GetRawMrays(), Case.GetPluginMrays(), Case.GetRatio(),
	    Case.GetQueueRatio(), Times(Case.Raw), Times(Case.Plugin), Case.GetSurfaceShare(), 100.0 * Case.Agreement,
	    bIsCpu ? fmt::format("  {:.3f} by processor time", GetProcessorRatio(Case)) : "");
	std::fflush(stdout);
}

int MeasureScene(
    FSession& Session, const FBenchScene& Scene, const FBenchRaysOptions& Options, FBenchProgress& Progress, nlohmann::json& Cases)
{
	Progress.Begin(Scene.Name + ": load", 1.0);
	const FRTCapabilities& Capabilities = Session.GetDevice().GetCapabilities();
	FPictureOptions Picture;
	if (const int Status = MakeBenchPicture(Scene, Options.View, Options.Size, Capabilities.bIsCpu, Picture); Status != ExitDone)
	{
		return Status;
	}
	// The hand-written dispatch takes hits as the driver gives them, and its table has no record but those of shadow rays.
	for (const char* const Name : {"r.RT.GI", "r.RT.Reflections", "r.RT.Transmission"})
	{
		FConsoleVariables::Get().Set(Name, "0", ERTSetBy::CommandLine, "bench rays");
	}
	FConsoleVariables::Get().Set("r.RT.Opacity.Pieces", "0", ERTSetBy::CommandLine, "bench rays");
	if (const int Status = Session.LoadScene(Picture); Status != ExitDone) { return Status; }
	const FPluginFolders Folders = FindPluginFolders();
	FRayBenchSettings Settings;
	Settings.Repetitions = Options.Repetitions;
	Settings.ShaderFolders = {Folders.Root + "/Programs/lantern/Bench/Shaders", Folders.Shaders};
	Settings.CacheFolder = Folders.GetShaderCache();
	FRayBench Bench(Session.GetDevice(), Session.GetEngine(), std::move(Settings));
	if (FRTStatus S = Bench.CaptureGBuffer(Session.MakeView(Picture)); !S) { return ReportStatus(S, Scene.Name.c_str()); }
	int Exit = ExitDone;
	for (const bool bPipeline : {true, false})
	{
		if (!HasRayPath(Capabilities, bPipeline, Scene)) { continue; }
		FRayCase Case;
		Case.Name = Scene.Name + (bPipeline ? "/pipeline" : "/query");
		Progress.Begin(Case.Name, 1.0);
		if (FRTStatus S = Bench.Measure(bPipeline, Case); !S) { return ReportStatus(S, Case.Name.c_str()); }
		Progress.Clear();
		PrintCase(Case, Capabilities.bIsCpu);
		Cases.push_back(MakeJson(Case, Capabilities.bIsCpu));
		if (Case.Agreement < LeastAgreement)
		{
			LogError("{}: plugin and raw dispatch agree on {:.3f} % of the pixels only: they do not trace the same rays", Case.Name,
			    100.0 * Case.Agreement);
			Exit = ExitCheckFailed;
		}
	}
	return Exit;
}
} // namespace

void FBenchRaysOptions::AddTo(CLI::App& App)
{
	AddBenchQuick(App, [this] {
		Size = "160x90";
		Repetitions = 3;
		bQuick = true;
	});
	AddSceneOptions(App, "Scenes beside the courtyard; without any, Sponza and black_forest of LANTERN_SCENES");
	App.add_option("--repetitions", Repetitions, "Measured dispatches of each")->check(CLI::Range(1, 100'000));
	AddBenchJson(App, Json);
}

int RunBenchRays(const FBenchRaysOptions& Options)
{
	FSceneBench Bench;
	Bench.Name = "rays";
	Bench.SceneWork = 3.0; // load and two paths
	Bench.PrintHeader = [] {
		fmt::print("{:<22} {:>9} {:>8} {:>9} {:>12} {:>6} {:>6}  {:>26} {:>26}  {:>13}  {}\n", "case", "size", "rays", "raw Mr/s",
		    "plugin Mr/s", "ratio", "queue", "raw ms [min, max]", "plugin ms [min, max]", "surface share", "same pixels");
	};
	Bench.ChooseScenes = [&] { return ChooseScenes(Options); };
	Bench.Measure = [&](FSession& Session, const FBenchScene& Scene, FBenchProgress& Progress, nlohmann::json& Cases) {
		return MeasureScene(Session, Scene, Options, Progress, Cases);
	};
	return RunSceneBench(Options, Bench);
}

} // namespace Lantern
