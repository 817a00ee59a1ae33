// Measures one point of the chart: cost and errors of a method's preset on a path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "LanternMeasure/MeasurePaths.h"
#include "LanternMeasure/Methods.h"

namespace Lantern
{

/// References of one signal that a path's script needs.
struct FPathReferences
{
	FSignalReference Home;
	std::optional<FSignalReference> Before, Switched;
};

struct FPathReferenceSettings
{
	ESignal Signal = ESignal::Frame;
	uint32_t Samples = 64;      ///< for Home
	uint32_t OtherSamples = 16; ///< for Before and Switched, which only tell the direction of an error
	uint32_t Seed = 0;
	std::string CacheFolder;
	std::function<void(double Done, double SecondsLeft)> Progress; ///< may be empty
};
/// Traces the references, before the script is played. Keeps an Out.Home that is there already, since all paths of a signal share
/// it. Restores the light. A signal without a light switch (ambient occlusion) gets no Switched.
FRTStatus GetPathReferences(FSampleEngine& Engine, const FPathScript& Path, const FPathReferenceSettings& Settings,
    const FLightSwitch& Switch, FPathReferences& Out);

/// Absent figures do not apply, see MeasureFigures.h.
struct FMethodFigures
{
	std::optional<double> GpuMs;      ///< of the signal's passes, median of the timed frames; absent without timestamps
	std::optional<double> FrameGpuMs; ///< of all passes
	double RaysPerPixel = 0.0;        ///< maximum over frames, of the signal's passes
	/// Memory of the device above BaselineBytes, after a frame's transient memory was pooled.
	uint64_t MemoryBytes = 0;
	uint64_t PeakBytes = 0; ///< maximum of the device's whole memory after any frame of the script
	std::optional<double> RelMse, Flip, Sigma, T90Frames, Ghost, Leak;
	bool bT90Reached = true; ///< false: T90Frames is the number of watched frames
	uint32_t Frames = 0;     ///< number of played frames
	double Seconds = 0.0;    ///< wall time
	FImage Picture, FlipMap; ///< the signal in the script's PictureFrame, and FLIP of it
};

enum class EMeasureEnd : uint8_t
{
	Done,
	NoSignal, ///< the frame lacks the signal, since the scene has nothing for it
	TooLong,  ///< the script would take longer than MaxSeconds; Figures.Seconds says how long
	Refused,  ///< the settings were refused: see Reason
};

struct FMeasureSettings
{
	uint64_t BaselineBytes = 0; ///< of the device with the scene loaded and all methods off, see MeasureBaseline
	double MaxSeconds = 0.0;    ///< 0: unlimited
};

struct FMeasureResult
{
	EMeasureEnd End = EMeasureEnd::Done;
	std::string Reason;
	FMethodFigures Figures;
};

/// Sets the method's variables, plays the script, and restores variables, light and histories. References must be those of Path
/// and of the method's signal. The status reports errors of the device and the renderer.
FRTStatus MeasureMethod(FSampleEngine& Engine, const FMethods& Methods, const FMethod& Method, const FMethodPreset& Preset,
    const FPathScript& Path, const FPathReferences& References, const FLightSwitch& Switch, const FMeasureSettings& Settings,
    FMeasureResult& Out);

/// The result of two frames of a method, before its references are traced.
struct FMethodProbe
{
	bool bSignal = false;      ///< the frame has the signal
	bool bHistory = false;     ///< the method has a history: figures need a warm-up
	double FrameSeconds = 0.0; ///< wall time of the second frame; the first one compiles and builds
};
FRTStatus ProbeMethod(FSampleEngine& Engine, const FMethods& Methods, const FMethod& Method, const FMethodPreset& Preset, const FView& View,
    double Time, FMethodProbe& Out);
/// Returns how many frames of a path MeasureMethod plays at least. Frames after the light switch end with the answer, at best
/// after two.
uint32_t CountPathFrames(const FPathScript& Path);

/// Measures the live bytes of the device with all methods off (FMethods::Defaults), after frames of View.
FRTStatus MeasureBaseline(FSampleEngine& Engine, const FMethods& Methods, const FView& View, double Time, uint64_t& OutBytes);

/// The cost of one fact of the scene in a frame.
struct FFactCost
{
	std::string Fact; ///< "alpha tests"
	double FrameGpuMs = 0.0, WithoutGpuMs = 0.0;
};
struct FFactSettings
{
	FView View;
	double Time = 1.0;
	uint32_t Rounds = 3, FramesPerRound = 7, WarmUp = 2; ///< rounds alternate, so that a slow drift affects all alike
	double MaxSeconds = 0.0;                             ///< 0: as long as it takes
};
/// Measures frames of a method with and without each fact that the scene has. Facts are alpha tests (r.RT.AlphaTest), animation
/// (stopped time), local lights, sun and sky (removed from the scene). Each round alternates between all of them; the results are
/// medians over all rounds. Empty on a device without timestamps. TooLong: nothing is measured.
FRTStatus MeasureFacts(FSampleEngine& Engine, const FMethods& Methods, const FMethod* Method, const FMethodPreset* Preset,
    const FFactSettings& Settings, std::vector<FFactCost>& Out, EMeasureEnd& OutEnd);

} // namespace Lantern
