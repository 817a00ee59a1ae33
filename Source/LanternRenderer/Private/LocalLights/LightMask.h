// The light mask: what pixels see of at most TILE_LIGHTS lights of their tile, for a host that lights by itself.
#pragma once

#include "LanternCore/FrameGraph/History.h"
#include "RayPath.h"

namespace Lantern
{

/// Lists the compute shaders of AddLightMaskPass (Frame.h), if a frame makes a mask.
void ListLightMaskShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);
/// Whether the mask is accumulated over frames: some light has an extent.
bool IsLightMaskAccumulated(const FSceneFacts& Facts);
/// Whether AddLightMaskPass can add its pass, if the frame makes a mask. False: its shader is being compiled, or an error, which the
/// context then has.
bool IsLightMaskReady(FFrameContext& Context);
/// Adds the define of shaders that match slots by the numbers of lights, if they are not to (planted fault).
void AddMaskOrderDefine(FShaderDefines& InOut);
/// Finds which lights the slots of tiles have, now and in the previous frame: R32_UINT, see FLightMaskConstants. Once a frame. False: an
/// error, which the context has.
bool FindMaskLights(FFrameContext& Context, FHistoryTexture& Out);

} // namespace Lantern
