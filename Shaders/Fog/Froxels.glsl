// Froxels: where they lie in the view, in the atlas, and in the frame before.
#ifndef LANTERN_FROXELS_GLSL
#define LANTERN_FROXELS_GLSL

#include "../Shared/FogTypes.h"
#include "../Library/View.glsl"

// Distance along the view axis at which a slice begins, metres. Slice need not be whole.
float FroxelDistance(FFogGrid Grid, float Slice)
{
	return (exp2(Slice / float(Grid.Slices) * FOG_LOG2_STEEPNESS) - 1.0) * (Grid.Distance / FOG_STEEPNESS);
}

float FroxelSlice(FFogGrid Grid, float Distance)
{
	return float(Grid.Slices) * log2(1.0 + FOG_STEEPNESS * max(Distance, 0.0) / Grid.Distance) / FOG_LOG2_STEEPNESS;
}

ivec2 FroxelTexel(FFogGrid Grid, ivec3 Froxel)
{
	return Froxel.xy + ivec2(Grid.Columns, Grid.Rows) * ivec2(Froxel.z % int(Grid.PerRow), Froxel.z / int(Grid.PerRow));
}

// Offset of the picture that temporal antialiasing adds, in pixels. Froxels stay where they are.
vec2 PixelJitter(FViewConstants View) { return View.ClipJitter * 0.5 * vec2(View.Width, View.Height); }

// Relative to the camera. Place: in columns, rows and slices; the first froxel's centre is at 0.5.
vec3 FroxelPosition(FFogGrid Grid, FViewConstants View, vec3 Place)
{
	return RelativePosition(View, Place.xy * float(Grid.PixelSize) + PixelJitter(View), FroxelDistance(Grid, Place.z));
}

// Where a point lay in the frame before, in pixels, and its distance then. Returns false where that frame did not look.
bool FindPreviousPlace(FViewConstants View, vec3 Relative, out vec2 Pixel, out float Distance)
{
	vec3 Previous = Relative + View.CameraMotion;
	vec4 Clip = View.PreviousRelativeToClip * vec4(Previous, 1.0);
	Distance = dot(View.PreviousForward, Previous);
	if (!(Clip.w > 0.0) || !(Distance > 0.0)) { return false; }
	Pixel = (Clip.xy / Clip.w * 0.5 + 0.5) * vec2(View.PreviousWidth, View.PreviousHeight);
	return all(greaterThanEqual(Pixel, vec2(0.0))) && all(lessThanEqual(Pixel, vec2(View.PreviousWidth, View.PreviousHeight)));
}

#endif
