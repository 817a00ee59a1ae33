// Guides rays of indirect light to where earlier rays of the neighbourhood found light (Shaders/Rays/PathGuide.glsl).
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// What a frame's paths follow, and what they leave for the next frame's.
struct FPathGuide
{
	FGraphBuffer Tiles;   ///< two times FPathGuideTile[], of this frame and of the one before; invalid: paths are not guided
	FGraphBuffer Records; ///< uint[], see FPathGuideConstants
	uint64_t Offset = 0;  ///< of this frame's tiles, bytes
	uint64_t PreviousOffset = 0;
	bool bPrevious = false; ///< the frame before has left tiles
	IRTPipeline* Update = nullptr;
	bool IsValid() const { return Tiles.IsValid(); }
};

constexpr const char* GuidedPathsDefine = "GUIDED_PATHS"; ///< of shaders whose paths are guided
/// Adds the defines of shaders whose paths are guided, and lists the pass that keeps the guide.
void AddPathGuideDefines(EPixelRate Rate, FPassRays& InOut);

/// Threads: of the launch, each of which writes a record. Invalid: shaders are being compiled, or an error, which the context has.
FPathGuide MakePathGuide(FFrameContext& Context, EPixelRate Rate, uint64_t Threads);
/// Declares what launches use.
void DeclareGuidedPaths(FPassBuilder& Builder, const FPathGuide& Guide);
/// Returns the address of the tiles that paths follow; 0: there are none.
FAddress GetGuideTiles(FPassContext& Pass, const FPathGuide& Guide);
/// After all launches.
void AddPathGuideUpdate(FFrameContext& Context, const FGBuffer& GBuffer, const FPathGuide& Guide);

} // namespace Lantern
