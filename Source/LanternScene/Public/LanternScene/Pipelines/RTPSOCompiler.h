// Makes RTPSOs without anybody waiting. Each shader group is compiled by itself, by glslang and then by the driver into a
// pipeline library, on threads of the compiler's own; libraries are kept, and what is ready is linked into a new RTPSO,
// which the render thread takes over at the start of a frame.
//
// Rounds: when something that a frame wants is missing and no round runs, one starts. It ends when all of its groups are
// done or r.RT.Pipeline.RoundMs is over; what has not been started then waits for the next one. Then what is ready is
// linked. Meanwhile hit programs that are missing have stand-ins of their class, or are left out (r.RT.Pipeline.Fallback).
//
// Without pipeline libraries (the device has none, or r.RT.Pipeline.Libraries is 0) the link compiles everything anew, on
// the same threads and just as unnoticed, only later. Where a link needs ray generation and miss shaders of its own
// (FRTCapabilities::bLibraryOnlyPipelines), it gets these as SPIR-V.
//
// Swaps: on some drivers the first frame with a new pipeline compiles all of it. From frames that are reported (FrameSubmitted,
// FrameDone) the compiler learns what a swap costs. Programs that are ready then wait until swaps take no more than
// r.RT.Pipeline.SwapShare of the time. Only materials' programs wait, and only where something stands in for them. What a
// setting asks for, such as a ray generation shader, is never held back. SwapPacer.h has the rule.
//
// Threads: one at a time, the render thread. The compiler's own threads are no tasks of LanternCore, because they block for
// as long as a driver likes, and a frame's tasks must not wait behind them.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "LanternScene/Pipelines/RTPSO.h"

namespace Lantern
{

/// What is drawn where a hit program is not ready.
enum class ERTFallback : uint8_t
{
	Skip,    ///< nothing: its objects are left out (FRTPSO::IsMissing)
	StandIn, ///< the standard material; with the alpha test where it is masked
	Wait,    ///< the frame waits
};
ERTFallback GetPipelineFallback(); ///< r.RT.Pipeline.Fallback, render thread

/// What is to be compiled first.
struct FProgramPriority
{
	uint64_t StandInHits = 0; ///< rays of a recent frame that hit this program's stand-in: more is earlier
	float Distance = 1e30f;   ///< of the nearest object that has it, metres: nearer is earlier
};

struct FRTPSOCompilerStats
{
	uint32_t Wanted = 0;                                                     ///< shader groups that the last Update or Finish asked for
	uint32_t Ready = 0;                                                      ///< of them, compiled
	uint32_t Failed = 0;                                                     ///< of them, with errors and nothing older to use
	uint32_t Kept = 0;                                                       ///< compiled groups in memory, wanted or not
	uint64_t Rounds = 0, Links = 0, Compiled = 0, Failures = 0, Dropped = 0; ///< since creation
	double GlslangMs = 0.0, DriverMs = 0.0;                                  ///< summed over threads, links left out
	double LastLinkMs = 0.0;
	double LastSwapMs = 0.0; ///< what the last swap has cost the frame that first used it; 0: nothing, or not known
	bool bBusy = false;      ///< something is being compiled, linked, or is waiting for it
};

/// What time it is; empty: the steady clock.
using FPipelineTimeSource = std::function<std::chrono::steady_clock::time_point()>;

class FRTPSOCompiler
{
public:
	/// All must outlive it. Programs is read by Update and Finish only. Time: any thread may ask it; for tests.
	FRTPSOCompiler(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, FPipelineTimeSource Time = {});
	/// Waits for compiles that a driver is in the middle of; what has not been started is forgotten.
	~FRTPSOCompiler();
	FRTPSOCompiler(const FRTPSOCompiler&) = delete;
	FRTPSOCompiler& operator=(const FRTPSOCompiler&) = delete;

	/// Frame start. Takes over what was linked, and starts what is missing. Never waits for a compile or link.
	/// What does not compile is logged once, with file and line, and keeps its older version or a stand-in.
	void Update(const FRTPSODesc& Wanted);
	/// Waits until everything in Wanted is compiled or has failed, and links it: for loading and for pictures that must be
	/// complete. Progress (0 … 1) may be empty. An error: without what failed (a miss shader, the standard material, the link)
	/// there is no pipeline of Wanted. Other hit programs and ray generation shaders that fail are no error: see Update.
	FRTStatus Finish(const FRTPSODesc& Wanted, const std::function<void(float)>& Progress = {});
	/// The RTPSO of this frame; null before the first was linked. Changes only in Update and Finish.
	std::shared_ptr<const FRTPSO> GetCurrent() const;

	/// The frame of the last Update went to the GPU. Frame: a number that rises. Never waits.
	void FrameSubmitted(uint64_t Frame);
	/// Such a frame is done, and took so long on the GPU. In their order; some may be left out. Never waits.
	void FrameDone(uint64_t Frame, double GpuMs);
	/// By program; those beyond the end have none.
	void SetPriorities(std::vector<FProgramPriority> ByProgram);
	/// Looks for shader files that were edited, in the background, and compiles what is made from them anew.
	void Reload();
	/// Never waits: where the compiler's threads are just busy, as they were.
	const FRTPSOCompilerStats& GetStats() const;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
