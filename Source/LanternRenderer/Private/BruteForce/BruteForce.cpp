// Indirect light by brute force, for any signal whose ray-generation shader gathers paths (Shaders/Rays/IndirectSampling.glsl).
#include "BruteForce/BruteForce.h"

#include <algorithm>

#include "BruteForce/PathGuide.h"
#include "BruteForceTypes.h"
#include "Feedback/RadianceAuditor.h"
#include "Lights/LightCells.h"
#include "LocalLights/Emitters.h"
#include "RadianceCells/RadianceCells.h"
#include "Rays/ThreadList.h"
#include "ScreenProbes/ScreenProbes.h"
#include "SharedPaths/SharedPaths.h"
#include "SignalPasses.h"
#include "TileTypes.h"

namespace Lantern
{

namespace
{
constexpr uint32_t BouncesWithoutCell = 3; // of a path that would end in a cell and meets none
constexpr const char* DefersPaths = "DEFERS_PATHS";
constexpr const char* SecondLobe = "SECOND_LOBE";
TRTConsoleVariable<bool> CVarMixturePdf("r.RT.Debug.GI.MixturePdf", true,
    "Planted fault. If off, paths that a guide or a second lobe draws count as if the cosine alone had drawn them.");

TRTConsoleVariable<bool> CVarFallback(
    "r.RT.Debug.GI.Fallback", true, "Planted fault. If off, paths that find no radiance cell where they end bring no light.");

FShaderSource MakeFillSource(EPixelRate Rate)
{
	FShaderDefines Defines;
	AddRateDefine(Rate, Defines);
	return MakeComputeSource("BruteForce/Fill.comp", std::move(Defines));
}

void AddAuditDefines(FShaderDefines& InOut)
{
	if (GetResidual() == EResidual::Off) { return; }
	InOut.emplace_back("AUDITS_CELLS", "1");
	if (!IsResidualWeighted()) { InOut.emplace_back("WRONG_RESIDUAL", "1"); }
	if (GetResidual() == EResidual::Corrected)
	{
		std::erase_if(InOut, [](const auto& Define) { return Define.first == NoCausticsDefine; });
	}
}

/// Second: may be invalid.
void AddFillPass(FFrameContext& Context, const FGBuffer& GBuffer, const std::string& Name, FGraphTexture Output, FGraphTexture Second,
    IRTPipeline* Pipeline)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		for (const FGraphTexture Texture : {Output, Second})
		{
			if (!Texture.IsValid()) { continue; }
			Builder.Read(Texture, ERTAccess::StorageRead);
			Builder.Write(Texture, ERTAccess::StorageWrite);
		}
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFillConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.Radiance = GetStorageIndex(Pass, Output);
			C.Second = GetStorageIndex(Pass, Second);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

/// What both launches of a pass share.
struct FPaths
{
	FGraphTexture Output;
	FGraphTexture SecondOutput; ///< of the second lobe; invalid: there is none
	FThreadMarks Deferred;      ///< threads for the second launch; invalid: there is none
	const FRadianceCells* RadianceCells = nullptr;
	FPathGuide Guide;     ///< invalid: paths are not guided
	FScreenProbes Probes; ///< invalid: paths start at pixels
	FSharedPaths Shared;  ///< invalid: paths light their own pixels alone
	FGraphTexture Toon;   ///< FToonOfFrame::Pixels; invalid: all paths start at what pixels show
	FRayDispatch First, Second;
	uint32_t Width = 0, Height = 0; ///< of the first launch
	/// Whether launches write the outputs. Else a pass behind them does.
	bool LightsPixels() const { return !Probes.IsValid() && !Shared.IsValid(); }
};

FPaths MakePaths(const FBruteForcePass& Settings, FFrameContext& Context, const FRayDispatch& First, const FRayDispatch* Second)
{
	const FSignalInfo& Info = GetSignalInfo(Settings.Signal);
	const EPixelRate Rate = FindRate(First.Defines);
	FPaths Paths;
	Paths.First = First;
	Paths.Toon = GetSignalPass(Settings.Signal).bStyled ? Context.Toon.Pixels : FGraphTexture();
	Paths.Width = Rate != EPixelRate::Full ? DivideUp(Context.Width, 2) : Context.Width;
	Paths.Height = Rate == EPixelRate::Quarter ? DivideUp(Context.Height, 2) : Context.Height;
	Paths.Output = Context.Graph.CreateTexture({Context.Width, Context.Height, Info.Format, ERTTextureUsage::CopySource}, Info.Pass);
	if (First.Has(SecondLobe))
	{
		const FSignalInfo& Specular = GetSignalInfo(Settings.Second);
		Paths.SecondOutput =
		    Context.Graph.CreateTexture({Context.Width, Context.Height, Specular.Format, ERTTextureUsage::CopySource}, Specular.Pass);
	}
	if (First.Has(ScreenProbesDefine))
	{
		Paths.Probes = MakeScreenProbes(Context, First.Has(SecondLobe));
		if (!Paths.Probes.IsValid()) { return Paths; }
		Paths.Width = Paths.Probes.GetLaunchWidth();
		Paths.Height = Paths.Probes.GetLaunchHeight();
	}
	const ERayPath Path = First.Compute ? ERayPath::Query : ERayPath::Pipeline;
	Paths.RadianceCells = Settings.EndsInRadianceCells() ? RequireRadianceCells(Context, Path) : nullptr;
	if (First.Has(SharedPathsDefine))
	{
		Paths.Shared = MakeSharedPaths(Context, Rate, First.Has(SecondLobe), First.Has(BackPixelsDefine), Paths.Width, Paths.Height);
	}
	if (First.Has(GuidedPathsDefine)) { Paths.Guide = MakePathGuide(Context, Rate, uint64_t(Paths.Width) * Paths.Height); }
	if (Second)
	{
		Paths.Deferred = AddThreadMarks(Context, Paths.Width, Paths.Height, "DeferredPaths");
		Paths.Second = *Second;
	}
	return Paths;
}

void TraceFirst(FPassContext& Pass, const FFrameContext& Frame, const FPaths& Paths, const FBruteForceConstants& Constants)
{
	if (Paths.First.Compute) { return Dispatch2D(Pass, Paths.First.Compute, Constants, Paths.Width, Paths.Height, RAY_QUERY_GROUP_SIZE); }
	TraceFrameRays(Pass, Frame, Paths.First.RayGen, Constants, Paths.Width, Paths.Height);
}

/// Whether pixels gather light from behind as well.
bool GathersBack(const FBruteForcePass& Settings, const FGBuffer& GBuffer) { return Settings.bBothSides && GBuffer.BackAlbedo.IsValid(); }

bool NeedsSurface(const FBruteForcePass& Settings, const FGBuffer& GBuffer, const FPaths& Paths)
{
	if (Paths.Probes.IsValid()) { return false; }
	return GetSignalInfo(Settings.Signal).bNeedsSurface || Paths.SecondOutput.IsValid() || GathersBack(Settings, GBuffer);
}

/// Declares what the launches of a pass use, other than cells. bDeferred: the second launch.
void DeclarePaths(FPassBuilder& Builder, const FBruteForcePass& Settings, const FGBuffer& GBuffer, const FPaths& Paths, bool bDeferred)
{
	Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
	Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
	if (Paths.Toon.IsValid()) { Builder.Read(Paths.Toon, ERTAccess::ShaderRead); }
	if (NeedsSurface(Settings, GBuffer, Paths))
	{
		const FGraphTexture Back = GathersBack(Settings, GBuffer) ? GBuffer.BackAlbedo : FGraphTexture();
		for (const FGraphTexture Texture : {GBuffer.BaseColor, GBuffer.Material, Back})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
	}
	if (Paths.LightsPixels())
	{
		Builder.Write(Paths.Output, ERTAccess::StorageWrite);
		if (Paths.SecondOutput.IsValid()) { Builder.Write(Paths.SecondOutput, ERTAccess::StorageWrite); }
	}
	if (Paths.Guide.IsValid()) { DeclareGuidedPaths(Builder, Paths.Guide); }
	if (Paths.Probes.IsValid()) { DeclareScreenProbeRays(Builder, Paths.Probes); }
	if (Paths.Shared.IsValid()) { Builder.Write(Paths.Shared.Fresh, ERTAccess::StorageWrite); }
	if (Paths.Shared.Reservoirs.IsValid()) { DeclarePathReservoirs(Builder, Paths.Shared.Reservoirs); }
	if (!Paths.Deferred.IsValid()) { return; }
	if (bDeferred) { LaunchFromThreadList(Builder, Paths.Deferred.List); }
	else { MarkThreads(Builder, Paths.Deferred.List); }
}

void RecordPaths(FPassContext& Pass, const FFrameContext& Frame, const FBruteForcePass& Settings, const FGBuffer& GBuffer,
    const FPaths& Paths, bool bDeferred)
{
	const bool bNeedsSurface = NeedsSurface(Settings, GBuffer, Paths);
	const uint32_t Bounces = static_cast<uint32_t>(Settings.Bounces.GetOnRenderThread());
	FBruteForceConstants C{};
	C.Pass = Frame.Pass;
	C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
	C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
	C.BaseColor = bNeedsSurface ? GetSampledIndex(Pass, GBuffer.BaseColor) : NO_TEXTURE;
	C.Material = bNeedsSurface ? GetSampledIndex(Pass, GBuffer.Material) : NO_TEXTURE;
	C.BackAlbedo = bNeedsSurface && GathersBack(Settings, GBuffer) ? GetSampledIndex(Pass, GBuffer.BackAlbedo) : NO_TEXTURE;
	C.Output = C.SecondOutput = NO_TEXTURE;
	if (Paths.LightsPixels())
	{
		C.Output = GetStorageIndex(Pass, Paths.Output);
		C.SecondOutput = GetStorageIndex(Pass, Paths.SecondOutput);
	}
	C.SamplesPerPixel = Paths.Probes.IsValid() ? 1 : static_cast<uint32_t>(Settings.Samples.GetOnRenderThread());
	C.MaxBounces = (Paths.RadianceCells ? std::max(Bounces, BouncesWithoutCell) : Bounces) + 1;
	C.RadianceCells = WriteRadianceGrid(Pass, Paths.RadianceCells);
	C.MaxRoughness = Settings.MaxRoughness ? Settings.MaxRoughness->GetOnRenderThread() : 1.0f;
	C.Deferred = GetAddress(Pass, Paths.Deferred.List);
	C.GuideTiles = GetGuideTiles(Pass, Paths.Guide);
	C.PathRecords = GetAddress(Pass, Paths.Guide.Records);
	C.ProbeGrid = WriteScreenProbeGrid(Pass, Paths.Probes);
	C.Shared = GetAddress(Pass, Paths.Shared.Fresh);
	C.Reservoirs = WritePathReservoirs(Pass, Frame, Paths.Shared.Reservoirs);
	C.NearPixels = GetNearPixels(Frame);
	C.ToonPixels = GetSampledIndex(Pass, Paths.Toon);
	C.bHalf = Frame.bHalf ? 1u : 0u;
	if (bDeferred) { return TraceThreadList(Pass, Frame, Paths.Second, Paths.Deferred.List, C, Paths.Width, Paths.Height); }
	const uint32_t Resampling = Paths.Shared.Reservoirs.IsValid() ? GetMostReservoirRays() : 0;
	Pass.CountRays(uint64_t(Paths.Width) * Paths.Height * (C.SamplesPerPixel * GetMaxPathRays(Frame.Facts, Bounces) + Resampling));
	TraceFirst(Pass, Frame, Paths, C);
}

/// bDeferred: the second launch.
void AddPathsPass(const FBruteForcePass& Settings, FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths, bool bDeferred)
{
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
	const std::string Name = std::string(GetSignalInfo(Settings.Signal).Pass) + (bDeferred ? "Deferred" : "");
	Context.Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		DeclarePaths(Builder, Settings, GBuffer, Paths, bDeferred);
		ReadLightCells(Builder, LightCells, true);
		ReadRadianceCells(Builder, Paths.RadianceCells);
		Builder.AllowAsync();
		Builder.RunBeside(PathsGroup);
		return [=, Frame = &Context, &Settings](FPassContext& Pass) { RecordPaths(Pass, *Frame, Settings, GBuffer, Paths, bDeferred); };
	});
}

/// Adds the second launch, and the passes that keep the cells which both look up.
void AddDeferredPasses(const FBruteForcePass& Settings, FFrameContext& Context, const FGBuffer& GBuffer, const FPaths& Paths)
{
	AddThreadOrder(Context, Paths.Deferred);
	FBesideUpdates Beside;
	Beside.Pass = std::string(GetSignalInfo(Settings.Signal).Pass) + "Deferred";
	Beside.Declare = [&](FPassBuilder& Builder) { DeclarePaths(Builder, Settings, GBuffer, Paths, true); };
	Beside.Record = [=, Frame = &Context, &Settings, bFallback = CVarFallback.GetOnRenderThread()](FPassContext& Pass) {
		if (bFallback) { RecordPaths(Pass, *Frame, Settings, GBuffer, Paths, true); }
	};
	const ERayPath Path = Paths.First.Compute ? ERayPath::Query : ERayPath::Pipeline;
	if (!AddRadianceCellPasses(Context, GBuffer, Path, Beside)) { AddPathsPass(Settings, Context, GBuffer, Paths, true); }
}
} // namespace

ERayPath ChooseBruteForcePath(const FBruteForcePass& Settings, const FPassQuery& Query)
{
	if (!IsRayTracingEnabled() || !Settings.IsOn()) { return ERayPath::None; }
	if (Query.Facts.Objects == 0 || !HasAnyLight(Query.Facts)) { return ERayPath::None; }
	return Settings.Path ? ChooseShadingRayPath(Query, *Settings.Path, Settings.What) : ChoosePipelinePath(Query, Settings.Variable);
}

FPassRays ChooseBruteForceRays(const FBruteForcePass& Settings, const FPassQuery& Query)
{
	FPassRays Rays;
	Rays.Path = ChooseBruteForcePath(Settings, Query);
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	if (IsEmissionDirect(Query, GetSignalPass(Settings.Signal).EmissionIn)) { Rays.Defines.emplace_back(EmissiveDirectDefine, "1"); }
	const bool bSecondLobe = Settings.Second != ESignal::Count && Settings.LightsSecond(Query);
	if (bSecondLobe) { Rays.Defines.emplace_back(SecondLobe, "1"); }
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
	const bool bProbes = Settings.FromProbes();
	if (bProbes) { AddScreenProbeShaders(bSecondLobe, Rays.Defines, Rays.Compute); }
	else if (Settings.Rate)
	{
		const auto Rate = static_cast<EPixelRate>(Settings.Rate->GetOnRenderThread());
		AddRateDefine(Rate, Rays.Defines);
		if (Settings.KeepsPaths()) { AddSharedPathShaders(Query.Facts, Rate, bSecondLobe, Rays.Defines, Rays.Compute); }
		else if (Rate != EPixelRate::Full) { Rays.Compute.push_back(MakeFillSource(Rate)); }
	}
	if (!CVarMixturePdf.GetOnRenderThread()) { Rays.Defines.emplace_back("NO_MIXTURE_PDF", "1"); }
	if (!bProbes && Settings.IsGuided()) { AddPathGuideDefines(FindRate(Rays.Defines), Rays); }
	Rays.bRadianceCells = Settings.EndsInRadianceCells();
	if (Rays.bRadianceCells)
	{
		AddRadianceCellDefines(Rays.Defines);
		Rays.Defines.emplace_back(DefersPaths, "1");
		Rays.Compute.push_back(MakeThreadOrderSource());
		if (!bProbes) { AddAuditDefines(Rays.Defines); }
		SetHitPrograms(EHitPrograms::Standard, Rays);
	}
	ListLightCellShaders(Query.Facts, Rays.Compute);
	if (Rays.Path == ERayPath::Pipeline) { AddReorderDefine(Query.Capabilities, Rays.Defines); }
	Rays.bShadesHits = true;
	return Rays;
}

FPassRays MakeDeferredRays(ESignal Signal, const FPassRays& Rays)
{
	FPassRays Deferred = Rays;
	Deferred.Shaders = std::string(GetSignalInfo(Signal).Pass) + "/Deferred";
	std::erase_if(Deferred.Defines, [](const auto& Define) { return Define.first == DefersPaths; });
	return Deferred;
}

FBruteForceOutputs AddBruteForcePass(const FBruteForcePass& Settings, FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FPassRays Rays = ChooseSignalRays(Context, Settings.Signal);
	const std::optional<FRayDispatch> First = RequireRayDispatch(Context, Settings.Signal, Rays);
	if (!First) { return {}; }
	std::optional<FRayDispatch> Second;
	if (First->Has(DefersPaths))
	{
		const FPassRays Deferred = MakeDeferredRays(Settings.Signal, Rays);
		Second = RequireRayDispatch(
		    Context, Deferred, Context.GetRayGen(EPassRayGen::DeferredPaths), MakeQuerySource(Context.Facts, Settings.Signal, Deferred));
		if (!RequireCompute(Context, MakeThreadOrderSource()) || !Second) { return {}; }
	}
	const EPixelRate Rate = FindRate(First->Defines);
	const bool bFills = Rate != EPixelRate::Full && !First->Has(SharedPathsDefine);
	IRTPipeline* const Fill = bFills ? RequireCompute(Context, MakeFillSource(Rate)) : nullptr;
	if (bFills && !Fill) { return {}; }
	const FPaths Paths = MakePaths(Settings, Context, *First, Second ? &*Second : nullptr);
	if (First->Has(GuidedPathsDefine) && !Paths.Guide.IsValid()) { return {}; }
	if (First->Has(SharedPathsDefine) && !Paths.Shared.IsValid()) { return {}; }
	if (First->Has(ScreenProbesDefine))
	{
		if (!Paths.Probes.IsValid()) { return {}; }
		AddScreenProbePlan(Context, GBuffer, Paths.Probes);
	}
	AddPathsPass(Settings, Context, GBuffer, Paths, false);
	if (Second) { AddDeferredPasses(Settings, Context, GBuffer, Paths); }
	if (Paths.Guide.IsValid()) { AddPathGuideUpdate(Context, GBuffer, Paths.Guide); }
	FGraphBuffer Changes;
	if (Paths.Shared.IsValid()) { Changes = AddPathResolve(Context, GBuffer, Paths.Shared, Paths.Output, Paths.SecondOutput); }
	if (Paths.Probes.IsValid()) { AddScreenProbeGather(Context, GBuffer, Paths.Probes, Paths.Output, Paths.SecondOutput); }
	if (Fill)
	{
		AddFillPass(Context, GBuffer, std::string(GetSignalInfo(Settings.Signal).Pass) + "Fill", Paths.Output, Paths.SecondOutput, Fill);
	}
	return {Paths.Output, Paths.SecondOutput, Paths.Shared.IsValid(), Changes};
}

} // namespace Lantern
