// lantern chart: options, the plan, and the page with its JSON.
#include "Chart/ChartCommand.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "Chart/ChartPage.h"
#include "Chart/ChartSweep.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/SceneHash.h"
#include "LanternImage/AtomicFile.h"
#include "LanternMeasure/Chart/ChartParts.h"
#include "Session.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

constexpr double CpuBudgetMinutes = 10.0;

std::vector<std::string> SplitList(const std::string& Text)
{
	std::vector<std::string> Out;
	for (size_t Begin = 0; !Text.empty() && Begin <= Text.size();)
	{
		const size_t End = std::min(Text.find(',', Begin), Text.size());
		if (End > Begin) { Out.push_back(Text.substr(Begin, End - Begin)); }
		Begin = End + 1;
	}
	return Out;
}

std::string WithEnding(const std::string& Output, const char* Ending) { return fs::path(Output).replace_extension(Ending).string(); }

std::string GetJsonPath(const FChartOptions& Options) { return Options.Json.empty() ? WithEnding(Options.Output, ".json") : Options.Json; }

/// Names are checked against the registry; empty where all are known. False: said what is not.
bool ParseSelection(const FChartOptions& Options, const FMethods& Methods, FChartSelection& Out)
{
	for (const std::string& Name : SplitList(Options.Signals))
	{
		const auto Signal = FindSignal(Name);
		if (!Signal) { return LogError("--signals: {} is no signal", Quote(Name)), false; }
		Out.Signals.push_back(*Signal);
	}
	for (const std::string& Name : SplitList(Options.Paths))
	{
		const auto Path = FindPath(Name);
		if (!Path) { return LogError("--paths: {} is none of still, slow, fast, cut", Quote(Name)), false; }
		Out.Paths.push_back(*Path);
	}
	for (const std::string& Name : SplitList(Options.Methods))
	{
		const FMethod* const Method = Methods.Find(Name);
		if (!Method)
		{
			std::string Known;
			for (const FMethod& M : Methods.Methods) { Known += (Known.empty() ? "" : ", ") + M.Name; }
			return LogError("--methods: {} is no method; there are {}", Quote(Name), Known), false;
		}
		Out.Methods.push_back(Method->Name);
	}
	return true;
}

/// The program and the shaders that it compiles: another build is another measurement.
std::string HashProgram(const std::string& ShaderFolder)
{
	std::map<std::string, std::string> Files = {{"", "/proc/self/exe"}}; // sorted: folders list in any order
	std::error_code Error;
	for (fs::recursive_directory_iterator It(ShaderFolder, Error), End; !Error && It != End; It.increment(Error))
	{
		if (It->is_regular_file(Error)) { Files.emplace(fs::relative(It->path(), ShaderFolder, Error).string(), It->path().string()); }
	}
	FContentHasher Hasher;
	for (const auto& [Name, Path] : Files)
	{
		std::ifstream File(Path, std::ios::binary);
		Hasher.AddText(Name);
		Hasher.AddText(std::string(std::istreambuf_iterator<char>(File), {}));
	}
	return Hasher.Finish().ToHex();
}

/// Page and data, from whichever parts.
int WriteChart(const FChartOptions& Options, std::vector<FChartPart> Parts)
{
	nlohmann::json Data;
	if (FRTStatus S = MakeChartData(std::move(Parts), Data); !S) { return ReportStatus(S, "chart"), ExitBadInput; }
	if (FRTStatus S = WriteFileAtomically(Options.Output, MakeChartPage(Data)); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	if (FRTStatus S = WriteFileAtomically(GetJsonPath(Options), WithoutImages(Data).dump(2) + "\n"); !S)
	{
		return ReportStatus(S, "--json"), ExitBadInput;
	}
	for (const nlohmann::json& Scene : Data["scenes"])
	{
		fmt::print(
		    "{}: {} points, {} skipped\n", EscapeText(Scene["name"].get<std::string>()), Scene["points"].size(), Scene["skipped"].size());
		for (const nlohmann::json& Fact : Scene["facts"])
		{
			fmt::print("  frame {:.3f} ms, without {} {:.3f} ms\n", Fact["frame_gpu_ms"].get<double>(),
			    EscapeText(Fact["fact"].get<std::string>()), Fact["without_gpu_ms"].get<double>());
		}
	}
	return ExitDone;
}

int CheckOutputs(const FChartOptions& Options)
{
	if (Options.Output.empty()) { return LogError("-o OUT.html is missing"), ExitUsage; }
	if (fs::path(Options.Output).extension() != ".html")
	{
		return LogError("-o {}: does not end in .html", EscapePath(Options.Output)), ExitUsage;
	}
	if (FRTStatus S = CheckOutputPath(Options.Output); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	if (FRTStatus S = CheckOutputPath(GetJsonPath(Options)); !S) { return ReportStatus(S, "--json"), ExitBadInput; }
	return ExitDone;
}

int RunMerge(const FChartOptions& Options)
{
	std::vector<FChartPart> Parts;
	if (FRTStatus S = ReadAllParts(Options.Merge, Parts); !S) { return ReportStatus(S, "--merge"), ExitBadInput; }
	return WriteChart(Options, std::move(Parts));
}

int LoadRegistry(const FChartOptions& Options, FMethods& Out)
{
	const std::string File = Options.MethodsFile.empty() ? FindPluginFolders().Config + "/Methods.ini" : Options.MethodsFile;
	Out = LoadMethods(File);
	for (const std::string& Problem : Out.Problems) { LogError("{}", Problem); }
	if (!Out.Problems.empty()) { return ExitBadInput; }
	if (Out.Methods.empty()) { return LogError("{}: no method is in it", EscapePath(File)), ExitBadInput; }
	return ExitDone;
}

/// One for each scene, with its view.
int MakePictures(const FChartOptions& Options, std::vector<FPictureOptions>& Out)
{
	for (const std::string& Scene : Options.Scenes.empty() ? std::vector<std::string>{"courtyard", "stability-poles"} : Options.Scenes)
	{
		FPictureOptions Picture = Options.Picture;
		Picture.Scene = Scene;
		if (const int Status = ResolveSceneView(Picture); Status != ExitDone) { return Status; }
		Out.push_back(std::move(Picture));
	}
	return ExitDone;
}

FChartSweepDesc MakeSweep(const FChartOptions& Options, std::vector<FPictureOptions> Pictures, FSession& Session,
    const FChartSelection& Selection, std::chrono::steady_clock::time_point Start)
{
	const FPluginFolders Folders = FindPluginFolders();
	FChartSweepDesc Desc;
	Desc.Pictures = std::move(Pictures);
	Desc.Settings = {Options.Picture.Width, Options.Picture.Height, Options.ReferenceSamples, Options.Frames, Options.WarmUp,
	    Options.Picture.Seed, DescribeVariables()};
	Desc.Selection = Selection;
	Desc.Shard = ParseShard(Options.Shard).value_or(FShard());
	const double Default = Session.GetDevice().GetCapabilities().bIsCpu ? CpuBudgetMinutes : 0.0;
	Desc.BudgetSeconds = 60.0 * (Options.BudgetMinutes < 0.0 ? Default : Options.BudgetMinutes);
	Desc.PartsFolder = WithEnding(Options.Output, ".parts");
	Desc.ReferenceFolder = Folders.Cache.empty() ? "" : Folders.Cache + "/references";
	Desc.Program = HashProgram(Folders.Shaders);
	Desc.Start = Start;
	return Desc;
}
} // namespace

void FChartOptions::AddTo(CLI::App& App)
{
	Picture.Width = 320;
	Picture.Height = 180;
	App.add_option("SCENE", Scenes, "Each a .gltf or .glb, or the name of a built-in scene. Without one: courtyard and stability-poles");
	App.add_option("-o,--output", Output, "OUT.html. Beside it: the data in OUT.json, and what is done so far in the folder OUT.parts");
	App.add_option("--json", Json, "Write the data to this file instead");
	App.add_option_function<std::string>(
	    "--size", [this](const std::string& Text) { ParseSize(Text, Picture); }, "WIDTHxHEIGHT, pixels; 320x180");
	AddViewOption(App, Picture.View);
	App.add_option("--frames", Frames, "Frames that are timed; 20")->check(CLI::Range(5, 100'000));
	App.add_option("--warm-up", WarmUp, "Frames before them; 16")->check(CLI::Range(1, 100'000));
	App.add_option("--spp", ReferenceSamples, "Samples of references; 256")->check(CLI::Range(4, 1 << 20));
	App.add_option("--seed", Picture.Seed, "Of the random numbers");
	App.add_option("--signals", Signals, "A list with commas of " + ListSignalNames() + ". Without it: all");
	App.add_option("--methods", Methods, "A list with commas, of names in the file of methods. Without it: all");
	App.add_option("--methods-file", MethodsFile, "Instead of Config/Methods.ini");
	App.add_option("--paths", Paths, "A list with commas: still, slow, fast, cut. Without it: all");
	App.add_option("--budget", BudgetMinutes,
	       "Minutes in which to end: cheap presets first, references of fewer samples, what does not fit is left out. "
	       "0: none. Without it: 10 on a device that is a CPU, none on others")
	    ->check(CLI::Range(0.0, 1e6));
	App.add_option("--shard", Shard, "k/n: only every n-th point, beginning with the k-th")->check([](const std::string& Text) {
		return ParseShard(Text) ? std::string() : Quote(Text) + " is not of the form k/n with k from 1 to n";
	});
	App.add_option("--merge", Merge, "Measure nothing: put the parts of these folders together");
	Device.AddTo(App);
}

int RunChart(const FChartOptions& Options)
{
	const auto Start = std::chrono::steady_clock::now();
	if (const int Status = CheckOutputs(Options); Status != ExitDone) { return Status; }
	if (!Options.Merge.empty()) { return RunMerge(Options); }
	FMethods Methods;
	if (const int Status = LoadRegistry(Options, Methods); Status != ExitDone) { return Status; }
	FChartSelection Selection;
	if (!ParseSelection(Options, Methods, Selection)) { return ExitUsage; }
	std::vector<FPictureOptions> Pictures;
	if (const int Status = MakePictures(Options, Pictures); Status != ExitDone) { return Status; }
	if (ListChartItems(Methods, Selection).size() < 2) { return LogError("no method fits --signals and --methods"), ExitUsage; }
	FSession Session;
	if (const int Status = Session.OpenDevice(Options.Device); Status != ExitDone) { return Session.Close(Status); }
	const FChartSweepDesc Desc = MakeSweep(Options, std::move(Pictures), Session, Selection, Start);
	std::error_code Error;
	fs::create_directories(Desc.PartsFolder, Error);
	if (Error)
	{
		LogError("{}: {}", EscapePath(Desc.PartsFolder), Error.message());
		return Session.Close(ExitBadInput);
	}
	int Status = ExitDone;
	{
		FChartSweep Sweep(Session, Methods, Desc);
		Status = Sweep.Run();
		if (Status == ExitDone) { Status = WriteChart(Options, Sweep.GetParts()); }
	}
	fs::remove(Desc.PartsFolder, Error); // only if nothing is in it
	const double Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - Start).count();
	LogInfo("{} in all", FormatSeconds(Seconds));
	return Session.Close(Status);
}

} // namespace Lantern
