// Scripts: sequences of frames that state camera, time, light and other changes. The sample engine plays them and collects
// pictures, timings and memory. References of a script's frames are traced before it is played, since a reference frame in
// between would end every history.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "LanternHost/SampleEngine.h"
#include "LanternMeasure/SignalReference.h"

namespace Lantern
{

struct FScriptFrame
{
	FView View; ///< with DeltaSeconds and bCut
	double Time = 0.0;
	/// Runs before the frame. It must set an absolute state of the scene, since it runs more than once (for references, then
	/// for the frames). The script's owner restores the scene afterwards. May be empty.
	std::function<void(FSampleEngine&)> Change;
	bool bCapture = true; ///< false: the frame is rendered completely and timed, but not read back
};
using FScript = std::vector<FScriptFrame>;

/// Returns the passes of the newest finished frame. With r.RT.Rays.Count, their rays are those that were traced, not those that there was
/// room for.
std::vector<FPassTiming> GetTimings(FRenderer& Renderer);

struct FPlayedFrame
{
	uint32_t Index = 0;    ///< in the script
	FCapturedFrame Images; ///< the requested signals; empty if not captured, or if the frame lacks it
	/// Timings of this frame, without readback.
	std::vector<FPassTiming> Passes;
	uint64_t LiveBytes = 0;                ///< memory of the device after the frame
	double Seconds = 0.0;                  ///< wall time, from its change to its picture
	double GetGpuMs() const;               ///< sum of all passes; < 0: the device has no timestamps
	double GetGpuMs(ESignal Signal) const; ///< of the signal's passes (Signals.h)
	uint64_t GetRays(ESignal Signal) const;
};

struct FPlaySettings
{
	std::vector<ESignal> Signals; ///< made in every frame, captured if the script says so; the lit frame is always made
	bool bKeepHistory = false;    ///< continues the histories; else they begin empty, and frame indices at 0
	bool bRealTime = false;       ///< as FSampleEngine::bRealTime
	/// If off, frames follow each other without a pause, and nothing is captured. Passes are then those of an earlier frame, or none.
	bool bWait = true;
};

/// Plays a script. Calls OnFrame after each frame; false ends the script. Unless bKeepHistory, first empties the histories and
/// frees the frame graph's idle memory. Restores the engine's settings. With bWait, waits for each frame, so that
/// timings belong to it.
FRTStatus PlayScript(
    FSampleEngine& Engine, const FScript& Script, const FPlaySettings& Settings, const std::function<bool(FPlayedFrame&)>& OnFrame);

struct FScriptReferences
{
	/// References by index of the script's frame.
	std::map<uint32_t, FSignalReference> Frames;
};

/// Traces the references of a signal for the script's frames in Indices (ascending), running the changes up to each one. Uses
/// Signal, Samples, Bounces, Seed, StateKey, CacheFolder and Progress of Desc; the script determines the rest. StateKey is
/// needed for changes that FSignalReferenceDesc::StateKey says are not seen. Each frame's index is then added to it.
FRTStatus GetScriptReferences(FSampleEngine& Engine, const FScript& Script, const std::vector<uint32_t>& Indices,
    const FSignalReferenceDesc& Desc, FScriptReferences& Out);

} // namespace Lantern
