// The rate at which pixels ask for rays to local lights, and the passes of second rays.
#include "LocalLights/SecondRays.h"

#include "LanternCore/Config/ConsoleVariables.h"
#include "PassTools.h"
#include "SecondRaysTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarRate("r.RT.Lights.Rate", 0,
    "Pixels that ask for rays to local lights in a frame. 0: all. 1: every other pixel, in turn. 2: one of four, in turn. The others take "
    "what neighbours on their plane saw. A pixel whose neighbours disagree about a lamp without extent asks for a second ray.",
    {0, 2});
TRTConsoleVariable<bool> CVarSecondRay("r.RT.Debug.Lights.SecondRay", true,
    "Planted fault. If off, a pixel takes the mean of neighbours that disagree about a lamp, and asks for no second ray.");

void AddAskPass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Second, FGraphBuffer TileLights, IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Second.Name + "Ask").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		for (const FGraphBuffer Buffer : {TileLights, Second.Answers}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		for (const FGraphBuffer Buffer : {Second.Requests, Second.Counters}) { Builder.Write(Buffer, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			StartQueue(Pass, Second);
			FSecondRaysConstants C{};
			C.Pass = Frame->Pass;
			C.TileLights = GetAddress(Pass, TileLights);
			C.Requests = GetAddress(Pass, Second.Requests);
			C.Counters = GetAddress(Pass, Second.Counters);
			C.Answers = GetAddress(Pass, Second.Answers);
			C.Capacity = Second.Capacity;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}
} // namespace

EPixelRate GetLightRate() { return static_cast<EPixelRate>(CVarRate.GetOnRenderThread()); }

bool WantsSecondRays() { return GetLightRate() != EPixelRate::Full && CVarSecondRay.GetOnRenderThread(); }

FShaderSource MakeSecondRaysSource(FShaderDefines Defines) { return MakeComputeSource("LocalLights/SecondRays.comp", std::move(Defines)); }

void AddSecondRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FQueuedRays& Rays, IRTPipeline* Pipeline)
{
	FRayQueue Second = CreateFurtherQueue(Context, Queue, "Second");
	Second.bRest = true; // a pixel asks here or there
	AddAskPass(Context, GBuffer, Second, Rays.TileLights, Pipeline);
	AddShadowRaysPass(Context, GBuffer, Dispatch, Second, Rays);
}

} // namespace Lantern
