// One filter for all noisy signals. It accumulates over time where the surface was seen before, and estimates the variance that
// is left. It then smooths by that variance along surfaces. History is dropped where the signal has changed by more than noise
// explains, so that it follows shadows that move. The history of colours is clamped to the neighbourhood as well.
//
// Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering".
// Dammertz et al. 2010, "Edge-Avoiding À-Trous Wavelet Transform".
// Salvi 2016, "An Excursion in Temporal Supersampling".
//
// No value that is not a number lives on: signals, histories and guides are tested where they are loaded. What fails counts
// as missing.
#pragma once

#include "Denoise/DenoiseVariables.h"
#include "LanternCore/FrameGraph/History.h"
#include "LanternRenderer/Frame.h"
#include "PassTools.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

struct FDenoiseInputs
{
	const char* Name = ""; ///< names passes and histories; the same in all frames
	/// A pixel's mean over the frame's rays, with at least ShaderRead. R16_FLOAT: visibility, each ray's is 0 or 1.
	/// RGBA16_FLOAT: a colour, ≥ 0. Its fourth channel is 0 where the colour has no noise. It is 2 where the
	/// mean of other pixels stands for the pixel's own, which the filter takes only without a history. It is 3 where
	/// the value was chosen of many, which is noisy: its history lasts twice as long. It is 4 where nothing was asked of
	/// dim emitters in this frame, which says nothing of their light. Above 8, it is 8 plus the number of values of others that
	/// this one is worth, since it has more rays. It is 1 elsewhere.
	FGraphTexture Signal;
	/// For colours: the fourth channel is instead the standard deviation of the pixel's brightness, over that brightness. Negative: the
	/// pixel has no value. Neither changes are looked for then, nor is a history clamped.
	bool bKnownNoise = false;
	uint32_t RaysPerPixel = 1;          ///< for visibility
	EPixelRate Rate = EPixelRate::Full; ///< for colours: pixels that have a value of their own. Full may have such as well as others
	/// For visibility, R16_FLOAT: width in pixels of the transition between seen and unseen that the pixel lies in. 0: the
	/// pixel knows of none. Negative: the pixel has no value of its own, and Signal holds what stands in for it; the filter then takes
	/// the history, or the mean of what is around it. Invalid: as wide as can be.
	FGraphTexture Extent;
	/// For colours, R16_FLOAT: standard deviation of the wavelet's reach, in pixels; 0: the pixel does not say. Invalid: no limit.
	FGraphTexture Reach;
	/// For colours, RGBA16_FLOAT: by how much they are known to have changed since the last frame, and the standard deviation of the error
	/// in it. Negative: the history is to be given up. Invalid: nothing is known of a change.
	FGraphTexture Change;
	/// For colours, RG16_FLOAT: share of them, and radiance, that may have changed since the last frame, nobody knows how. Invalid: none.
	FGraphTexture ChangedShare;
	FShadowChanges Changes; ///< of the shadows of the sun or of lamps; what is not known is looked for in the signal
	/// For colours: what pixels show where that is not their surface, and Anchors of it. A valid Previous says that there is a history. The
	/// other members do not count. Invalid: FFrameContext::Surface, which is made where it is not there.
	FSurfaceTextures Surface;
	FHistoryTexture History; ///< what RequireDenoiseHistory gave in this frame; Current is invalid: nobody called it
};

/// Pictures of the filter's history for r.RT.Debug.View: FDenoiseInputs::Name, and one of these.
inline constexpr const char *ConfidencePicture = ".confidence", *ChangePicture = ".change";

/// Returns the least weight of a new frame in a mean over time, 0 to 1. Seconds.
float GetMinAlpha(float HistorySeconds, float DeltaSeconds);
/// The defines of shaders that ask Library/History.glsl for a surface's history, by planted faults.
FShaderDefines MakeValidationDefines();
/// Finds the history of a signal before it is filtered, for passes that read what was there before. Once a frame: FDenoiseInputs::History
/// hands it on. Its channels are those of FTemporalConstants. False: an error, which the context has.
bool RequireDenoiseHistory(FFrameContext& Context, const char* Name, FHistoryTexture& Out);
/// What the filter's shaders are made for.
struct FDenoiseForm
{
	bool bColor = false;                ///< three channels
	bool bExtent = false;               ///< FDenoiseInputs::Extent is valid
	bool bPair = false;                 ///< AddDenoisePair; colours only
	EPixelRate Rate = EPixelRate::Full; ///< FDenoiseInputs::Rate
	bool bKnownNoise = false;           ///< FDenoiseInputs::bKnownNoise
	bool bSparse = false;               ///< FDenoiseInputs::Surface is valid: most tiles of the screen may show nothing
	bool bReach = false;                ///< FDenoiseInputs::Reach is valid
};
/// Lists the compute shaders of the filter.
void ListDenoiseShaders(const FDenoiseForm& Form, const FDenoiseSettings& Settings, std::vector<FShaderSource>& Out);

/// Whether they are there, for passes in front of the filter that keep something for the next frame's.
bool AreDenoiseShadersReady(const FFrameContext& Context, const FDenoiseForm& Form, const FDenoiseSettings& Settings);

/// Returns the filtered signal, of Signal's description. Pixels without a surface keep their value. Passes are named
/// "<Name>Temporal" and "<Name>Filter<I>". Signals share the passes "Surface" and, if the host gives no motion,
/// "CameraMotion". Returns Signal while shaders are being compiled, and on an error, which the context then has. Histories then
/// start anew.
FGraphTexture AddDenoise(FFrameContext& Context, const FGBuffer& GBuffer, const FDenoiseInputs& Inputs, const FDenoiseSettings& Settings);
/// Filters two colours of one surface in the passes of one, named by the first. Neither changes the other.
FLobes AddDenoisePair(FFrameContext& Context, const FGBuffer& GBuffer, const FDenoiseInputs& Diffuse, const FDenoiseInputs& Specular,
    const FDenoiseSettings& Settings);
/// Filters by a signal's console variables.
inline FGraphTexture AddDenoise(
    FFrameContext& Context, const FGBuffer& GBuffer, const FDenoiseInputs& Inputs, const FDenoiseVariables& Variables)
{
	return AddDenoise(Context, GBuffer, Inputs, Variables.Get());
}

} // namespace Lantern
