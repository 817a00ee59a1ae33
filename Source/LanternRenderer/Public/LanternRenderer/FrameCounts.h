// What the GPU counts in frames that have run, for whoever measures.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace Lantern
{

/// Counts of alpha tests under rays, with r.RT.Opacity.Count. A frame's count arrives two frames later, or with WaitForAll.
struct FAnyHitCounts
{
	uint64_t LastFrame = 0; ///< count of the newest frame that has arrived; modulo 2³²
	uint64_t Total = 0;     ///< sum over all frames that have arrived
	uint32_t Frames = 0;    ///< number of frames that have arrived
};

/// Counts of the shadow rays that queues really traced, with r.RT.Rays.Count. A frame's count arrives two frames later, or with
/// WaitForAll.
struct FRayCounts
{
	uint64_t LastFrame = 0;                               ///< count of the newest frame that has arrived
	std::vector<std::pair<std::string, uint64_t>> Passes; ///< its parts, by the names of the passes that traced
	uint64_t Total = 0;                                   ///< sum over all frames that have arrived
	uint32_t Frames = 0;                                  ///< number of frames that have arrived
};

/// Counts of the rays that paths really traced, of all passes, with r.RT.Rays.CountPaths. A frame's counts arrive two frames later, or with
/// WaitForAll.
struct FPathRayCounts
{
	uint32_t Surfaces = 0; ///< rays that look for a surface
	uint32_t Lights = 0;   ///< rays from a surface to a light
	uint32_t Checks = 0;   ///< rays that test whether light of a radiance cell, or of a kept path, arrives
	uint32_t Frames = 0;   ///< number of frames that have arrived
};

/// Counts of radiance cells in the newest frame that has arrived, with r.RT.GI.Cells.Count. A frame's counts arrive two frames later, or
/// with WaitForAll.
struct FRadianceCellCounts
{
	uint32_t Live = 0;    ///< cells in use
	uint32_t Young = 0;   ///< of these, such of rank 1 and 2 that have had few updates and come before all others
	uint32_t Updated = 0; ///< cells
	uint32_t Full = 0;    ///< look-ups and votes that found no room for a cell at its level
	uint32_t Found = 0;   ///< look-ups that ended in the cell of their place
	uint32_t Coarse = 0;  ///< that ended in a coarse one instead
	uint32_t Missed = 0;  ///< that ended in none: the path went on
	uint32_t Frames = 0;  ///< number of frames that have arrived
};

/// Counts of reflections in the newest frame that has arrived, with r.RT.Rays.CountEnds. A frame's counts arrive two frames later, or
/// with WaitForAll.
struct FReflectionCounts
{
	uint32_t Mirrors = 0;  ///< pixels that traced: roughness below 0.032
	uint32_t Sharp = 0;    ///< below r.RT.Reflections.LitRoughness
	uint32_t Wide = 0;     ///< rougher ones
	uint32_t Further = 0;  ///< paths beside those that each pixel has, where light has changed (r.RT.Reflections.ChangedSamples)
	uint32_t Lit = 0;      ///< paths whose first hit was lit by rays to lights
	uint32_t Sky = 0;      ///< paths that ended in the sky
	uint32_t Cells = 0;    ///< that ended in a radiance cell
	uint32_t StandIns = 0; ///< that ended at a mirror, whose cell stood in for what it shows
	uint32_t Dark = 0;     ///< that ended where nothing was known, or all was absorbed
	uint32_t None = 0;     ///< that had no direction to go
	uint32_t Frames = 0;   ///< number of frames that have arrived
};

} // namespace Lantern
