// Path reservoirs: shared paths (SharedPaths/SharedPaths.h) that pixels keep from frame to frame, and take over from pixels around.
#pragma once

#include "TwoFrames.h"

namespace Lantern
{

/// Those of one frame.
struct FPathReservoirsOfFrame
{
	FTwoFrames Kept; ///< FPathReservoir of each thread, row by row
	FUploadSlice Constants;
	bool IsValid() const { return Kept.Buffer.IsValid(); }
};

constexpr const char* PathReservoirsDefine = "PATH_RESERVOIRS";
/// Whether paths that are shared are resampled.
bool AreReservoirsWanted();
/// Returns the rays of a path that is resampled, beside its own.
uint32_t GetMostReservoirRays();
/// Adds what the shader of the paths is compiled with.
void AddPathReservoirDefines(FShaderDefines& InOut);
/// Width, Height: of the launch of paths, threads. Invalid: there is no memory, which the context then has as an error.
FPathReservoirsOfFrame MakePathReservoirs(FFrameContext& Context, uint32_t Width, uint32_t Height);
void DeclarePathReservoirs(FPassBuilder& Builder, const FPathReservoirsOfFrame& Reservoirs);
/// Returns FPathReservoirs' address. 0: there are none.
FAddress WritePathReservoirs(FPassContext& Pass, const FFrameContext& Frame, const FPathReservoirsOfFrame& Reservoirs);

} // namespace Lantern
