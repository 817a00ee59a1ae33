// References of signals, kept on disk by content: what was traced once is read the next time, by whichever process.
#pragma once

#include <functional>
#include <string>

#include "LanternHost/SampleEngine.h"
#include "LanternImage/Image.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

struct FSignalReferenceDesc
{
	FView View; ///< FrameIndex, Seed, Exposure, DeltaSeconds and bCut change nothing
	double Time = 0.0;
	ESignal Signal = ESignal::Frame;
	uint32_t Samples = 256; ///< of Mean; each half has half of them, at least one
	uint32_t Bounces = 64;  ///< see FReferenceSettings
	uint32_t Seed = 0;
	bool bPixelCenters = true;   ///< see FReferenceSettings: real-time passes see no more of a pixel than its centre
	bool bRasterSurfaces = true; ///< see FReferenceSettings; ignored for ESignal::Frame
	/// Names what a script changed in the scene that neither its file nor the console variables say. Objects moved, masks,
	/// materials, lights, sun and sky as they stand in FRTScene are seen without it; buffers that were edited are not.
	std::string StateKey;
	std::string CacheFolder; ///< made if need be; empty: nothing is kept
	/// How much is done (0 … 1), and seconds left. May be empty.
	std::function<void(double Done, double SecondsLeft)> Progress;
};

struct FSignalReference
{
	/// Of independent samples. With R their mean, mean((F − A)(F − B) / (R² + 0.01)) is the relative squared error of F
	/// without the references' own noise in it: the errors of A and B are uncorrelated and cancel on average.
	FImage A, B;
	FImage Mean;
	bool bFromCache = false;
	double Seconds = 0.0; ///< that it took to trace, here or when it was
};

/// The signal as GetSignalInfo has it: 1 or 3 channels. The same description, scene and shaders give the same images on the
/// same device, from the cache bit for bit. What is in the cache was traced with the same content of the scene, state (time,
/// sun, sky, lights, objects, console variables that reach the reference), view, samples and text of all shaders that take
/// part; on which device is not asked. Damaged files are traced anew, said once; a cache that cannot be written is said once
/// and does without. Any number of processes may use the same folder. Errors: as RenderReference. Between frames.
FRTStatus GetSignalReference(FSampleEngine& Engine, const FSignalReferenceDesc& Desc, FSignalReference& Out);

/// Name of the file in CacheFolder.
std::string GetSignalReferenceFile(FSampleEngine& Engine, const FSignalReferenceDesc& Desc);

} // namespace Lantern
