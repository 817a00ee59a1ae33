// Guides first directions of paths to where earlier paths of the neighbourhood found light: a map of directions for each tile of the screen,
// times the cosine (after Müller, Gross & Novák 2017, "Practical Path Guiding for Efficient Light-Transport Simulation", who learn trees).
#ifndef LANTERN_PATH_GUIDE_GLSL
#define LANTERN_PATH_GUIDE_GLSL

#include "../Shared/PathGuideTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Motion.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FPathGuideTileRef { FPathGuideTile Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FPathRecordRef { uint Data[]; };

const uint PathGuideTileBytes = 144u;

uvec2 CountGuideTiles(uvec2 Size) { return (Size + PATH_GUIDE_TILE - 1u) / PATH_GUIDE_TILE; }

// Returns the address of a tile of the previous frame that showed a place, as if nothing but the camera had moved. 0: none did.
// Relative: to the camera. Shift: pixels.
FAddress FindGuideTile(FViewConstants View, FAddress Tiles, vec3 Relative, vec2 Pixel, vec2 Shift)
{
	if (Tiles == FAddress(0)) { return FAddress(0); }
	vec3 Motion = ComputeMotion(View, Relative, Relative + View.CameraMotion);
	vec2 Previous = Pixel + Motion.xy, Size = vec2(View.Width, View.Height);
	if (Motion.z <= 0.0 || any(lessThan(Previous, vec2(0.0))) || any(greaterThanEqual(Previous, Size))) { return FAddress(0); }
	uvec2 Tile = uvec2(clamp(Previous + Shift, vec2(0.0), Size - 1.0)) / PATH_GUIDE_TILE;
	uint Number = Tile.y * CountGuideTiles(uvec2(View.Width, View.Height)).x + Tile.x;
	return Tiles + FAddress(Number) * PathGuideTileBytes;
}

uint GuideBin(vec3 Direction)
{
	uvec2 Place = uvec2(clamp((OctEncode(Direction) * 0.5 + 0.5) * float(PATH_GUIDE_SIDE), vec2(0.0), vec2(PATH_GUIDE_SIDE - 1u)));
	return Place.y * PATH_GUIDE_SIDE + Place.x;
}

// Value: radiance / pdf.
uint PackGuideRecord(vec3 Direction, float Value)
{
	const float Most = 1.0e30; // not infinite, and no NaN
	uint Bits = floatBitsToUint(Value > 0.0 ? min(Value, Most) : 0.0);
	return (Bits & ~uint(PATH_GUIDE_BINS - 1)) | GuideBin(Direction);
}

// A tile's map as a surface sees it.
struct FPathGuide
{
	FAddress Tile; // 0: nothing is known, and the cosine alone counts
	vec3 N;
	float Rows[PATH_GUIDE_SIDE];
	float Total; // of Rows
};

uint LoadBins(FPathGuide Guide, uint Word) { return FPathGuideTileRef(Guide.Tile).Data.Bins[Word]; }

// Pair: the word that holds the bin.
float GuideWeight(FPathGuide Guide, uint Pair, uint Bin)
{
	const float Reach = 0.2; // of a bin, as a cosine: parts of it may lie above a horizon that its centre is below
	uint Light = (Bin & 1u) != 0u ? Pair >> 16u : Pair & 0xffffu;
	if (Light == 0u) { return 0.0; }
	vec2 Center = (vec2(Bin % PATH_GUIDE_SIDE, Bin / PATH_GUIDE_SIDE) + 0.5) * (2.0 / float(PATH_GUIDE_SIDE)) - 1.0;
	return float(Light) * max(dot(Guide.N, OctDecode(Center)) + Reach, 0.0);
}
float GuideWeight(FPathGuide Guide, uint Bin) { return GuideWeight(Guide, LoadBins(Guide, Bin >> 1u), Bin); }

FPathGuide MakePathGuide(FAddress Tile, vec3 N)
{
	FPathGuide Guide;
	Guide.Tile = Tile;
	Guide.N = N;
	Guide.Total = 0.0;
	if (Tile == FAddress(0) || FPathGuideTileRef(Tile).Data.Frames == 0u)
	{
		Guide.Tile = FAddress(0);
		return Guide;
	}
	for (uint Row = 0u; Row < PATH_GUIDE_SIDE; ++Row)
	{
		Guide.Rows[Row] = 0.0;
		for (uint Bin = Row * PATH_GUIDE_SIDE; Bin < (Row + 1u) * PATH_GUIDE_SIDE; Bin += 2u)
		{
			uint Pair = LoadBins(Guide, Bin >> 1u);
			Guide.Rows[Row] += GuideWeight(Guide, Pair, Bin) + GuideWeight(Guide, Pair, Bin + 1u);
		}
		Guide.Total += Guide.Rows[Row];
	}
	if (Guide.Total <= 0.0) { Guide.Tile = FAddress(0); }
	return Guide;
}

// Returns the density over solid angle by which the map alone would draw a direction. An octahedral map has four units of area, and a
// direction d its density |d|₁⁻³ (the octahedron's faces, seen from its centre).
float GuidePdf(FPathGuide Guide, vec3 Direction)
{
	float Chance = GuideWeight(Guide, GuideBin(Direction)) / Guide.Total;
	float Norm = abs(Direction.x) + abs(Direction.y) + abs(Direction.z);
	return Chance * (float(PATH_GUIDE_BINS) / 4.0) / (Norm * Norm * Norm);
}

vec3 DrawGuided(FPathGuide Guide, vec2 U)
{
	uint Row = 0u, Column = 0u;
	float Left = U.y * Guide.Total;
	for (; Row < PATH_GUIDE_SIDE - 1u && Left >= Guide.Rows[Row]; ++Row) { Left -= Guide.Rows[Row]; }
	float Y = min(Left / max(Guide.Rows[Row], 1.0e-30), 1.0);
	Left = U.x * Guide.Rows[Row];
	float Weight = 0.0;
	for (;; ++Column)
	{
		Weight = GuideWeight(Guide, Row * PATH_GUIDE_SIDE + Column);
		if (Left < Weight || Column == PATH_GUIDE_SIDE - 1u) { break; }
		Left -= Weight;
	}
	float X = min(Left / max(Weight, 1.0e-30), 1.0);
	return OctDecode((vec2(Column, Row) + vec2(X, Y)) * (2.0 / float(PATH_GUIDE_SIDE)) - 1.0);
}

#endif
