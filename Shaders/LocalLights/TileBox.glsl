// The box of all surfaces that a work group's tile shows.
#ifndef LANTERN_TILE_BOX_GLSL
#define LANTERN_TILE_BOX_GLSL

#include "LightBox.glsl"

shared uint LowBits[3], HighBits[3]; // corners, in an order that integers keep

// A barrier must follow.
void StartBox(uint Place)
{
	if (Place >= 3u) { return; }
	LowBits[Place] = 0xffffffffu;
	HighBits[Place] = 0u;
}

// A barrier must follow the last one.
void GrowBox(vec3 P)
{
	for (uint Axis = 0u; Axis < 3u; ++Axis)
	{
		atomicMin(LowBits[Axis], ToOrdered(P[Axis]));
		atomicMax(HighBits[Axis], ToOrdered(P[Axis]));
	}
}

// Whether the tile shows nothing but sky.
bool IsBoxEmpty() { return HighBits[0] < LowBits[0]; }

#endif
