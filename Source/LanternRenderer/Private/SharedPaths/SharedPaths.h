// Shared paths: paths of pixels that light the pixels around them as well (Shaders/SharedPaths/). They are launched as those of a
// brute-force pass (BruteForce/BruteForce.h).
#pragma once

#include "PassTools.h"
#include "PathReservoirs/PathReservoirs.h"

namespace Lantern
{

/// Those of one frame.
struct FSharedPaths
{
	FGraphBuffer Fresh;                ///< FSharedPath of each thread of the first launch, row by row
	FPathReservoirsOfFrame Reservoirs; ///< invalid: paths are not resampled
	IRTPipeline* Resolve = nullptr;
	bool IsValid() const { return Resolve != nullptr; }
};

constexpr const char* SharedPathsDefine = "SHARED_PATHS";
/// Adds what the shader of the paths is compiled with, and lists the shaders of the other passes. bSecondLobe: see FBruteForcePass::Second.
void AddSharedPathShaders(
    const FSceneFacts& Facts, EPixelRate Rate, bool bSecondLobe, FShaderDefines& InOutDefines, std::vector<FShaderSource>& OutCompute);

/// Width, Height: of the first launch, threads. Invalid: shaders are being compiled, or there is no memory.
/// bBothSides: the first launch has BackPixelsDefine.
FSharedPaths MakeSharedPaths(FFrameContext& Context, EPixelRate Rate, bool bSecondLobe, bool bBothSides, uint32_t Width, uint32_t Height);
/// Pixels up to which what a path meets is near, and lights the path's own pixel alone.
float GetNearPixels(const FFrameContext& Context);
/// Adds the pass that lights pixels by what the paths have found. Second: of the second lobe; invalid: there is none. Returns FPathChange of
/// each tile; invalid: nothing has changed for long.
FGraphBuffer AddPathResolve(
    FFrameContext& Context, const FGBuffer& GBuffer, const FSharedPaths& Shared, FGraphTexture Output, FGraphTexture Second);

} // namespace Lantern
