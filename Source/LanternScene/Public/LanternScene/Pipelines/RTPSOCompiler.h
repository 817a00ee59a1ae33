// The RTPSO compiler: makes ray-tracing pipelines while frames go on.
//
// Units: each shader group of a description is compiled by itself, first by glslang, then by the driver into a pipeline
// library. Threads of the compiler's own do this. Libraries are kept. The compiler links what is ready into a new RTPSO, and
// the render thread takes it over at the start of a frame.
//
// Rounds: a round starts when a frame wants something that is missing and no round is open. The round ends when all of its
// units are done, or after r.RT.Pipeline.RoundMs. Units that nobody has started then wait for the next round. The link follows.
// Meanwhile missing hit programs have stand-ins of their class, or are left out (r.RT.Pipeline.Fallback).
//
// Libraries: if the device has no pipeline libraries, or r.RT.Pipeline.Libraries is 0, each link compiles everything anew. Frames
// notice nothing but a later result. Some drivers need ray generation and miss groups of the link's own
// (FRTCapabilities::bLibraryOnlyPipelines is false); the link then gets these as SPIR-V.
//
// Swaps: some drivers compile a pipeline when a frame first uses it. The compiler learns the cost of such a swap from
// FrameSubmitted and FrameDone. Programs that are ready wait until swaps take at most r.RT.Pipeline.SwapShare of the time.
// Only material programs with a stand-in wait. Whatever a setting asks for, such as a ray generation shader, never waits.
// SwapPacer.h has the rule.
//
// Threads: the render thread, one call at a time.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "LanternScene/Pipelines/RTPSO.h"

namespace Lantern
{

/// What a frame shows where a hit program is not ready.
enum class ERTFallback : uint8_t
{
	Skip,    ///< nothing: objects that use it are left out (FRTPSO::IsMissing)
	StandIn, ///< the standard material; with the alpha test if the class is masked
	Wait,    ///< the program itself: the frame waits
};
ERTFallback GetPipelineFallback(); ///< r.RT.Pipeline.Fallback; render thread

/// What decides which programs are compiled first.
struct FProgramPriority
{
	uint64_t StandInHits = 0; ///< rays of a recent frame that hit this program's stand-in: more is earlier
	float Distance = 1e30f;   ///< from the camera to the nearest object that has it, metres: nearer is earlier
};

struct FRTPSOCompilerStats
{
	uint32_t Wanted = 0;                            ///< shader groups that the last Update or Finish asked for
	uint32_t Ready = 0;                             ///< wanted groups that are compiled
	uint32_t Failed = 0;                            ///< wanted groups that do not compile and have no older version
	uint32_t Kept = 0;                              ///< compiled groups in memory, wanted or not
	uint64_t Links = 0, Compiled = 0, Failures = 0; ///< since creation; Links: those that were taken over
	double LastLinkMs = 0.0;                        ///< duration of the last link, on the compiler's thread
	double LastSwapMs = 0.0; ///< GPU time that the last swap added to the frame which first used it; 0: none, or not known yet
	bool bBusy = false;      ///< something is being compiled or linked, or waits for it
};

/// Returns the time; empty: the steady clock.
using FPipelineTimeSource = std::function<std::chrono::steady_clock::time_point()>;

class FRTPSOCompiler
{
public:
	/// All references must outlive it. Update and Finish read Programs, other calls do not. Any thread may call Time, which
	/// tests replace.
	FRTPSOCompiler(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, FPipelineTimeSource Time = {});
	/// Waits for compiles that a driver is in the middle of, and forgets those that have not been started.
	~FRTPSOCompiler();
	FRTPSOCompiler(const FRTPSOCompiler&) = delete;
	FRTPSOCompiler& operator=(const FRTPSOCompiler&) = delete;

	/// Takes over a pipeline that was linked, and starts what is missing. Call it at the start of a frame. Never waits for a
	/// compile, a link or a lock. A shader that does not compile is logged once, with file and line; its older version or a
	/// stand-in stays in use.
	void Update(const FRTPSODesc& Wanted);
	/// Waits until everything in Wanted is compiled or has failed, and links it: for loading, and for complete pictures.
	/// Progress (0 to 1) may be empty. Returns an error if there is no pipeline of Wanted: a miss shader, the standard material,
	/// or the link has failed. A failure of other hit programs or ray generation shaders is no error: see Update. Without memory for
	/// a shader it is an error, unless an older version serves. The next call tries again.
	/// bStandIns: makes stand-ins as well, as Update does, so that an Update behind it finds nothing to do.
	FRTStatus Finish(const FRTPSODesc& Wanted, const std::function<void(float)>& Progress = {}, bool bStandIns = false);
	/// The RTPSO of this frame; null before the first link. Changes only in Update and Finish.
	std::shared_ptr<const FRTPSO> GetCurrent() const;

	/// Tells that the frame of the last Update went to the GPU. Frame: a number that rises. Never waits.
	void FrameSubmitted(uint64_t Frame);
	/// Tells that a submitted frame is done, and its GPU time. Frames come in order; some may be left out. Never waits.
	void FrameDone(uint64_t Frame, double GpuMs);
	/// Sets the priorities by program. Programs beyond the end have none.
	void SetPriorities(std::vector<FProgramPriority> ByProgram);
	/// Looks for edited shader files in the background, and compiles what is made from them anew.
	void Reload();
	/// Never waits: if another thread has the lock, the figures are older and bBusy is true.
	const FRTPSOCompilerStats& GetStats() const;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
