// The screen in tiles.
#include "Tiles/Tiles.h"

#include "TileTypes.h"

namespace Lantern
{

namespace
{
/// Others reach the counters as their pass has declared it, behind this.
void ClearCounters(FPassContext& Pass, IRTBuffer* Counters)
{
	constexpr ERTAccess Declared = ERTAccess::StorageWrite;
	const FRTBarrier Before{Counters, nullptr, Declared, ERTAccess::CopyWrite}, After{Counters, nullptr, ERTAccess::CopyWrite, Declared};
	Pass.Commands().Barriers(&Before, 1);
	Pass.Commands().FillBuffer(Counters, 0, sizeof(FRayQueueCounters), 0);
	Pass.Commands().Barriers(&After, 1);
}
} // namespace

FShaderSource MakeTilesSource() { return MakeComputeSource("Tiles/Tiles.comp"); }

FGraphBuffer AddTilesPass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeTilesSource());
	if (!Pipeline) { return {}; }
	const uint32_t Width = Context.Width, Height = Context.Height;
	const uint64_t TileCount = uint64_t(DivideUp(Width, TILE_SIZE)) * DivideUp(Height, TILE_SIZE);
	const FGraphBuffer Tiles = Context.Graph.CreateBuffer({TileCount * sizeof(FTile)}, "Tiles");
	const FPassConstants PassConstants = Context.Pass;
	Context.Graph.AddPass((Queue.Name + "Tiles").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		for (const FGraphBuffer Buffer : {Tiles, Queue.Requests, Queue.Counters, Queue.Answers})
		{
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			IRTBuffer* const Counters = Pass.GetBuffer(Queue.Counters);
			ClearCounters(Pass, Counters);
			FTilesConstants C{};
			C.Pass = PassConstants;
			C.Tiles = Pass.GetBuffer(Tiles)->GetDeviceAddress();
			C.Requests = Pass.GetBuffer(Queue.Requests)->GetDeviceAddress();
			C.Counters = Counters->GetDeviceAddress();
			C.Answers = Pass.GetBuffer(Queue.Answers)->GetDeviceAddress();
			C.Capacity = Queue.Capacity;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.SunSamples = Sun.SamplesPerPixel;
			C.bSoftSun = Sun.bSoft ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, Width, Height, TILE_SIZE);
		};
	});
	return Tiles;
}

} // namespace Lantern
