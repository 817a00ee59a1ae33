// The sample engine's: puts surfaces that light shines through in front of the picture.
#version 460
#include "../Shared/TileTypes.h"
#include "../Shared/TransmissionTypes.h"
#include "../Library/View.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FTransmissionCompositeConstants Push; };

void main()
{
	if (IsOutsideView(FViewRef(Push.Pass.View).Data, gl_GlobalInvocationID.xy)) { return; }
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	vec3 Behind = texelFetch(Textures[Push.Lighting], Pixel, 0).rgb, Through = texelFetch(Textures[Push.Transmittance], Pixel, 0).rgb;
	imageStore(Images[Push.Output], Pixel, vec4(Behind * Through + texelFetch(Textures[Push.Light], Pixel, 0).rgb, 1.0));
}
