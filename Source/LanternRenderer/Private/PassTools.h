// What passes share.
#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

constexpr uint32_t DivideUp(uint32_t Value, uint32_t By) { return (Value + By - 1) / By; }

/// A compute pipeline by shader; failure is recorded in the context and gives null: the pass is then not added.
IRTPipeline* RequireCompute(const FFrameContext& Context, const char* Path, std::vector<std::pair<std::string, std::string>> Defines = {});

template <class T>
void Dispatch2D(FPassContext& Pass, IRTPipeline* Pipeline, const T& Constants, uint32_t Width, uint32_t Height, uint32_t GroupSize)
{
	Pass.Commands().SetPipeline(Pipeline);
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
	Pass.Commands().Dispatch(DivideUp(Width, GroupSize), DivideUp(Height, GroupSize), 1);
}

/// r.RT.Enable.
bool IsRayTracingEnabled();

/// HAS_… for what the scene has, so that the rest is not compiled.
std::vector<std::pair<std::string, std::string>> MakeFactDefines(const FSceneFacts& Facts);

/// The same, with what light sampling in shaders asks of it (Shaders/Rays/PathLights.glsl).
std::vector<std::pair<std::string, std::string>> MakePathDefines(const FSceneFacts& Facts);

/// Whether there is anything that paths could bring.
bool HasAnyLight(const FSceneFacts& Facts);
/// The most rays that one path of a brute-force pass casts, shadow rays counted, Bounces being the surfaces that it may shade
/// after the first: paths that leave the scene cast fewer.
uint64_t GetMaxPathRays(const FSceneFacts& Facts, uint32_t Bounces);

/// Nothing where Items is empty.
FRTStatus AddSkinningPass(FFrameContext& Context, FFrameUploads& Uploads, const std::vector<FSkinningInputs>& Items, bool bMotion);

} // namespace Lantern
