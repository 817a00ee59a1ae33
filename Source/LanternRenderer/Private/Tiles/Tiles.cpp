// The screen in tiles.
#include "Tiles/Tiles.h"

#include "ThreadListTypes.h"
#include "TileTypes.h"

namespace Lantern
{

namespace
{
struct FTilesPass
{
	FGBuffer GBuffer;
	FRayQueue Queue;
	FGraphBuffer Tiles, Marks;
	FSunRays Sun;
	FSettledTiles Settled;
	FHostShadowMap Map;
};

FTilesConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FTilesPass& Inputs)
{
	FTilesConstants C{};
	C.Pass = Frame.Pass;
	C.Tiles = GetAddress(Pass, Inputs.Tiles);
	C.Requests = GetAddress(Pass, Inputs.Queue.Requests);
	C.Counters = GetAddress(Pass, Inputs.Queue.Counters);
	C.Capacity = Inputs.Queue.Capacity;
	return C;
}

void AddSortPass(FFrameContext& Context, IRTPipeline* Pipeline, const FTilesPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	const FRayQueue& Queue = Inputs.Queue;
	Context.Graph.AddPass((Queue.Name + "Tiles").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(Inputs.GBuffer.Normals, ERTAccess::ShaderRead);
		for (const FGraphBuffer Buffer : {Inputs.Tiles, Inputs.Marks, Queue.Answers}) { Builder.Write(Buffer, ERTAccess::StorageWrite); }
		DeclareSettled(Builder, *Frame, Inputs.Settled);
		Inputs.Map.Read(Builder);
		const bool bWidths = Inputs.Map.IsValid() && Queue.SunWidths.IsValid();
		if (bWidths) { Builder.Write(Queue.SunWidths, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FTilesConstants C{};
			C.Pass = Frame->Pass;
			C.Tiles = GetAddress(Pass, Inputs.Tiles);
			C.Marks = GetAddress(Pass, Inputs.Marks);
			C.Answers = Pass.GetBuffer(Inputs.Queue.Answers)->GetDeviceAddress();
			C.Depth = GetSampledIndex(Pass, Inputs.GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, Inputs.GBuffer.Normals);
			C.SunSamples = Inputs.Sun.SamplesPerPixel;
			C.SunOneMinusCos = GetSunOneMinusCos(Inputs.Sun);
			C.Settled = WriteSettled(Pass, *Frame, Inputs.Settled);
			C.SunMask = Inputs.Sun.InstanceMask;
			C.LitMask = Inputs.Sun.LitMask;
			C.HostShadow = Inputs.Map.Push(Pass, *Frame);
			C.SunWidths = bWidths ? Pass.GetBuffer(Inputs.Queue.SunWidths)->GetDeviceAddress() : 0;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

FShaderSource MakeTilesSource(const FSceneFacts& Facts, const FSunRates& Rates)
{
	FShaderDefines Defines = MakeSettledDefines(Rates);
	for (auto& Define : MakeHostShadowDefines(Facts)) { Defines.push_back(std::move(Define)); }
	AddBackPixelsDefine(Facts.bBackPixels, Defines);
	return MakeComputeSource("Tiles/Tiles.comp", std::move(Defines));
}

FShaderSource MakeSunQueueSource() { return MakeComputeSource("Tiles/QueueSun.comp"); }

uint32_t CountTiles(const FFrameContext& Context) { return DivideUp(Context.Width, TILE_SIZE) * DivideUp(Context.Height, TILE_SIZE); }
} // namespace

bool MayLackSunRays(const FFrameContext& Context, const FRayQueue& Queue)
{
	return Queue.bMayOverflow && Queue.Capacity < uint64_t(Context.Width) * Context.Height;
}

void ListTilesShaders(const FSceneFacts& Facts, const FSunRates& Rates, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeTilesSource(Facts, Rates));
	Out.push_back(MakeSunQueueSource());
}

FGraphBuffer CreateSunMarks(FFrameContext& Context, const FRayQueue& Queue)
{
	const uint64_t Pairs = DivideUp(CountTiles(Context), 2);
	return Context.Graph.CreateBuffer({Pairs * (THREAD_ORDER_BITS / 8)}, (Queue.Name + "Marks").c_str());
}

void AddSunQueuePass(FFrameContext& Context, const FRayQueue& Queue, FGraphBuffer Marks, uint32_t Samples, FGraphBuffer Tiles)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSunQueueSource());
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Queue.Name + "Queue").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Marks, ERTAccess::ShaderRead);
		if (Tiles.IsValid()) { Builder.Read(Tiles, ERTAccess::ShaderRead); }
		for (const FGraphBuffer Buffer : {Queue.Requests, Queue.Counters}) { Builder.Write(Buffer, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			StartQueue(Pass, Queue);
			FSunQueueConstants C{};
			C.Pass = Frame->Pass;
			C.Marks = GetAddress(Pass, Marks);
			C.Tiles = GetAddress(Pass, Tiles);
			C.Requests = GetAddress(Pass, Queue.Requests);
			C.Counters = GetAddress(Pass, Queue.Counters);
			C.Capacity = Queue.Capacity;
			C.TileCount = CountTiles(*Frame);
			C.Samples = Samples;
			Dispatch2D(Pass, Pipeline, C, DivideUp(C.TileCount * TILE_PIXELS, THREAD_ORDER_BITS), 1, THREAD_ORDER_GROUP_SIZE);
		};
	});
}

FShaderSource MakeShareSource() { return MakeComputeSource("Tiles/ShareQueue.comp"); }

void AddShareQueuePass(FFrameContext& Context, const FRayQueue& Queue, FGraphBuffer Tiles, bool bRest)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeShareSource());
	if (!Pipeline) { return; } // AddTilesPass had it
	const FFrameContext* const Frame = &Context;
	const FTilesPass Inputs{{}, Queue, Tiles};
	Context.Graph.AddPass((Queue.Name + "Share").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Tiles, ERTAccess::ShaderRead);
		for (const FGraphBuffer Buffer : {Queue.Requests, Queue.Counters})
		{
			Builder.Read(Buffer, ERTAccess::StorageRead);
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FTilesConstants C = MakeConstants(Pass, *Frame, Inputs);
			C.bSunRest = bRest ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, CountTiles(*Frame), 1, TILE_PIXELS);
		};
	});
}

FGraphBuffer AddTilesPass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun,
    const FSettledTiles& Settled, const FHostShadowMap& Map)
{
	IRTPipeline* const Sort = RequireCompute(Context, MakeTilesSource(Context.Facts, Settled.Rates));
	// Sun rays come first in the queue: they find room unless it is smaller than the picture.
	const bool bShare = MayLackSunRays(Context, Queue) && Sun.SamplesPerPixel > 0;
	if (!Sort || !RequireCompute(Context, MakeSunQueueSource()) || (bShare && !RequireCompute(Context, MakeShareSource()))) { return {}; }
	FTilesPass Inputs{GBuffer, Queue, {}, {}, Sun, Settled, Map};
	Inputs.Tiles = Context.Graph.CreateBuffer({uint64_t(CountTiles(Context)) * sizeof(FTile)}, "Tiles");
	Inputs.Marks = CreateSunMarks(Context, Queue);
	AddSortPass(Context, Sort, Inputs);
	AddSunQueuePass(Context, Queue, Inputs.Marks, 1, Map.IsValid() ? Inputs.Tiles : FGraphBuffer());
	if (bShare) { AddShareQueuePass(Context, Queue, Inputs.Tiles, false); }
	return Inputs.Tiles;
}

} // namespace Lantern
