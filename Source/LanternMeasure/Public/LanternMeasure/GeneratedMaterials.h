// Generates material programs of realistic size for `lantern bench rtpso`. No two are alike, so that neither a driver nor a
// cache has seen them before.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "LanternScene/Pipelines/MaterialPrograms.h"

namespace Lantern
{

/// Makes a program whose text depends on Index and Salt.
FMaterialProgramDesc MakeBenchProgram(uint32_t Index, uint64_t Salt);
uint64_t MakeSalt(); ///< random; differs at each call

/// SPIR-V of a pipeline with one hit group for each of Count programs.
struct FBenchShaders
{
	FShaderBinary RayGen;
	std::vector<FShaderBinary> Misses, Hits;
};
/// Makes the benchmark's ray generation shader, which traces material rays from the camera into an image.
FShaderSource MakeBenchRayGen();
/// Compiles with glslang on Threads threads. OutMs: wall time of all hit shaders together.
FRTStatus CompileBenchShaders(FShaderCompiler& Compiler, uint32_t Count, uint32_t Threads, FBenchShaders& Out, double& OutMs);
/// Replaces a constant in each hit shader, so that it is new to a driver. Returns false if there is no such constant.
bool RenewShaders(FBenchShaders& Shaders);

/// Runs Task(0 … Count − 1), each once, on Threads new threads, however many cores the machine has.
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
