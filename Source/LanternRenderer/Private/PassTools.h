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

/// HAS_… for what the scene has, so that the rest is not compiled.
std::vector<std::pair<std::string, std::string>> MakeFactDefines(const FSceneFacts& Facts);

/// Nothing where Items is empty.
FRTStatus AddSkinningPass(FFrameContext& Context, FFrameUploads& Uploads, const std::vector<FSkinningInputs>& Items);

} // namespace Lantern
