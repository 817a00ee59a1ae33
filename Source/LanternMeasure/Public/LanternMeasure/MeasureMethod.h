// One point of the chart: a method's preset on a path, its cost and its errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "LanternMeasure/MeasurePaths.h"
#include "LanternMeasure/Methods.h"

namespace Lantern
{

/// References of one signal that a path's script asks for.
struct FPathReferences
{
	FSignalReference Home;
	std::optional<FSignalReference> Before, Switched;
};

struct FPathReferenceSettings
{
	ESignal Signal = ESignal::Frame;
	uint32_t Samples = 64;      ///< of Home
	uint32_t OtherSamples = 16; ///< of Before and Switched, which only say in which direction a frame is wrong
	uint32_t Seed = 0;
	std::string CacheFolder;
	std::function<void(double Done, double SecondsLeft)> Progress; ///< may be empty
};
/// Before the script is played. Out.Home stays if it is there already, since all paths of a signal share it. The light is put back. A signal without a light switch (ambient occlusion) gets no Switched.
FRTStatus GetPathReferences(FSampleEngine& Engine, const FPathScript& Path, const FPathReferenceSettings& Settings,
    const FLightSwitch& Switch, FPathReferences& Out);

/// Absent figures do not apply, see MeasureFigures.h.
struct FMethodFigures
{
	std::optional<double> GpuMs;      ///< of the signal's passes: median of the timed frames; absent: no timestamps
	std::optional<double> FrameGpuMs; ///< of all passes
	double RaysPerPixel = 0.0;        ///< of the signal's passes in a frame, at most
	/// What the device holds, after a frame's transient memory was pooled, above BaselineBytes.
	uint64_t MemoryBytes = 0;
	uint64_t PeakBytes = 0; ///< most that the device held after any frame of the script, all in all
	std::optional<double> RelMse, Flip, Sigma, T90Frames, Ghost, Leak;
	bool bT90Reached = true; ///< false: T90Frames is how long was watched
	uint32_t Frames = 0;     ///< played
	double Seconds = 0.0;    ///< on the clock
	FImage Picture, FlipMap; ///< the signal in the script's PictureFrame, and FLIP of it
};

enum class EMeasureEnd : uint8_t
{
	Done,
	NoSignal, ///< the frame does not have the signal: nothing in the scene for it
	TooLong,  ///< the script would take longer than MaxSeconds; Figures.Seconds says how long
	Refused,  ///< the settings: see Reason
};

struct FMeasureSettings
{
	uint64_t BaselineBytes = 0; ///< of the device with the scene loaded and all methods off, see MeasureBaseline
	double MaxSeconds = 0.0;    ///< 0: as long as it takes
};

struct FMeasureResult
{
	EMeasureEnd End = EMeasureEnd::Done;
	std::string Reason;
	FMethodFigures Figures;
};

/// Sets the method's variables, plays the script, and puts all back: variables, light, histories. Path must be of the
/// signal's references. FRTStatus: what the device or the renderer could not do.
FRTStatus MeasureMethod(FSampleEngine& Engine, const FMethods& Methods, const FMethod& Method, const FMethodPreset& Preset,
    const FPathScript& Path, const FPathReferences& References, const FLightSwitch& Switch, const FMeasureSettings& Settings,
    FMeasureResult& Out);

/// What two frames of a method tell, before its references are traced.
struct FMethodProbe
{
	bool bSignal = false;      ///< the frame has the signal
	bool bHistory = false;     ///< something is carried over from frame to frame: figures need a warm-up
	double FrameSeconds = 0.0; ///< of the second, on the clock; the first compiles and builds
};
FRTStatus ProbeMethod(FSampleEngine& Engine, const FMethods& Methods, const FMethod& Method, const FMethodPreset& Preset, const FView& View,
    double Time, FMethodProbe& Out);
/// Frames that MeasureMethod plays of a path: the light switch ends with its answer, after two of them at best.
uint32_t CountPathFrames(const FPathScript& Path);

/// Live bytes of the device with all methods off (FMethods::Defaults), after frames of View.
FRTStatus MeasureBaseline(FSampleEngine& Engine, const FMethods& Methods, const FView& View, double Time, uint64_t& OutBytes);

/// What one fact of the scene costs in a frame.
struct FFactCost
{
	std::string Fact; ///< "alpha tests"
	double FrameGpuMs = 0.0, WithoutGpuMs = 0.0;
};
struct FFactSettings
{
	FView View;
	double Time = 1.0;
	uint32_t Rounds = 3, FramesPerRound = 7, WarmUp = 2; ///< in turn, so that a slow drift meets all alike
	double MaxSeconds = 0.0;                             ///< 0: as long as it takes
};
/// Frames of a method with and without each fact that the scene has: alpha tests (r.RT.AlphaTest), animation (time held
/// still), local lights, sun and sky (taken out of the scene), all in turn in each round. Medians over all rounds. Empty on a device without
/// timestamps. TooLong: nothing is measured.
FRTStatus MeasureFacts(FSampleEngine& Engine, const FMethods& Methods, const FMethod* Method, const FMethodPreset* Preset,
    const FFactSettings& Settings, std::vector<FFactCost>& Out, EMeasureEnd& OutEnd);

} // namespace Lantern
