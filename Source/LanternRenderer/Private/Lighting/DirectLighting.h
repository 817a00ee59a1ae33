// Our own composite, for hosts that have none.
#pragma once

#include "LanternRenderer/Frame.h"

namespace Lantern
{

/// Returns whether the composite has light of lights other than the sun (r.RT.LocalLights).
bool HasLocalLight();

/// Returns whether the composite has ambient light of the sky (r.RT.SkyAmbient), which ambient occlusion darkens.
bool HasSkyAmbient(const FSceneFacts& Facts);

/// Makes the source of the composite's shader.
FShaderSource MakeLightingSource(FSceneFacts Facts);

/// The composite's inputs by what they mean for light, whichever pass made them.
struct FDirectLightingInputs
{
	FGBuffer GBuffer;
	FGraphTexture SunVisibility;    ///< invalid: the sun is unshadowed
	FGraphTexture SkyVisibility;    ///< invalid: the sky is unoccluded
	FGraphTexture IndirectDiffuse;  ///< invalid: the sky's ambient light stands in
	FGraphTexture IndirectSpecular; ///< invalid: nothing is traced, and what follows stands in
	FGraphTexture IndirectRough;    ///< over the lobe's albedo, where IndirectSpecular is not traced; invalid: the sky's light stands in
	/// Shadowed light of local lights over the albedo of each lobe. Invalid: they are unshadowed.
	FGraphTexture LightsDiffuse, LightsSpecular;
};
/// Adds direct light, emission and indirect light. Returns linear radiance, RGBA32_FLOAT. Invalid: its shader is
/// being compiled, or an error, which the context then has.
FGraphTexture AddDirectLightingPass(FFrameContext& Context, const FDirectLightingInputs& Inputs);

} // namespace Lantern
