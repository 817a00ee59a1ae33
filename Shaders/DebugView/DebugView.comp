// Shows one signal: a visibility as grey, a radiance as the picture would show it. Enlarges pictures of the half frame.
#version 460
#include "../Shared/DebugViewTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/ToneMap.glsl"

layout(local_size_x = DEBUG_VIEW_GROUP_SIZE, local_size_y = DEBUG_VIEW_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FDebugViewConstants Push; };

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { return; }
	vec3 Value = texelFetch(Textures[Push.Input], ivec2(Pixel / Push.Scale), 0).rgb;
	if (Push.Show == DEBUG_SHOW_RADIANCE) { Value = LinearToSrgb(ToneMapFilmic(Value * View.Exposure)); }
	else if (Push.Show == DEBUG_SHOW_GREY) { Value = LinearToSrgb(clamp(Value.rrr, 0.0, 1.0)); }
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Value, 1.0));
}
