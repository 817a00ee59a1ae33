// Froxels of a view, and the passes that find how far they are seen.
#include "Fog/FroxelColumns.h"

#include <algorithm>
#include <cmath>

#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarDebugSlice("r.RT.Debug.Fog.Slice", true,
    "Planted fault. Off: rays of froxels start at the centre of the next slice, and light leaks through walls.");

constexpr uint32_t MostAtlas = 16384; // texels in a row, which every device with ray tracing has

FShaderSource MakeDepthSource() { return MakeComputeSource("Fog/FogDepth.comp"); }
FShaderSource MakeColumnsSource(const FFroxelSettings& Settings)
{
	FShaderDefines Defines;
	if (Settings.bAfterGBuffer) { Defines.emplace_back("CURRENT_DEPTH", "1"); }
	return MakeComputeSource("Fog/FogColumns.comp", std::move(Defines));
}

bool FindTexture(FFrameContext& Context, const FFroxelSettings& Settings, const FFogGrid& Grid, const char* What, glm::uvec2 Size,
    ERTFormat Format, FHistoryTexture& Out)
{
	const std::string Name = std::string(Settings.Name) + What + " " + std::to_string(Grid.PixelSize) + " " + std::to_string(Grid.Slices) +
	                         " " + std::to_string(Grid.Distance);
	const FRTStatus Status =
	    Context.History->GetTexture(Name.c_str(), {Size.x, Size.y, Format, ERTTextureUsage::CopySource}, Out); // engines copy it
	if (!Status) { Context.Fail(Status); }
	return static_cast<bool>(Status);
}
} // namespace

FFogGrid MakeFroxelGrid(const FFroxelSettings& Settings, uint32_t Width, uint32_t Height)
{
	FFogGrid Grid{};
	Grid.Slices = Settings.Slices;
	Grid.PerRow = static_cast<uint32_t>(std::ceil(std::sqrt(double(Grid.Slices))));
	Grid.PixelSize = std::max(Settings.PixelSize, DivideUp(std::max(Width, Height) * Grid.PerRow, MostAtlas));
	if (Grid.PixelSize != Settings.PixelSize)
	{
		LogOnce(ERTLogLevel::Warning, std::string(Settings.Variable) + ": froxels are larger, because no texture holds so many");
	}
	Grid.Columns = DivideUp(Width, Grid.PixelSize);
	Grid.Rows = DivideUp(Height, Grid.PixelSize);
	Grid.Distance = Settings.Distance;
	return Grid;
}

float GetFroxelShare(double Seconds, float DeltaSeconds)
{
	return Seconds > 0.0 ? static_cast<float>(1.0 - std::pow(0.1, 2.0 * double(DeltaSeconds) / Seconds)) : 1.0f;
}

void AddFroxelDefines(FShaderDefines& InOut)
{
	if (!CVarDebugSlice.GetOnRenderThread()) { InOut.emplace_back("FOG_NEXT_SLICE", "1"); }
}

void ListFroxelShaders(const FFroxelSettings& Settings, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeColumnsSource(Settings));
	Out.push_back(MakeDepthSource());
}

bool FindFroxelColumns(FFrameContext& Context, const FFroxelSettings& Settings, FFroxelColumns& Out)
{
	Out.Pipeline = RequireCompute(Context, MakeColumnsSource(Settings));
	if (!RequireCompute(Context, MakeDepthSource()) || !Out.Pipeline) { return false; } // both are asked for at once
	Out.Grid = MakeFroxelGrid(Settings, Context.Width, Context.Height);
	const glm::uvec2 Size(Out.Grid.Columns, Out.Grid.Rows);
	if (!FindTexture(Context, Settings, Out.Grid, "Counts", Size, ERTFormat::RG32_FLOAT, Out.Counts)) { return false; }
	if (Settings.bAfterGBuffer)
	{
		const std::string Name = std::string(Settings.Name) + "Depth";
		Out.Depth.Current = Context.Graph.CreateTexture({Size.x, Size.y, ERTFormat::RG32_FLOAT}, Name.c_str());
	}
	else if (!FindTexture(Context, Settings, Out.Grid, "Depth", Size, ERTFormat::RG32_FLOAT, Out.Depth)) { return false; }
	if (!Context.PreviousView) { return true; }
	Out.bHistory = Out.Counts.Previous.IsValid();
	const FFogGrid Previous = MakeFroxelGrid(Settings, Context.PreviousView->Width, Context.PreviousView->Height);
	Out.PreviousColumns = Previous.Columns;
	Out.PreviousRows = Previous.Rows;
	return true;
}

bool FindFroxelAtlas(
    FFrameContext& Context, const FFroxelSettings& Settings, const FFogGrid& Grid, const char* What, ERTFormat Format, FHistoryTexture& Out)
{
	return FindTexture(Context, Settings, Grid, What, {Grid.Columns * Grid.PerRow, CountFroxelRows(Grid, Grid.Slices)}, Format, Out);
}

void AddFroxelColumnsPass(FFrameContext& Context, const FFroxelSettings& Settings, const FFroxelColumns& Columns)
{
	const FFrameContext* const Frame = &Context;
	const bool bNow = Settings.bAfterGBuffer;
	const FGraphTexture Depth = bNow ? Columns.Depth.Current : Columns.PreviousColumns > 0 ? Columns.Depth.Previous : FGraphTexture();
	const FGraphTexture Before = Columns.bHistory ? Columns.Counts.Previous : FGraphTexture();
	Context.Graph.AddPass((std::string(Settings.Name) + "Columns").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {Depth, Before})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.Write(Columns.Counts.Current, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFogColumnsConstants C{};
			C.Pass = Frame->Pass;
			C.Grid = Columns.Grid;
			C.PreviousColumns = bNow ? Columns.Grid.Columns : Columns.PreviousColumns;
			C.PreviousRows = bNow ? Columns.Grid.Rows : Columns.PreviousRows;
			C.Depth = GetSampledIndex(Pass, Depth);
			C.PreviousCounts = GetSampledIndex(Pass, Before);
			C.OutCounts = GetStorageIndex(Pass, Columns.Counts.Current);
			Dispatch2D(Pass, Columns.Pipeline, C, Columns.Grid.Columns, Columns.Grid.Rows, FOG_GROUP_SIZE);
		};
	});
}

void AddFroxelDepthPass(FFrameContext& Context, const FGBuffer& GBuffer, const char* Name, const FFogGrid& Grid, FGraphTexture Depth,
    const std::function<void(FPassBuilder&)>& Declare)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeDepthSource());
	if (!Pipeline) { return; }
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((std::string(Name) + "Depth").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Write(Depth, ERTAccess::StorageWrite);
		if (Declare) { Declare(Builder); }
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FFogDepthConstants C{};
			C.Pass = Frame->Pass;
			C.PixelSize = Grid.PixelSize;
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Output = GetStorageIndex(Pass, Depth);
			Dispatch2D(Pass, Pipeline, C, Grid.Columns, Grid.Rows, 1);
		};
	});
}

} // namespace Lantern
