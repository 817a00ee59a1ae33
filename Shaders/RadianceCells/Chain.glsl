// The cells that a path's end tries in turn: fine ones, thin and thick, then coarse ones that stand in.
#ifndef LANTERN_RADIANCE_CHAIN_GLSL
#define LANTERN_RADIANCE_CHAIN_GLSL

#include "../Library/RadianceCells.glsl"

const uint RadianceChain = 4u;

struct FRadianceLink
{
	FRadianceKey Key;
	uint Level;
	bool bCoarse;
};

// Level: of fine cells. I: less than RadianceChain.
FRadianceLink MakeRadianceLink(FRadianceGrid Grid, ivec3 Steps, uint Level, vec3 Normal, uint I)
{
	FRadianceLink Link;
	Link.bCoarse = I >= 2u;
	Link.Level = min(Link.bCoarse ? Level + RADIANCE_CELL_COARSER : Level, RADIANCE_CELL_LEVELS - 1u);
	Link.Key = MakeRadianceKey(Grid, Steps, Link.Level, Link.bCoarse, Normal, (I & 1u) != 0u);
	return Link;
}

// Returns whether a path's end takes a cell's light.
bool IsLinkKnown(FRadianceLink Link, FRadianceCell Cell)
{
	return RadianceCellCount(Cell.State) >= (Link.bCoarse ? LeastCoarseCount : 1u);
}

#endif
