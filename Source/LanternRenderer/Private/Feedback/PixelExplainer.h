// Tells what is known of the light of one pixel: r.RT.Debug.Explain. If it is off, nothing is allocated.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "ExplainTypes.h"
#include "Feedback/GpuStatistics.h"
#include "LanternRenderer/PixelExplanation.h"

namespace Lantern
{

/// Returns the pixel that frames explain, if they do.
std::optional<glm::uvec2> GetExplainedPixel();

class FPixelExplainer : public TGpuStatistics<FExplainedPixel, FPixelExplanation>
{
public:
	explicit FPixelExplainer(IRTDevice& InDevice);
};

} // namespace Lantern
