// The frame with one pixel for each 2×2, for signals that look the same at a quarter of the cost. They add their passes to its context, and
// their results are brought back to all pixels. The frame's own signals know nothing of it.
//
//   FHalfFrame* const Half = RequireHalfFrame(Context, GBuffer);
//   if (!Half) { return {}; }
//   FLobes Lobes = AddMyPasses(Half->Context, Half->GBuffer);
//   return AddUpsample(Context, GBuffer, "MyPass", Lobes);
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Shaders that run for the half frame alone, and would reach beyond what the whole one has, are compiled with it.
inline constexpr const char* HalfFrameDefine = "HALF_FRAME";

struct FHalfFrame
{
	FFrameContext Context; ///< has its own view, histories and pixels, and shares the world; passes may keep its address
	FGBuffer GBuffer;      ///< without Emissive; BaseColor is RGBA16_FLOAT
	FView PreviousView;    ///< see FFrameContext::PreviousView
	FUploadSlice ViewConstants;
};

/// Returns the half frame, made with the first call, and asks for the whole frame's light cells. Context: of the whole frame. Null: its shader is being compiled, or an error, which the
/// context then has.
FHalfFrame* RequireHalfFrame(FFrameContext& Context, const FGBuffer& GBuffer);

/// Returns the view of a half frame: its first pixel's centre is that of View's first pixel.
FView MakeHalfView(const FView& View);

/// Writes what shaders read of the half frame's view, once the frame is recorded. FrameIndex: FViewConstants::FrameIndex of the whole frame.
void WriteHalfConstants(const FHalfFrame& Half, uint32_t FrameIndex);

/// Returns signals of the half frame for all pixels. Name: the pass's, with "Upsample". Either may be invalid, and is then returned as it is.
/// GBuffer: of the whole frame. Invalid: shaders are being compiled.
FLobes AddUpsample(FFrameContext& Context, const FGBuffer& GBuffer, const char* Name, const FLobes& Lobes);

/// Lists the compute shaders of both. bPair: AddUpsample gets two signals.
void ListHalfFrameShaders(bool bPair, std::vector<FShaderSource>& Out);

} // namespace Lantern
