// Lights of tiles and requests for rays to them.
#include "LocalLights/LocalRequests.h"

#include "Lights/LightCells.h"
#include "LocalLightTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarWeight("r.RT.Debug.Lights.Weight", true,
    "Planted fault. If off, a light that a pixel chose of many counts once, and not for all that it was chosen from.");

FShaderSource MakeRequestsSource(const FSceneFacts& Facts, uint32_t Exact)
{
	FShaderDefines Defines = MakeLocalDefines(Facts, Exact);
	if (!CVarWeight.GetOnRenderThread()) { Defines.emplace_back("NO_CHOICE_WEIGHT", "1"); }
	return MakeComputeSource("LocalLights/Requests.comp", std::move(Defines));
}

FShaderSource MakeShareSource() { return MakeComputeSource("LocalLights/ShareRequests.comp"); }

struct FRequestsPass
{
	FGBuffer GBuffer;
	FRayQueue Queue;
	FLocalRays Rays;
	bool bFirst = false; ///< no pass before it writes requests and answers
	FGraphBuffer TileLights, Choices;
	uint32_t Tiles = 0;
};

FLocalRequestsConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FRequestsPass& Inputs)
{
	FLocalRequestsConstants C{};
	C.Pass = Frame.Pass;
	C.TileLights = GetAddress(Pass, Inputs.TileLights);
	C.Requests = GetAddress(Pass, Inputs.Queue.Requests);
	C.Counters = GetAddress(Pass, Inputs.Queue.Counters);
	C.Capacity = Inputs.Queue.Capacity;
	C.Exact = Inputs.Rays.Exact;
	return C;
}

void DeclareQueue(FPassBuilder& Builder, const FRayQueue& Queue, bool bFirst)
{
	for (const FGraphBuffer Buffer : {Queue.Requests, Queue.Counters})
	{
		if (!bFirst) { Builder.Read(Buffer, ERTAccess::StorageRead); }
		Builder.Write(Buffer, ERTAccess::StorageWrite);
	}
}

void AddRequestsPass(FFrameContext& Context, IRTPipeline* Pipeline, const FRequestsPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "Lights").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(Inputs.GBuffer.Normals, ERTAccess::ShaderRead);
		DeclareQueue(Builder, Inputs.Queue, Inputs.bFirst);
		Builder.Write(Inputs.TileLights, ERTAccess::StorageWrite);
		if (Inputs.Choices.IsValid()) { Builder.Write(Inputs.Choices, ERTAccess::StorageWrite); }
		if (Inputs.bFirst) { Builder.Write(Inputs.Queue.Answers, ERTAccess::StorageWrite); }
		if (Inputs.Rays.bMany) { ReadLightCells(Builder, Frame->LightCells, false); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			if (Inputs.bFirst) { StartQueue(Pass, Inputs.Queue); }
			FLocalRequestsConstants C = MakeConstants(Pass, *Frame, Inputs);
			C.Answers = Inputs.bFirst ? GetAddress(Pass, Inputs.Queue.Answers) : 0;
			C.Choices = GetAddress(Pass, Inputs.Choices);
			C.Depth = GetSampledIndex(Pass, Inputs.GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, Inputs.GBuffer.Normals);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

void AddSharePass(FFrameContext& Context, IRTPipeline* Pipeline, const FRequestsPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "LightsShare").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.TileLights, ERTAccess::ShaderRead);
		DeclareQueue(Builder, Inputs.Queue, false);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) { Dispatch2D(Pass, Pipeline, MakeConstants(Pass, *Frame, Inputs), Inputs.Tiles, 1, TILE_PIXELS); };
	});
}
} // namespace

FShaderDefines MakeLocalDefines(FSceneFacts Facts, uint32_t Exact)
{
	const bool bMany = MayChooseLights(Facts, Exact);
	Facts.bSun = Facts.bSky = Facts.bMasked = false; // nothing of it reaches these shaders
	FShaderDefines Defines = MakeFactDefines(Facts);
	if (bMany) { Defines.emplace_back("MANY_LIGHTS", "1"); }
	return Defines;
}

void ListLocalRequestShaders(const FSceneFacts& Facts, uint32_t Exact, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeRequestsSource(Facts, Exact));
	if (MayChooseLights(Facts, Exact)) { ListLightCellShaders(Facts, Out); }
	if (MayQueuesOverflow(1 + GetLocalRaysPerPixel(Facts, Exact))) { Out.push_back(MakeShareSource()); }
}

bool AreLocalRequestsReady(FFrameContext& Context, uint32_t Exact)
{
	const bool bShared = !MayQueuesOverflow(1 + GetLocalRaysPerPixel(Context.Facts, Exact)) || RequireCompute(Context, MakeShareSource());
	return RequireCompute(Context, MakeRequestsSource(Context.Facts, Exact)) && bShared;
}

void AddLocalRequests(FFrameContext& Context, const FGBuffer& GBuffer, FShadowRays& InOut, const FLocalRays& Rays)
{
	FRequestsPass Inputs{GBuffer, InOut.Queue, Rays, !InOut.Tiles.IsValid()};
	Inputs.Tiles = DivideUp(Context.Width, TILE_SIZE) * DivideUp(Context.Height, TILE_SIZE);
	Inputs.TileLights = Context.Graph.CreateBuffer({Inputs.Tiles * sizeof(FTileLights)}, "TileLights");
	if (Rays.bMany)
	{
		const uint64_t Pixels = uint64_t(Context.Width) * Context.Height;
		Inputs.Choices = Context.Graph.CreateBuffer({Pixels * sizeof(FLightChoice)}, "LightChoices");
		RequireLightCells(Context, GBuffer); // pixels that choose visit the lights of their cell
	}
	AddRequestsPass(Context, RequireCompute(Context, MakeRequestsSource(Context.Facts, Rays.Exact)), Inputs);
	if (InOut.Queue.bMayOverflow) { AddSharePass(Context, RequireCompute(Context, MakeShareSource()), Inputs); }
	InOut.Traced.TileLights = Inputs.TileLights;
	InOut.Traced.Choices = Inputs.Choices;
	InOut.Traced.LocalPerPixel = Rays.PerPixel;
}

} // namespace Lantern
