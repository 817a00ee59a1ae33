// The command line of Lantern.
#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <cstdio>

#include <CLI/CLI.hpp>

#include "BenchCommand.h"
#include "CompareCommand.h"
#include "InfoCommand.h"
#include "LanternCore/Log.h"
#include "RenderCommand.h"

namespace
{
using namespace Lantern;

int Run(int ArgumentCount, char** Arguments)
{
	CLI::App App{"Lantern: ray tracing for engines with a UE4.26-style RHI", "lantern"};
	App.require_subcommand(1);
	App.set_version_flag("--version", "lantern 0.1.0");
	int Status = ExitDone;

	FRenderOptions Render;
	bool bList = false;
	CLI::App* const RenderApp = App.add_subcommand("render", "Render a scene through the plugin");
	Render.Device.AddTo(*RenderApp);
	Render.Picture.AddTo(*RenderApp);
	RenderApp->add_option("--frames", Render.Frames, "Frames to render; the picture is the last one's")->check(CLI::Range(1, 1'000'000));
	RenderApp->add_flag("--list", bList, "List the built-in scenes");
	RenderApp->add_flag("--dump-graph", Render.bDumpGraph, "Print the last frame's passes, resources and barriers");
	RenderApp->final_callback([&] { Status = bList ? RunListScenes() : RunRender(Render); });

	FReferenceOptions Reference;
	CLI::App* const ReferenceApp = App.add_subcommand("reference", "Render a scene with the unbiased path tracer");
	Reference.Device.AddTo(*ReferenceApp);
	Reference.Picture.AddTo(*ReferenceApp);
	ReferenceApp->add_option("--spp", Reference.Samples, "Samples per pixel")->check(CLI::Range(1, 1 << 24));
	ReferenceApp->add_option("--bounces", Reference.Bounces, "Scattering events, at most")->check(CLI::Range(0, 1 << 16));
	ReferenceApp->add_flag("--resume", Reference.bResume, "Keep the sums in OUT.state, and go on from there");
	ReferenceApp->add_option("--save-every", Reference.SaveSeconds, "With --resume: seconds after which the sums are kept")
	    ->check(CLI::Range(0.0, 1e6));
	ReferenceApp->final_callback([&] { Status = RunReference(Reference); });

	FCompareOptions Compare;
	CLI::App* const CompareApp = App.add_subcommand("compare", "Compare two images; B is the reference");
	CompareApp->add_option("A", Compare.A, "Image")->required();
	CompareApp->add_option("B", Compare.B, "Reference")->required();
	CompareApp->add_option("--heatmap", Compare.Heatmap, "FLIP's error map, .png");
	CompareApp->add_option("--json", Compare.Json, "Write the figures to this file");
	CompareApp->final_callback([&] { Status = RunCompare(Compare); });

	std::string InfoJson;
	CLI::App* const InfoApp = App.add_subcommand("info", "Devices, drivers, what runs on them and what does not, and why");
	InfoApp->add_option("--json", InfoJson, "Write it to this file");
	InfoApp->final_callback([&] { Status = RunInfo(InfoJson); });

	std::string CvarsJson;
	bool bMarkdown = false;
	CLI::App* const CvarsApp = App.add_subcommand("cvars", "Console variables");
	CvarsApp->add_flag("--markdown", bMarkdown, "As Docs/ConsoleVariables.md");
	CvarsApp->add_option("--json", CvarsJson, "Write them to this file");
	FDeviceOptions CvarsSettings;
	CvarsSettings.AddSettingsTo(*CvarsApp);
	CvarsApp->final_callback([&] { Status = RunCvars(CvarsSettings, bMarkdown, CvarsJson); });

	FBenchRaysOptions BenchRays;
	CLI::App* const BenchApp = App.add_subcommand("bench", "Benchmarks");
	BenchApp->require_subcommand(1);
	CLI::App* const BenchRaysApp = BenchApp->add_subcommand("rays", "The sun shadow pass against a minimal hand-written Vulkan dispatch");
	BenchRays.AddTo(*BenchRaysApp);
	BenchRaysApp->final_callback([&] { Status = RunBenchRays(BenchRays); });

	try
	{
		App.parse(ArgumentCount, Arguments);
	}
	catch (const CLI::ParseError& Error)
	{
		if (ArgumentCount > 1 && Arguments[1][0] != '-' && App.get_subcommands().empty())
		{
			std::cerr << "'" << Arguments[1] << "' is not a command\nRun with --help for more information.\n";
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
		const int Status = Run(ArgumentCount, Arguments);
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
		LogError("{}", Error.what());
	}
	return ExitCheckFailed;
}
