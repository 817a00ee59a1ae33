// The driver's part of `lantern bench rtpso`: one pipeline of many hit groups, made whole and from libraries.
#pragma once

#include "Bench/BenchProgress.h"
#include "Bench/BenchTimes.h"
#include "LanternMeasure/GeneratedMaterials.h"
#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

struct FPipelineRun
{
	uint32_t Threads = 0;
	FBenchTimes MonolithicMs, LibrariesMs, LinkMs;
	double GlslangMs = 0.0; ///< all hit shaders, on as many threads
	double FinishMs = 0.0;  ///< from text to RTPSO through the plugin's compiler, on as many threads
	double GetRatio() const { return MonolithicMs.GetMedian() / (LibrariesMs.GetMedian() + LinkMs.GetMedian()); }
};

/// Measures a monolithic pipeline and one from libraries. They begin with equal SPIR-V, but for a constant that no driver has
/// seen before. Which of the two goes first alternates. The steps have GetPipelineRunWork together.
FRTStatus MeasurePipelineRun(
    IRTDevice& Device, FShaderCompiler& Compiler, uint32_t Groups, uint32_t Repetitions, FBenchProgress& Progress, FPipelineRun& Run);
/// In groups that one thread compiles.
double GetPipelineRunWork(uint32_t Threads, uint32_t Groups, uint32_t Repetitions);

struct FIncrementalRun
{
	FBenchTimes ReadyMs, LinkMs;
};
/// One more material among Groups, Added times: until its pipeline is in use, and the link alone.
FRTStatus MeasureIncremental(IRTDevice& Device, FShaderCompiler& Compiler, uint32_t Groups, uint32_t Added, FIncrementalRun& Out);

} // namespace Lantern
