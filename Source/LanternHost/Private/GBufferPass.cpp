#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "GBufferTypes.h"
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

/// One draw a batch, in the order of their nearest objects, and the objects of each, near before far.
FRTStatus FGBufferPass::MakeBatchDraws(FHostScene& Scene, FUploadSlice& OutObjects)
{
	const std::vector<uint32_t>& Indices = Scene.GetBatchIndices();
	const auto ForEach = [&](auto Do) {
		for (const FDrawBlocks::FSeen& InBlock : Seen)
		{
			const FDrawBlocks::FBlock& Block = Scene.GetDrawBlocks().GetBlock(InBlock.Block);
			for (uint64_t Left = InBlock.Items; Left != 0; Left &= Left - 1)
			{
				const int Index = std::countr_zero(Left);
				const FDrawBlocks::FItem& Item = Block.Items[Index];
				const uint32_t Mirrored = (Block.Mirrored >> Index) & 1u;
				for (uint32_t I = 0; I < Item.BatchCount; ++I) { Do(2 * Indices[Item.FirstBatch + I] + Mirrored, Item.Object); }
			}
		}
	};
	BatchDraws.clear();
	DrawOfBatch.assign(2 * Scene.GetBatches().size(), NoDraw);
	uint32_t Total = 0;
	ForEach([&](uint32_t Batch, uint32_t) {
		uint32_t& Index = DrawOfBatch[Batch];
		if (Index == NoDraw)
		{
			Index = static_cast<uint32_t>(BatchDraws.size());
			BatchDraws.push_back({Batch / 2, Batch % 2 != 0});
		}
		++BatchDraws[Index].Count;
		++Total;
	});
	if (Total == 0) { return FRTStatus::Success(); }
	if (FRTStatus S = Renderer.GetUploads().Allocate(uint64_t(Total) * sizeof(uint32_t), OutObjects); !S) { return S; }
	uint32_t First = 0;
	for (FBatchDraw& Draw : BatchDraws)
	{
		Draw.First = First;
		First += std::exchange(Draw.Count, 0u);
	}
	auto* const Objects = static_cast<uint32_t*>(OutObjects.Data);
	ForEach([&](uint32_t Batch, uint32_t Object) {
		FBatchDraw& Draw = BatchDraws[DrawOfBatch[Batch]];
		Objects[Draw.First + Draw.Count++] = Object;
	});
	return FRTStatus::Success();
}

void FGBufferPass::RecordDraws(FFrameContext& Frame, IRTCommandList& List, FHostScene& Scene)
{
	Scene.GetDrawBlocks().Collect(Frame.View, MinPixels, Seen);
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

FGBuffer FGBufferPass::Add(FFrameContext& Context, FHostScene& Scene)
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
