// Keeps the scene's emissive triangles up to date on the GPU, for all that samples them.
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Lists the shaders of AddEmissivePass. None: nothing emits.
void ListEmissiveShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);
/// Whether they are ready. False: they are being compiled, or an error, which the context then has. The frame then samples no emissive
/// triangle, as FSceneUse::bLightSampling says.
bool AreEmissiveShadersReady(const FFrameContext& Context);
/// Adds the pass that finds what changed of emissive triangles. Adds nothing if nothing did. After FRTScene::BeginUpdate and the pass of
/// tables.
FRTStatus AddEmissivePass(FFrameContext& Context, FFrameUploads& Uploads);

} // namespace Lantern
