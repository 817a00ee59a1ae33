// Passes that ask for more rays to lamps with an extent, and trace them.
#include "LocalLights/MoreLocalRays.h"

#include <algorithm>

#include "Denoise/Denoise.h"
#include "Denoise/SurfaceHistory.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "MoreLocalRaysTypes.h"
#include "RayQueueTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarMoreRays("r.RT.Lights.MoreRays", true,
    "Pixels in penumbrae of lamps with an extent have four rays to a lamp instead of one. They do while the filter has no history of them. "
    "This is what has just come into view, and where light has changed. Needs r.RT.Lights.Denoise, and tiles of few lights "
    "(r.RT.Lights.Exact). Does not count where an engine reads the light mask.");

struct FMoreRaysPass
{
	FRayQueue Queue;
	FGraphBuffer TileLights, Answers;
	FGraphTexture History, Anchors; ///< invalid: there is no history
	float EnoughFrames = 0.0f;
};

void AddAskPass(FFrameContext& Context, IRTPipeline* Pipeline, const FMoreRaysPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "Ask").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {Inputs.History, Inputs.Anchors})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		for (const FGraphBuffer Buffer : {Inputs.TileLights, Inputs.Queue.Answers}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		for (const FGraphBuffer Buffer : {Inputs.Queue.Requests, Inputs.Queue.Counters, Inputs.Answers})
		{
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			StartQueue(Pass, Inputs.Queue);
			FMoreLocalRaysConstants C{};
			C.Pass = Frame->Pass;
			C.TileLights = GetAddress(Pass, Inputs.TileLights);
			C.Requests = GetAddress(Pass, Inputs.Queue.Requests);
			C.Counters = GetAddress(Pass, Inputs.Queue.Counters);
			C.Answers = GetAddress(Pass, Inputs.Queue.Answers);
			C.MoreAnswers = GetAddress(Pass, Inputs.Answers);
			C.Capacity = Inputs.Queue.Capacity;
			C.History = GetSampledIndex(Pass, Inputs.History);
			C.Anchors = GetSampledIndex(Pass, Inputs.Anchors);
			C.EnoughFrames = Inputs.EnoughFrames;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

FShaderSource MakeSource(FShaderDefines Defines) { return MakeComputeSource("LocalLights/MoreLocalRays.comp", std::move(Defines)); }
} // namespace

bool WantsMoreLocalRays(const FSceneFacts& Facts) { return CVarMoreRays.GetOnRenderThread() && Facts.bAreaLights && !Facts.bLightMask; }

void ListMoreLocalRaysShaders(FShaderDefines Defines, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeSource(std::move(Defines)));
	ListSurfaceShaders(Out);
}

void AddMoreLocalRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, FShadowRays& InOut,
    FShaderDefines Defines, const FMoreRaysFilter& Filter)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource(std::move(Defines)));
	if (!Pipeline || !RequireSurface(Context, {GBuffer.Depth, GBuffer.Normals, GBuffer.Motion})) { return; }
	if (!RequireDenoiseHistory(Context, Filter.Name, InOut.LocalHistory)) { return; }
	const bool bHistory = Context.Surface.Previous.IsValid() && InOut.LocalHistory.Previous.IsValid();
	FMoreRaysPass Inputs{CreateFurtherQueue(Context, InOut.Queue, "MoreLocal"), InOut.Traced.TileLights};
	// A history is never worth more frames than the inverse of its least weight: at low frame rates all would ask for ever.
	Inputs.EnoughFrames = std::min(16.0f, 0.5f / Filter.MinAlpha);
	if (bHistory)
	{
		Inputs.History = InOut.LocalHistory.Previous;
		Inputs.Anchors = Context.Surface.Anchors;
	}
	Inputs.Answers = Context.Graph.CreateBuffer({uint64_t(Context.Width) * Context.Height * sizeof(uint32_t)}, "MoreLocalAnswers");
	AddAskPass(Context, Pipeline, Inputs);
	InOut.Traced.MoreAnswers = Inputs.Answers;
	FQueuedRays Traced = InOut.Traced;
	Traced.MoreSamples = LOCAL_MORE_RAYS;
	AddShadowRaysPass(Context, GBuffer, Dispatch, Inputs.Queue, Traced);
}

} // namespace Lantern
