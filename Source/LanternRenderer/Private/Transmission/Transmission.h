// Surfaces in front of the G-buffer's that light shines through: glass, and water (Shaders/Transmission/). Rays find them, so that an
// engine's G-buffer need not hold them.
#pragma once

#include "LanternRenderer/Frame.h"
#include "RayPath.h"

namespace Lantern
{

constexpr const char* TransmissionShaders = "Transmission/Transmission";

FPassRays ChooseTransmissionRays(const FPassQuery& Query);
/// Lists the shader of AddTransmissionComposite, if the scene has a use for it.
void ListTransmissionComposite(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);
/// Returns Lighting behind these surfaces, RGBA32_FLOAT. Lighting itself: there are none, or shaders are being compiled.
FGraphTexture AddTransmissionComposite(FFrameContext& Context, FGraphTexture Lighting, const FTransmission& Transmission);

} // namespace Lantern
