// Goes from the map that is shown towards the one that was baked, so that no frame shows a step.
#version 460
#include "../Library/Bindings.glsl"
#include "../Shared/SkyTypes.h"

layout(local_size_x = SKY_GROUP_SIZE, local_size_y = SKY_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSkyFadeConstants Push; };

void main()
{
	ivec2 Texel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(Texel, ivec2(Push.Size)))) { return; }
	vec4 Mixed = Push.OfBaked * texelFetch(Textures[Push.Baked], Texel, 0);
	if (Push.OfShown > 0.0) { Mixed += Push.OfShown * texelFetch(Textures[Push.Shown], Texel, 0); }
	imageStore(Images[Push.Output], Texel, min(Mixed, vec4(65504.0)));
}
