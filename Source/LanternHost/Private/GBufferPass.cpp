// Records the raster G-buffer: its pipelines, culled batches and draws.
#include "LanternHost/GBufferPass.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "GBufferTypes.h"
#include "HostMaterials.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarMotion("r.RT.GBuffer.Motion", true,
    "Makes the sample engine's raster write motion vectors. If off, histories treat moving objects as static, "
    "and each pixel costs 16 bytes less.");
struct FTarget
{
	FGraphTexture FGBuffer::*Texture;
	ERTFormat Format;
	const char* Name;
};
constexpr size_t MostTargets = 6;

/// In the order of the fragment shader's outputs.
std::vector<FTarget> ListTargets(bool bMotion, bool bBack)
{
	std::vector<FTarget> Targets = {{&FGBuffer::Normals, ERTFormat::RGBA16_SNORM, "GBufferNormals"},
	    {&FGBuffer::BaseColor, ERTFormat::RGBA8_SRGB, "GBufferBaseColor"}, {&FGBuffer::Material, ERTFormat::RGBA8_UNORM, "GBufferMaterial"},
	    {&FGBuffer::Emissive, ERTFormat::RGBA32_FLOAT, "GBufferEmissive"}};
	if (bMotion) { Targets.push_back({&FGBuffer::Motion, ERTFormat::RGBA32_FLOAT, "GBufferMotion"}); }
	if (bBack) { Targets.push_back({&FGBuffer::BackAlbedo, ERTFormat::RGBA8_SRGB, "GBufferBackAlbedo"}); }
	return Targets;
}

} // namespace

FRasterSource FGBufferPass::MakeSource(const FPipelineKey& Key) const
{
	const FMaterialPrograms& Programs = Renderer.GetPrograms();
	FRasterSource Source;
	Source.Key = fmt::format("GBuffer {}{}{}{}{}", Key.Program, Key.bMasked ? " masked" : "", Key.Targets.bMotion ? " motion" : "",
	    Key.Targets.bBack ? " back" : "",
	    Key.Cull == ERTCull::Back    ? ""
	    : Key.Cull == ERTCull::Front ? " front"
	                                 : " both");
	Source.Revision = Programs.GetRevision(Key.Program);
	Source.Name = Key.bMasked ? "GBufferMasked" : "GBuffer";
	if (Key.Program != StandardProgram) { Source.Name += ' ' + Programs.Get(Key.Program).Name; }
	Source.Vertex = {"GBuffer/GBuffer.vert", ERTShaderStage::Vertex, {}, {}};
	Source.Fragment = {"GBuffer/GBuffer.frag", ERTShaderStage::Fragment, {}, {}};
	if (Key.bMasked) { Source.Fragment.Defines.emplace_back("MASKED", "1"); }
	if (Key.Targets.bBack) { Source.Fragment.Defines.emplace_back("BACK", "1"); }
	if (Key.Targets.bMotion)
	{
		Source.Vertex.Defines.emplace_back("MOTION", "1");
		Source.Fragment.Defines.emplace_back("MOTION", "1");
	}
	Source.Fragment = Programs.MakeSource(std::move(Source.Fragment), Key.Program);
	for (const FTarget& Target : ListTargets(Key.Targets.bMotion, Key.Targets.bBack)) { Source.ColorFormats.push_back(Target.Format); }
	Source.DepthFormat = ERTFormat::D32_FLOAT;
	Source.Cull = Key.Cull;
	return Source;
}

const FRasterSource& FGBufferPass::GetSource(const FPipelineKey& Key)
{
	FRasterSource& Source = Sources[Key];
	if (Source.Key.empty() || Source.Revision != Renderer.GetPrograms().GetRevision(Key.Program)) { Source = MakeSource(Key); }
	return Source;
}

/// Of all that the scene may draw, in view or not: what comes into view is then there.
std::vector<FGBufferPass::FPipelineKey> FGBufferPass::ListKeys(const FHostScene& Scene, const FSceneFacts& Facts, FTargets Targets)
{
	std::vector<FPipelineKey> Keys;
	for (const FHostScene::FDrawKind& Kind : Scene.GetDrawKinds())
	{
		const FPipelineKey Key{Kind.Program, IsTested(Kind, Facts), Kind.bDoubleSided ? ERTCull::None : ERTCull::Back, Targets};
		Keys.push_back(Key);
		if (Kind.bDoubleSided || !Scene.GetDrawBlocks().HasMirrored()) { continue; }
		Keys.push_back(Key);
		Keys.back().Cull = ERTCull::Front;
	}
	return Keys;
}

bool FGBufferPass::MayMove(bool bFollowed) const { return bFollowed && bMotion && CVarMotion.GetOnRenderThread(); }

void FGBufferPass::Want(const std::vector<FPipelineKey>& Keys)
{
	for (const FPipelineKey& Key : Keys)
	{
		IRTPipeline* Unused = nullptr;
		(void)Renderer.GetPipelines().Find(GetSource(Key), Unused);
	}
}

std::vector<FGBufferPass::FPipelineKey> FGBufferPass::ListKeys(FHostScene& Scene, const FFrameFeatures& Features) const
{
	const bool bFollowed = Renderer.FollowsMotion(Scene.GetScene(), Features); // brings the facts up to date
	return ListKeys(Scene, Scene.GetScene().GetFacts(), {MayMove(bFollowed), Renderer.HasBackPixels(Scene.GetScene(), Features)});
}

namespace
{
/// Whether a picture would not be complete. A program that does not compile has a stand-in.
bool IsFatal(uint32_t Program, const FRTStatus& Status) { return Program == StandardProgram || Status.Code != ERTResult::CompileFailed; }

void LogFailure(const FRTStatus& Status)
{
	const auto Level = Status.Code == ERTResult::CompileFailed ? ERTLogLevel::Error : ERTLogLevel::Warning;
	LogOnce(Level, std::string("raster: ") + Status.Message);
}
} // namespace

FRTStatus FGBufferPass::Precache(FHostScene& Scene, const FFrameFeatures& Features, const std::function<void(float)>& Progress)
{
	const std::vector<FPipelineKey> Keys = ListKeys(Scene, Features);
	Want(Keys); // side by side
	for (size_t I = 0; I < Keys.size(); ++I)
	{
		IRTPipeline* Unused = nullptr;
		FRTStatus Status = Renderer.GetPipelines().Get(GetSource(Keys[I]), Unused);
		if (!Status && !IsFatal(Keys[I].Program, Status))
		{
			LogFailure(Status);
			FPipelineKey StandIn = Keys[I];
			StandIn.Program = StandardProgram;
			Status = Renderer.GetPipelines().Get(GetSource(StandIn), Unused);
		}
		if (!Status) { return Status; }
		if (Progress) { Progress(static_cast<float>(I + 1) / static_cast<float>(Keys.size())); }
	}
	if (Progress && Keys.empty()) { Progress(1.0f); }
	return FRTStatus::Success();
}

IRTPipeline* FGBufferPass::Ask(const FFrameContext& Context, const FPipelineKey& Key)
{
	IRTPipeline* Pipeline = nullptr;
	const FRasterSource& Source = GetSource(Key);
	const bool bWait = Context.bWaitForPipelines;
	const FRTStatus Status = bWait ? Context.Pipelines.Get(Source, Pipeline) : Context.Pipelines.Find(Source, Pipeline);
	if (Status) { return Pipeline; }
	if (Status.Code == ERTResult::DeviceLost || (bWait && IsFatal(Key.Program, Status))) { Context.Fail(Status); }
	else { LogFailure(Status); }
	return Pipeline;
}

/// Returns whether there is something to draw everything with.
bool FGBufferPass::FindPipelines(const FFrameContext& Context, const FHostScene& Scene, FTargets Targets)
{
	const std::vector<FPipelineKey> Keys = ListKeys(Scene, Context.Facts, Targets);
	if (Context.bWaitForPipelines) { Want(Keys); } // side by side
	const bool bStandIns = GetPipelineFallback() != ERTFallback::Skip;
	bool bComplete = true;
	Pipelines.clear();
	for (const FPipelineKey& Key : Keys)
	{
		IRTPipeline* Pipeline = Ask(Context, Key);
		if (!Pipeline && bStandIns && Key.Program != StandardProgram)
		{
			Pipeline = Ask(Context, {StandardProgram, Key.bMasked, Key.Cull, Key.Targets});
		}
		Pipelines[Key] = Pipeline;
		bComplete &= Pipeline != nullptr;
	}
	return bComplete;
}

/// Finds the frame's pipelines. Returns what they write.
FGBufferPass::FTargets FGBufferPass::ChooseTargets(const FFrameContext& Context, const FHostScene& Scene)
{
	const FTargets Wanted{MayMove(Context.bMotion), Context.Facts.bBackPixels};
	if (FindPipelines(Context, Scene, Wanted))
	{
		Complete = Wanted;
		return Wanted;
	}
	if (!Complete || *Complete == Wanted) { return Wanted; }
	if (FindPipelines(Context, Scene, *Complete)) { return *Complete; }
	FindPipelines(Context, Scene, Wanted);
	return Wanted;
}

void FGBufferPass::RecordDraws(FFrameContext& Frame, IRTCommandList& List, FHostScene& Scene, FTargets Targets, bool bLayers)
{
	if (FRTStatus S = Draws.Make(Scene, Renderer.GetUploads(), Frame.View, MinPixels); !S) { return Frame.Fail(S); }
	IRTPipeline* Bound = nullptr;
	IRTBuffer* BoundIndices = nullptr;
	for (const FDrawList::FRun& Run : Draws.GetRuns())
	{
		const FHostScene::FDrawBatch& Batch = Scene.GetBatches()[Run.Batch];
		if (bLayers && Batch.bTransmissive && !Batch.bBlended) { continue; }
		const ERTCull Cull = Batch.bDoubleSided ? ERTCull::None : Run.bMirrored ? ERTCull::Front : ERTCull::Back;
		IRTPipeline* const Pipeline = Pipelines.at({Batch.Program, IsTested(Batch, Frame.Facts), Cull, Targets});
		if (!Pipeline) { continue; }
		if (Pipeline != Bound) { List.SetPipeline(Bound = Pipeline); }
		if (Batch.Indices != BoundIndices) { List.SetIndexBuffer(BoundIndices = Batch.Indices, 0, ERTIndexType::UInt32); }
		const FGBufferConstants Constants{Frame.Pass, Run.Objects, Batch.Section, bLayers ? 1u : 0u};
		List.PushConstants(&Constants, sizeof(Constants));
		List.DrawIndexed(Batch.IndexCount, Run.Count, Batch.FirstIndex, 0);
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
	const FTargets Written = ChooseTargets(Context, Scene);
	std::vector<FGraphTexture> Targets;
	for (const FTarget& Target : ListTargets(Written.bMotion, Written.bBack))
	{
		Targets.push_back(Out.*Target.Texture = Create(Target.Format, Target.Name));
	}
	assert(Targets.size() <= MostTargets);
	Out.bNamesObjects = true;
	FFrameContext* const Frame = &Context;
	const bool bLayers = IsTransmissionShown(Context);
	Graph.AddPass("GBuffer", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Target : Targets) { Builder.Write(Target, ERTAccess::RenderTarget); }
		Builder.Write(Out.Depth, ERTAccess::DepthWrite);
		Builder.RecordOnTask();
		for (const FGraphToken Unused : {Context.Tokens.Structures, Context.Tokens.Records, Context.Tokens.Sky})
		{
			Builder.Without(Unused);
		}
		return [=, this, &Scene](FPassContext& Pass) {
			std::array<FRTColorTarget, MostTargets> Colors;
			for (size_t I = 0; I < Targets.size(); ++I) { Colors[I].Texture = Pass.GetTexture(Targets[I]); }
			FRTRasterPassDesc Desc;
			Desc.Colors = Colors.data();
			Desc.ColorCount = static_cast<uint32_t>(Targets.size());
			Desc.Depth = Pass.GetTexture(Out.Depth);
			Desc.Width = Frame->Width;
			Desc.Height = Frame->Height;
			Pass.Commands().BeginRasterPass(Desc);
			RecordDraws(*Frame, Pass.Commands(), Scene, Written, bLayers);
			Pass.Commands().EndRasterPass();
		};
	});
	return Out;
}

} // namespace Lantern
