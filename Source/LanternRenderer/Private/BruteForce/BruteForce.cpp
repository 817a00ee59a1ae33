// Indirect light by brute force, for any signal whose ray-generation shader gathers paths (Shaders/Rays/IndirectSampling.glsl).
#include "BruteForce/BruteForce.h"

#include "BruteForceTypes.h"
#include "Lights/LightCells.h"
#include "LocalLights/Emitters.h"
#include "SignalPasses.h"

namespace Lantern
{

ERayPath ChooseBruteForcePath(const FBruteForcePass& Settings, const FPassQuery& Query)
{
	if (!IsRayTracingEnabled() || !Settings.Enable.GetOnRenderThread()) { return ERayPath::None; }
	if (Query.Facts.Objects == 0 || !HasAnyLight(Query.Facts)) { return ERayPath::None; }
	return ChooseShadingRayPath(Query, Settings.Enable);
}

FPassRays ChooseBruteForceRays(const FBruteForcePass& Settings, const FPassQuery& Query)
{
	FPassRays Rays;
	Rays.Path = ChooseBruteForcePath(Settings, Query);
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	if (IsEmissionDirect(Query, GetSignalPass(Settings.Signal).EmissionIn)) { Rays.Defines.emplace_back(EmissiveDirectDefine, "1"); }
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
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
	const FGraphTexture Output =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, Info.Format, ERTTextureUsage::CopySource}, Info.Pass);
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
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
			C.MaxBounces = Bounces + 1;
			C.MaxRoughness = Settings.MaxRoughness ? Settings.MaxRoughness->GetOnRenderThread() : 1.0f;
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * C.SamplesPerPixel * GetMaxPathRays(Frame->Facts, Bounces));
			DispatchRays(Pass, *Frame, *Dispatch, C);
		};
	});
	return Output;
}

} // namespace Lantern
