// The command line of Lantern.
#include <cstdio>
#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <CLI/CLI.hpp>

#ifdef LANTERN_WITH_BENCH
#include "Bench/BenchCommands.h"
#endif
#include "Chart/ChartCommand.h"
#include "Commands/CompareCommand.h"
#include "Commands/Explain.h"
#include "Commands/InfoCommand.h"
#include "Commands/RenderCommand.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternSignals/Signals.h"
#include "Stability/StabilityCommand.h"

namespace
{
using namespace Lantern;

/// The parser quotes arguments as they are.
std::string DescribeFailure(const CLI::App* App, const CLI::Error& Error)
{
	constexpr size_t MaxLength = 500;
	return CLI::FailureMessage::simple(App, CLI::Error(Error.get_name(), EscapeText(Error.what(), MaxLength), Error.get_exit_code()));
}

/// One function a command: its options, and what to run when it was named. Options live as long as the parsing.
class FCommandLine
{
public:
	FCommandLine()
	{
		App.require_subcommand(1);
		App.set_version_flag("--version", "lantern 0.1.0");
		App.failure_message(DescribeFailure);
		AddRender();
		AddReference();
		AddCompare();
		AddInfo();
		AddCvars();
#ifdef LANTERN_WITH_BENCH
		Bench.AddTo(App, Status);
#endif
		AddChart();
		AddStability();
	}
	int Run(int ArgumentCount, char** Arguments);

private:
	void AddRender();
	void AddReference();
	void AddCompare();
	void AddInfo();
	void AddCvars();
	void AddChart();
	void AddStability();

	CLI::App App{"Lantern: ray tracing for engines with a UE4.26-style RHI", "lantern"};
	int Status = ExitDone;
	FRenderOptions Render;
	bool bList = false;
	FReferenceOptions Reference;
	FCompareOptions Compare;
	std::string InfoJson, CvarsJson;
	FDeviceOptions CvarsSettings;
	bool bMarkdown = false;
#ifdef LANTERN_WITH_BENCH
	FBenchCommands Bench;
#endif
	FChartOptions Chart;
	FStabilityOptions Stability;
};

void FCommandLine::AddRender()
{
	CLI::App* const Command = App.add_subcommand("render", "Render a scene through the plugin");
	Render.Device.AddTo(*Command);
	Render.Picture.AddTo(*Command);
	Command
	    ->add_option("--frames", Render.Frames,
	        "Frames to render; the picture is the last one's. "
	        "Without it: until what accumulates over frames has settled, 64 at most")
	    ->check(CLI::Range(1, 1'000'000));
	Command
	    ->add_option("--path", Render.Path,
	        "slow or fast: the camera comes along this path of lantern chart, and the last frame is at the view. Needs --frames")
	    ->check(CLI::IsMember({"slow", "fast"}));
	Command->add_flag("--list", bList, "List the built-in scenes");
	Command->add_flag("--dump-graph", Render.bDumpGraph, "Print the last frame's passes, resources and barriers");
	Command
	    ->add_option("--explain", Render.Explain,
	        "X,Y of a pixel: print the signals of the last frame there, the radiance cells that a path's end would try, and the light cell")
	    ->check([](const std::string& Text) { return ParsePixel(Text) ? std::string() : Quote(Text) + " is not X,Y of a pixel"; });
	Command->final_callback([this] { Status = bList ? RunListScenes() : RunRender(Render); });
}

void FCommandLine::AddReference()
{
	CLI::App* const Command = App.add_subcommand("reference", "Render a scene with the unbiased path tracer");
	Reference.Device.AddTo(*Command);
	Reference.Picture.AddTo(*Command);
	Command->add_option("--spp", Reference.Samples, "Samples per pixel")->check(CLI::Range(1, 1 << 24));
	Command->add_option("--bounces", Reference.Bounces, "Scattering events, at most")->check(CLI::Range(0, 1 << 16));
	Command->add_option("--signal", Reference.Signal, "One signal instead of the whole frame: " + ListSignalNames())
	    ->check(
	        [](const std::string& Text) { return FindSignal(Text) ? std::string() : Quote(Text) + " is none of " + ListSignalNames(); });
	Command->add_flag(
	    "--pixel-centers", Reference.bPixelCenters, "Camera rays through pixel centres, as real-time passes shade them; no antialiasing");
	Command->add_flag("--raster-surfaces", Reference.bRasterSurfaces,
	    "Starts at the surfaces of the raster, whose textures are filtered, as real-time passes do; no antialiasing");
	Command->add_flag("--resume", Reference.bResume, "Keep the sums in OUT.state, and go on from there");
	Command->add_option("--save-every", Reference.SaveSeconds, "With --resume: seconds after which the sums are kept")
	    ->check(CLI::Range(0.0, 1e6));
	Command->final_callback([this] { Status = RunReference(Reference); });
}

void FCommandLine::AddCompare()
{
	CLI::App* const Command = App.add_subcommand("compare", "Compare two images; B is the reference");
	Command->add_option("A", Compare.A, "Image")->required();
	Command->add_option("B", Compare.B, "Reference")->required();
	Command->add_option("--heatmap", Compare.Heatmap, "FLIP's error map, .png")->check([](const std::string& Text) {
		return Text.ends_with(".png") ? std::string() : Quote(Text) + " does not end in .png";
	});
	Command->add_option("--json", Compare.Json, "Write the figures to this file");
	Command->final_callback([this] { Status = RunCompare(Compare); });
}

void FCommandLine::AddInfo()
{
	CLI::App* const Command = App.add_subcommand("info", "Devices, drivers, what runs on them and what does not, and why");
	Command->add_option("--json", InfoJson, "Write it to this file");
	Command->final_callback([this] { Status = RunInfo(InfoJson); });
}

void FCommandLine::AddCvars()
{
	CLI::App* const Command = App.add_subcommand("cvars", "Console variables");
	Command->add_flag("--markdown", bMarkdown, "As Docs/ConsoleVariables.md");
	Command->add_option("--json", CvarsJson, "Write them to this file");
	CvarsSettings.AddSettingsTo(*Command);
	Command->final_callback([this] { Status = RunCvars(CvarsSettings, bMarkdown, CvarsJson); });
}

void FCommandLine::AddStability()
{
	CLI::App* const Command =
	    App.add_subcommand("stability", "Where methods fail: cases with limits, each with a planted fault under which it must fail");
	Stability.AddTo(*Command);
	Command->final_callback([this] { Status = RunStability(Stability); });
}

void FCommandLine::AddChart()
{
	CLI::App* const Command = App.add_subcommand("chart", "Error against time of all methods, as one page");
	Chart.AddTo(*Command);
	Command->final_callback([this] { Status = RunChart(Chart); });
}

int FCommandLine::Run(int ArgumentCount, char** Arguments)
{
	try
	{
		App.parse(ArgumentCount, Arguments);
	}
	catch (const CLI::ParseError& Error)
	{
		if (ArgumentCount > 1 && Arguments[1][0] != '-' && App.get_subcommands().empty())
		{
			std::cerr << Quote(Arguments[1]) << " is not a command\nRun with --help for more information.\n";
			return ExitUsage;
		}
		return App.exit(Error, std::cout, std::cerr) == 0 ? ExitDone : ExitUsage;
	}
	return Status;
}
} // namespace

int main(int ArgumentCount, char** Arguments)
{
#if defined(__GLIBC__)
	// Left alone, glibc raises this limit with each large block that is freed and keeps such blocks from then on: 70 MiB
	// of decoded images, after loading a scene of 200 textures.
	mallopt(M_MMAP_THRESHOLD, 256 << 10);
#endif
	try
	{
		const int Status = FCommandLine().Run(ArgumentCount, Arguments);
		if (std::fflush(stdout) == 0 && !std::ferror(stdout)) { return Status; }
		LogError("standard output cannot be written");
		return Status == ExitDone ? ExitBadInput : Status;
	}
	catch (const std::bad_alloc&)
	{
		LogError("out of memory");
		return ExitNoDevice;
	}
	catch (const std::exception& Error)
	{
		if (std::ferror(stdout)) // the text was longer than its buffer
		{
			LogError("standard output cannot be written");
			return ExitBadInput;
		}
		LogError("{}", EscapeText(Error.what()));
	}
	return ExitCheckFailed;
}
