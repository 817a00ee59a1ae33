// Guides first directions of paths to where earlier paths of the neighbourhood found light: a map of directions for each tile of the screen,
// times the cosine (after Müller, Gross & Novák 2017, "Practical Path Guiding for Efficient Light-Transport Simulation", who learn trees).
#ifndef LANTERN_PATH_GUIDE_GLSL
#define LANTERN_PATH_GUIDE_GLSL

#include "../Shared/PathGuideTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Motion.glsl"
#include "../Library/OctahedralMap.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FPathGuideTileRef { FPathGuideTile Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FPathRecordRef { uint Data[]; };

const uint PathGuideTileBytes = 144u;

FAddress GuideTileAddress(FViewConstants View, FAddress Tiles, uvec2 Tile)
{
	uint Columns = (View.Width + PATH_GUIDE_TILE - 1u) / PATH_GUIDE_TILE;
	return Tiles + FAddress(Tile.y * Columns + Tile.x) * PathGuideTileBytes;
}

// Returns the address of a tile of the previous frame that showed a place, as if nothing but the camera had moved. 0: none did.
// Relative: to the camera. Shift: pixels.
FAddress FindGuideTile(FViewConstants View, FAddress Tiles, vec3 Relative, vec2 Pixel, vec2 Shift)
{
	if (Tiles == FAddress(0)) { return FAddress(0); }
	vec3 Motion = ComputeMotion(View, Relative, Relative + View.CameraMotion);
	vec2 Previous = Pixel + Motion.xy, Size = vec2(View.Width, View.Height);
	if (Motion.z <= 0.0 || any(lessThan(Previous, vec2(0.0))) || any(greaterThanEqual(Previous, Size))) { return FAddress(0); }
	return GuideTileAddress(View, Tiles, uvec2(clamp(Previous + Shift, vec2(0.0), Size - 1.0)) / PATH_GUIDE_TILE);
}

// Value: radiance / pdf.
uint PackGuideRecord(vec3 Direction, float Value)
{
	const float Most = 1.0e30; // not infinite, and no NaN
	uint Bits = floatBitsToUint(Value > 0.0 ? min(Value, Most) : 0.0);
	return (Bits & ~uint(PATH_GUIDE_BINS - 1)) | OctMapTexel(Direction);
}

// A tile's map as a surface sees it.
struct FPathGuide
{
	FAddress Tile;
	vec3 N;
	float Rows[PATH_GUIDE_SIDE];
	float Total; // of Rows
	float Trust; // 0: nothing is known that the cosine does not; to 1
};

uint LoadBins(FPathGuide Guide, uint Word) { return FPathGuideTileRef(Guide.Tile).Data.Bins[Word]; }

float GuideLight(uint Pair, uint Bin) { return float((Bin & 1u) != 0u ? Pair >> 16u : Pair & 0xffffu); }

// Returns the cosine by which a bin counts.
float GuideCosine(FPathGuide Guide, vec3 Center)
{
	const float Reach = 0.2; // of a bin, as a cosine: parts of it may lie above a horizon that its centre is below
	return max(dot(Guide.N, Center) + Reach, 0.0);
}

vec3 GuideCenter(uint Bin) { return OctMapDirection(Bin, vec2(0.5)); }

float GuideWeight(FPathGuide Guide, uint Bin) { return GuideLight(LoadBins(Guide, Bin >> 1u), Bin) * GuideCosine(Guide, GuideCenter(Bin)); }

// Returns bins for each unit of solid angle around a direction.
float GuideDensity(vec3 Direction) { return 1.0 / OctMapSolidAngle(Direction); }

// What decides how far a guide is trusted: sums over bins of solid angle, light, and squared light, each times the cosine.
struct FGuideSums
{
	float Angle, Light, Square;
};

// Returns the weight of a bin.
float AddBin(FPathGuide Guide, uint Pair, uint Bin, inout FGuideSums Sums)
{
	vec3 Center = GuideCenter(Bin);
	float Light = GuideLight(Pair, Bin), Cosine = GuideCosine(Guide, Center), Density = GuideDensity(Center);
	Sums.Angle += Cosine / Density;
	Sums.Light += Cosine * Light;
	Sums.Square += Cosine * Light * Light * Density;
	return Cosine * Light;
}

// The relative variance of what cosine-weighted paths bring, less what the map would have of noise alone. Even light needs no guide, and one
// with steps would add noise.
float TrustGuide(FGuideSums Sums, float Paths)
{
	const float Even = 0.25, Full = 1.0;
	float Variance = Sums.Square * Sums.Angle / (Sums.Light * Sums.Light) - 1.0;
	float Noise = 4.0 * float(PATH_GUIDE_BINS) / max(Paths, 1.0e-3); // some four times what it is in the mean
	return clamp((Variance - Noise - Even) / (Full - Even), 0.0, 1.0);
}

FPathGuide MakePathGuide(FAddress Tile, vec3 N)
{
	FPathGuide Guide;
	Guide.Tile = Tile;
	Guide.N = N;
	Guide.Total = Guide.Trust = 0.0;
	if (Tile == FAddress(0) || FPathGuideTileRef(Tile).Data.Frames == 0u) { return Guide; }
	FGuideSums Sums = FGuideSums(0.0, 0.0, 0.0);
	for (uint Row = 0u; Row < PATH_GUIDE_SIDE; ++Row)
	{
		Guide.Rows[Row] = 0.0;
		for (uint Bin = Row * PATH_GUIDE_SIDE; Bin < (Row + 1u) * PATH_GUIDE_SIDE; Bin += 2u)
		{
			uint Pair = LoadBins(Guide, Bin >> 1u);
			Guide.Rows[Row] += AddBin(Guide, Pair, Bin, Sums) + AddBin(Guide, Pair, Bin + 1u, Sums);
		}
		Guide.Total += Guide.Rows[Row];
	}
	if (Guide.Total > 0.0) { Guide.Trust = TrustGuide(Sums, FPathGuideTileRef(Tile).Data.Paths); }
	return Guide;
}

// Returns the density over solid angle by which the map alone would draw a direction.
float GuidePdf(FPathGuide Guide, vec3 Direction) { return GuideWeight(Guide, OctMapTexel(Direction)) / Guide.Total * GuideDensity(Direction); }

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
	return OctMapDirection(Row * PATH_GUIDE_SIDE + Column, vec2(X, Y));
}

#endif
