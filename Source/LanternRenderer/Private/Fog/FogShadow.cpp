// Fog shadows: the passes, and their memory from frame to frame.
#include "Fog/FogShadow.h"

#include <algorithm>
#include <cmath>

#include "Fog/FroxelColumns.h"
#include "Lights/LightCells.h"
#include "Rays/RayQueue.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarFog("r.RT.Fog", true,
    "Traces shadows in fog, if somebody reads them: a host's fog, or that of r.Fog.Density. If off, its light is not shadowed.");
TRTConsoleVariable<int32_t> CVarPixelSize(
    "r.RT.Fog.PixelSize", 16, "Width and height of froxels, in pixels. The rays grow with the inverse of its square.", {1, 256});
TRTConsoleVariable<int32_t> CVarSlices(
    "r.RT.Fog.Slices", 64, "Number of slices of froxels along the view. Half of them get rays in each frame.", {2, FOG_MOST_SLICES});
TRTConsoleVariable<float> CVarDistance(
    "r.RT.Fog.Distance", 250.0f, "Distance at which froxels end, in metres. Slices are thinner near the camera.", {1, 1e6});
TRTConsoleVariable<float> CVarHistorySeconds("r.RT.Fog.HistorySeconds", 0.12f,
    "Time, in seconds, after which 90 % of a change of light shows in fog. Longer times have less noise. 0: each frame stands alone.",
    {0, 10});
TRTConsoleVariable<bool> CVarDebugHistory(
    "r.RT.Debug.Fog.History", true, "Planted fault. Off: the light in fog changes only within a minute.");

FFroxelSettings GetSettings()
{
	return {"FogShadow", static_cast<uint32_t>(CVarPixelSize.GetOnRenderThread()), "r.RT.Fog.PixelSize",
	    static_cast<uint32_t>(CVarSlices.GetOnRenderThread()), CVarDistance.GetOnRenderThread()};
}

float GetShare(float DeltaSeconds)
{
	const double Seconds = CVarDebugHistory.GetOnRenderThread() ? double(CVarHistorySeconds.GetOnRenderThread()) : 60.0;
	return GetFroxelShare(Seconds, DeltaSeconds);
}

struct FFogPass
{
	FFroxelColumns Columns;
	FHistoryTexture Visibility, Light;
	FRayDispatch Dispatch;
	bool bSun = false, bLights = false;
	bool bHistory = false;
	float Share = 1.0f, Phase = 0.0f, SunOneMinusCos = 0.0f;
};

/// False: an error, which the context has.
bool FindAtlases(FFrameContext& Context, FFogPass& Out)
{
	const FFroxelSettings Settings = GetSettings();
	const FFogGrid& Grid = Out.Columns.Grid;
	if (Out.bSun && !FindFroxelAtlas(Context, Settings, Grid, "Visibility", ERTFormat::R8_UNORM, Out.Visibility)) { return false; }
	return !Out.bLights || FindFroxelAtlas(Context, Settings, Grid, "Light", ERTFormat::RGBA16_FLOAT, Out.Light);
}

FFogShadowConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FFogPass& Fog)
{
	FFogShadowConstants C{};
	C.Pass = Frame.Pass;
	C.Grid = Fog.Columns.Grid;
	C.PreviousColumns = Fog.Columns.PreviousColumns;
	C.PreviousRows = Fog.Columns.PreviousRows;
	C.Counts = GetSampledIndex(Pass, Fog.Columns.Counts.Current);
	C.PreviousCounts = Fog.bHistory ? GetSampledIndex(Pass, Fog.Columns.Counts.Previous) : NO_TEXTURE;
	C.PreviousVisibility = Fog.bHistory ? GetSampledIndex(Pass, Fog.Visibility.Previous) : NO_TEXTURE;
	C.PreviousLight = Fog.bHistory ? GetSampledIndex(Pass, Fog.Light.Previous) : NO_TEXTURE;
	C.OutVisibility = GetStorageIndex(Pass, Fog.Visibility.Current);
	C.OutLight = GetStorageIndex(Pass, Fog.Light.Current);
	C.Share = Fog.Share;
	C.Phase = Fog.Phase;
	C.SunOneMinusCos = Fog.SunOneMinusCos;
	C.RayFlags = GetCasterRayFlags();
	return C;
}

void AddTracePass(FFrameContext& Context, const FFogPass& Fog)
{
	const FFrameContext* const Frame = &Context;
	const FLightCellsOfFrame Cells = Fog.bLights ? RequireLightGrid(Context) : FLightCellsOfFrame();
	Context.Graph.AddPass("FogShadow", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Fog.Columns.Counts.Current, ERTAccess::ShaderRead);
		if (Fog.bHistory)
		{
			for (const FHistoryTexture* History : {&Fog.Columns.Counts, &Fog.Visibility, &Fog.Light})
			{
				if (History->Previous.IsValid()) { Builder.Read(History->Previous, ERTAccess::ShaderRead); }
			}
		}
		for (const FHistoryTexture* History : {&Fog.Visibility, &Fog.Light})
		{
			if (!History->Current.IsValid()) { continue; }
			Builder.Write(History->Current, ERTAccess::StorageWrite);
			Builder.Keep(History->Current);
		}
		Builder.Keep(Fog.Columns.Counts.Current);
		Builder.Keep(Fog.Columns.Depth.Current);
		ReadLightCells(Builder, Cells, true);
		if (Cells.Buffer.IsValid()) { Builder.Keep(Cells.Buffer); }
		Builder.AllowAsync();
		Builder.RunBeside(PathsGroup);
		return [=](FPassContext& Pass) {
			if (Cells.Buffer.IsValid()) { Cells.OfView->WriteGrid(Pass); }
			const FFogShadowConstants C = MakeConstants(Pass, *Frame, Fog);
			const FFogGrid& Grid = Fog.Columns.Grid;
			const uint32_t Pairs = DivideUp(Grid.Slices, 2), Width = Grid.Columns * Grid.PerRow, Height = CountFroxelRows(Grid, Pairs);
			Pass.CountRays(uint64_t(Grid.Columns) * Grid.Rows * Pairs * ((Fog.bSun ? 1 : 0) + (Fog.bLights ? 1 : 0)));
			if (Fog.Dispatch.Compute) { Dispatch2D(Pass, Fog.Dispatch.Compute, C, Width, Height, RAY_QUERY_GROUP_SIZE); }
			else { TraceFrameRays(Pass, *Frame, Fog.Dispatch.RayGen, C, Width, Height); }
		};
	});
}

FFogAtlas AddFog(FFrameContext& Context)
{
	const FPassRays Rays = ChooseFogRays({Context.Device.GetCapabilities(), Context.Facts, Context.Signals});
	const std::optional<FRayDispatch> Dispatch =
	    RequireRayDispatch(Context, Rays, Context.GetRayGen(EPassRayGen::Fog), MakeQuerySource(Context.Facts, FogShaders, Rays));
	if (!Dispatch) { return {}; }
	FFogPass Fog;
	Fog.Dispatch = *Dispatch;
	// A variant from before a change may lack what there is now.
	Fog.bSun = Dispatch->Has("FOG_SUN") && Context.Facts.bSun;
	Fog.bLights = Dispatch->Has("FOG_LIGHTS") && Context.Facts.FogLights > 0;
	if (!FindFroxelColumns(Context, GetSettings(), Fog.Columns) || (!Fog.bSun && !Fog.bLights)) { return {}; }
	if (!FindAtlases(Context, Fog)) { return {}; }
	// A history serves only as a whole: what is missing of it would count as dark.
	Fog.bHistory =
	    Fog.Columns.bHistory && (!Fog.bSun || Fog.Visibility.Previous.IsValid()) && (!Fog.bLights || Fog.Light.Previous.IsValid());
	Fog.Columns.bHistory = Fog.bHistory;
	Fog.Share = GetShare(Context.View.DeltaSeconds);
	Fog.Phase = std::clamp(Context.Signals.FogPhase, -0.99f, 0.99f);
	FSunRays Sun;
	Sun.Diameter = Context.Scene.GetSun().AngularDiameter;
	Fog.SunOneMinusCos = GetSunOneMinusCos(Sun);
	AddFroxelColumnsPass(Context, GetSettings(), Fog.Columns);
	AddTracePass(Context, Fog);
	Context.Fog.Depth = Fog.Columns.Depth.Current;
	return {Fog.Visibility.Current, Fog.Light.Current, Fog.Columns.Grid};
}
} // namespace

FPassRays ChooseFogRays(const FPassQuery& Query)
{
	FPassRays Rays;
	const FSceneFacts& Facts = Query.Facts;
	const bool bLight = Facts.bSun || Facts.FogLights > 0;
	if (!Query.Requests.bFog || !bLight || !IsRayTracingEnabled() || !CVarFog.GetOnRenderThread()) { return Rays; }
	Rays.Path = ChooseQueuePath(Query, "fog shadows are");
	if (Facts.bSun) { Rays.Defines.emplace_back("FOG_SUN", "1"); }
	if (Facts.FogLights > 0) { Rays.Defines.emplace_back("FOG_LIGHTS", "1"); }
	if (Facts.FogLights > 0 && Facts.bAreaLights) { Rays.Defines.emplace_back("HAS_AREA_LIGHTS", "1"); }
	if (Facts.FogLights > 0 && Facts.bLightProfiles) { Rays.Defines.emplace_back("HAS_LIGHT_PROFILES", "1"); }
	AddFroxelDefines(Rays.Defines);
	Rays.Shaders = FogShaders;
	ListFroxelShaders(GetSettings(), Rays.Compute);
	if (Facts.FogLights > 0) { ListLightCellShaders(Facts, Rays.Compute); }
	return Rays;
}

FFogAtlas AddFogShadowPass(FFrameContext& Context)
{
	if (!Context.Fog.bAsked) { Context.Fog.Atlas = AddFog(Context); }
	Context.Fog.bAsked = true;
	return Context.Fog.Atlas;
}

void AddFogDepthPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (Context.Fog.bDepthAsked || !Context.Fog.Atlas.IsValid()) { return; }
	Context.Fog.bDepthAsked = true;
	const FLightCellsOfFrame Cells = Context.World->LightCells.bGridAsked ? RequireLightCells(Context, GBuffer) : FLightCellsOfFrame();
	AddFroxelDepthPass(Context, GBuffer, "FogShadow", Context.Fog.Atlas.Grid, Context.Fog.Depth, [&Cells](FPassBuilder& Builder) {
		if (Cells.Counts.IsValid()) { Builder.Keep(Cells.Counts); }
	});
}

} // namespace Lantern
