// Drives the reference path tracer. It accumulates many dispatches, each short enough to keep the device responsive.
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
	/// Maximum of scattering events, including the one at the first surface. Russian roulette ends most paths earlier. 0:
	/// directly visible light only.
	uint32_t Bounces = 64;
	ESignal Signal = ESignal::Frame;
	/// Traces camera rays through pixel centres, without antialiasing. Real-time passes shade pixel centres, so that only this
	/// is comparable with them.
	bool bPixelCenters = false;
	/// Takes the signal at the surfaces of the raster, as real-time passes do. Differences then come from the method, not from
	/// which leaf a pixel shows, nor from how its texture is filtered. Implies pixel centres. Only these surfaces know their objects: diffuse
	/// global illumination of others, and the whole frame, know no toon styles.
	bool bRasterSurfaces = false;
	/// File that keeps the sums between runs; empty: none. It is written every StateSeconds and at the end.
	std::string StateFile;
	double StateSeconds = 20.0;
	bool bResume = false; ///< start from StateFile if it fits these settings
	/// Names everything else that the picture depends on (scene, lights, console variables).
	std::string SceneKey;
	/// Gets the samples done, their total, and the seconds left. May be empty.
	std::function<void(double Done, uint32_t Total, double SecondsLeft)> Progress;
};

struct FReferenceResult
{
	FImage Radiance;    ///< mean of the samples; see GetSignalInfo for the channels
	uint64_t Paths = 0; ///< traced in this run
	double Seconds = 0.0;
	uint32_t Samples = 0;        ///< in the picture; more than requested if the state had more
	uint32_t ResumedSamples = 0; ///< samples that came from the state
};

/// Renders a reference. Different seeds give independent samples. Equal settings and seed give bit-equal images on one device,
/// even after interruptions. A state file of other settings gives InvalidArgument and is not overwritten.
FRTStatus RenderReference(FSampleEngine& Engine, const FReferenceSettings& Settings, FReferenceResult& Out);

} // namespace Lantern
