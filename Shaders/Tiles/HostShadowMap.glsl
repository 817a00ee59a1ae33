// Reads cascades of the host's shadow map and their pyramids.
#ifndef LANTERN_HOST_SHADOW_MAP_GLSL
#define LANTERN_HOST_SHADOW_MAP_GLSL

#include "../Shared/HostShadowTypes.h"
#include "../Library/Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FHostShadowRef { FHostShadowData Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FCascadeRef { FHostShadowCascadeData Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FCellRef { vec2 Data[]; };

FCascadeRef GetCascade(FHostShadowRef Host, uint Index) { return FCascadeRef(Host.Data.Cascades + uint64_t(Index * HOST_SHADOW_CASCADE_BYTES)); }

// Distance of what a texel shows from the near plane, metres. What lies on the near plane was clamped to it, and may be anywhere nearer
// to the sun. A texel of the far plane shows nothing.
float LoadMapDepth(FCascadeRef Cascade, ivec2 Texel)
{
	float Depth = texelFetch(Textures[Cascade.Data.Map], Texel + ivec2(Cascade.Data.FirstX, Cascade.Data.FirstY), 0).x;
	if (Depth == 1.0 - Cascade.Data.NearDepth) { return 1.0e9; }
	return Depth == Cascade.Data.NearDepth ? -1.0e9 : (Depth - Cascade.Data.NearDepth) * Cascade.Data.DepthScale;
}

uvec2 LevelSize(FCascadeRef Cascade, uint Level)
{
	return (uvec2(Cascade.Data.Width, Cascade.Data.Height) + (1u << Level) - 1u) >> Level;
}

vec2 LoadCell(FCascadeRef Cascade, uint Level, uvec2 Cell)
{
	return FCellRef(Cascade.Data.Pyramid).Data[Cascade.Data.Levels[Level] + Cell.y * LevelSize(Cascade, Level).x + Cell.x];
}

// Nearest and farthest of all texels in a square around Texel, and of some beside it. OutReach: how far those lie from Texel at most,
// texels.
vec2 LoadSquare(FCascadeRef Cascade, vec2 Texel, float HalfWidth, out float OutReach)
{
	uint Level = clamp(uint(ceil(log2(max(2.0 * HalfWidth, 1.0)))), uint(HOST_SHADOW_FIRST_LEVEL), Cascade.Data.TopLevel);
	float Edge = float(1u << Level);
	vec2 Last = vec2(LevelSize(Cascade, Level) - 1u);
	uvec2 From = uvec2(clamp((Texel - HalfWidth) / Edge, vec2(0.0), Last)), To = uvec2(clamp((Texel + HalfWidth) / Edge, vec2(0.0), Last));
	OutReach = HalfWidth + Edge;
	vec2 A = LoadCell(Cascade, Level, From), B = LoadCell(Cascade, Level, To);
	vec2 C = LoadCell(Cascade, Level, uvec2(From.x, To.y)), D = LoadCell(Cascade, Level, uvec2(To.x, From.y));
	return vec2(min(min(A.x, B.x), min(C.x, D.x)), max(max(A.y, B.y), max(C.y, D.y)));
}

#endif
