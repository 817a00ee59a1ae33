// The frame's passes, in order: see Frame.cpp.
#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// What the host's raster gives.
struct FGBuffer
{
	FGraphTexture Depth;     ///< D32, reversed: near / distance along the view; 0: sky
	FGraphTexture Normals;   ///< RGBA16_SNORM: shading and geometric normal, octahedral, towards the camera
	FGraphTexture BaseColor; ///< RGBA8_SRGB: base colour, a: metalness
	FGraphTexture Material;  ///< RGBA8_UNORM: roughness, occlusion, sqrt(F0) of the dielectric, specular weight
	FGraphTexture Emissive;  ///< any float format: nits
};

/// What the plugin gives. A texture is invalid where the scene has no use for it.
struct FSunShadowOutputs
{
	FGraphTexture Visibility; ///< R16_FLOAT: fraction of the sun's disk that is seen
	/// Distance to what hides the sun, for a denoiser. Not made yet: always invalid.
	FGraphTexture OccluderDistance;
};

struct FFrameOutputs
{
	FSunShadowOutputs SunShadow;
	FGraphTexture Lighting; ///< RGBA32_FLOAT, linear radiance
	FGraphTexture Display;  ///< RGBA8_UNORM, tone-mapped, sRGB-encoded
};

struct FSunShadowInputs
{
	FGraphTexture Depth, Normals; ///< as in FGBuffer
};
/// Invalid outputs: no sun, or shadows are off.
FSunShadowOutputs AddSunShadowPass(FFrameContext& Context, const FSunShadowInputs& Inputs);

struct FDirectLightingInputs
{
	FGBuffer GBuffer;
	FGraphTexture SunShadow; ///< may be invalid: unshadowed
};
FGraphTexture AddDirectLightingPass(FFrameContext& Context, const FDirectLightingInputs& Inputs);

FGraphTexture AddToneMapPass(FFrameContext& Context, FGraphTexture Radiance);

/// All of it. The host may use SunShadow alone and light by itself: passes whose results it does not read are culled.
FFrameOutputs AddFramePasses(FFrameContext& Context, const FGBuffer& GBuffer);

/// Which path sun shadows take this frame.
enum class ESunShadowPath : uint8_t { None, Pipeline, Query };
ESunShadowPath ChooseSunShadowPath(const FRTCapabilities& Capabilities, const FSceneFacts& Facts);

struct FReferencePassInputs
{
	FGraphBuffer Sum; ///< vec4[Width · Height]: sums of radiance, and of samples in w
	uint32_t FirstSample = 0, SampleCount = 1;
	uint32_t MaxBounces = 0; ///< 0: directly seen light only
	uint32_t FirstRow = 0, RowCount = 0;
};
void AddReferencePass(FFrameContext& Context, const FReferencePassInputs& Inputs);

} // namespace Lantern
