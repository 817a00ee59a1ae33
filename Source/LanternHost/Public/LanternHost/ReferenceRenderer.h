// Drives the reference path tracer: many dispatches that add up, each short enough to leave the device responsive.
#pragma once

#include <functional>
#include <string>

#include "LanternHost/SampleEngine.h"
#include "LanternImage/Image.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

struct FReferenceSettings
{
	FView View;
	double Time = 0.0;
	uint32_t Samples = 256;
	/// Scattering events, at most, that at the first surface included; Russian roulette ends most paths earlier. 0: directly
	/// seen light only.
	uint32_t Bounces = 64;
	ESignal Signal = ESignal::Frame;
	/// Camera rays through pixel centres, without antialiasing: what real-time passes shade, and so what they are compared
	/// with.
	bool bPixelCenters = false;
	/// The signal at the surfaces that the raster saw, which are those that real-time passes have: what then differs is what
	/// they make of them, not which leaf a pixel shows. Implies pixel centres. Ignored for ESignal::Frame.
	bool bRasterSurfaces = false;
	/// File that holds the sums between runs; empty: none. Written every StateSeconds and at the end.
	std::string StateFile;
	double StateSeconds = 20.0;
	bool bResume = false; ///< start from StateFile if it fits these settings
	/// All that the picture depends on beside the settings above (scene, lights, console variables).
	std::string SceneKey;
	/// Samples done so far, of how many, and seconds left. May be empty.
	std::function<void(double Done, uint32_t Total, double SecondsLeft)> Progress;
};

struct FReferenceResult
{
	FImage Radiance;    ///< mean of the samples; channels as GetSignalInfo says
	uint64_t Paths = 0; ///< traced in this run
	double Seconds = 0.0;
	uint32_t Samples = 0;        ///< in the picture; more than asked for where the state had more
	uint32_t ResumedSamples = 0; ///< of them, from the state
};

/// Different seeds give independent samples. The same settings and seed give the same image, bit for bit on the same device, however it was interrupted.
/// A state file of other settings is an error (InvalidArgument) that says so; it is not overwritten.
FRTStatus RenderReference(FSampleEngine& Engine, const FReferenceSettings& Settings, FReferenceResult& Out);

} // namespace Lantern
