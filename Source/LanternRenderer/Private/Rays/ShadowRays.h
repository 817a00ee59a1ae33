// The shadow rays of a frame. All signals of it that want some share one queue and one trace, whichever of them is added first. Those of the
// half frame have a queue of their own.
#pragma once

#include <optional>

#include "Tiles/HostShadow.h"
#include "Tiles/MovedCasters.h"
#include "Tiles/SettledTiles.h"

namespace Lantern
{

/// The filter of the lobe whose history says who has more rays.
struct FMoreRaysFilter
{
	const char* Name = ""; ///< FDenoiseInputs::Name
	float MinAlpha = 1.0f; ///< GetMinAlpha
};

/// Rays towards lights other than the sun.
struct FLocalRays
{
	uint32_t Exact = 0;                  ///< most lights of a tile that all get rays, 1 to 8
	uint32_t PerPixel = 0;               ///< most rays of a pixel
	bool bMany = false;                  ///< tiles may have more; each of their pixels chooses one
	std::optional<FMoreRaysFilter> More; ///< empty: no pixel has more rays
};

/// What signals ask for in one frame.
struct FShadowRayWishes
{
	FSunRays Sun;
	bool bSunWidths = false; ///< FRayQueue::SunWidths
	FSunRates SunRates;
	uint32_t MoreSunRays = 0;       ///< of a pixel, where its first one cannot tell
	bool bSunFiltered = false;      ///< what becomes of the sun's rays is accumulated over frames
	const char* SunFilterName = ""; ///< its FDenoiseInputs::Name
	std::optional<FLocalRays> Local;
};

/// Buffers of one frame, after the rays.
struct FShadowRays
{
	FRayQueue Queue;
	FGraphBuffer Tiles; ///< FTile[]; invalid: nobody asks for the sun
	FSunRays Sun;
	FShadowChanges Changes;       ///< of the sun's shadows, if they are filtered
	FHistoryTexture SunHistory;   ///< FDenoiseInputs::History of sun shadows, if passes before the filter read it
	FHistoryTexture LocalHistory; ///< and of the lobe of FLocalRays::More
	FSettledTiles Settled;
	FHostShadowMap Map; ///< what it holds is left to it
	FQueuedRays Traced;
};

/// Adds the passes of the frame's shadow rays with the first call, and returns what they fill. Each signal is asked whose row has
/// FSignalPass::AskShadowRays, and FSignalPass::IsHalf as the context. Null: nobody wants any, or shaders are being compiled, or an error,
/// which the context then has.
const FShadowRays* RequireShadowRays(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
