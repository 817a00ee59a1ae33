// Values of pixels that traced no ray because they are far away (FSettledConstants::RateDistance): from those of their tile that did.
#ifndef LANTERN_FILL_GLSL
#define LANTERN_FILL_GLSL

#include "../Shared/TileTypes.h"
#include "../Library/View.glsl"
#include "Tile.glsl"

shared float OfferedValue[TILE_PIXELS]; // negative: none
shared vec3 OfferedPosition[TILE_PIXELS];

// Called by all threads, with a barrier behind it. Value: of the pixel's own rays; negative: it has none.
void OfferValue(uint Place, float Value, vec3 Position)
{
	OfferedValue[Place] = Value;
	OfferedPosition[Place] = Position;
}

// Mean of the values that were offered on the plane through Position, the nearer pixels counting more. Negative: there is none. Reach: of
// the plane to either side, metres.
float FillFromTile(uint Place, vec3 Position, vec3 Normal, float Reach)
{
	vec2 At = vec2(TilePixel(uvec2(0u), Place));
	float Sum = 0.0, Weights = 0.0;
	[[dont_unroll]] for (uint Other = 0u; Other < TILE_PIXELS; ++Other)
	{
		if (OfferedValue[Other] < 0.0 || abs(dot(Normal, OfferedPosition[Other] - Position)) > Reach) { continue; }
		vec2 Off = vec2(TilePixel(uvec2(0u), Other)) - At;
		float Weight = exp(-0.5 * dot(Off, Off));
		Sum += Weight * OfferedValue[Other];
		Weights += Weight;
	}
	return Weights > 0.0 ? Sum / Weights : -1.0;
}

#endif
