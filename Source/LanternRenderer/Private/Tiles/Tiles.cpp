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
	FHostShadowMap Map;
	uint64_t TileCount = 0;
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
		Inputs.Map.Read(Builder);
		const bool bWidths = Inputs.Map.IsValid() && Queue.SunWidths.IsValid();
		if (bWidths) { Builder.Write(Queue.SunWidths, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			StartQueue(Pass, Inputs.Queue);
			FTilesConstants C = MakeConstants(Pass, *Frame, Inputs);
			C.Answers = Pass.GetBuffer(Inputs.Queue.Answers)->GetDeviceAddress();
			C.Depth = GetSampledIndex(Pass, Inputs.GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, Inputs.GBuffer.Normals);
			C.SunSamples = Inputs.Sun.SamplesPerPixel;
			C.bSoftSun = Inputs.Sun.bSoft ? 1u : 0u;
			C.SunMask = Inputs.Sun.InstanceMask;
			C.LitMask = Inputs.Sun.LitMask;
			C.HostShadow = Inputs.Map.Push(Pass, *Frame);
			C.SunWidths = bWidths ? Pass.GetBuffer(Inputs.Queue.SunWidths)->GetDeviceAddress() : 0;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

void AddSharePass(FFrameContext& Context, IRTPipeline* Pipeline, const FTilesPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "Share").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.Tiles, ERTAccess::ShaderRead);
		for (const FGraphBuffer Buffer : {Inputs.Queue.Requests, Inputs.Queue.Counters})
		{
			Builder.Read(Buffer, ERTAccess::StorageRead);
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			const auto Tiles = static_cast<uint32_t>(Inputs.TileCount);
			Dispatch2D(Pass, Pipeline, MakeConstants(Pass, *Frame, Inputs), Tiles, 1, TILE_PIXELS);
		};
	});
}
} // namespace

FShaderSource MakeTilesSource(const FSceneFacts& Facts) { return MakeComputeSource("Tiles/Tiles.comp", MakeHostShadowDefines(Facts)); }

FShaderSource MakeShareSource() { return MakeComputeSource("Tiles/ShareQueue.comp"); }

FGraphBuffer AddTilesPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun, const FHostShadowMap& Map)
{
	IRTPipeline* const Sort = RequireCompute(Context, MakeTilesSource(Context.Facts));
	// Sun rays come first in the queue: they find room unless it is smaller than the picture.
	const bool bShare = Queue.bMayOverflow && Sun.SamplesPerPixel > 0 && Queue.Capacity < uint64_t(Context.Width) * Context.Height;
	IRTPipeline* const Share = bShare ? RequireCompute(Context, MakeShareSource()) : nullptr;
	if (!Sort || (bShare && !Share)) { return {}; }
	FTilesPass Inputs{GBuffer, Queue, {}, Sun, Map};
	Inputs.TileCount = uint64_t(DivideUp(Context.Width, TILE_SIZE)) * DivideUp(Context.Height, TILE_SIZE);
	Inputs.Tiles = Context.Graph.CreateBuffer({Inputs.TileCount * sizeof(FTile)}, "Tiles");
	AddSortPass(Context, Sort, Inputs);
	if (Share) { AddSharePass(Context, Share, Inputs); }
	return Inputs.Tiles;
}

} // namespace Lantern
