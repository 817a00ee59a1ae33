// lantern render --explain X,Y
#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

#include "LanternHost/SampleEngine.h"
#include "LanternRenderer/PixelExplanation.h"

namespace Lantern
{

/// Signals that an explanation lists: all but the whole frame.
FSignalSet GetExplainedSignals();

/// What is known of a pixel: the values of Frame's signals there, and Explanation. Lengths are metres, light is in units of radiance.
nlohmann::json ExplanationToJson(glm::uvec2 Pixel, const FCapturedFrame& Frame, const FPixelExplanation& Explanation);

/// Prints what ExplanationToJson made.
void PrintExplanation(const nlohmann::json& Json);

} // namespace Lantern
