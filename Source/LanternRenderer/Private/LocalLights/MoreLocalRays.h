// More rays to lamps with an extent, where one ray cannot tell and no history helps (LocalLights/MoreLocalRays.comp).
#pragma once

#include "Denoise/Denoise.h"
#include "Rays/RayQueue.h"

namespace Lantern
{

/// Returns whether a frame of these lights asks for more rays, if its light is filtered: r.RT.Lights.MoreRays.
bool WantsMoreLocalRays(const FSceneFacts& Facts);

/// Defines: of all shaders that sample local lights.
FShaderSource MakeMoreLocalRaysSource(FShaderDefines Defines);
/// Lists the compute shaders of AddMoreLocalRays.
void ListMoreLocalRaysShaders(FShaderDefines Defines, std::vector<FShaderSource>& Out);

/// The filter of the lobe whose history says who has more rays.
struct FMoreRaysFilter
{
	const char* Name = ""; ///< FDenoiseInputs::Name
	float MinAlpha = 1.0f; ///< GetMinAlpha
};

/// Adds the passes that ask for more rays and trace them, behind all others to local lights. InOut.MoreAnswers gets their answers.
/// OutHistory: FDenoiseInputs::History of the filtered lobe, if it is read. Reads Depth, Normals and
/// Motion of the G-buffer. Nothing is added while shaders are being compiled.
void AddMoreLocalRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    FQueuedRays& InOut, FShaderDefines Defines, const FMoreRaysFilter& Filter, FHistoryTexture& OutHistory);

} // namespace Lantern
