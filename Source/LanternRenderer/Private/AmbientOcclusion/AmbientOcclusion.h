#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// What the reference of the signal has to know of r.RT.AO.…
struct FAmbientOcclusionSettings
{
	float Radius = 2.0f;       ///< metres
	uint32_t InstanceMask = 0; ///< of what occludes
};
FAmbientOcclusionSettings GetAmbientOcclusionSettings();

/// Whether the frame's ambient occlusion, if there is any, is filtered over frames.
bool IsAmbientOcclusionFiltered(const FFrameContext& Context);

} // namespace Lantern
