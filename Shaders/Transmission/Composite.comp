// The sample engine's: puts surfaces that light shines through in front of the picture.
#version 460
#include "../Shared/TileTypes.h"
#include "../Shared/TransmissionTypes.h"
#include "../Library/Random.glsl"
#include "../Library/UintTextures.glsl"
#include "../Library/View.glsl"
#include "Looks.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FTransmissionCompositeConstants Push; };

// Place: 0 to 1. Bilinear.
vec3 SamplePicture(vec2 Place, vec2 Size)
{
	vec2 At = clamp(Place, vec2(0.0), vec2(1.0)) * Size - 0.5, Part = fract(At);
	ivec2 First = ivec2(floor(At)), Last = ivec2(Size) - 1;
	vec3 L[4];
	for (int I = 0; I < 4; ++I) { L[I] = texelFetch(Textures[Push.Lighting], clamp(First + ivec2(I & 1, I >> 1), ivec2(0), Last), 0).rgb; }
	return mix(mix(L[0], L[1], Part.x), mix(L[2], L[3], Part.x), Part.y);
}

vec3 SampleLook(uvec2 Packed, float PackedSpread, vec2 Size, float Turn)
{
	const uint Taps = 24u;
	FLook Look = UnpackLook(Packed);
	float Spread = UnpackSpread(PackedSpread);
	if (Look.Weight == vec3(0.0)) { return vec3(0.0); }
	if (Spread * Size.y < 0.5) { return Look.Weight * SamplePicture(Look.Place, Size); }
	vec3 Sum = vec3(0.0);
	for (uint Tap = 0u; Tap < Taps; ++Tap)
	{
		Sum += SamplePicture(Look.Place + SpreadTap(Spread, Tap, Taps, Turn) * vec2(Size.y / Size.x, 1.0), Size);
	}
	return Look.Weight * Sum / float(Taps);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (IsOutsideView(View, gl_GlobalInvocationID.xy)) { return; }
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	vec2 Size = vec2(View.Width, View.Height);
	vec4 Light = texelFetch(Textures[Push.Light], Pixel, 0), Through = texelFetch(Textures[Push.Transmittance], Pixel, 0);
	uvec4 Looks = texelFetch(UintTextures[Push.Looks], Pixel, 0);
	float Turn = float(HashPcg(uint(Pixel.x) + HashPcg(uint(Pixel.y) + HashPcg(View.FrameIndex)))) / 4294967296.0;
	vec3 Front = Light.rgb + SampleLook(Looks.xy, Light.a, Size, Turn) + SampleLook(Looks.zw, Through.a, Size, Turn);
	vec3 Behind = texelFetch(Textures[Push.Lighting], Pixel, 0).rgb * Through.rgb;
	imageStore(Images[Push.Output], Pixel, vec4(Behind + Front, 1.0));
}
