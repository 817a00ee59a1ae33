// Exposure, tone mapping and sRGB encoding.
#version 460
#include "../Shared/ToneMapTypes.h"
#include "../Library/ToneMap.glsl"
#include "../Library/View.glsl"

layout(local_size_x = TONE_MAP_GROUP_SIZE, local_size_y = TONE_MAP_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FToneMapConstants Push; };

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (IsOutsideView(View, Pixel)) { return; }
	vec3 Color = texelFetch(Textures[Push.Input], ivec2(Pixel), 0).rgb * View.Exposure;
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(LinearToSrgb(ToneMapFilmic(Color)), 1.0));
}
