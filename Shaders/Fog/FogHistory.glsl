// What the frame before knew of a froxel. The includer has Push, with Grid, PreviousColumns, PreviousRows and PreviousCounts as in
// FFogShadowConstants, and
//   FFroxelValue                                                          what is known of one, and NoFroxelValue()
//   bool AddFroxel(ivec2 Texel, float Weight, inout FFroxelValue Sum)     adds one of the frame before; false: it holds no number
//   void ScaleFroxel(float Factor, inout FFroxelValue Value)
// KNOWS_LIT_FROXELS: those are known that were lit, also behind what their column showed.
#ifndef LANTERN_FOG_HISTORY_GLSL
#define LANTERN_FOG_HISTORY_GLSL

#include "Froxels.glsl"
#include "../Library/Math.glsl"

// Reads one froxel of the frame before. Returns its weight: 0 if it was out of view.
float LoadPreviousFroxel(FFogGrid Grid, ivec3 Froxel, float Weight, inout FFroxelValue Sum)
{
	ivec3 Inside = clamp(Froxel, ivec3(0), ivec3(Grid.Columns, Grid.Rows, Grid.Slices) - 1);
	vec2 Counts = texelFetch(Textures[Push.PreviousCounts], Inside.xy, 0).xy;
#ifdef KNOWS_LIT_FROXELS
	float End = floor(0.5 * Counts.x);
#else
	float End = Counts.y;
#endif
	if (!(End > float(Inside.z))) { return 0.0; } // nor is what is no number
	return AddFroxel(FroxelTexel(Grid, Inside), Weight, Sum) ? Weight : 0.0;
}

// Interpolates what the frame before knew at Relative, a position relative to the camera. Returns false if that was nothing.
bool LoadFogHistory(FViewConstants View, vec3 Relative, out FFroxelValue Value)
{
	Value = NoFroxelValue();
	vec2 Pixel;
	float Distance;
	if (Push.PreviousCounts == NO_TEXTURE || View.bHistory == 0u || !FindPreviousPlace(View, Relative, Pixel, Distance)) { return false; }
	FFogGrid Grid = Push.Grid;
	Grid.Columns = Push.PreviousColumns;
	Grid.Rows = Push.PreviousRows;
	if (Distance > Grid.Distance) { return false; }
	vec3 Place = vec3(Pixel / float(Grid.PixelSize), FroxelSlice(Grid, Distance)) - 0.5;
	vec3 Fraction = fract(Place);
	// A froxel that stands still reads itself alone, whatever rounding says.
	Fraction = mix(mix(Fraction, vec3(0.0), lessThan(Fraction, vec3(1.0e-3))), vec3(1.0), greaterThan(Fraction, vec3(0.999)));
	float Weights = 0.0;
	[[dont_unroll]] for (int Tap = 0; Tap < 8; ++Tap)
	{
		ivec3 Corner = ivec3(Tap & 1, (Tap >> 1) & 1, Tap >> 2);
		vec3 W = mix(1.0 - Fraction, Fraction, bvec3(Corner));
		float Weight = W.x * W.y * W.z;
		if (Weight > 0.0) { Weights += LoadPreviousFroxel(Grid, ivec3(floor(Place)) + Corner, Weight, Value); }
	}
	if (Weights < 0.01) { return false; }
	ScaleFroxel(1.0 / Weights, Value);
	return true;
}

#endif
