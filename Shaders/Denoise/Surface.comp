// Packs distance, geometric normal and object of each pixel: a guide for this frame's filters, and for the next frame's
// reprojection.
#version 460
#include "../Shared/DenoiseTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/History.glsl"

layout(local_size_x = DENOISE_GROUP_SIZE, local_size_y = DENOISE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSurfaceConstants Push; };

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	float Depth = LoadDepth(Push.Depth, Pixel);
	vec2 Packed = vec2(0.0);
	if (Depth > 0.0 && IsFinite(Depth))
	{
		vec3 Normal = OctDecode(texelFetch(Textures[Push.Normals], Pixel, 0).zw);
		float Identity = Push.Motion == NO_TEXTURE ? 0.0 : MakeIdentity(texelFetch(Textures[Push.Motion], Pixel, 0).w);
		Packed = PackSurface(FSurface(DistanceFromDepth(View, Depth), Normal, Identity));
	}
	imageStore(Images[Push.Output], Pixel, vec4(Packed, 0.0, 0.0));
}
