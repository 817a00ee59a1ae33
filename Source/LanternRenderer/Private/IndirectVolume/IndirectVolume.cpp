// Indirect light in the air: the passes, and their memory from frame to frame.
#include "IndirectVolume/IndirectVolume.h"

#include "Fog/FroxelColumns.h"
#include "IndirectVolumeTypes.h"
#include "Lights/LightCells.h"
#include "RadianceCells/RadianceCells.h"
#include "Rays/RayQueue.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarVolume("r.RT.GI.Volume", true,
    "Finds indirect light in the air, if somebody reads it: an engine's fog, particles and translucent surfaces, or the fog of "
    "r.Fog.Density. With r.RT.GI 2 or 3. If off, that fog takes the sky's light without shadows.");
TRTConsoleVariable<int32_t> CVarPixelSize("r.RT.GI.Volume.PixelSize", 32,
    "Width and height of froxels of indirect light, in pixels. The rays grow with the inverse of its square.", {8, 256});
TRTConsoleVariable<int32_t> CVarSlices("r.RT.GI.Volume.Slices", 32,
    "Number of slices of indirect light along the view. Half of them get paths in each frame.", {2, FOG_MOST_SLICES});
TRTConsoleVariable<float> CVarDistance(
    "r.RT.GI.Volume.Distance", 250.0f, "Distance at which froxels of indirect light end, in metres.", {1, 1e6});
TRTConsoleVariable<int32_t> CVarSamples(
    "r.RT.GI.Volume.Samples", 1, "Number of paths of a froxel of indirect light, in every other frame.", {1, 64});
TRTConsoleVariable<float> CVarHistorySeconds("r.RT.GI.Volume.HistorySeconds", 0.75f,
    "Time, in seconds, after which 90 % of a change of indirect light shows in the air. 0: each frame stands alone.", {0, 10});
TRTConsoleVariable<bool> CVarMoment(
    "r.RT.Debug.GI.VolumeMoment", true, "Planted fault. Off: indirect light in the air counts as coming evenly from all directions.");

constexpr uint32_t BouncesWithoutCell = 2; // of a path that meets no cell

FFroxelSettings GetSettings()
{
	return {"IndirectVolume", static_cast<uint32_t>(CVarPixelSize.GetOnRenderThread()), "r.RT.GI.Volume.PixelSize",
	    static_cast<uint32_t>(CVarSlices.GetOnRenderThread()), CVarDistance.GetOnRenderThread(), true};
}

FPassQuery MakeQuery(const FFrameContext& Context) { return {Context.Device.GetCapabilities(), Context.Facts, Context.Signals}; }

uint32_t CountPairs(const FFogGrid& Grid) { return DivideUp(Grid.Slices, 2); }

struct FVolumePass
{
	FFroxelColumns Columns;
	FHistoryTexture Light, Moment;
	FRayDispatch Dispatch;
	const FRadianceCells* Cells = nullptr;
};

/// False: shaders are being compiled, there are no cells, or an error, which the context has.
bool FindVolume(FFrameContext& Context, FVolumePass& Out)
{
	const FPassQuery Query = MakeQuery(Context);
	const FPassRays Rays = ChooseIndirectVolumeRays(Query);
	const std::optional<FRayDispatch> Dispatch = RequireRayDispatch(
	    Context, Rays, Context.GetRayGen(EPassRayGen::IndirectVolume), MakeQuerySource(Context.Facts, IndirectVolumeShaders, Rays));
	const FFroxelSettings Settings = GetSettings();
	if (!FindFroxelColumns(Context, Settings, Out.Columns) || !Dispatch || !Dispatch->Has("RADIANCE_CELLS")) { return false; }
	Out.Dispatch = *Dispatch;
	Out.Cells = RequireRadianceCells(Context, ChooseRadianceCellPath(Query));
	if (!Out.Cells) { return false; }
	for (const auto& [What, History] : {std::pair("Light", &Out.Light), std::pair("Moment", &Out.Moment)})
	{
		if (!FindFroxelAtlas(Context, Settings, Out.Columns.Grid, What, ERTFormat::RGBA16_FLOAT, *History)) { return false; }
		Out.Columns.bHistory &= History->Previous.IsValid();
	}
	return true;
}

FIndirectVolumeConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FVolumePass& Volume)
{
	const FFroxelColumns& Columns = Volume.Columns;
	FIndirectVolumeConstants C{};
	C.Pass = Frame.Pass;
	C.Grid = Columns.Grid;
	C.PreviousColumns = Columns.PreviousColumns;
	C.PreviousRows = Columns.PreviousRows;
	C.Counts = GetSampledIndex(Pass, Columns.Counts.Current);
	C.PreviousCounts = C.PreviousLight = C.PreviousMoment = NO_TEXTURE;
	if (Columns.bHistory)
	{
		C.PreviousCounts = GetSampledIndex(Pass, Columns.Counts.Previous);
		C.PreviousLight = GetSampledIndex(Pass, Volume.Light.Previous);
		C.PreviousMoment = GetSampledIndex(Pass, Volume.Moment.Previous);
	}
	C.OutLight = GetStorageIndex(Pass, Volume.Light.Current);
	C.OutMoment = GetStorageIndex(Pass, Volume.Moment.Current);
	C.Share = GetFroxelShare(double(CVarHistorySeconds.GetOnRenderThread()), Frame.View.DeltaSeconds);
	C.Samples = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	C.MaxBounces = BouncesWithoutCell;
	C.FirstVoter = Volume.Cells->VolumeVoters;
	C.RadianceCells = WriteRadianceGrid(Pass, Volume.Cells);
	return C;
}

void AddTracePass(FFrameContext& Context, const FGBuffer& GBuffer, const FVolumePass& Volume)
{
	const FFrameContext* const Frame = &Context;
	const FLightCellsOfFrame& LightCells = RequireLightCells(Context, GBuffer);
	Context.Graph.AddPass("IndirectVolume", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Volume.Columns.Counts.Current, ERTAccess::ShaderRead);
		for (const FHistoryTexture* History : {&Volume.Columns.Counts, &Volume.Light, &Volume.Moment})
		{
			if (Volume.Columns.bHistory) { Builder.Read(History->Previous, ERTAccess::ShaderRead); }
		}
		for (const FHistoryTexture* History : {&Volume.Light, &Volume.Moment})
		{
			Builder.Write(History->Current, ERTAccess::StorageWrite);
			Builder.Keep(History->Current);
		}
		Builder.Keep(Volume.Columns.Counts.Current);
		ReadRadianceCells(Builder, Volume.Cells);
		ReadLightCells(Builder, LightCells, true);
		Builder.AllowAsync();
		Builder.RunBeside(PathsGroup);
		return [=](FPassContext& Pass) {
			const FIndirectVolumeConstants C = MakeConstants(Pass, *Frame, Volume);
			const FFogGrid& Grid = Volume.Columns.Grid;
			const uint32_t Width = Grid.Columns * Grid.PerRow, Height = CountFroxelRows(Grid, CountPairs(Grid));
			Pass.CountRays(uint64_t(Grid.Columns) * Grid.Rows * CountPairs(Grid) * C.Samples);
			if (Volume.Dispatch.Compute) { Dispatch2D(Pass, Volume.Dispatch.Compute, C, Width, Height, RAY_QUERY_GROUP_SIZE); }
			else { TraceFrameRays(Pass, *Frame, Volume.Dispatch.RayGen, C, Width, Height); }
		};
	});
}
} // namespace

FPassRays ChooseIndirectVolumeRays(const FPassQuery& Query)
{
	FPassRays Rays;
	if (!Query.Requests.bIndirectVolume || !CVarVolume.GetOnRenderThread() || !HasAnyLight(Query.Facts)) { return Rays; }
	Rays.Path = ChooseRadianceCellPath(Query);
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.Defines = MakePathDefines(Query.Facts);
	if (Query.Facts.Lights > 0) { Rays.Defines.emplace_back("LIGHT_CELLS_OF_VIEW", "1"); }
	AddRadianceCellDefines(Rays.Defines);
	AddFroxelDefines(Rays.Defines);
	if (!CVarMoment.GetOnRenderThread()) { Rays.Defines.emplace_back("NO_VOLUME_MOMENT", "1"); }
	if (Rays.Path == ERayPath::Pipeline) { AddReorderDefine(Query.Capabilities, Rays.Defines); }
	SetHitPrograms(EHitPrograms::Standard, Rays);
	Rays.bShadesHits = true;
	Rays.Shaders = IndirectVolumeShaders;
	ListFroxelShaders(GetSettings(), Rays.Compute);
	ListLightCellShaders(Query.Facts, Rays.Compute);
	return Rays;
}

uint32_t CountIndirectVolumeVoters(const FFrameContext& Context)
{
	if (ChooseIndirectVolumeRays(MakeQuery(Context)).Path == ERayPath::None) { return 0; }
	const FFogGrid Grid = MakeFroxelGrid(GetSettings(), Context.Width, Context.Height);
	return Grid.Columns * Grid.Rows * CountPairs(Grid);
}

FIndirectVolume AddIndirectVolumePass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (Context.IndirectVolume) { return *Context.IndirectVolume; }
	Context.IndirectVolume.emplace();
	FVolumePass Volume;
	if (ChooseIndirectVolumeRays(MakeQuery(Context)).Path == ERayPath::None || !FindVolume(Context, Volume)) { return {}; }
	AddFroxelDepthPass(Context, GBuffer, GetSettings().Name, Volume.Columns.Grid, Volume.Columns.Depth.Current);
	AddFroxelColumnsPass(Context, GetSettings(), Volume.Columns);
	AddTracePass(Context, GBuffer, Volume);
	Context.IndirectVolume = {Volume.Light.Current, Volume.Moment.Current, Volume.Columns.Grid};
	return *Context.IndirectVolume;
}

} // namespace Lantern
