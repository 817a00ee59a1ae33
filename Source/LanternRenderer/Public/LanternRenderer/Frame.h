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
	/// RGBA32_FLOAT. xy: from the pixel's centre to where its surface was in the frame before, in pixels; z: how far it was
	/// along the view then, metres; w: its object's index + 1, 0: unknown. What was behind the camera then points off the
	/// screen, with z = 0. Where depth is 0 nothing is read. Invalid: the host has none, and what moves is taken for still.
	FGraphTexture Motion;
};

/// What the plugin gives. A texture is invalid where the scene has no use for it.
struct FSunShadowOutputs
{
	FGraphTexture Visibility; ///< R16_FLOAT: fraction of the sun's disk that is seen
};

struct FAmbientOcclusionOutputs
{
	/// R16_FLOAT: cosine-weighted fraction of the hemisphere about the shading normal in which nothing is within
	/// r.RT.AO.Radius; what is there counts less the farther away it is.
	FGraphTexture Visibility;
};

struct FDiffuseGIOutputs
{
	/// RGBA16_FLOAT: indirect irradiance / π, about the shading normal: all light that arrives but that of the sun's disk and
	/// of punctual lights, which direct lighting has. Sky and emissive surfaces are in it. A direction below the geometric
	/// surface brings nothing. Sky pixels: 0.
	FGraphTexture Radiance;
};

struct FReflectionOutputs
{
	/// RGBA16_FLOAT: what the surface's specular lobe reflects towards the camera (Fresnel included), of the same light. A
	/// mirror (roughness² < 0.001) is a delta. a: 1, or 0 where the surface is rougher than r.RT.Reflections.MaxRoughness;
	/// there rgb is what it would reflect of an unoccluded sky. Sky pixels: 0.
	FGraphTexture Radiance;
};

struct FFrameOutputs
{
	FSunShadowOutputs SunShadow;
	FAmbientOcclusionOutputs AmbientOcclusion;
	FDiffuseGIOutputs DiffuseGI;
	FReflectionOutputs Reflections;
	FGraphTexture Lighting; ///< RGBA32_FLOAT, linear radiance
	FGraphTexture Display;  ///< RGBA8_UNORM, tone-mapped, sRGB-encoded
};

struct FSunShadowInputs
{
	FGraphTexture Depth, Normals; ///< as in FGBuffer
	FGraphTexture Motion;         ///< as in FGBuffer; may be invalid
};
/// Invalid outputs: no sun, or shadows are off.
FSunShadowOutputs AddSunShadowPass(FFrameContext& Context, const FSunShadowInputs& Inputs);

/// The same of the other signals. All take what they need of the G-buffer, and give invalid outputs where they are off,
/// where the scene has nothing for them, or while their shaders are being compiled.
FAmbientOcclusionOutputs AddAmbientOcclusionPass(FFrameContext& Context, const FGBuffer& GBuffer);
FDiffuseGIOutputs AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer);
FReflectionOutputs AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer);

struct FDirectLightingInputs
{
	FGBuffer GBuffer;
	FGraphTexture SunShadow;        ///< may be invalid: unshadowed
	FGraphTexture AmbientOcclusion; ///< may be invalid: the sky is unoccluded
	FGraphTexture DiffuseGI;        ///< may be invalid: then the sky's ambient light stands in
	FGraphTexture Reflections;      ///< may be invalid: the same
};
FGraphTexture AddDirectLightingPass(FFrameContext& Context, const FDirectLightingInputs& Inputs);

FGraphTexture AddToneMapPass(FFrameContext& Context, FGraphTexture Radiance);

/// Motion of a world that stands still, from depth alone, as FGBuffer::Motion has it but for w = 0.
FGraphTexture AddCameraMotionPass(FFrameContext& Context, FGraphTexture Depth);

/// All of it. The host may use SunShadow alone and light by itself: passes whose results it does not read are culled.
FFrameOutputs AddFramePasses(FFrameContext& Context, const FGBuffer& GBuffer);

enum class ERayPath : uint8_t
{
	None,
	Pipeline,
	Query
};
using ESunShadowPath = ERayPath;
/// Which path sun shadows take this frame.
ERayPath ChooseSunShadowPath(const FRTCapabilities& Capabilities, const FSceneFacts& Facts);
/// The same of ambient occlusion. None where nothing uses it: no ambient light of the sky, or diffuse global illumination
/// instead of it (bDiffuseGI: its rays are ready, not merely wanted), and nobody asks.
ERayPath ChooseAmbientOcclusionPath(
    const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FSignalRequests& Requests, bool bDiffuseGI);

struct FReferencePassInputs
{
	FGraphBuffer Sum; ///< vec4[Width · Height]: sums of radiance, and of samples in w
	uint32_t FirstSample = 0, SampleCount = 1;
	uint32_t MaxBounces = 0; ///< 0: directly seen light only
	uint32_t FirstRow = 0, RowCount = 0;
	bool bPixelCenters = false; ///< camera rays through pixel centres, as the G-buffer has them; else all over the pixel
	FGBuffer GBuffer;           ///< with FFrameFeatures::bReferenceFromGBuffer
};
/// Of the signal that the frame began with, FFrameFeatures::ReferenceSignal, as the outputs above define it: a grey one is
/// in all three channels. Sky: visibilities are 1, radiances 0.
void AddReferencePass(FFrameContext& Context, const FReferencePassInputs& Inputs);

} // namespace Lantern
