// The farthest distance that a column of froxels shows (x), and up to which it shows air alone (y). A group of threads for each column.
#version 460
#include "../Library/View.glsl"
#include "../Library/GBuffer.glsl"
#include "../Shared/FogTypes.h"

layout(local_size_x = FOG_GROUP_SIZE, local_size_y = FOG_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FFogDepthConstants Push; };

shared uint LeastDepth, MostDepth; // bits of floats ≥ 0, which have their order

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (gl_LocalInvocationIndex == 0u)
	{
		LeastDepth = floatBitsToUint(1.0e30);
		MostDepth = 0u;
	}
	barrier();
	uvec2 First = gl_WorkGroupID.xy * Push.PixelSize;
	uint Least = floatBitsToUint(1.0e30), Most = 0u;
	for (uint Y = gl_LocalInvocationID.y; Y < Push.PixelSize; Y += FOG_GROUP_SIZE)
	{
		for (uint X = gl_LocalInvocationID.x; X < Push.PixelSize; X += FOG_GROUP_SIZE)
		{
			uvec2 Pixel = First + uvec2(X, Y);
			if (IsOutsideView(View, Pixel)) { continue; }
			uint Depth = floatBitsToUint(max(LoadDepth(Push.Depth, ivec2(Pixel)), 0.0));
			Least = min(Least, Depth);
			Most = max(Most, Depth);
		}
	}
	atomicMin(LeastDepth, Least);
	atomicMax(MostDepth, Most);
	barrier();
	if (gl_LocalInvocationIndex != 0u) { return; }
	float LeastOfAll = uintBitsToFloat(LeastDepth), MostOfAll = uintBitsToFloat(MostDepth);
	float Far = LeastOfAll > 0.0 ? DistanceFromDepth(View, LeastOfAll) : 0.0, Near = MostOfAll > 0.0 ? DistanceFromDepth(View, MostOfAll) : 0.0;
	// Behind an edge there is air again.
	imageStore(Images[Push.Output], ivec2(gl_WorkGroupID.xy), vec4(Far, Far <= FOG_EDGE * Near ? Near : Far, 0.0, 0.0));
}
