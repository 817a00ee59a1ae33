// Froxels of a view: how they lie, how far each column of them is seen, and their atlases of slices (Shaders/Fog/Froxels.glsl). What lights
// them is a pass of its own.
#pragma once

#include <functional>
#include <string>

#include "FogTypes.h"
#include "LanternCore/FrameGraph/History.h"
#include "PassTools.h"

namespace Lantern
{

/// How froxels are wanted.
struct FFroxelSettings
{
	const char* Name;     ///< of their passes and histories
	uint32_t PixelSize;   ///< width and height of a column, pixels
	const char* Variable; ///< that says so, for a message if no texture holds so many
	uint32_t Slices;      ///< 2 to FOG_MOST_SLICES
	float Distance;       ///< at which the last one ends, metres
	/// The G-buffer is there before they are lit: AddFroxelDepthPass comes before AddFroxelColumnsPass, and there is no frame for which it is
	/// unknown how far it is seen.
	bool bAfterGBuffer = false;
};

struct FFroxelColumns
{
	FFogGrid Grid{};
	uint32_t PreviousColumns = 0, PreviousRows = 0; ///< of the frame before; 0: there is none
	FHistoryTexture Counts;                         ///< RG32_FLOAT, see FFogColumnsConstants
	FHistoryTexture Depth;                          ///< RG32_FLOAT, see AddFroxelDepthPass; with bAfterGBuffer, Current alone
	IRTPipeline* Pipeline = nullptr;
	bool bHistory = false; ///< what the frame before knew of its columns is there
};

FFogGrid MakeFroxelGrid(const FFroxelSettings& Settings, uint32_t Width, uint32_t Height);
inline uint32_t CountFroxelRows(const FFogGrid& Grid, uint32_t Tiles) { return DivideUp(Tiles, Grid.PerRow) * Grid.Rows; }

/// Returns what is traced in a frame against the history, so that 90 % of a change shows after Seconds: two frames pass between a froxel's rays.
float GetFroxelShare(double Seconds, float DeltaSeconds);
/// Adds what shaders that trace from froxels are compiled with.
void AddFroxelDefines(FShaderDefines& InOut);
void ListFroxelShaders(const FFroxelSettings& Settings, std::vector<FShaderSource>& Out);
/// False: shaders are being compiled, or an error, which the context has.
bool FindFroxelColumns(FFrameContext& Context, const FFroxelSettings& Settings, FFroxelColumns& Out);
/// Finds an atlas of all slices, by a name that says how froxels lie: other settings begin anew. False: an error, which the context has.
bool FindFroxelAtlas(FFrameContext& Context, const FFroxelSettings& Settings, const FFogGrid& Grid, const char* What, ERTFormat Format,
    FHistoryTexture& Out);
/// Adds the pass that finds how far each column is seen, by what the frame before has shown. Without history it is all lit.
/// FFroxelSettings::bAfterGBuffer: by what this frame shows.
void AddFroxelColumnsPass(FFrameContext& Context, const FFroxelSettings& Settings, const FFroxelColumns& Columns);
/// Adds the pass that notes how far the frame shows each column. Declare: also of the pass; may be empty. Shaders:
/// FindFroxelColumns had them.
void AddFroxelDepthPass(FFrameContext& Context, const FGBuffer& GBuffer, const char* Name, const FFogGrid& Grid, FGraphTexture Depth,
    const std::function<void(FPassBuilder&)>& Declare = {});

} // namespace Lantern
