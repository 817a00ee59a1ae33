// The distances of what a work group's pixels show, and the sphere around it. One thread starts them before a barrier, all note theirs, and
// read them behind another barrier.
#ifndef LANTERN_GROUP_BOUNDS_GLSL
#define LANTERN_GROUP_BOUNDS_GLSL

#include "MovedCasters.glsl"

shared uint NearestBits, FarthestBits; // distances as bits: of positive floats they have the order

void StartBounds()
{
	NearestBits = 0x7f7fffffu;
	FarthestBits = 0u;
}

// Distance: along the view, metres, > 0.
void NoteDistance(float Distance)
{
	atomicMin(NearestBits, floatBitsToUint(Distance));
	atomicMax(FarthestBits, floatBitsToUint(Distance));
}

// Whether any thread has noted a distance.
bool HasBounds() { return NearestBits <= FarthestBits; }

// Returns the sphere of BoundTile around the group's square of the screen.
vec4 BoundGroup(FViewConstants View, uvec2 FirstPixel, uint Size)
{
	return BoundTile(View, FirstPixel, Size, uintBitsToFloat(NearestBits), uintBitsToFloat(FarthestBits));
}

#endif
