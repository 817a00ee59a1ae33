// Path reservoirs: paths of pixels that light the pixels around them as well (Shaders/PathReservoirs/). They are launched as those of a
// brute-force pass (BruteForce/BruteForce.h).
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// The reservoirs of one frame.
struct FPathReservoirs
{
	FGraphBuffer Fresh; ///< FPathReservoir of each thread of the first launch, row by row
	IRTPipeline* Resolve = nullptr;
	bool IsValid() const { return Resolve != nullptr; }
};

constexpr const char* PathReservoirsDefine = "PATH_RESERVOIRS";
/// Adds what the shader of the paths is compiled with, and lists the shaders of the other passes. bSecondLobe: see FBruteForcePass::Second.
void AddPathReservoirShaders(EPixelRate Rate, bool bSecondLobe, FShaderDefines& InOutDefines, std::vector<FShaderSource>& OutCompute);

/// Threads: of the first launch. Invalid: shaders are being compiled.
FPathReservoirs MakePathReservoirs(FFrameContext& Context, EPixelRate Rate, bool bSecondLobe, uint64_t Threads);
/// Pixels up to which what a path meets is near, and lights the path's own pixel alone.
float GetNearPixels();
/// Adds the pass that lights pixels by what the paths have found. Second: of the second lobe; invalid: there is none.
void AddPathResolve(
    FFrameContext& Context, const FGBuffer& GBuffer, const FPathReservoirs& Reservoirs, FGraphTexture Output, FGraphTexture Second);

} // namespace Lantern
