// Which ray generation shaders and ray types a frame needs.
#pragma once

#include <array>
#include <optional>

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// What one pass wants of the frame's RTPSO. Every pass has a function Choose<Pass>Rays that says it.
struct FPassRays
{
	FShaderSource RayGen;
	/// Its rays shade what they hit, and may sample the scene's emissive triangles (Shaders/Rays/PathTracing.glsl). Else
	/// it casts shadow rays only, and the RTPSO has no closest-hit shader.
	bool bShadesHits = false;
	bool bBlockers = false; ///< its shadow rays tell how far off what is in the way is
};
FPassRays MakePassRays(const char* RayGenPath, std::vector<std::pair<std::string, std::string>> Defines, bool bShadesHits);

struct FRayPrograms
{
	FRTPSODesc Desc; ///< no ray generation shaders: no pipeline is needed
	std::array<std::optional<FShaderSource>, static_cast<size_t>(EFrameRayGen::Count)> RayGens; ///< of Desc.RayGens, by EFrameRayGen
	bool bQueries = false;                                                                      ///< some pass traces inline
	bool bLightSampling = false;                                                                ///< some pass samples emissive triangles
};

/// Scene: its facts are up to date. bDiffuseGIReady: diffuse GI, where it is wanted, is compiled or waited for; until then what
/// it takes the place of is wanted too.
FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, FRTScene& Scene, const FFrameFeatures& Features, bool bDiffuseGIReady);

/// Of the reference path tracer.
FPassRays ChooseReferenceRays(const FSceneFacts& Facts, EReferenceSignal Signal, bool bFromGBuffer);
/// Of real-time passes; nullopt where they are off, have nothing to do, or trace inline.
std::optional<FPassRays> ChooseSunShadowRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts);
std::optional<FPassRays> ChooseAmbientOcclusionRays(
    const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FSignalRequests& Requests, bool bDiffuseGI);
std::optional<FPassRays> ChooseDiffuseGIRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts);
std::optional<FPassRays> ChooseReflectionsRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts);

} // namespace Lantern
