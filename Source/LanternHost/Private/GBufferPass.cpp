// Records the raster G-buffer: its pipelines, culled batches and draws.
#include <algorithm>
#include <array>
#include <bit>

#include "GBufferTypes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternHost/HostScene.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarMotion("r.RT.GBuffer.Motion", true,
    "Makes the sample engine's raster write motion vectors. If off, histories treat moving objects as static, "
    "and each pixel costs 16 bytes less.");
constexpr std::array<ERTFormat, 5> ColorFormats = {
    ERTFormat::RGBA16_SNORM, ERTFormat::RGBA8_SRGB, ERTFormat::RGBA8_UNORM, ERTFormat::RGBA32_FLOAT, ERTFormat::RGBA32_FLOAT};
constexpr std::array<const char*, 5> ColorNames = {
    "GBufferNormals", "GBufferBaseColor", "GBufferMaterial", "GBufferEmissive", "GBufferMotion"};
constexpr uint32_t CountColors(bool bMotion) { return bMotion ? 5 : 4; }

} // namespace

FGBufferPass::FProgram FGBufferPass::MakeProgram(const FPipelineKey& Key) const
{
	FProgram Program{{"GBuffer/GBuffer.vert", ERTShaderStage::Vertex, {}, {}}, {"GBuffer/GBuffer.frag", ERTShaderStage::Fragment, {}, {}}};
	if (Key.bMasked) { Program.Fragment.Defines.emplace_back("MASKED", "1"); }
	if (Key.bMotion)
	{
		Program.Vertex.Defines.emplace_back("MOTION", "1");
		Program.Fragment.Defines.emplace_back("MOTION", "1");
	}
	Program.Fragment = Renderer.GetPrograms().MakeSource(std::move(Program.Fragment), Key.Program);
	return Program;
}

std::vector<FGBufferPass::FProgram> FGBufferPass::GetPrograms() const
{
	std::vector<FProgram> Programs;
	for (const auto& [Key, Entry] : Pipelines) { Programs.push_back(MakeProgram(Key)); }
	return Programs;
}

FRTStatus FGBufferPass::CreatePipeline(const FPipelineKey& Key, TRTRef<IRTPipeline>& Out)
{
	const FProgram Program = MakeProgram(Key);
	FShaderBinary VertexBinary, FragmentBinary;
	if (FRTStatus S = Renderer.GetCompiler().Compile(Program.Vertex, VertexBinary); !S) { return S; }
	if (FRTStatus S = Renderer.GetCompiler().Compile(Program.Fragment, FragmentBinary); !S) { return S; }
	std::string Name = Key.bMasked ? "GBufferMasked" : "GBuffer";
	if (Key.Program != StandardProgram) { Name += ' ' + Renderer.GetPrograms().Get(Key.Program).Name; }
	FRTRasterPipelineDesc Desc;
	Desc.Vertex = VertexBinary.GetCode();
	Desc.Fragment = FragmentBinary.GetCode();
	Desc.ColorFormats = ColorFormats.data();
	Desc.ColorCount = CountColors(Key.bMotion);
	Desc.DepthFormat = ERTFormat::D32_FLOAT;
	Desc.Cull = Key.Cull;
	Desc.Name = Name.c_str();
	TRTRef<IRTPipeline> Made;
	if (FRTStatus S = Renderer.GetDevice().CreateRasterPipeline(Desc, Made.ReleaseAndGetAddress()); !S) { return S; }
	Out = std::move(Made);
	return FRTStatus::Success();
}

IRTPipeline* FGBufferPass::GetPipeline(const FFrameContext& Context, const FPipelineKey& Key)
{
	FPipelineEntry& Entry = Pipelines[Key];
	const uint32_t Revision = Renderer.GetPrograms().GetRevision(Key.Program);
	if (!Entry.Pipeline || Entry.Revision != Revision)
	{
		const bool bTried = Entry.Revision == Revision && Key.Program != StandardProgram;
		const FRTStatus Status = bTried ? FRTStatus::Success() : CreatePipeline(Key, Entry.Pipeline);
		// Errors in the shader's code are permanent; a shortage of memory may pass.
		if (Status || Status.Code == ERTResult::CompileFailed) { Entry.Revision = Revision; }
		if (!Status && (Key.Program == StandardProgram || Status.Code != ERTResult::CompileFailed))
		{
			Context.Fail(Status);
			return Entry.Pipeline.Get();
		}
		if (!Status) { LogError("raster, material program {}: {}", Renderer.GetPrograms().Get(Key.Program).Name, Status.Message); }
	}
	if (Entry.Pipeline || Key.Program == StandardProgram) { return Entry.Pipeline.Get(); }
	return GetPipeline(Context, {StandardProgram, Key.bMasked, Key.Cull, Key.bMotion});
}

/// Lists the objects of each batch in its places, near before far, and orders the batches by their nearest objects.
void FGBufferPass::ListObjects(FHostScene& Scene, uint32_t* Objects)
{
	const uint32_t* const Indices = Scene.GetBatchIndices().data();
	const FHostScene::FDrawBatch* const Batches = Scene.GetBatches().data();
	Uses.assign(Scene.GetBatches().size(), {});
	Order.clear();
	for (const FDrawBlocks::FSeen& InBlock : Seen)
	{
		const FDrawBlocks::FBlock& Block = Scene.GetDrawBlocks().GetBlock(InBlock.Block);
		for (uint64_t Left = InBlock.Items; Left != 0; Left &= Left - 1)
		{
			const int Index = std::countr_zero(Left);
			const FDrawBlocks::FItem& Item = Block.Items[Index];
			const bool bMirrored = ((Block.Mirrored >> Index) & 1u) != 0;
			for (uint32_t I = 0; I < Item.BatchCount; ++I)
			{
				const uint32_t Batch = Indices[Item.FirstBatch + I];
				FBatchUse& Use = Uses[Batch];
				if (Use.Plain + Use.Mirrored == 0) { Order.push_back(Batch); }
				const uint32_t Place = bMirrored ? Batches[Batch].Places - ++Use.Mirrored : Use.Plain++;
				Objects[Batches[Batch].FirstPlace + Place] = Item.Object;
			}
		}
	}
	std::stable_partition(Order.begin(), Order.end(), [&](uint32_t Batch) { return !Batches[Batch].bMasked; });
}

void FGBufferPass::RecordDraws(FFrameContext& Frame, IRTCommandList& List, FHostScene& Scene)
{
	Scene.GetDrawBlocks().Collect(Frame.View, MinPixels, Seen);
	if (Seen.empty()) { return; }
	FUploadSlice Objects;
	if (FRTStatus S = Renderer.GetUploads().Allocate(uint64_t(Scene.GetPlaceCount()) * sizeof(uint32_t), Objects); !S)
	{
		return Frame.Fail(S);
	}
	ListObjects(Scene, static_cast<uint32_t*>(Objects.Data));
	IRTPipeline* Bound = nullptr;
	IRTBuffer* BoundIndices = nullptr;
	for (const uint32_t Index : Order)
	{
		const FHostScene::FDrawBatch& Batch = Scene.GetBatches()[Index];
		for (const bool bMirrored : {false, true})
		{
			const uint32_t Count = bMirrored ? Uses[Index].Mirrored : Uses[Index].Plain;
			if (Count == 0) { continue; }
			const ERTCull Cull = Batch.bDoubleSided ? ERTCull::None : bMirrored ? ERTCull::Front : ERTCull::Back;
			IRTPipeline* const Pipeline = GetPipeline(Frame, {Batch.Program, Batch.bMasked && Frame.Facts.bMasked, Cull, bMotionNow});
			if (!Pipeline) { return; }
			if (Pipeline != Bound) { List.SetPipeline(Bound = Pipeline); }
			if (Batch.Indices != BoundIndices) { List.SetIndexBuffer(BoundIndices = Batch.Indices, 0, ERTIndexType::UInt32); }
			const uint32_t First = Batch.FirstPlace + (bMirrored ? Batch.Places - Count : 0);
			const FGBufferConstants Constants{Frame.Pass, Objects.Address + uint64_t(First) * sizeof(uint32_t), Batch.Section};
			List.PushConstants(&Constants, sizeof(Constants));
			List.DrawIndexed(Batch.IndexCount, Count, Batch.FirstIndex, 0);
		}
	}
}

FGBuffer FGBufferPass::Add(FFrameContext& Context, FHostScene& Scene)
{
	FFrameGraph& Graph = Context.Graph;
	const auto Create = [&](ERTFormat Format, const char* Name) {
		return Graph.CreateTexture({Context.Width, Context.Height, Format}, Name);
	};
	FGBuffer Out;
	Out.Depth = Create(ERTFormat::D32_FLOAT, "GBufferDepth");
	const bool bMayMove = bMotion && CVarMotion.GetOnRenderThread();
	std::array<FGraphTexture, ColorFormats.size()> Targets;
	for (uint32_t I = 0; I < CountColors(bMayMove); ++I) { Targets[I] = Create(ColorFormats[I], ColorNames[I]); }
	Out.Normals = Targets[0];
	Out.BaseColor = Targets[1];
	Out.Material = Targets[2];
	Out.Emissive = Targets[3];
	Out.Motion = Targets[4];
	FFrameContext* const Frame = &Context;
	Graph.AddPass("GBuffer", [&](FPassBuilder& Builder) -> FPassExecute {
		for (uint32_t I = 0; I < CountColors(false); ++I) { Builder.Write(Targets[I], ERTAccess::RenderTarget); }
		if (bMayMove) { Builder.WriteIfRead(Out.Motion, ERTAccess::RenderTarget); }
		Builder.Write(Out.Depth, ERTAccess::DepthWrite);
		Builder.RecordOnTask();
		for (const FGraphToken Unused : {Context.Tokens.Structures, Context.Tokens.Records}) { Builder.Without(Unused); }
		return [=, this, &Scene](FPassContext& Pass) {
			bMotionNow = bMayMove && Pass.GetTexture(Out.Motion);
			const uint32_t ColorCount = CountColors(bMotionNow);
			std::array<FRTColorTarget, ColorFormats.size()> Colors;
			for (uint32_t I = 0; I < ColorCount; ++I) { Colors[I].Texture = Pass.GetTexture(Targets[I]); }
			FRTRasterPassDesc Desc;
			Desc.Colors = Colors.data();
			Desc.ColorCount = ColorCount;
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
