// Shows the radiance cell of each pixel's place, about as a long ray that ends there would find it: each cell has a colour of its own, and is the
// darker the fewer updates it has had. Coarse ones that stand in are grey, and what has none is black. bLight: their light instead.
#version 460
#include "../Library/GBuffer.glsl"
#include "Chain.glsl"

layout(local_size_x = RADIANCE_CELL_VIEW_GROUP, local_size_y = RADIANCE_CELL_VIEW_GROUP) in;
layout(push_constant, scalar) uniform FPush { FRadianceCellViewConstants Push; };

struct FSeenCell
{
	uint Slot, Check;
	bool bCoarse;
};

// Without a vote and without a mark, so that looking changes nothing.
FSeenCell FindCell(FRadianceGrid Grid, vec3 Position, vec3 Normal, float FromCamera)
{
	ivec3 Steps = ToRadianceSteps(Grid, Position);
	uint Level = RadianceLevel(Grid, FromCamera, 0.5);
	FSeenCell Unknown = FSeenCell(NO_RADIANCE_CELL, 0u, false);
	for (uint I = 0u; I < RadianceChain; ++I)
	{
		bool bFull;
		FRadianceLink Link = MakeRadianceLink(Grid, Steps, Level, Normal, I);
		uint Slot = FindRadianceCell(Grid, Link.Key, bFull);
		if (Slot == NO_RADIANCE_CELL) { continue; }
		FSeenCell Seen = FSeenCell(Slot, Link.Key.Check, Link.bCoarse);
		if (IsLinkKnown(Link, FRadianceCellRef(Grid.Cells).Data[Slot])) { return Seen; }
		if (Unknown.Slot == NO_RADIANCE_CELL) { Unknown = Seen; }
	}
	return Unknown;
}

vec3 ShowCell(FRadianceGrid Grid, FSeenCell Seen)
{
	const float Middle = 0.5; // irradiance / π that is shown at half of the brightness
	if (Seen.Slot == NO_RADIANCE_CELL) { return vec3(0.0); }
	FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[Seen.Slot];
	if (Push.bLight != 0u)
	{
		vec3 Light = UnpackRgbe(Cell.Light);
		return Light / (Light + Middle);
	}
	float Known = min(float(RadianceCellCount(Cell.State)) / 16.0, 1.0);
	vec3 Color = vec3(HashPcg4(uvec4(Seen.Check, 0u, 0u, 0u)).xyz >> 8u) * (1.0 / 16777216.0);
	return (Seen.bCoarse ? vec3(0.5) : 0.25 + 0.75 * Color) * (0.2 + 0.8 * Known);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	float Depth = LoadDepth(Push.Depth, Pixel);
	vec3 Color = vec3(0.0);
	if (Depth > 0.0)
	{
		FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
		Color = ShowCell(Grid, FindCell(Grid, RasterRayOrigin(FSceneRef(Push.Pass.Scene).Data, View, Point), Point.Ng, length(Point.Relative)));
	}
	imageStore(Images[Push.Output], Pixel, vec4(Color, 1.0));
}
