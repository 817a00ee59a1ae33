// Reads cascades of the host's shadow map and their pyramids.
#ifndef LANTERN_HOST_SHADOW_MAP_GLSL
#define LANTERN_HOST_SHADOW_MAP_GLSL

#include "../Shared/HostShadowTypes.h"
#include "../Library/Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FHostShadowRef { FHostShadowData Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FCascadeRef { FHostShadowCascadeData Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FCellRef { vec2 Data[]; };

// Addresses, not references, are what functions take: the optimizer of SPIR-V fails on references that were made of numbers.
FAddress GetCascade(FAddress Host, uint Index) { return FHostShadowRef(Host).Data.Cascades + uint64_t(Index * HOST_SHADOW_CASCADE_BYTES); }

// Distance of what a texel shows from the near plane, metres. What lies on the near plane was clamped to it, and may be anywhere nearer
// to the sun. A texel of the far plane shows nothing. Pixels side by side may read different cascades.
float LoadMapDepth(FAddress Cascade, ivec2 Texel)
{
	float Depth = texelFetch(Textures[nonuniformEXT(FCascadeRef(Cascade).Data.Map)], Texel + ivec2(FCascadeRef(Cascade).Data.FirstX, FCascadeRef(Cascade).Data.FirstY), 0).x;
	if (Depth == 1.0 - FCascadeRef(Cascade).Data.NearDepth) { return 1.0e9; }
	return Depth == FCascadeRef(Cascade).Data.NearDepth ? -1.0e9 : (Depth - FCascadeRef(Cascade).Data.NearDepth) * FCascadeRef(Cascade).Data.DepthScale;
}

uvec2 LevelSize(FAddress Cascade, uint Level)
{
	return (uvec2(FCascadeRef(Cascade).Data.Width, FCascadeRef(Cascade).Data.Height) + (1u << Level) - 1u) >> Level;
}

vec2 LoadCell(FAddress Cascade, uint Level, uvec2 Cell)
{
	return FCellRef(FCascadeRef(Cascade).Data.Pyramid).Data[FCascadeRef(Cascade).Data.Levels[Level] + Cell.y * LevelSize(Cascade, Level).x + Cell.x];
}

// Nearest and farthest of all texels in a square around Texel, and of some beside it: of up to 3 × 3 cells. OutReach: how far those lie
// from Texel at most, texels.
vec2 LoadSquare(FAddress Cascade, vec2 Texel, float HalfWidth, out float OutReach)
{
	uint Level = clamp(uint(ceil(log2(max(HalfWidth, 1.0)))), uint(HOST_SHADOW_FIRST_LEVEL), FCascadeRef(Cascade).Data.TopLevel);
	float Edge = float(1u << Level);
	vec2 Last = vec2(LevelSize(Cascade, Level) - 1u);
	uvec2 From = uvec2(clamp((Texel - HalfWidth) / Edge, vec2(0.0), Last)), To = uvec2(clamp((Texel + HalfWidth) / Edge, vec2(0.0), Last));
	OutReach = HalfWidth + Edge;
	uint Across = To.x - From.x + 1u, Count = Across * (To.y - From.y + 1u);
	vec2 Joined = vec2(1.0e30, -1.0e30);
	[[dont_unroll]] for (uint I = 0u; I < Count; ++I)
	{
		vec2 Cell = LoadCell(Cascade, Level, From + uvec2(I % Across, I / Across));
		Joined = vec2(min(Joined.x, Cell.x), max(Joined.y, Cell.y));
	}
	return Joined;
}

#endif
