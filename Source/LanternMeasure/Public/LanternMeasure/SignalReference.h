// References of signals, cached on disk by content, so that any process traces a reference only once.
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
	uint32_t Samples = 256; ///< for Mean; A and B have half of them each, at least one
	uint32_t Bounces = 64;  ///< see FReferenceSettings
	uint32_t Seed = 0;
	bool bPixelCenters = true;   ///< see FReferenceSettings; real-time passes see only a pixel's centre
	bool bRasterSurfaces = true; ///< see FReferenceSettings
	/// Names changes to the scene that the cache key cannot see, such as edited buffers. The key sees objects, masks, materials,
	/// lights, sun and sky in FRTScene, the scene's file, and console variables without it.
	std::string StateKey;
	std::string CacheFolder; ///< created if missing; empty: no cache
	/// Gets how much is done (0 … 1), and the seconds left. May be empty.
	std::function<void(double Done, double SecondsLeft)> Progress;
};

struct FSignalReference
{
	/// Two images of independent samples. With R their mean, mean((F − A)(F − B) / (R² + 0.01)) is the relative squared error
	/// of F without the noise of the reference. The errors of A and B are uncorrelated and cancel on average.
	FImage A, B;
	FImage Mean;
	bool bFromCache = false;
	double Seconds = 0.0; ///< time that tracing took, now or when the cache file was written
};

/// Reads a reference from the cache, or traces it. Images have 1 or 3 channels, see GetSignalInfo. Equal description, scene and
/// shaders give equal images on one device; images from the cache are bit-equal. The cache key covers the content of the
/// scene, its state, the view, the samples, and the text of all shaders that take part. The state is time, sun, sky, lights,
/// objects, and the console variables that affect the reference. The key does not cover the device.
/// A damaged file is logged once and traced anew. A cache that cannot be written is logged once and ignored. Any number of
/// processes may use one folder. Errors are those of RenderReference. Call between frames.
FRTStatus GetSignalReference(FSampleEngine& Engine, const FSignalReferenceDesc& Desc, FSignalReference& Out);

/// Returns the file's name in CacheFolder.
std::string GetSignalReferenceFile(FSampleEngine& Engine, const FSignalReferenceDesc& Desc);

} // namespace Lantern
