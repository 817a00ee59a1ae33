// lantern render and lantern reference.
#pragma once

#include "Options.h"

namespace Lantern
{

struct FRenderOptions
{
	FDeviceOptions Device;
	FPictureOptions Picture;
	uint32_t Frames = 1;
	bool bDumpGraph = false;
};
int RunRender(const FRenderOptions& Options);

struct FReferenceOptions
{
	FDeviceOptions Device;
	FPictureOptions Picture;
	uint32_t Samples = 256;
	uint32_t Bounces = 64;
	std::string Signal = "frame"; ///< a name that FindSignal knows
	bool bPixelCenters = false;
	bool bResume = false;
	double SaveSeconds = 20.0;
};
int RunReference(const FReferenceOptions& Options);

} // namespace Lantern
