// Takes one pixel of each 2×2 of the G-buffer.
#version 460
#include "../Shared/HalfFrameTypes.h"
#include "../Library/HostNumbers.glsl"
#include "HalfPixel.glsl"

layout(local_size_x = HALF_FRAME_GROUP_SIZE, local_size_y = HALF_FRAME_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FHalfReduceConstants Push; };

void Copy(uint From, uint To, ivec2 Source, ivec2 HalfPixel)
{
	if (To != NO_TEXTURE) { imageStore(Images[To], HalfPixel, texelFetch(Textures[From], Source, 0)); }
}

// Returns motion in pixels of the half frame. Readers scale a position by the sizes of the two frames, and odd sizes of half frames are not
// in proportion to those of whole ones. Place: in the whole frame.
vec2 HalveMotion(FViewConstants View, vec2 Place, vec2 Motion)
{
	uvec2 Size = uvec2(View.Width, View.Height), Before = uvec2(View.PreviousWidth, View.PreviousHeight);
	if (Size == Before) { return 0.5 * Motion; }
	vec2 Then = (Place + Motion) * vec2(Before) / vec2(Size) + 0.5;
	return 0.5 * (Then * vec2(HalfSizeOf(Size)) / vec2(HalfSizeOf(Before)) - (Place + 0.5));
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 HalfPixel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(uvec2(HalfPixel), HalfSizeOf(View)))) { return; }
	float Depth;
	ivec2 Source = FindHalfSource(View, Push.From.Depth, HalfPixel, Depth);
	if (Push.To.Depth != NO_TEXTURE) { imageStore(Images[Push.To.Depth], HalfPixel, vec4(Depth)); }
	Copy(Push.From.Normals, Push.To.Normals, Source, HalfPixel);
	Copy(Push.From.BaseColor, Push.To.BaseColor, Source, HalfPixel);
	Copy(Push.From.Material, Push.To.Material, Source, HalfPixel);
	Copy(Push.From.BackAlbedo, Push.To.BackAlbedo, Source, HalfPixel);
	if (Push.To.Motion != NO_TEXTURE)
	{
		vec4 Motion = texelFetch(Textures[Push.From.Motion], Source, 0);
		imageStore(Images[Push.To.Motion], HalfPixel, vec4(HalveMotion(View, vec2(Source) + 0.5, Motion.xy), Motion.zw));
	}
	for (int I = 0; I < HALF_FRAME_NUMBERS; ++I)
	{
		if (Push.To.Numbers[I] == NO_TEXTURE) { continue; }
		uint Number = LoadHostNumber(Push.From.Numbers[I], Push.NumbersOffset, Source);
		imageStore(Images[Push.To.Numbers[I]], HalfPixel, vec4(float(Number) / 255.0));
	}
}
