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

constexpr uint32_t OrderedTiles = 2 * THREAD_ORDER_GROUP_SIZE; // of a work group of QueueSun.comp
static_assert(THREAD_ORDER_BITS == 2 * TILE_PIXELS, "an entry of marks has two tiles");

/// Rays: SUN_QUEUE_…
void AddQueuePass(FFrameContext& Context, const FSunQueue& Inputs, const std::string& Name, const FShaderSource& Shader, uint32_t Rays,
    uint32_t TilesPerGroup)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, Shader);
	const FFrameContext* const Frame = &Context;
	const bool bKept = Rays == SUN_QUEUE_KEPT;
	Context.Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.Marks, bKept ? ERTAccess::StorageRead : ERTAccess::ShaderRead);
		if (bKept) { Builder.Write(Inputs.Marks, ERTAccess::StorageWrite); }
		if (Inputs.Tiles.IsValid()) { Builder.Read(Inputs.Tiles, ERTAccess::ShaderRead); }
		for (const FGraphBuffer Buffer : {Inputs.Queue.Requests, Inputs.Queue.Counters})
		{
			if (bKept) { Builder.Read(Buffer, ERTAccess::StorageRead); }
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			if (!bKept) { StartQueue(Pass, Inputs.Queue); }
			FSunQueueConstants C{};
			C.Pass = Frame->Pass;
			C.Marks = GetAddress(Pass, Inputs.Marks);
			C.Tiles = GetAddress(Pass, Inputs.Tiles);
			C.Requests = GetAddress(Pass, Inputs.Queue.Requests);
			C.Counters = GetAddress(Pass, Inputs.Queue.Counters);
			C.Capacity = Inputs.Queue.Capacity;
			C.TileCount = CountTiles(*Frame);
			C.Samples = Inputs.Samples;
			C.Rays = Rays;
			Dispatch2D(Pass, Pipeline, C, C.TileCount, 1, TilesPerGroup);
		};
	});
}
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

void AddSunQueuePass(FFrameContext& Context, const FSunQueue& Inputs)
{
	const bool bShare = Inputs.bMayLackRoom;
	AddQueuePass(Context, Inputs, Inputs.Queue.Name + "Queue", MakeSunQueueSource(), bShare ? SUN_QUEUE_ALL : SUN_QUEUE_ROOM, OrderedTiles);
	if (!bShare) { return; }
	AddQueuePass(Context, Inputs, Inputs.Queue.Name + "Share", MakeShareSource(), SUN_QUEUE_KEPT, TILE_PIXELS);
	AddQueuePass(Context, Inputs, Inputs.Queue.Name + "Kept", MakeSunQueueSource(), SUN_QUEUE_KEPT, OrderedTiles);
}

FShaderSource MakeShareSource() { return MakeComputeSource("Tiles/ShareQueue.comp"); }

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
	AddSunQueuePass(Context, {Queue, Inputs.Marks, Map.IsValid() ? Inputs.Tiles : FGraphBuffer(), 1, bShare});
	return Inputs.Tiles;
}

} // namespace Lantern
