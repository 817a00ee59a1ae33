// Records the cascades of the sample engine's shadow map.
#include "LanternHost/ShadowMapPass.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "HostMaterials.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "ShadowMapTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarHostShadow("r.RT.HostShadow", 0,
    "Shadow map of the sun that the sample engine draws and hands over, by the casters on it. 0: no map. 1: none. 2: objects that stand "
    "still. 3: all objects. 4: only objects that rays to the sun cannot meet, as an engine's billboards.",
    {0, 4});
TRTConsoleVariable<int32_t> CVarCascades(
    "r.RT.HostShadow.Cascades", 4, "Number of cascades of the sample engine's shadow map.", {1, HOST_SHADOW_CASCADES});
TRTConsoleVariable<int32_t> CVarResolution(
    "r.RT.HostShadow.Resolution", 2048, "Texels of a cascade of the sample engine's shadow map, in each direction.", {16, 16384});
TRTConsoleVariable<float> CVarDistance(
    "r.RT.HostShadow.Distance", 120.0f, "Distance from the camera that the sample engine's shadow map reaches, metres.", {1, 1e5});
TRTConsoleVariable<float> CVarSplit("r.RT.HostShadow.Split", 0.8f,
    "How the cascades of the sample engine's shadow map divide the distance. 1: each cascade is larger than the one before by one factor. "
    "0: all are of equal depth. (Zhang et al. 2006)",
    {0, 1});

enum ECasters : int32_t
{
	NoMap,
	NoCasters,
	StillCasters,
	AllCasters,
	OtherCasters,
};

uint32_t GetHeld()
{
	switch (CVarHostShadow.GetOnRenderThread())
	{
	case StillCasters: return MASK_SUN;
	case AllCasters: return MASK_SUN_CASTERS;
	case OtherCasters: return HOST_SHADOW_OTHERS;
	default: return 0;
	}
}

bool IsDrawn(uint8_t Mask)
{
	const uint32_t Held = GetHeld();
	return Held == HOST_SHADOW_OTHERS ? (Mask & MASK_SUN_CASTERS) == 0 : (Mask & Held) != 0;
}

/// Where cascade Index of Count ends, metres along the view.
double GetSplit(int32_t Index, int32_t Count)
{
	const double Begin = 1.0, End = double(CVarDistance.GetOnRenderThread()), Part = double(Index) / Count;
	const double Logarithmic = Begin * std::pow(End / Begin, Part), Even = Begin + (End - Begin) * Part;
	return std::lerp(Even, Logarithmic, double(CVarSplit.GetOnRenderThread()));
}

FRasterSource MakeSource(const FMaterialPrograms& Programs, uint32_t Program, bool bMasked)
{
	FRasterSource Source;
	Source.Key = fmt::format("ShadowMap {}{}", Program, bMasked ? " masked" : "");
	Source.Name = bMasked ? "ShadowMapMasked" : "ShadowMap";
	Source.Vertex = {"ShadowMap/ShadowMap.vert", ERTShaderStage::Vertex, {}, {}};
	Source.Fragment = {"ShadowMap/ShadowMap.frag", ERTShaderStage::Fragment, {}, {}};
	if (bMasked)
	{
		Source.Revision = Programs.GetRevision(Program);
		Source.Vertex.Defines.emplace_back("MASKED", "1");
		Source.Fragment.Defines.emplace_back("MASKED", "1");
		Source.Fragment = Programs.MakeSource(std::move(Source.Fragment), Program);
	}
	Source.DepthFormat = ERTFormat::D32_FLOAT;
	Source.Cull = ERTCull::None; // as rays: both sides cast
	return Source;
}
} // namespace

bool FShadowMapPass::IsOn() { return CVarHostShadow.GetOnRenderThread() != NoMap; }

IRTPipeline* FShadowMapPass::Ask(const FFrameContext& Context, uint32_t Program, bool bMasked)
{
	IRTPipeline* Pipeline = nullptr;
	const FRasterSource Source = MakeSource(Renderer.GetPrograms(), Program, bMasked);
	const bool bWait = Context.bWaitForPipelines;
	const FRTStatus Status = bWait ? Context.Pipelines.Get(Source, Pipeline) : Context.Pipelines.Find(Source, Pipeline);
	if (Status) { return Pipeline; }
	if (Status.Code == ERTResult::DeviceLost) { Context.Fail(Status); }
	else { LogOnce(ERTLogLevel::Error, std::string("shadow map: ") + Status.Message); }
	return Pipeline;
}

/// Program and alpha test of all pipelines. Solid surfaces need no material program.
std::set<FShadowMapPass::FPipelineKey> FShadowMapPass::ListKeys(const FHostScene& Scene, const FSceneFacts& Facts)
{
	std::set<FPipelineKey> Keys;
	for (const FHostScene::FDrawKind& Kind : Scene.GetDrawKinds())
	{
		const bool bMasked = IsTested(Kind, Facts);
		Keys.insert({bMasked ? Kind.Program : StandardProgram, bMasked});
	}
	return Keys;
}

FRTStatus FShadowMapPass::Precache(FHostScene& Scene)
{
	if (!IsOn() || !Scene.GetScene().RefreshFacts().bSun) { return FRTStatus::Success(); }
	FRTStatus Status;
	for (const auto& [Program, bMasked] : ListKeys(Scene, Scene.GetScene().GetFacts()))
	{
		IRTPipeline* Unused = nullptr;
		const FRTStatus Made = Renderer.GetPipelines().Get(MakeSource(Renderer.GetPrograms(), Program, bMasked), Unused);
		if (Status) { Status = Made; }
	}
	return Status;
}

/// Returns whether there is something to draw everything with.
bool FShadowMapPass::FindPipelines(const FFrameContext& Context, const FHostScene& Scene)
{
	bool bComplete = true;
	Pipelines.clear();
	for (const FPipelineKey& Key : ListKeys(Scene, Context.Facts))
	{
		Pipelines[Key] = Ask(Context, Key.first, Key.second);
		bComplete &= Pipelines[Key] != nullptr;
	}
	return bComplete;
}

FShadowMapPass::FCascade FShadowMapPass::PlaceCascade(
    const FFrameContext& Context, const FHostScene& Scene, double Begin, double End, uint32_t Resolution) const
{
	const FView& View = Context.View;
	const FViewWindow Window = View.GetWindow();
	const double X = std::max(std::abs(Window.Left), std::abs(Window.Right)), Y = std::max(std::abs(Window.Bottom), std::abs(Window.Top));
	const double Slope2 = X * X + Y * Y;
	const double Middle = std::min(0.5 * (Begin + End) * (1.0 + Slope2), End);
	FCascade Out;
	const glm::dvec3 Light = glm::normalize(Context.Scene.GetSun().Direction);
	const glm::dvec3 Right = glm::normalize(glm::cross(Light, std::abs(Light.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
	Out.Axes = {Right, glm::cross(Light, Right), Light};
	// A radius of whole sixteenths of a metre: it stays as it is while the camera turns. A texel at each border is for the snapping.
	Out.Radius = std::ceil(16.0 * std::sqrt((End - Middle) * (End - Middle) + End * End * Slope2)) / 16.0;
	const double Texel = 2.0 * Out.Radius / Resolution;
	const glm::dvec3 Center = (View.Position + glm::normalize(glm::dvec3(View.Forward)) * Middle) * Out.Axes;
	Out.Center = glm::floor(glm::dvec2(Center) / Texel) * Texel;
	// What is skinned has no bounds: some metres around the camera are for it. Nothing lies on the near plane, which would count as clamped.
	constexpr double Around = 10.0;
	Out.Near = glm::dot(View.Position, Light) - Around;
	Out.Far = Out.Near + 2.0 * Around;
	Scene.GetDrawBlocks().AddExtent(Light, Out.Near, Out.Far);
	Out.Near = std::floor(Out.Near) - 1.0;
	Out.Far = std::ceil(Out.Far) + 1.0;
	return Out;
}

void FShadowMapPass::AddCascade(FFrameContext& Context, FHostScene& Scene, const FCascade& Cascade, FDrawList& Draws, FGraphTexture Map)
{
	FView View;
	View.Position = Cascade.Axes * glm::dvec3(Cascade.Center, Cascade.Near);
	View.Forward = Cascade.Axes[2];
	View.Up = -Cascade.Axes[1];
	View.Window = FViewWindow{-Cascade.Radius, Cascade.Radius, -Cascade.Radius, Cascade.Radius, true};
	View.Width = View.Height = Context.Graph.GetDesc(Map).Width;
	// Now, because the raster of the G-buffer culls on a task.
	const auto Keep = [this](uint32_t Object) { return IsDrawn(Masks[Object]); };
	if (FRTStatus S = Draws.Make(Scene, Renderer.GetUploads(), View, 0.0f, Keep); !S) { return Context.Fail(S); }
	const glm::dvec3 Camera = Context.View.Position * Cascade.Axes;
	const double Depth = Cascade.Far - Cascade.Near;
	const glm::vec4 ToClip[3] = {glm::vec4(Cascade.Axes[0] / Cascade.Radius, (Camera.x - Cascade.Center.x) / Cascade.Radius),
	    glm::vec4(Cascade.Axes[1] / Cascade.Radius, (Camera.y - Cascade.Center.y) / Cascade.Radius),
	    glm::vec4(-Cascade.Axes[2] / Depth, (Cascade.Far - Camera.z) / Depth)};
	FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("HostShadowMap", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Map, ERTAccess::DepthWrite);
		for (const FGraphToken Unused : {Context.Tokens.Structures, Context.Tokens.Records, Context.Tokens.Sky})
		{
			Builder.Without(Unused);
		}
		return [=, this, &Scene, &Draws](FPassContext& Pass) {
			FRTRasterPassDesc Desc;
			Desc.Depth = Pass.GetTexture(Map);
			Desc.Width = Desc.Height = Desc.Depth->GetDesc().Width;
			IRTCommandList& List = Pass.Commands();
			List.BeginRasterPass(Desc);
			for (const FDrawList::FRun& Run : Draws.GetRuns())
			{
				const FHostScene::FDrawBatch& Batch = Scene.GetBatches()[Run.Batch];
				// A map knows no shares. Blended surfaces are cut at half, and glass casts nothing.
				if (Batch.bTransmissive && !Batch.bBlended && Frame->Facts.bTransmissive) { continue; }
				const bool bMasked = IsTested(Batch, Frame->Facts);
				List.SetPipeline(Pipelines.at({bMasked ? Batch.Program : StandardProgram, bMasked}));
				List.SetIndexBuffer(Batch.Indices, 0, ERTIndexType::UInt32);
				const FShadowMapConstants C{Frame->Pass, Run.Objects, Batch.Section, 0, {ToClip[0], ToClip[1], ToClip[2]}};
				List.PushConstants(&C, sizeof(C));
				List.DrawIndexed(Batch.IndexCount, Run.Count, Batch.FirstIndex, 0);
			}
			List.EndRasterPass();
		};
	});
}

FHostShadow FShadowMapPass::Add(FFrameContext& Context, FHostScene& Scene)
{
	FHostShadow Out;
	if (!IsOn() || !Context.Facts.bSun || !FindPipelines(Context, Scene)) { return Out; }
	Masks.clear();
	for (const FHostScene::FDraw& Draw : Scene.GetDraws())
	{
		Masks.resize(std::max<size_t>(Masks.size(), Draw.Object.Index + 1));
		Masks[Draw.Object.Index] = Scene.GetScene().GetObject(Draw.Object).Mask;
	}
	Out.CascadeCount = static_cast<uint32_t>(CVarCascades.GetOnRenderThread());
	Out.Held = GetHeld();
	const auto Resolution = static_cast<uint32_t>(CVarResolution.GetOnRenderThread());
	for (uint32_t I = 0; I < Out.CascadeCount; ++I)
	{
		const auto Count = static_cast<int32_t>(Out.CascadeCount), Index = static_cast<int32_t>(I);
		const double Begin = I == 0 ? 0.0 : GetSplit(Index, Count);
		const FCascade Cascade = PlaceCascade(Context, Scene, Begin, GetSplit(Index + 1, Count), Resolution);
		FHostShadowCascade& Made = Out.Cascades[I];
		Made.Map = Context.Graph.CreateTexture({Resolution, Resolution, ERTFormat::D32_FLOAT}, "HostShadowMap");
		Made.TexelSize = static_cast<float>(2.0 * Cascade.Radius / Resolution);
		Made.DepthBias = 0.002f; // rounding of depth over some hundreds of metres
		const double Scales[3] = {0.5 / Cascade.Radius, 0.5 / Cascade.Radius, -1.0 / (Cascade.Far - Cascade.Near)};
		const double Offsets[3] = {-Cascade.Center.x * Scales[0] + 0.5, -Cascade.Center.y * Scales[1] + 0.5, -Cascade.Far * Scales[2]};
		for (int Row = 0; Row < 3; ++Row)
		{
			for (int Axis = 0; Axis < 3; ++Axis) { Made.WorldToMap[4 * Row + Axis] = Cascade.Axes[Row][Axis] * Scales[Row]; }
			Made.WorldToMap[4 * Row + 3] = Offsets[Row];
		}
		AddCascade(Context, Scene, Cascade, Lists[I], Made.Map);
	}
	return Out;
}

} // namespace Lantern
