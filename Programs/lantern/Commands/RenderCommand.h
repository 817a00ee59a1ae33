// lantern render and lantern reference.
#pragma once

#include "Options.h"

namespace Lantern
{

struct FRenderOptions
{
	FDeviceOptions Device;
	FPictureOptions Picture;
	/// 0: until what accumulates has settled. RunRender replaces it by the number of frames that it took.
	uint32_t Frames = 0;
	std::string Path; ///< a name that FindPath knows: the camera comes along it, and the last frame is at the view. Empty: it stands still
	bool bDumpGraph = false;
	std::string Explain; ///< X,Y of a pixel whose light is explained in the last frame; empty: none
};
int RunRender(FRenderOptions Options);

struct FReferenceOptions
{
	FDeviceOptions Device;
	FPictureOptions Picture;
	uint32_t Samples = 256;
	uint32_t Bounces = 64;
	std::string Signal = "frame"; ///< a name that FindSignal knows
	bool bPixelCenters = false;
	bool bRasterSurfaces = false;
	bool bResume = false;
	double SaveSeconds = 20.0;
};
int RunReference(FReferenceOptions Options);

} // namespace Lantern
