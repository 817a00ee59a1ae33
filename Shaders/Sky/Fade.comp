// Goes from the map that is shown towards the one that was baked, so that no frame shows a step.
#version 460
#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"
#include "../Shared/SkyTypes.h"

layout(local_size_x = SKY_GROUP_SIZE, local_size_y = SKY_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSkyFadeConstants Push; };

void main()
{
	ivec2 Texel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(Texel, ivec2(Push.Size)))) { return; }
	vec3 Roots = texelFetch(Textures[Push.Baked], Texel, 0).rgb;
	if (Push.Share < 1.0)
	{
		vec3 Shown = imageLoad(Images[Push.Shown], Texel).rgb;
		Roots = sqrt(mix(Shown * Shown, Roots * Roots, Push.Share));
	}
	imageStore(Images[Push.Shown], Texel, RoundToHalf(vec4(Roots, 1.0)));
}
