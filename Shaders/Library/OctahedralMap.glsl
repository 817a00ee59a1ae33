// Maps of all directions: squares of 8×8 texels in octahedral coordinates, row by row.
#ifndef LANTERN_OCTAHEDRAL_MAP_GLSL
#define LANTERN_OCTAHEDRAL_MAP_GLSL

#include "Math.glsl"

const uint OctMapSide = 8u;
const uint OctMapTexels = OctMapSide * OctMapSide;

uint OctMapTexel(vec3 Direction)
{
	uvec2 Place = uvec2(clamp((OctEncode(Direction) * 0.5 + 0.5) * float(OctMapSide), vec2(0.0), vec2(OctMapSide - 1u)));
	return Place.y * OctMapSide + Place.x;
}

// Returns a direction of a texel. Place: in the texel, [0, 1)².
vec3 OctMapDirection(uint Texel, vec2 Place)
{
	return OctDecode((vec2(Texel % OctMapSide, Texel / OctMapSide) + Place) * (2.0 / float(OctMapSide)) - 1.0);
}

// Returns the solid angle of a texel around a direction, if all of the texel were alike. A map has four units of area, and a direction d the
// solid angle |d|₁³ for each of them (the octahedron's faces, seen from its centre).
float OctMapSolidAngle(vec3 Direction)
{
	float Norm = abs(Direction.x) + abs(Direction.y) + abs(Direction.z);
	return Norm * Norm * Norm * (4.0 / float(OctMapTexels));
}

#endif
