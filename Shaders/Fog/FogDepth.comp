// The farthest distance that a column of froxels shows. A group of threads for each column.
#version 460
#include "../Library/View.glsl"
#include "../Library/GBuffer.glsl"
#include "../Shared/FogTypes.h"

layout(local_size_x = FOG_GROUP_SIZE, local_size_y = FOG_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FFogDepthConstants Push; };

shared uint LeastDepth; // bits of a float ≥ 0, which have its order

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (gl_LocalInvocationIndex == 0u) { LeastDepth = floatBitsToUint(1.0e30); }
	barrier();
	uvec2 First = gl_WorkGroupID.xy * Push.PixelSize;
	uint Least = floatBitsToUint(1.0e30);
	for (uint Y = gl_LocalInvocationID.y; Y < Push.PixelSize; Y += FOG_GROUP_SIZE)
	{
		for (uint X = gl_LocalInvocationID.x; X < Push.PixelSize; X += FOG_GROUP_SIZE)
		{
			uvec2 Pixel = First + uvec2(X, Y);
			if (IsOutsideView(View, Pixel)) { continue; }
			Least = min(Least, floatBitsToUint(max(LoadDepth(Push.Depth, ivec2(Pixel)), 0.0)));
		}
	}
	atomicMin(LeastDepth, Least);
	barrier();
	if (gl_LocalInvocationIndex != 0u) { return; }
	float Depth = uintBitsToFloat(LeastDepth);
	imageStore(Images[Push.Output], ivec2(gl_WorkGroupID.xy), vec4(Depth > 0.0 ? DistanceFromDepth(View, Depth) : 0.0));
}
