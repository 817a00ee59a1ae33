// Fog shadows: the passes, and their memory from frame to frame.
#include "Fog/FogShadow.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "LanternCore/FrameGraph/History.h"
#include "LanternCore/Text/Log.h"
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
TRTConsoleVariable<bool> CVarDebugSlice(
    "r.RT.Debug.Fog.Slice", true, "Planted fault. Off: rays of fog start at the centre of the next slice, and light leaks through walls.");
TRTConsoleVariable<bool> CVarDebugHistory(
    "r.RT.Debug.Fog.History", true, "Planted fault. Off: the light in fog changes only within a minute.");

constexpr uint32_t MostAtlas = 16384; // texels in a row, which every device with ray tracing has

uint32_t GetSlices() { return static_cast<uint32_t>(CVarSlices.GetOnRenderThread()); }

FFogGrid MakeGrid(uint32_t Width, uint32_t Height)
{
	FFogGrid Grid{};
	Grid.Slices = GetSlices();
	Grid.PerRow = static_cast<uint32_t>(std::ceil(std::sqrt(double(Grid.Slices))));
	const auto Wanted = static_cast<uint32_t>(CVarPixelSize.GetOnRenderThread());
	Grid.PixelSize = std::max(Wanted, DivideUp(std::max(Width, Height) * Grid.PerRow, MostAtlas));
	if (Grid.PixelSize != Wanted)
	{
		LogOnce(ERTLogLevel::Warning, CVarPixelSize.GetName() + ": froxels are larger, because no texture holds so many");
	}
	Grid.Columns = DivideUp(Width, Grid.PixelSize);
	Grid.Rows = DivideUp(Height, Grid.PixelSize);
	Grid.Distance = CVarDistance.GetOnRenderThread();
	return Grid;
}

uint32_t CountRows(const FFogGrid& Grid, uint32_t Tiles) { return DivideUp(Tiles, Grid.PerRow) * Grid.Rows; }

FShaderSource MakeSource(const char* Name) { return MakeComputeSource(std::string("Fog/Fog") + Name + ".comp"); }

/// What is traced in time and what is not: two frames pass between a froxel's rays.
float GetShare(float DeltaSeconds)
{
	const double Seconds = CVarDebugHistory.GetOnRenderThread() ? double(CVarHistorySeconds.GetOnRenderThread()) : 60.0;
	if (Seconds <= 0.0) { return 1.0f; }
	return static_cast<float>(1.0 - std::pow(0.1, 2.0 * double(DeltaSeconds) / Seconds));
}

struct FFogPass
{
	FFogGrid Grid{};
	uint32_t PreviousColumns = 0, PreviousRows = 0;
	FHistoryTexture Counts, Depth, Visibility, Light;
	FRayDispatch Dispatch;
	IRTPipeline* Columns = nullptr;
	bool bSun = false, bLights = false;
	bool bHistory = false;
	float Share = 1.0f, Phase = 0.0f, SunOneMinusCos = 0.0f;
};

/// Finds all textures, by names that say how froxels lie: other settings begin anew. False: an error, which the context has.
bool FindTextures(FFrameContext& Context, FFogPass& Out)
{
	const FFogGrid& Grid = Out.Grid;
	FRTStatus Status;
	const auto Find = [&](const char* What, uint32_t Width, uint32_t Height, ERTFormat Format, FHistoryTexture& Texture) {
		if (!Status) { return; }
		const std::string Name = std::string("Fog") + What + " " + std::to_string(Grid.PixelSize) + " " + std::to_string(Grid.Slices) +
		                         " " + std::to_string(Grid.Distance);
		Status =
		    Context.History->GetTexture(Name.c_str(), {Width, Height, Format, ERTTextureUsage::CopySource}, Texture); // engines copy it
	};
	const uint32_t Width = Grid.Columns * Grid.PerRow, Height = CountRows(Grid, Grid.Slices);
	Find("Counts", Grid.Columns, Grid.Rows, ERTFormat::RG32_FLOAT, Out.Counts);
	Find("Depth", Grid.Columns, Grid.Rows, ERTFormat::RG32_FLOAT, Out.Depth);
	if (Out.bSun) { Find("Visibility", Width, Height, ERTFormat::R8_UNORM, Out.Visibility); }
	if (Out.bLights) { Find("Light", Width, Height, ERTFormat::RGBA16_FLOAT, Out.Light); }
	if (!Status) { Context.Fail(Status); }
	return static_cast<bool>(Status);
}

/// A history serves only as a whole: what is missing of it would count as dark.
void CheckHistory(const FFrameContext& Context, FFogPass& InOut)
{
	InOut.bHistory = Context.PreviousView && InOut.Counts.Previous.IsValid() && (!InOut.bSun || InOut.Visibility.Previous.IsValid()) &&
	                 (!InOut.bLights || InOut.Light.Previous.IsValid());
	if (!Context.PreviousView) { return; }
	const FFogGrid Previous = MakeGrid(Context.PreviousView->Width, Context.PreviousView->Height);
	InOut.PreviousColumns = Previous.Columns;
	InOut.PreviousRows = Previous.Rows;
}

void AddColumnsPass(FFrameContext& Context, const FFogPass& Fog)
{
	const FFrameContext* const Frame = &Context;
	const FGraphTexture Depth = Fog.PreviousColumns > 0 ? Fog.Depth.Previous : FGraphTexture();
	const FGraphTexture Before = Fog.bHistory ? Fog.Counts.Previous : FGraphTexture();
	Context.Graph.AddPass("FogShadowColumns", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {Depth, Before})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.Write(Fog.Counts.Current, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFogColumnsConstants C{};
			C.Pass = Frame->Pass;
			C.Grid = Fog.Grid;
			C.PreviousColumns = Fog.PreviousColumns;
			C.PreviousRows = Fog.PreviousRows;
			C.Depth = GetSampledIndex(Pass, Depth);
			C.PreviousCounts = GetSampledIndex(Pass, Before);
			C.OutCounts = GetStorageIndex(Pass, Fog.Counts.Current);
			Dispatch2D(Pass, Fog.Columns, C, Fog.Grid.Columns, Fog.Grid.Rows, FOG_GROUP_SIZE);
		};
	});
}

FFogShadowConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FFogPass& Fog)
{
	FFogShadowConstants C{};
	C.Pass = Frame.Pass;
	C.Grid = Fog.Grid;
	C.PreviousColumns = Fog.PreviousColumns;
	C.PreviousRows = Fog.PreviousRows;
	C.Counts = GetSampledIndex(Pass, Fog.Counts.Current);
	C.PreviousCounts = Fog.bHistory ? GetSampledIndex(Pass, Fog.Counts.Previous) : NO_TEXTURE;
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
		Builder.Read(Fog.Counts.Current, ERTAccess::ShaderRead);
		if (Fog.bHistory)
		{
			for (const FHistoryTexture* History : {&Fog.Counts, &Fog.Visibility, &Fog.Light})
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
		Builder.Keep(Fog.Counts.Current);
		Builder.Keep(Fog.Depth.Current);
		ReadLightCells(Builder, Cells, true);
		if (Cells.Buffer.IsValid()) { Builder.Keep(Cells.Buffer); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			if (Cells.Buffer.IsValid()) { Cells.OfView->WriteGrid(Pass); }
			const FFogShadowConstants C = MakeConstants(Pass, *Frame, Fog);
			const uint32_t Pairs = DivideUp(Fog.Grid.Slices, 2), Width = Fog.Grid.Columns * Fog.Grid.PerRow;
			const uint32_t Height = CountRows(Fog.Grid, Pairs);
			Pass.CountRays(uint64_t(Fog.Grid.Columns) * Fog.Grid.Rows * Pairs * ((Fog.bSun ? 1 : 0) + (Fog.bLights ? 1 : 0)));
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
	Fog.Columns = RequireCompute(Context, MakeSource("Columns"));
	// A variant from before a change may lack what there is now.
	Fog.bSun = Dispatch->Has("FOG_SUN") && Context.Facts.bSun;
	Fog.bLights = Dispatch->Has("FOG_LIGHTS") && Context.Facts.FogLights > 0;
	if (!Fog.Columns || !RequireCompute(Context, MakeSource("Depth")) || (!Fog.bSun && !Fog.bLights)) { return {}; }
	Fog.Grid = MakeGrid(Context.Width, Context.Height);
	if (!FindTextures(Context, Fog)) { return {}; }
	CheckHistory(Context, Fog);
	Fog.Share = GetShare(Context.View.DeltaSeconds);
	Fog.Phase = std::clamp(Context.Signals.FogPhase, -0.99f, 0.99f);
	FSunRays Sun;
	Sun.Diameter = Context.Scene.GetSun().AngularDiameter;
	Fog.SunOneMinusCos = GetSunOneMinusCos(Sun);
	AddColumnsPass(Context, Fog);
	AddTracePass(Context, Fog);
	Context.Fog.Depth = Fog.Depth.Current;
	return {Fog.Visibility.Current, Fog.Light.Current, Fog.Grid};
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
	if (!CVarDebugSlice.GetOnRenderThread()) { Rays.Defines.emplace_back("FOG_NEXT_SLICE", "1"); }
	Rays.Shaders = FogShaders;
	Rays.Compute = {MakeSource("Columns"), MakeSource("Depth")};
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
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeSource("Depth"));
	if (!Pipeline) { return; } // AddFogShadowPass had it
	const FLightCellsOfFrame Cells = Context.World->LightCells.bGridAsked ? RequireLightCells(Context, GBuffer) : FLightCellsOfFrame();
	const FFrameContext* const Frame = &Context;
	const FFogGrid Grid = Context.Fog.Atlas.Grid;
	const FGraphTexture Output = Context.Fog.Depth;
	Context.Graph.AddPass("FogShadowDepth", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		if (Cells.Counts.IsValid()) { Builder.Keep(Cells.Counts); }
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFogDepthConstants C{};
			C.Pass = Frame->Pass;
			C.PixelSize = Grid.PixelSize;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Output = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Grid.Columns, Grid.Rows, 1);
		};
	});
}

} // namespace Lantern
