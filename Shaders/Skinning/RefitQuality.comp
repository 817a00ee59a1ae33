// Sums the areas of boxes around runs of consecutive triangles, and of the triangles themselves: see RefitQuality.h.
#version 460
#include "../Shared/RefitQualityTypes.h"
#include "../Library/Bindings.glsl"

layout(local_size_x = REFIT_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FRefitQualityConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FRefitQualitySumRef { FRefitQualitySum Data[]; };

shared vec2 Sums[REFIT_GROUP_SIZE];

uint FetchIndex(uint Index)
{
	if ((Push.Flags & REFIT_INDEX_16) == 0u) { return FIndexRef(Push.Indices).Data[Index]; }
	uint Word = FIndexRef(Push.Indices).Data[Index >> 1];
	return (Index & 1u) != 0u ? Word >> 16 : Word & 0xffffu;
}

// x: half the surface area of the box; y: twice the area of its triangles.
vec2 MeasureBox(uint FirstTriangle, uint Count)
{
	vec3 Min = vec3(3e38), Max = vec3(-3e38);
	float TriangleArea = 0.0;
	for (uint Triangle = FirstTriangle; Triangle < FirstTriangle + Count; ++Triangle)
	{
		uint Index = Push.FirstIndex + 3u * Triangle;
		vec3 A = FPositionRef(Push.Positions).Data[FetchIndex(Index)];
		vec3 B = FPositionRef(Push.Positions).Data[FetchIndex(Index + 1u)];
		vec3 C = FPositionRef(Push.Positions).Data[FetchIndex(Index + 2u)];
		Min = min(Min, min(A, min(B, C)));
		Max = max(Max, max(A, max(B, C)));
		TriangleArea += length(cross(B - A, C - A));
	}
	vec3 Size = Max - Min;
	return vec2(Size.x * Size.y + Size.y * Size.z + Size.z * Size.x, TriangleArea);
}

void main()
{
	uint Group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
	uint FirstTriangle = (Group * REFIT_GROUP_SIZE + gl_LocalInvocationID.x) * REFIT_GROUP_TRIANGLES;
	uint Lane = gl_LocalInvocationID.x;
	Sums[Lane] = FirstTriangle < Push.TriangleCount
	                 ? MeasureBox(FirstTriangle, min(REFIT_GROUP_TRIANGLES, Push.TriangleCount - FirstTriangle))
	                 : vec2(0.0);
	barrier();
	for (uint Stride = REFIT_GROUP_SIZE / 2; Stride > 0u; Stride /= 2u)
	{
		if (Lane < Stride) { Sums[Lane] += Sums[Lane + Stride]; }
		barrier();
	}
	// The last row of work groups may extend beyond the triangles.
	if (Lane == 0u && Group * REFIT_GROUP_SIZE * REFIT_GROUP_TRIANGLES < Push.TriangleCount)
	{
		FRefitQualitySumRef(Push.Sums).Data[Group] = FRefitQualitySum(Sums[0].x, Sums[0].y);
	}
}
