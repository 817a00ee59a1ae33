#include <algorithm>
#include <array>
#include <cmath>

#include "GBufferTypes.h"
#include "LanternCore/Log.h"
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

struct FSeenDraw
{
	const FHostScene::FDraw* Draw = nullptr;
	double Distance = 0.0; ///< to the nearest it may be
};

/// What the camera may see; solid before masked, near before far, so that depth tests spare the shading of what is hidden.
std::vector<FSeenDraw> CollectDraws(const FFrameContext& Context, const FHostScene& Scene)
{
	const FViewFrustum Frustum(Context.View);
	std::vector<FSeenDraw> Seen;
	for (const FHostScene::FDraw& Draw : Scene.GetDraws())
	{
		const glm::dmat4& Transform = Context.Scene.GetObject(Draw.Object).Transform;
		// No direction is stretched by more than this (the Frobenius norm).
		const double Scale2 = glm::dot(Transform[0], Transform[0]) + glm::dot(Transform[1], Transform[1]) + glm::dot(Transform[2], Transform[2]);
		const double Radius = std::sqrt(Scale2) * double(Draw.Radius);
		const glm::dvec3 Center(Transform * glm::dvec4(Draw.Center, 1.0));
		if (Frustum.MaySee(Center, Radius)) { Seen.push_back({&Draw, std::max(0.0, glm::distance(Center, Context.View.Position) - Radius)}); }
	}
	std::stable_sort(Seen.begin(), Seen.end(), [](const FSeenDraw& A, const FSeenDraw& B) {
		return A.Draw->bMasked != B.Draw->bMasked ? B.Draw->bMasked : A.Distance < B.Distance;
	});
	return Seen;
}
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
			IRTPipeline* Bound = nullptr;
			IRTBuffer* BoundIndices = nullptr;
			for (const FSeenDraw& Seen : CollectDraws(*Frame, Scene))
			{
				const FHostScene::FDraw& Draw = *Seen.Draw;
				const bool bMirrored = glm::determinant(glm::dmat3(Frame->Scene.GetObject(Draw.Object).Transform)) < 0.0;
				const ERTCull Cull = Draw.bDoubleSided ? ERTCull::None : bMirrored ? ERTCull::Front : ERTCull::Back;
				IRTPipeline* const Pipeline = GetPipeline(*Frame, Draw.bMasked && Frame->Facts.bMasked, Cull);
				if (!Pipeline) { break; }
				if (Pipeline != Bound) { Pass.Commands().SetPipeline(Bound = Pipeline); }
				if (Draw.Indices != BoundIndices) { Pass.Commands().SetIndexBuffer(BoundIndices = Draw.Indices, 0, ERTIndexType::UInt32); }
				const FGBufferConstants Constants{Frame->Pass, Draw.Object.Index, Frame->Scene.GetFirstSection(Draw.Object) + Draw.Section};
				Pass.Commands().PushConstants(&Constants, sizeof(Constants));
				Pass.Commands().DrawIndexed(Draw.IndexCount, 1, Draw.FirstIndex, 0);
			}
			Pass.Commands().EndRasterPass();
		};
	});
	return Out;
}

} // namespace Lantern
