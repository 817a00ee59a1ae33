// What passes share: compute pipelines by shader, defines by what the scene has, names of shaders.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRenderer/Frame.h"

namespace Lantern
{

using FShaderDefines = std::vector<std::pair<std::string, std::string>>;

/// Passes of paths, which may run at the same time (FPassBuilder::RunBeside): few of their threads live long, and leave the device idle.
inline constexpr const char* PathsGroup = "Paths";

constexpr uint32_t DivideUp(uint32_t Value, uint32_t By) { return (Value + By - 1) / By; }

FShaderSource MakeComputeSource(std::string Path, FShaderDefines Defines = {});

/// Returns the compute pipeline of a shader. Null: the pass is left out, because the shader is being compiled or cannot be. A
/// frame that waits for its pipelines (FFrameContext::bWaitForPipelines) then has the error.
IRTPipeline* RequireCompute(const FFrameContext& Context, const FShaderSource& Source);
inline IRTPipeline* RequireCompute(const FFrameContext& Context, const char* Path, FShaderDefines Defines = {})
{
	return RequireCompute(Context, MakeComputeSource(Path, std::move(Defines)));
}

/// Names a signal's shader: "<Pass>/<Pass>" + Suffix.
std::string MakeShaderPath(ESignal Signal, const char* Suffix);

template <class T>
void Dispatch2D(FPassContext& Pass, IRTPipeline* Pipeline, const T& Constants, uint32_t Width, uint32_t Height, uint32_t GroupSize)
{
	Pass.Commands().SetPipeline(Pipeline);
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
	Pass.Commands().Dispatch(DivideUp(Width, GroupSize), DivideUp(Height, GroupSize), 1);
}

/// Dispatches groups that a shader numbers by gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x. There may be more of them than Count.
template <class T>
void DispatchMany(FPassContext& Pass, IRTPipeline* Pipeline, const T& Constants, uint32_t Count)
{
	constexpr uint32_t MaxGroups = 65535; // in one dimension, on any device
	Pass.Commands().SetPipeline(Pipeline);
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
	Pass.Commands().Dispatch(std::min(Count, MaxGroups), DivideUp(Count, MaxGroups), 1);
}

/// Returns the index by which shaders sample a texture, or NO_TEXTURE if it is invalid.
uint32_t GetSampledIndex(FPassContext& Pass, FGraphTexture Texture);
/// Returns the index by which shaders write a texture, or NO_TEXTURE if it is invalid or culled.
uint32_t GetStorageIndex(FPassContext& Pass, FGraphTexture Texture);

/// Returns a buffer's address for shaders, or 0 if it is invalid.
FAddress GetAddress(FPassContext& Pass, FGraphBuffer Buffer);

/// Which pixels trace in a frame: Shaders/Library/Rate.glsl.
enum class EPixelRate : uint8_t
{
	Full,
	Checkerboard, ///< every other pixel, in turn
	Quarter,      ///< one of four, in turn
};
/// Returns the frames in which each pixel traces once.
uint32_t GetTurnFrames(EPixelRate Rate);
/// Adds the define of shaders that run at a rate.
void AddRateDefine(EPixelRate Rate, FShaderDefines& InOut);
/// Returns the rate of shaders with these defines.
EPixelRate FindRate(const FShaderDefines& Defines);

/// r.RT.Enable.
bool IsRayTracingEnabled();

/// Adds HAS_LIGHT_EMISSION if some material lights otherwise than it looks. Shaders that read emission of hits need it.
void AddLightEmissionDefine(const FSceneFacts& Facts, FShaderDefines& InOut);

inline constexpr const char* BackPixelsDefine = "BACK_PIXELS";
/// Adds HAS_DIFFUSE_TRANSMISSION if some material scatters light through, for shaders that read hits. Adds BACK_PIXELS if the G-buffer says
/// which pixels do, for those that light pixels.
void AddDiffuseTransmissionDefine(const FSceneFacts& Facts, FShaderDefines& InOut);
/// The same, for shaders that read no hits. bBackPixels: see FSceneFacts.
void AddBackPixelsDefine(bool bBackPixels, FShaderDefines& InOut);
/// Adds HAS_TRANSMISSION if light shines through some material. Shaders that read hits, or what any-hit shaders decide, need it.
void AddTransmissionDefine(const FSceneFacts& Facts, FShaderDefines& InOut);

/// Adds HAS_SKY if there is one, and SKY_IN_PLACE if shaders run its program. Shaders that ask SampleSkyRadiance need them.
void AddSkyDefines(const FSceneFacts& Facts, FShaderDefines& InOut);

/// Returns HAS_… for what the scene has, so that shaders are compiled without the rest.
FShaderDefines MakeFactDefines(const FSceneFacts& Facts);

/// Returns MakeFactDefines and what light sampling in shaders needs beside them (Shaders/Rays/PathLights.glsl).
FShaderDefines MakePathDefines(const FSceneFacts& Facts);

/// Returns whether paths could bring any light.
bool HasAnyLight(const FSceneFacts& Facts);
/// Returns the most rays that one path casts, shadow rays included. Bounces counts the surfaces that it may shade after the
/// first. Paths that leave the scene cast fewer.
uint64_t GetMaxPathRays(const FSceneFacts& Facts, uint32_t Bounces);

/// Lists the compute shaders that skinning uses in a scene.
void ListSkinningShaders(FRTScene& Scene, std::vector<FShaderSource>& Out);
/// Whether skinning can run in this frame. False: its shader is being compiled, or an error, which the context then has.
bool IsSkinningReady(const FFrameContext& Context);
/// Adds nothing if Items is empty. After IsSkinningReady.
FRTStatus AddSkinningPass(FFrameContext& Context, FFrameUploads& Uploads, const std::vector<FSkinningInputs>& Items, bool bMotion);

} // namespace Lantern
