// Indirect light by brute force, for any signal whose ray-generation shader gathers paths (Shaders/Rays/IndirectSampling.glsl).
#include "BruteForce/BruteForce.h"

#include <algorithm>

#include "BruteForceTypes.h"
#include "Lights/LightCells.h"
#include "LocalLights/Emitters.h"
#include "RadianceCells/RadianceCells.h"
#include "SignalPasses.h"
#include "TileTypes.h"

namespace Lantern
{

namespace
{
constexpr uint32_t BouncesWithoutCell = 3; // of a path that would end in a cell and meets none

FShaderSource MakeFillSource(EPixelRate Rate)
{
	FShaderDefines Defines;
	AddRateDefine(Rate, Defines);
	return MakeComputeSource("BruteForce/Fill.comp", std::move(Defines));
}

void AddFillPass(FFrameContext& Context, const FGBuffer& GBuffer, const std::string& Name, FGraphTexture Output, IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		Builder.Read(Output, ERTAccess::StorageRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFillConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.Radiance = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}
} // namespace

ERayPath ChooseBruteForcePath(const FBruteForcePass& Settings, const FPassQuery& Query)
{
	if (!IsRayTracingEnabled() || !Settings.IsOn()) { return ERayPath::None; }
	if (Query.Facts.Objects == 0 || !HasAnyLight(Query.Facts)) { return ERayPath::None; }
	return ChooseShadingRayPath(Query, Settings.Variable);
}

FPassRays ChooseBruteForceRays(const FBruteForcePass& Settings, const FPassQuery& Query)
{
	FPassRays Rays;
	Rays.Path = ChooseBruteForcePath(Settings, Query);
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	if (IsEmissionDirect(Query, GetSignalPass(Settings.Signal).EmissionIn)) { Rays.Defines.emplace_back(EmissiveDirectDefine, "1"); }
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
	if (Settings.Rate)
	{
		const auto Rate = static_cast<EPixelRate>(Settings.Rate->GetOnRenderThread());
		AddRateDefine(Rate, Rays.Defines);
		if (Rate != EPixelRate::Full) { Rays.Compute.push_back(MakeFillSource(Rate)); }
	}
	Rays.bRadianceCells = Settings.EndsInRadianceCells();
	if (Rays.bRadianceCells) { AddRadianceCellDefines(Rays.Defines); }
	ListLightCellShaders(Query.Facts, Rays.Compute);
	AddReorderDefine(Query.Capabilities, Rays.Defines);
	Rays.bShadesHits = true;
	return Rays;
}

FGraphTexture AddBruteForcePass(const FBruteForcePass& Settings, FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FSignalInfo& Info = GetSignalInfo(Settings.Signal);
	const std::optional<FRayDispatch> Dispatch = RequireRayDispatch(Context, Settings.Signal, ChooseSignalRays(Context, Settings.Signal));
	if (!Dispatch) { return {}; }
	const EPixelRate Rate = FindRate(Dispatch->Defines);
	IRTPipeline* const Fill = Rate != EPixelRate::Full ? RequireCompute(Context, MakeFillSource(Rate)) : nullptr;
	if (Rate != EPixelRate::Full && !Fill) { return {}; }
	const FGraphTexture Output =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, Info.Format, ERTTextureUsage::CopySource}, Info.Pass);
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
	const FRadianceCells* const RadianceCells = Settings.EndsInRadianceCells() ? RequireRadianceCells(Context) : nullptr;
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Info.Pass, [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		const FGraphTexture BaseColor = Info.bNeedsSurface ? GBuffer.BaseColor : FGraphTexture();
		const FGraphTexture Material = Info.bNeedsSurface ? GBuffer.Material : FGraphTexture();
		for (const FGraphTexture Texture : {BaseColor, Material})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.Write(Output, ERTAccess::StorageWrite);
		ReadLightCells(Builder, LightCells, true);
		ReadRadianceCells(Builder, RadianceCells);
		Builder.AllowAsync();
		return [=, &Settings](FPassContext& Pass) {
			const uint32_t Bounces = static_cast<uint32_t>(Settings.Bounces.GetOnRenderThread());
			FBruteForceConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.BaseColor = GetSampledIndex(Pass, BaseColor);
			C.Material = GetSampledIndex(Pass, Material);
			C.Output = GetStorageIndex(Pass, Output);
			C.SamplesPerPixel = static_cast<uint32_t>(Settings.Samples.GetOnRenderThread());
			C.MaxBounces = (RadianceCells ? std::max(Bounces, BouncesWithoutCell) : Bounces) + 1;
			C.RadianceCells = WriteRadianceGrid(Pass, RadianceCells);
			C.MaxRoughness = Settings.MaxRoughness ? Settings.MaxRoughness->GetOnRenderThread() : 1.0f;
			const uint32_t Width = Rate != EPixelRate::Full ? DivideUp(Frame->Width, 2) : Frame->Width;
			const uint32_t Height = Rate == EPixelRate::Quarter ? DivideUp(Frame->Height, 2) : Frame->Height;
			Pass.CountRays(uint64_t(Width) * Height * C.SamplesPerPixel * GetMaxPathRays(Frame->Facts, Bounces));
			TraceFrameRays(Pass, *Frame, Dispatch->RayGen, C, Width, Height);
		};
	});
	if (Fill) { AddFillPass(Context, GBuffer, std::string(Info.Pass) + "Fill", Output, Fill); }
	if (RadianceCells) { AddRadianceCellPasses(Context, GBuffer); }
	return Output;
}

} // namespace Lantern
