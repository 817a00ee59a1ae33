// The screen in tiles.
#include "Tiles/Tiles.h"

#include "TileTypes.h"

namespace Lantern
{

namespace
{
struct FTilesPass
{
	FGBuffer GBuffer;
	FRayQueue Queue;
	FGraphBuffer Tiles;
	FSunRays Sun;
	FSettledTiles Settled;
};

FTilesConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FTilesPass& Inputs)
{
	const auto AddressOf = [&](FGraphBuffer Buffer) { return Pass.GetBuffer(Buffer)->GetDeviceAddress(); };
	FTilesConstants C{};
	C.Pass = Frame.Pass;
	C.Tiles = AddressOf(Inputs.Tiles);
	C.Requests = AddressOf(Inputs.Queue.Requests);
	C.Counters = AddressOf(Inputs.Queue.Counters);
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
		for (const FGraphBuffer Buffer : {Inputs.Tiles, Queue.Requests, Queue.Counters, Queue.Answers})
		{
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		DeclareSettled(Builder, *Frame, Inputs.Settled);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			StartQueue(Pass, Inputs.Queue);
			FTilesConstants C = MakeConstants(Pass, *Frame, Inputs);
			C.Answers = Pass.GetBuffer(Inputs.Queue.Answers)->GetDeviceAddress();
			C.Depth = GetSampledIndex(Pass, Inputs.GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, Inputs.GBuffer.Normals);
			C.SunSamples = Inputs.Sun.SamplesPerPixel;
			C.SunOneMinusCos = GetSunOneMinusCos(Inputs.Sun);
			C.Settled = WriteSettled(Pass, *Frame, Inputs.Settled);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

uint32_t CountTiles(const FFrameContext& Context) { return DivideUp(Context.Width, TILE_SIZE) * DivideUp(Context.Height, TILE_SIZE); }
} // namespace

bool MayLackSunRays(const FFrameContext& Context, const FRayQueue& Queue)
{
	return Queue.bMayOverflow && Queue.Capacity < uint64_t(Context.Width) * Context.Height;
}

FShaderSource MakeTilesSource(const FSunRates& Rates) { return MakeComputeSource("Tiles/Tiles.comp", MakeSettledDefines(Rates)); }

FShaderSource MakeShareSource() { return MakeComputeSource("Tiles/ShareQueue.comp"); }

void AddShareQueuePass(FFrameContext& Context, const FRayQueue& Queue, FGraphBuffer Tiles, bool bRest)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeShareSource());
	if (!Pipeline) { return; } // AddTilesPass had it
	const FFrameContext* const Frame = &Context;
	const FTilesPass Inputs{{}, Queue, Tiles, {}, {}};
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

FGraphBuffer AddTilesPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun, const FSettledTiles& Settled)
{
	IRTPipeline* const Sort = RequireCompute(Context, MakeTilesSource(Settled.Rates));
	// Sun rays come first in the queue: they find room unless it is smaller than the picture.
	const bool bShare = MayLackSunRays(Context, Queue) && Sun.SamplesPerPixel > 0;
	if (!Sort || (bShare && !RequireCompute(Context, MakeShareSource()))) { return {}; }
	FTilesPass Inputs{GBuffer, Queue, {}, Sun, Settled};
	Inputs.Tiles = Context.Graph.CreateBuffer({uint64_t(CountTiles(Context)) * sizeof(FTile)}, "Tiles");
	AddSortPass(Context, Sort, Inputs);
	if (bShare) { AddShareQueuePass(Context, Queue, Inputs.Tiles, false); }
	return Inputs.Tiles;
}

} // namespace Lantern
