// Fewer sun rays where they tell nothing new. Of pixels that had one answer for SETTLED_FRAMES frames, a quarter is traced, in turn. One that disagrees sends the rest of its tile to a second queue of the same frame.
#pragma once

#include "Denoise/SurfaceHistory.h"
#include "LanternCore/FrameGraph/History.h"
#include "LanternScene/Memory/Upload.h"
#include "Rays/RayQueue.h"
#include "SettledTypes.h"

namespace Lantern
{

/// How frames of these settings leave out rays if they can.
struct FSunRates
{
	bool bAdaptive = false;      ///< where they tell nothing new
	float DistanceMetres = 0.0f; ///< from which on fewer pixels are traced; 0: all are
	bool IsAny() const { return bAdaptive || DistanceMetres > 0.0f; }
};

/// Of one frame.
struct FSettledTiles
{
	FSunRates Rates;       ///< shaders have MakeSettledDefines of them
	FHistoryTexture Known; ///< R8_UNORM, see SettledTypes.h. Current is invalid: nothing is known of any pixel
	FUploadSlice Constants;
	FSettledConstants Values{};
	bool IsUsed() const { return Constants.Address != 0; }
};

/// bMayFilter: the signal is accumulated over frames, if the sun is no point.
FSunRates GetSunRates(bool bMayFilter);
/// The defines of shaders that take part, of which a frame may make no use all the same.
FShaderDefines MakeSettledDefines(const FSunRates& Rates);
void ListSettledShaders(std::vector<FShaderSource>& Out);

/// Finds what the frame before knew, and what has changed since. Unused: shaders are being compiled, or an error, which the context
/// then has. bFiltered: the signal is accumulated over frames; without that nothing is known of a pixel.
FSettledTiles FindSettledTiles(
    FFrameContext& Context, const FGBuffer& GBuffer, const FSunRays& Sun, const FSunRates& Rates, bool bFiltered);
/// Declares what Tiles/Settled.glsl reads and writes.
void DeclareSettled(FPassBuilder& Builder, const FFrameContext& Context, const FSettledTiles& Settled);
/// Returns FTilesConstants::Settled, in the pass that declared it. 0: unused.
FAddress WriteSettled(FPassContext& Pass, const FFrameContext& Context, const FSettledTiles& Settled);
/// Adds the passes that trace the rest of tiles in which a ray of the first queue disagrees. Behind the pass that traces Queue.
void AddSettledRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FQueuedRays& Rays, FGraphBuffer Tiles, const FSettledTiles& Settled);

} // namespace Lantern
