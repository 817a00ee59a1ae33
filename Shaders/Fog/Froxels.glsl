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

// Eight froxels around a place, to interpolate between.
struct FFroxelTaps
{
	ivec3 First, Last; // Last: of those that may be read
	vec3 Fraction;
};

// Pixel: without jitter. Distance: along the view axis, metres. Surface: that of what the pixel shows; slices behind it are not read.
FFroxelTaps FindFroxelTaps(FFogGrid Grid, vec2 Pixel, float Distance, float Surface)
{
	vec3 Place = vec3(Pixel / float(Grid.PixelSize), FroxelSlice(Grid, Distance)) - 0.5;
	ivec3 Last = ivec3(Grid.Columns, Grid.Rows, min(uint(FroxelSlice(Grid, min(Surface, Grid.Distance))) + 1u, Grid.Slices)) - 1;
	return FFroxelTaps(ivec3(floor(Place)), Last, fract(Place));
}

// Returns the texel of a tap, 0 to 7.
ivec2 TapTexel(FFogGrid Grid, FFroxelTaps Taps, int Tap, out float Weight)
{
	ivec3 Corner = ivec3(Tap & 1, (Tap >> 1) & 1, Tap >> 2);
	vec3 W = mix(1.0 - Taps.Fraction, Taps.Fraction, bvec3(Corner));
	Weight = W.x * W.y * W.z;
	return FroxelTexel(Grid, clamp(Taps.First + Corner, ivec3(0), Taps.Last));
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
