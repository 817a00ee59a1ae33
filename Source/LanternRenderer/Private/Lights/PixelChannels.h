// Channels of the objects that pixels show, which say what lights light them.
#pragma once

#include "LanternRenderer/Frame.h"

namespace Lantern
{

FShaderSource MakePixelChannelsSource();

/// Returns a texture that LoadPixelChannels (LightProfile.glsl) reads; later calls of a frame return what the first one did. Invalid:
/// nothing needs it (FSceneFacts::bLightChannels), nobody knows what pixels show, or its shader is being compiled. All pixels then have
/// CHANNELS_DEFAULT.
FGraphTexture RequirePixelChannels(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
