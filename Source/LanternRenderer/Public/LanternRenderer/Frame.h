// The frame's passes: Frame.cpp has them in order.
#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// The host's G-buffer.
struct FGBuffer
{
	FGraphTexture Depth;     ///< D32, reversed: near / distance along the view; 0: sky
	FGraphTexture Normals;   ///< RGBA16_SNORM: shading and geometric normal, octahedral, towards the camera
	FGraphTexture BaseColor; ///< RGBA8_SRGB: base colour, a: metalness
	FGraphTexture Material;  ///< RGBA8_UNORM: roughness, occlusion, sqrt(F0) of the dielectric, specular weight
	FGraphTexture Emissive;  ///< any float format: nits
	/// RGBA32_FLOAT motion vectors.
	/// - xy: offset from the pixel's centre to where its surface was in the frame before, in pixels.
	/// - z: distance along the view then, in metres.
	/// - w: with bNamesObjects, index of the object + 1; else a number of the host's. 0: unknown.
	///
	/// A surface that was behind the camera points off the
	/// screen, with z = 0. Pixels with depth 0 are not read. Invalid: the host has none, and moving objects count as still.
	FGraphTexture Motion;
	bool bNamesObjects = false; ///< see Motion
	/// RGBA8_SRGB: rgb albedo for light that arrives on the other side (FBrdf::BackAlbedo), a: share that the front's diffuse albedo has lost
	/// to it. The lowest bit of w of Normals then says where rgb is not 0. Invalid: nowhere.
	FGraphTexture BackAlbedo;
	/// R8_UNORM: what the pixel shows, CLASS_… (SceneTypes.h) over 255. Invalid: with bNamesObjects, a pixel has the class of the
	/// object that Motion names, and without it none.
	FGraphTexture Classes;
	/// R8_UNORM: channels of the pixel's object (FRTObjectTraits) over 255. Invalid: as without Classes, and CHANNELS_DEFAULT for none.
	FGraphTexture Channels;
	/// R8_UNORM: numbers of toon styles (FToonStyle) over 255; 0: none. Invalid: with bNamesObjects, a pixel has the style of the object that
	/// Motion names, and without it none.
	FGraphTexture ToonNumbers;
	glm::uvec2 ClassesOffset{0}; ///< of the view in Classes, Channels and ToonNumbers, pixels, below 65,536
};

/// What a frame made. A texture is invalid if the scene has no use for it, if it is off, or if its shaders are being compiled.
struct FFrameOutputs
{
	std::array<FGraphTexture, SignalCount> Signals; ///< as FSignalInfo says; that of ESignal::Frame is Lighting
	FGraphTexture Lighting;                         ///< RGBA32_FLOAT, linear radiance
	FGraphTexture Display;                          ///< RGBA8_UNORM, tone-mapped, sRGB-encoded
	FFogAtlas Fog;                                  ///< with FSignalRequests::bFog
	FLightMask LightMask;                           ///< with FSignalRequests::bLightMask
	FTransmission Transmission;                     ///< with FSignalRequests::bTransmission
	FIndirectVolume IndirectVolume;                 ///< with FSignalRequests::bIndirectVolume
	FGraphTexture& Get(ESignal Signal) { return Signal == ESignal::Frame ? Lighting : Signals[ToIndex(Signal)]; }
	const FGraphTexture& Get(ESignal Signal) const { return Signal == ESignal::Frame ? Lighting : Signals[ToIndex(Signal)]; }
};

/// Adds the pass of one signal and returns its output; Signal: neither Frame nor Count. Once a frame. Invalid: see FFrameOutputs.
FGraphTexture AddSignalPass(FFrameContext& Context, ESignal Signal, const FGBuffer& GBuffer);

FGraphTexture AddToneMapPass(FFrameContext& Context, FGraphTexture Radiance);

/// Adds the light in fog, and returns it; later calls of a frame return what the first one did. It reads nothing of the G-buffer, so a
/// host may add it before its own passes. Invalid: nobody asks, or see FFrameOutputs.
FFogAtlas AddFogShadowPass(FFrameContext& Context);
/// Notes how far the next frame's fog can be seen; after AddFogShadowPass. Does nothing without fog. A frame whose predecessor lacks it
/// lights all froxels, whatever hides them.
void AddFogDepthPass(FFrameContext& Context, const FGBuffer& GBuffer);

/// Adds indirect light in the air, and returns it; later calls of a frame return what the first one did. It is added before the signals of
/// indirect light: its rays ask for radiance cells as well. Reads Depth and Normals of the G-buffer. Invalid: nobody asks, r.RT.GI.Volume is
/// off, nothing that somebody reads keeps radiance cells, or see FFrameOutputs.
FIndirectVolume AddIndirectVolumePass(FFrameContext& Context, const FGBuffer& GBuffer);

/// Adds the light mask, and returns it; later calls of a frame return what the first one did. Reads Depth, Normals and, if there is any,
/// Motion of the G-buffer.
FLightMask AddLightMaskPass(FFrameContext& Context, const FGBuffer& GBuffer);

/// Returns whether rays show the surfaces that light shines through, so that a host leaves them out of its G-buffer. False: there are none,
/// nobody asks for them, or shaders are being compiled, and they may stand in as opaque surfaces.
bool IsTransmissionShown(const FFrameContext& Context);
/// Adds what these surfaces show, and returns it; later calls of a frame return what the first one did. It is added before the signals of
/// indirect light: its rays ask for radiance cells as well. Reads Depth and Normals of the G-buffer. Invalid: as IsTransmissionShown says.
FTransmission AddTransmissionPass(FFrameContext& Context, const FGBuffer& GBuffer);

/// Makes FGBuffer::Motion of a world that stands still, from depth alone, with w = 0.
FGraphTexture AddCameraMotionPass(FFrameContext& Context, FGraphTexture Depth);

/// Adds all passes. A host may read single outputs and light by itself: passes whose results nobody reads are culled.
FFrameOutputs AddFramePasses(FFrameContext& Context, const FGBuffer& GBuffer);

struct FReferencePassInputs
{
	ESignal Signal = ESignal::Frame; ///< FFrameFeatures::ReferenceSignal
	FGraphBuffer Sum;                ///< vec4[Width · Height]: sums of radiance, and of samples in w
	uint32_t FirstSample = 0, SampleCount = 1;
	uint32_t MaxBounces = 0; ///< scattering events at most; 0: directly seen light only
	uint32_t FirstRow = 0, RowCount = 0;
	bool bPixelCenters = false; ///< camera rays pass through pixel centres, as in the G-buffer; if false, all over the pixel
	FGBuffer GBuffer;           ///< needed with FFrameFeatures::bReferenceFromGBuffer
};
/// Adds samples of FFrameFeatures::ReferenceSignal. A signal of one channel has its value in all three. Sky pixels: visibilities
/// are 1, radiances 0.
void AddReferencePass(FFrameContext& Context, const FReferencePassInputs& Inputs);
/// Lists the compute shaders of a reference with bReferenceFromGBuffer, beside those of its G-buffer.
std::vector<FShaderSource> ListReferenceComputeShaders(const FSceneFacts& Facts, ESignal Signal);
/// Whether the sum of all samples is not yet the signal: some of it is no mean of samples (FToonStyle). Needs bReferenceFromGBuffer.
bool IsReferenceGraded(const FSceneFacts& Facts, ESignal Signal);
/// Makes the signal of the sum, in a frame of its own with the same features. Does nothing if IsReferenceGraded is false.
void AddReferenceGrade(FFrameContext& Context, const FReferencePassInputs& Inputs);

} // namespace Lantern
