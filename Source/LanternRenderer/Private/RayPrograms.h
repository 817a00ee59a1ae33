// Which ray generation shaders and ray types a frame needs.
#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

struct FRayPrograms
{
	FRTPSODesc Desc; ///< no ray generation shaders: no pipeline is needed
	std::optional<FShaderSource> SunShadow, Reference; ///< of Desc.RayGens
};

/// Scene: its facts are up to date.
FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, FRTScene& Scene, const FFrameFeatures& Features);

} // namespace Lantern
