// Emissive triangles as local lights: where they count, and the clusters by which tiles weigh them.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// Returns whether the signals of local lights hold emissive triangles (r.RT.Lights.Emissive).
bool HasEmitters(const FSceneFacts& Facts);

/// Returns whether Lobe, a signal of local lights or Count, takes directly seen emission over from the signal of indirect light that
/// traces this lobe. That signal's shaders then have EmissiveDirectDefine.
bool IsEmissionDirect(const FPassQuery& Query, ESignal Lobe);
/// The same rule for references, which know no requests: as in frames of the same console variables that make all signals.
bool IsEmissionDirectInReference(const FSceneFacts& Facts);
inline constexpr const char* EmissiveDirectDefine = "EMISSIVE_IS_DIRECT";

/// Adds the defines of shaders that choose or shade emissive triangles. Does nothing without emitters.
void AddEmitterDefines(const FSceneFacts& Facts, FShaderDefines& InOut);

/// Lists the shader of AddEmitterClusters, if there is anything for it.
void ListEmitterShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);
/// Whether it is ready. False: it is being compiled, or an error, which the context then has.
bool AreEmittersReady(FFrameContext& Context);
/// Adds the passes that find where clusters of emissive triangles lie in this frame, and which of them regions of the screen look at.
/// Returns FEmitterHeader and what follows it. Invalid: nothing emits. After AreEmittersReady.
FGraphBuffer AddEmitterClusters(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
