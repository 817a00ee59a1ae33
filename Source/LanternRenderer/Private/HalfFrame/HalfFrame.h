// The frame with one pixel for each 2×2, for signals that look the same at a quarter of the cost. They add their passes to its context, and
// their results are brought back to all pixels. The frame's own signals know nothing of it.
//
//   if (!IsWanted() || !AreHalfFrameShadersReady(Context, true)) { return AddMyPasses(Context, GBuffer); }
//   FHalfFrame* const Half = RequireHalfFrame(Context, GBuffer);
//   return Half ? AddUpsample(Context, GBuffer, "MyPassUpsample", AddMyPasses(Half->Context, Half->GBuffer)) : FLobes();
#pragma once

#include "PassTools.h"

namespace Lantern
{

struct FHalfFrame
{
	FFrameContext Context; ///< has its own view, histories and pixels, and shares the world; passes may keep its address
	FGBuffer GBuffer;      ///< without Emissive; BaseColor is RGBA16_FLOAT
	FView PreviousView;    ///< see FFrameContext::PreviousView
	FUploadSlice ViewConstants;
};

/// Whether its shaders are there. Until then signals go on in the whole frame. bPair: AddUpsample gets two signals.
bool AreHalfFrameShadersReady(const FFrameContext& Context, bool bPair);

/// Returns the half frame, made with the first call. Context: of the whole frame, whose caches of the world passes of the half frame share:
/// those that they look up are asked for before. Null: an error, which the context has, or AreHalfFrameShadersReady is false.
FHalfFrame* RequireHalfFrame(FFrameContext& Context, const FGBuffer& GBuffer);

/// Returns the view of a half frame: its first pixel's centre is that of View's first pixel.
FView MakeHalfView(const FView& View);

/// Writes what shaders read of the half frame's view, once the frame is recorded. FrameIndex: FViewConstants::FrameIndex of the whole frame.
void WriteHalfConstants(const FHalfFrame& Half, uint32_t FrameIndex);

/// Returns signals of the half frame for all pixels. Name: of the pass. Either may be invalid, and is then returned as it is. GBuffer: of the
/// whole frame.
FLobes AddUpsample(FFrameContext& Context, const FGBuffer& GBuffer, const char* Name, const FLobes& Lobes);

/// Lists the compute shaders of both. bPair: AddUpsample gets two signals.
void ListHalfFrameShaders(const FSceneFacts& Facts, bool bPair, std::vector<FShaderSource>& Out);

} // namespace Lantern
