// Scripts: a sequence of frames in which camera, time, light and anything else change as written, played through the
// sample engine while pictures, timings and memory are taken. References of a script's frames are traced before it is
// played, since a reference frame in between would end every history.
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
	/// Before the frame: sets the scene to a state, never changes it relative to what it is, since it runs more than once
	/// (for references, then for the frames). What it set is the script's owner's to put back. May be empty.
	std::function<void(FSampleEngine&)> Change;
	bool bCapture = true; ///< else the frame is only rendered and timed, as whole as the others
};
using FScript = std::vector<FScriptFrame>;

struct FPlayedFrame
{
	uint32_t Index = 0;    ///< in the script
	FCapturedFrame Images; ///< of the signals asked for; empty where not captured or where the frame does not have it
	/// Of this very frame, without the reading back.
	std::vector<FPassTiming> Passes;
	uint64_t LiveBytes = 0;                ///< of the device after the frame
	double Seconds = 0.0;                  ///< on the clock, from its change to its picture
	double GetGpuMs() const;               ///< sum of all passes; < 0: the device has no timestamps
	double GetGpuMs(ESignal Signal) const; ///< of the signal's passes (Signals.h)
	uint64_t GetRays(ESignal Signal) const;
};

struct FPlaySettings
{
	std::vector<ESignal> Signals; ///< made in every frame and captured where the script says so; the lit frame always is
	bool bKeepHistory = false;    ///< goes on from the frame before the script; else histories begin empty and frames at 0
	bool bRealTime = false;       ///< as FSampleEngine::bRealTime
};

/// OnFrame: called after each frame; false ends the script. Histories are emptied and the frame graph's idle memory is
/// freed first, unless bKeepHistory. The engine's own settings are put back. Each frame is waited for, so that timings
/// belong to it.
FRTStatus PlayScript(
    FSampleEngine& Engine, const FScript& Script, const FPlaySettings& Settings, const std::function<bool(FPlayedFrame&)>& OnFrame);

struct FScriptReferences
{
	/// Of the script's frames, by index.
	std::map<uint32_t, FSignalReference> Frames;
};

/// References of a signal for the script's frames in Indices (ascending): runs the changes up to each, traces, goes on.
/// Desc: its Signal, Samples, Bounces, Seed, StateKey, CacheFolder and Progress; the script gives the rest. StateKey is
/// needed where changes do what FSignalReferenceDesc::StateKey says is not seen; each frame's index is added to it then.
FRTStatus GetScriptReferences(FSampleEngine& Engine, const FScript& Script, const std::vector<uint32_t>& Indices,
    const FSignalReferenceDesc& Desc, FScriptReferences& Out);

} // namespace Lantern
