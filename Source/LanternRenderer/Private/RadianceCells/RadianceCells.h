// Radiance cells: light that surfaces receive, kept in small cells of the world (Shaders/Library/RadianceCells.glsl). Paths end in them, so
// that a frame traces one ray where it would trace a path. Cells are the world's: a cut keeps them.
//
// A pass that looks cells up calls RequireRadianceCells, declares ReadRadianceCells, and hands WriteRadianceGrid's address to its shader.
// AddRadianceCellPasses then brings the cells up to date for the next frame.
#pragma once

#include <functional>

#include "RadianceCellTypes.h"
#include "RayPath.h"

namespace Lantern
{

struct FRadianceCells
{
	FGraphBuffer Table;   ///< what is kept: FRadianceTable
	FGraphBuffer Work;    ///< of this frame: FRadianceWork
	FRadianceGrid Grid{}; ///< without addresses of buffers
	FUploadSlice GridData;
	float EventFrames = 0.0f; ///< for which what pixels saw may hold, by what has changed
	uint32_t Slots = 0;
	/// First voters of reflections, and of surfaces that light shines through. Those of the pass that keeps the cells come before them.
	uint32_t ReflectionVoters = 0, TransmissionVoters = 0;
	uint32_t VolumeVoters = 0; ///< the first one of indirect light in the air
};

/// What the updates of cells trace, and their other shaders, for frames with a pass whose rays end in them (FPassRays::bRadianceCells).
/// Path: that pass's. None: there is none.
FPassRays ChooseRadianceCellRays(const FPassQuery& Query, ERayPath Path);
/// Adds what shaders that look cells up are compiled with.
void AddRadianceCellDefines(FShaderDefines& InOut);
/// Mirrors throw no sun: see r.RT.GI.Caustics.
constexpr const char* NoCausticsDefine = "NO_CAUSTICS";
constexpr const char* RadianceCellShaders = "RadianceCells/Update";

/// Returns the cells of the frame's view. Null: shaders are being compiled, or there is no memory, of which the log tells. Path: as in
/// ChooseRadianceCellRays. The first call of a frame is for the whole one. Look-ups that may vote have places of their own in
/// FRadianceGrid::Votes. Each 2×2 pixels share one (VoterOfPixel in Shaders/Library/RadianceCells.glsl), and a pixel of the half frame has its
/// own. Some may be written in no frame, or not in this one: a vote of an earlier frame is no cell's any more. Passes that vote are added
/// before AddRadianceCellPasses.
const FRadianceCells* RequireRadianceCells(FFrameContext& Context, ERayPath Path);
/// Declares that a pass looks cells up and asks for those that it misses. Cells may be null.
void ReadRadianceCells(FPassBuilder& Builder, const FRadianceCells* Cells);
/// Returns FRadianceGrid's address, while a pass with ReadRadianceCells is recorded. 0: Cells is null.
FAddress WriteRadianceGrid(FPassContext& Pass, const FRadianceCells* Cells);
/// Rays that run beside the updates of cells: either waits for its longest path, and they wait together. They may look cells up, and do
/// not vote.
struct FBesideUpdates
{
	std::string Pass; ///< name
	std::function<void(FPassBuilder&)> Declare;
	std::function<void(FPassContext&)> Record;
};
/// Adds the passes behind all that look cells up and vote. Path: as in ChooseRadianceCellRays. False: there are no cells, or their updates
/// cannot run in this frame. Nothing is added then.
bool AddRadianceCellPasses(FFrameContext& Context, const FGBuffer& GBuffer, ERayPath Path, const FBesideUpdates& Beside);

} // namespace Lantern
