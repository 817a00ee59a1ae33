// The benchmarks as subcommands of the program.
#include "Bench/BenchCommands.h"

#include <CLI/CLI.hpp>

#include "Bench/BenchAnyHit.h"
#include "Bench/BenchFirstFrame.h"
#include "Bench/BenchFrame.h"
#include "Bench/BenchGather.h"
#include "Bench/BenchGrowth.h"
#include "Bench/BenchLights.h"
#include "Bench/BenchPipelines.h"
#include "Bench/BenchRaysCommand.h"
#include "Bench/BenchShaders.h"
#include "Bench/BenchTables.h"
#include "Bench/BenchUploads.h"

namespace Lantern
{

struct FBenchCommands::FOptions
{
	FBenchRaysOptions BenchRays;
	FBenchFrameOptions BenchFrame;
	FBenchAnyHitOptions BenchAnyHit;
	FBenchTablesOptions BenchTables;
	FBenchGatherOptions BenchGather;
	FBenchLightsOptions BenchLights;
	FBenchPipelinesOptions BenchPipelines;
	FBenchShadersOptions BenchShaders;
	FBenchUploadsOptions BenchUploads;
	FBenchFirstFrameOptions BenchFirstFrame;
	FBenchGrowthOptions BenchGrowth;
};

FBenchCommands::FBenchCommands() : Options(std::make_unique<FOptions>()) {}

FBenchCommands::~FBenchCommands() = default;

void FBenchCommands::AddTo(CLI::App& App, int& Status)
{
	CLI::App* const Command = App.add_subcommand("bench", "Benchmarks");
	Command->require_subcommand(1);
	CLI::App* const Rays = Command->add_subcommand("rays", "The sun shadow pass against a minimal hand-written Vulkan dispatch");
	Options->BenchRays.AddTo(*Rays);
	Rays->final_callback([&Options = Options->BenchRays, &Status] { Status = RunBenchRays(Options); });
	CLI::App* const Frame = Command->add_subcommand("frame", "The render thread's time for a frame of an open world, stage by stage");
	Options->BenchFrame.AddTo(*Frame);
	Frame->final_callback([&Options = Options->BenchFrame, &Status] { Status = RunBenchFrame(Options); });
	CLI::App* const AnyHit = Command->add_subcommand("anyhit", "Alpha tests under rays, with classified triangles and without");
	Options->BenchAnyHit.AddTo(*AnyHit);
	AnyHit->final_callback([&Options = Options->BenchAnyHit, &Status] { Status = RunBenchAnyHit(Options); });
	CLI::App* const Tables =
	    Command->add_subcommand("sbt", "Keeping the shader table: everything each frame, nothing changed, 1 % changed, another pipeline");
	Options->BenchTables.AddTo(*Tables);
	Tables->final_callback([&Options = Options->BenchTables, &Status] { Status = RunBenchTables(Options); });
	CLI::App* const Gather = Command->add_subcommand(
	    "gather", "Which instances of a world 32 km across rays see: by buckets against a plain loop; needs no device");
	Options->BenchGather.AddTo(*Gather);
	Gather->final_callback([&Options = Options->BenchGather, &Status] { Status = RunBenchGather(Options); });
	CLI::App* const Lights = Command->add_subcommand("lights", "The render thread's time for lights that come, move and go");
	Options->BenchLights.AddTo(*Lights);
	Lights->final_callback([&Options = Options->BenchLights, &Status] { Status = RunBenchLights(Options); });
	CLI::App* const Pipelines = Command->add_subcommand("rtpso", "Pipelines made whole and from libraries, and what frames notice of it");
	Options->BenchPipelines.AddTo(*Pipelines);
	Pipelines->final_callback([&Options = Options->BenchPipelines, &Status] { Status = RunBenchPipelines(Options); });
	CLI::App* const Shaders = Command->add_subcommand("shaders", "What each shader costs to compile; caches are off");
	Options->BenchShaders.AddTo(*Shaders);
	Shaders->final_callback([&Options = Options->BenchShaders, &Status] { Status = RunBenchShaders(Options); });
	CLI::App* const Uploads = Command->add_subcommand("uploads", "What the render thread notices of meshes that a thread streams in");
	Options->BenchUploads.AddTo(*Uploads);
	Uploads->final_callback([&Options = Options->BenchUploads, &Status] { Status = RunBenchUploads(Options); });
	CLI::App* const First = Command->add_subcommand("first", "The render thread's time for the first frame of a renderer of the module");
	Options->BenchFirstFrame.AddTo(*First);
	First->final_callback([&Options = Options->BenchFirstFrame, &Status] { Status = RunBenchFirstFrame(Options); });
	CLI::App* const Growth =
	    Command->add_subcommand("growth", "A frame's time against objects, triangles, materials and pixels, with the exponent of each");
	Options->BenchGrowth.AddTo(*Growth);
	Growth->final_callback([&Options = Options->BenchGrowth, &Status] { Status = RunBenchGrowth(Options); });
}

} // namespace Lantern
