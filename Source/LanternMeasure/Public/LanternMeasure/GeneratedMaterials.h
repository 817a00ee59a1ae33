// Material programs for `lantern bench rtpso`: text made up at run time, of realistic size, no two alike, so that neither a
// driver nor a cache has seen them before.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "LanternScene/Pipelines/MaterialPrograms.h"

namespace Lantern
{

/// Index and Salt both make a difference.
FMaterialProgramDesc MakeBenchProgram(uint32_t Index, uint64_t Salt);
uint64_t MakeSalt(); ///< never the same again

/// SPIR-V of a pipeline with one hit group for each of Count programs.
struct FBenchShaders
{
	FShaderBinary RayGen;
	std::vector<FShaderBinary> Misses, Hits;
};
/// The ray generation shader of the benchmark: camera rays of the material type into an image.
FShaderSource MakeBenchRayGen();
/// glslang on Threads threads; OutMs: how long all hit shaders took together, wall clock.
FRTStatus CompileBenchShaders(FShaderCompiler& Compiler, uint32_t Count, uint32_t Threads, FBenchShaders& Out, double& OutMs);
/// Puts another constant into each hit shader, so that it is a new one to a driver. False: there is none to replace.
bool RenewShaders(FBenchShaders& Shaders);

/// Runs Task(0 … Count − 1), each once, on threads of its own: as many as said, whatever the machine has.
template <class F>
void RunOnThreads(uint32_t Threads, uint32_t Count, F Task)
{
	std::atomic<uint32_t> Next{0};
	std::vector<std::thread> Workers;
	for (uint32_t Thread = 0; Thread < Threads; ++Thread)
	{
		Workers.emplace_back([&] {
			for (uint32_t Index = Next++; Index < Count; Index = Next++) { Task(Index); }
		});
	}
	for (std::thread& Worker : Workers) { Worker.join(); }
}

} // namespace Lantern
