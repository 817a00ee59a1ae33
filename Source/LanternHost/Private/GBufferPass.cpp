#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "GBufferTypes.h"
#include "LanternCore/TaskTrace.h"
#include "LanternCore/Tasks.h"
#include "LanternHost/HostScene.h"

namespace Lantern
{

namespace
{
constexpr std::array<ERTFormat, 4> ColorFormats = {ERTFormat::RGBA16_SNORM, ERTFormat::RGBA8_SRGB, ERTFormat::RGBA8_UNORM, ERTFormat::RGBA32_FLOAT};

FRTStatus CreatePipeline(FRenderer& Renderer, bool bMasked, ERTCull Cull, TRTRef<IRTPipeline>& Out)
{
	FShaderSource Vertex{"GBuffer/GBuffer.vert", ERTShaderStage::Vertex, {}, {}};
	FShaderSource Fragment{"GBuffer/GBuffer.frag", ERTShaderStage::Fragment, {}, {}};
	if (bMasked) { Fragment.Defines.emplace_back("MASKED", "1"); }
	FShaderBinary VertexBinary, FragmentBinary;
	if (FRTStatus S = Renderer.GetCompiler().Compile(Vertex, VertexBinary); !S) { return S; }
	if (FRTStatus S = Renderer.GetCompiler().Compile(Fragment, FragmentBinary); !S) { return S; }
	FRTRasterPipelineDesc Desc;
	Desc.Vertex = VertexBinary.GetCode();
	Desc.Fragment = FragmentBinary.GetCode();
	Desc.ColorFormats = ColorFormats.data();
	Desc.ColorCount = static_cast<uint32_t>(ColorFormats.size());
	Desc.DepthFormat = ERTFormat::D32_FLOAT;
	Desc.Cull = Cull;
	Desc.Name = bMasked ? "GBufferMasked" : "GBuffer";
	return Renderer.GetDevice().CreateRasterPipeline(Desc, Out.ReleaseAndGetAddress());
}

constexpr uint32_t NoDraw = ~0u;
constexpr size_t CullGrain = 4096;
constexpr uint32_t DistanceBins = 1024;

/// Quarters of powers of two, which is near enough: depth tests spare the shading of what is hidden.
uint32_t GetDistanceBin(double Distance) { return std::bit_cast<uint32_t>(static_cast<float>(std::max(0.0, Distance))) >> 21; }
} // namespace

IRTPipeline* FGBufferPass::GetPipeline(const FFrameContext& Context, bool bMasked, ERTCull Cull)
{
	TRTRef<IRTPipeline>& Entry = Pipelines[bMasked][static_cast<size_t>(Cull)];
	if (!Entry)
	{
		if (FRTStatus S = CreatePipeline(Renderer, bMasked, Cull, Entry); !S)
		{
			Context.Fail(S);
			return nullptr;
		}
	}
	return Entry.Get();
}

void FGBufferPass::CollectSeen(const FView& View, const FHostScene& Scene)
{
	const FViewFrustum Frustum(View);
	const std::vector<FHostScene::FDraw>& Draws = Scene.GetDraws();
	Chunks.resize((Draws.size() + CullGrain - 1) / CullGrain);
	ParallelFor(Chunks.size(), 1, [&](size_t Begin, size_t End) {
		FTraceScope Trace("G-buffer culling");
		for (size_t Chunk = Begin; Chunk < End; ++Chunk)
		{
			Chunks[Chunk].clear();
			for (size_t I = Chunk * CullGrain; I < std::min(Draws.size(), (Chunk + 1) * CullGrain); ++I)
			{
				const FHostScene::FDraw& Draw = Draws[I];
				if (!Frustum.MaySee(Draw.Center, Draw.Radius)) { continue; }
				Chunks[Chunk].push_back({static_cast<uint32_t>(I), GetDistanceBin(glm::distance(Draw.Center, View.Position) - Draw.Radius)});
			}
		}
	});
	Seen.clear();
	for (const std::vector<FSeen>& Chunk : Chunks) { Seen.insert(Seen.end(), Chunk.begin(), Chunk.end()); }
}

void FGBufferPass::SortByDistance()
{
	std::array<uint32_t, DistanceBins> Next{};
	for (const FSeen& Item : Seen) { ++Next[Item.Bin]; }
	uint32_t First = 0;
	for (uint32_t& Count : Next) { First += std::exchange(Count, First); }
	Sorted.resize(Seen.size());
	for (const FSeen& Item : Seen) { Sorted[Next[Item.Bin]++] = Item; }
}

/// One draw a batch, in the order of their nearest objects, and the objects of each, near before far.
FRTStatus FGBufferPass::MakeBatchDraws(const FHostScene& Scene, FUploadSlice& OutObjects)
{
	const std::vector<uint32_t>& Indices = Scene.GetBatchIndices();
	BatchDraws.clear();
	DrawOfBatch.assign(2 * Scene.GetBatches().size(), NoDraw);
	uint32_t Total = 0;
	for (const FSeen& Item : Sorted)
	{
		const FHostScene::FDraw& Draw = Scene.GetDraws()[Item.Draw];
		for (uint32_t I = 0; I < Draw.BatchCount; ++I)
		{
			const uint32_t Batch = Indices[Draw.FirstBatch + I];
			uint32_t& Index = DrawOfBatch[2 * Batch + Draw.bMirrored];
			if (Index == NoDraw)
			{
				Index = static_cast<uint32_t>(BatchDraws.size());
				BatchDraws.push_back({Batch, Draw.bMirrored});
			}
			++BatchDraws[Index].Count;
		}
		Total += Draw.BatchCount;
	}
	if (Total == 0) { return FRTStatus::Success(); }
	if (FRTStatus S = Renderer.GetUploads().Allocate(uint64_t(Total) * sizeof(uint32_t), OutObjects); !S) { return S; }
	uint32_t First = 0;
	for (FBatchDraw& BatchDraw : BatchDraws)
	{
		BatchDraw.First = First;
		First += std::exchange(BatchDraw.Count, 0u);
	}
	auto* const Objects = static_cast<uint32_t*>(OutObjects.Data);
	for (const FSeen& Item : Sorted)
	{
		const FHostScene::FDraw& Draw = Scene.GetDraws()[Item.Draw];
		for (uint32_t I = 0; I < Draw.BatchCount; ++I)
		{
			FBatchDraw& BatchDraw = BatchDraws[DrawOfBatch[2 * Indices[Draw.FirstBatch + I] + Draw.bMirrored]];
			Objects[BatchDraw.First + BatchDraw.Count++] = Draw.Object.Index;
		}
	}
	return FRTStatus::Success();
}

void FGBufferPass::RecordDraws(FFrameContext& Frame, IRTCommandList& List, const FHostScene& Scene)
{
	CollectSeen(Frame.View, Scene);
	SortByDistance();
	FUploadSlice Objects;
	if (FRTStatus S = MakeBatchDraws(Scene, Objects); !S) { return Frame.Fail(S); }
	const auto IsMasked = [&](const FBatchDraw& Draw) { return Scene.GetBatches()[Draw.Batch].bMasked; };
	std::stable_partition(BatchDraws.begin(), BatchDraws.end(), [&](const FBatchDraw& Draw) { return !IsMasked(Draw); });
	IRTPipeline* Bound = nullptr;
	IRTBuffer* BoundIndices = nullptr;
	for (const FBatchDraw& Draw : BatchDraws)
	{
		const FHostScene::FDrawBatch& Batch = Scene.GetBatches()[Draw.Batch];
		const ERTCull Cull = Batch.bDoubleSided ? ERTCull::None : Draw.bMirrored ? ERTCull::Front : ERTCull::Back;
		IRTPipeline* const Pipeline = GetPipeline(Frame, Batch.bMasked && Frame.Facts.bMasked, Cull);
		if (!Pipeline) { return; }
		if (Pipeline != Bound) { List.SetPipeline(Bound = Pipeline); }
		if (Batch.Indices != BoundIndices) { List.SetIndexBuffer(BoundIndices = Batch.Indices, 0, ERTIndexType::UInt32); }
		const FGBufferConstants Constants{Frame.Pass, Objects.Address + uint64_t(Draw.First) * sizeof(uint32_t), Batch.Section};
		List.PushConstants(&Constants, sizeof(Constants));
		List.DrawIndexed(Batch.IndexCount, Draw.Count, Batch.FirstIndex, 0);
	}
}

FGBuffer FGBufferPass::Add(FFrameContext& Context, const FHostScene& Scene)
{
	FFrameGraph& Graph = Context.Graph;
	const auto Create = [&](ERTFormat Format, const char* Name) { return Graph.CreateTexture({Context.Width, Context.Height, Format}, Name); };
	FGBuffer Out;
	Out.Depth = Create(ERTFormat::D32_FLOAT, "GBufferDepth");
	const std::array<FGraphTexture, 4> Targets = {Create(ColorFormats[0], "GBufferNormals"), Create(ColorFormats[1], "GBufferBaseColor"),
	                                              Create(ColorFormats[2], "GBufferMaterial"), Create(ColorFormats[3], "GBufferEmissive")};
	Out.Normals = Targets[0];
	Out.BaseColor = Targets[1];
	Out.Material = Targets[2];
	Out.Emissive = Targets[3];
	FFrameContext* const Frame = &Context;
	Graph.AddPass("GBuffer", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Target : Targets) { Builder.Write(Target, ERTAccess::RenderTarget); }
		Builder.Write(Out.Depth, ERTAccess::DepthWrite);
		return [=, this, &Scene](FPassContext& Pass) {
			std::array<FRTColorTarget, 4> Colors;
			for (size_t I = 0; I < Colors.size(); ++I) { Colors[I].Texture = Pass.GetTexture(Targets[I]); }
			FRTRasterPassDesc Desc;
			Desc.Colors = Colors.data();
			Desc.ColorCount = static_cast<uint32_t>(Colors.size());
			Desc.Depth = Pass.GetTexture(Out.Depth);
			Desc.Width = Frame->Width;
			Desc.Height = Frame->Height;
			Pass.Commands().BeginRasterPass(Desc);
			RecordDraws(*Frame, Pass.Commands(), Scene);
			Pass.Commands().EndRasterPass();
		};
	});
	return Out;
}

} // namespace Lantern
