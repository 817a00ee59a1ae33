// Drives the reference path tracer: many dispatches that add up, each short enough to leave the device responsive.
#pragma once

#include <functional>
#include <string>

#include "LanternHost/Image.h"
#include "LanternHost/SampleEngine.h"

namespace Lantern
{

struct FReferenceSettings
{
	FView View;
	double Time = 0.0;
	uint32_t Samples = 256;
	/// Scattering events, at most; Russian roulette ends most paths earlier. 0: directly seen light only.
	uint32_t Bounces = 64;
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
	FImage Radiance; ///< mean of the samples
	uint64_t Paths = 0; ///< traced in this run
	double Seconds = 0.0;
	uint32_t Samples = 0;        ///< in the picture; more than asked for where the state had more
	uint32_t ResumedSamples = 0; ///< of them, from the state
};

/// The same settings and seed give the same image, bit for bit on the same device, however it was interrupted.
/// A state file of other settings is an error (InvalidArgument) that says so; it is not overwritten.
FRTStatus RenderReference(FSampleEngine& Engine, const FReferenceSettings& Settings, FReferenceResult& Out);

} // namespace Lantern
