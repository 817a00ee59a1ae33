// Packs distance, geometric normal and object of each pixel: a guide for this frame's filters, and for the next frame's reprojection. Also
// finds where the surface was in the frame before, once for all passes that reproject.
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
	FSurface Surface = FSurface(0.0, vec3(0.0, 0.0, 1.0), 0.0);
	vec4 Motion = vec4(0.0);
	if (Depth > 0.0 && IsFinite(Depth))
	{
		if (Push.Motion != NO_TEXTURE) { Motion = texelFetch(Textures[Push.Motion], Pixel, 0); }
		vec3 Normal = OctDecode(texelFetch(Textures[Push.Normals], Pixel, 0).zw);
		Surface = FSurface(DistanceFromDepth(View, Depth), Normal, MakeIdentity(Motion.w));
	}
	vec2 Packed = Surface.Distance > 0.0 ? PackSurface(Surface) : vec2(0.0);
	imageStore(Images[Push.Output], Pixel, vec4(Packed, 0.0, 0.0));
	if (Push.PreviousSurface == NO_TEXTURE)
	{
		imageStore(UintImages[Push.OutAnchors], Pixel, uvec4(0u));
		return;
	}
	// What is compared is what the texel before had, which has fewer bits.
	uvec2 Reprojection = FindReprojection(View, Push.PreviousSurface, uvec2(Pixel), UnpackSurface(Packed), Motion, 1.0);
	imageStore(UintImages[Push.OutReprojection], Pixel, uvec4(Reprojection, 0u, 0u));
	imageStore(UintImages[Push.OutAnchors], Pixel, uvec4(FindAnchor(View, Push.PreviousAnchors, Reprojection), 0u, 0u));
}
