// Objects of a stylised look (FToonStyle): about which normals their pixels gather diffuse indirect light, and what they show of it.
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// r.RT.GI.Toon.
bool AreToonStylesOn();

FShaderSource MakeToonSurfaceSource();

/// Lists the shaders of both passes below, if the scene has styles. bReference: those of the reference.
void ListToonShaders(const FSceneFacts& Facts, bool bReference, std::vector<FShaderSource>& Out);

/// Returns the surfaces about which light is gathered: the G-buffer with other Normals. Sets FFrameContext::Toon. Later calls of a frame
/// return what the first one did. Returns GBuffer itself if the scene has no styles, if nobody knows what pixels show, or while the shader
/// is being compiled.
FGBuffer RequireToonSurface(FFrameContext& Context, const FGBuffer& GBuffer);

/// Returns a signal as objects with a style show it, after RequireToonSurface of this frame; or Signal if there is none. bHorizon: light
/// from below a surface is missing in it. bFiltered: it is filtered, and spheres are smoothed once more.
FGraphTexture AddToonGrade(FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture Signal, bool bHorizon, bool bFiltered);
/// Does so in the sum of the reference, FReferenceConstants::Sum.
void AddToonReferenceGrade(FFrameContext& Context, const FGBuffer& GBuffer, FGraphBuffer Sum);

} // namespace Lantern
