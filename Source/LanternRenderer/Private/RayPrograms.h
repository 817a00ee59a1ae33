// Which ray generation shaders, ray types and compute shaders a frame needs.
#pragma once

#include <array>
#include <optional>

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

struct FRayPrograms
{
	FRTPSODesc Desc; ///< without ray generation shaders: no pipeline is needed
	/// Members of Desc.RayGens by signal. That of ESignal::Frame is the reference path tracer.
	std::array<std::optional<FShaderSource>, SignalCount> RayGens;
	std::array<std::optional<FShaderSource>, PassRayGenCount> PassRayGens; ///< as RayGens
	/// Compute shaders of the signals' passes, most important first.
	std::vector<FShaderSource> Compute;
	bool bQueries = false;       ///< some pass traces by ray queries
	bool bLightSampling = false; ///< some pass samples emissive triangles
	bool bMotion = false;        ///< some pass follows how objects moved, or the host asks
};

/// Scene: its facts are up to date. Ready: signals whose shaders were there in the last frame, or are waited for. Until then the
/// signal that such a one replaces is made as well (FSignalPass::ReplacedBy).
FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, FRTScene& Scene, const FFrameFeatures& Features,
    const FSignalRequests& Requests, FSignalSet Ready);

} // namespace Lantern
