// Areas of the boxes around runs of consecutive triangles, and of the triangles: see RefitQuality.h.
#version 460
#include "../Shared/RefitQualityTypes.h"
#include "../Library/Bindings.glsl"

layout(local_size_x = REFIT_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FRefitQualityConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FSumOut { FRefitQualitySum Data[]; };

shared vec2 Sums[REFIT_GROUP_SIZE];

uint FetchIndex(uint At)
{
	if ((Push.Flags & REFIT_INDEX_16) == 0u) { return FIndexRef(Push.Indices).Data[At]; }
	uint Word = FIndexRef(Push.Indices).Data[At >> 1];
	return (At & 1u) != 0u ? Word >> 16 : Word & 0xffffu;
}

vec2 MeasureBox(uint First, uint Count)
{
	vec3 Low = vec3(3e38), High = vec3(-3e38);
	float Triangles = 0.0;
	for (uint Triangle = First; Triangle < First + Count; ++Triangle)
	{
		uint At = Push.FirstIndex + 3u * Triangle;
		vec3 A = FPositionRef(Push.Positions).Data[FetchIndex(At)];
		vec3 B = FPositionRef(Push.Positions).Data[FetchIndex(At + 1u)];
		vec3 C = FPositionRef(Push.Positions).Data[FetchIndex(At + 2u)];
		Low = min(Low, min(A, min(B, C)));
		High = max(High, max(A, max(B, C)));
		Triangles += length(cross(B - A, C - A));
	}
	vec3 Size = High - Low;
	return vec2(Size.x * Size.y + Size.y * Size.z + Size.z * Size.x, Triangles);
}

void main()
{
	uint Group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
	uint First = (Group * REFIT_GROUP_SIZE + gl_LocalInvocationID.x) * REFIT_GROUP_TRIANGLES;
	uint Lane = gl_LocalInvocationID.x;
	Sums[Lane] = First < Push.TriangleCount ? MeasureBox(First, min(REFIT_GROUP_TRIANGLES, Push.TriangleCount - First)) : vec2(0.0);
	barrier();
	for (uint Half = REFIT_GROUP_SIZE / 2; Half > 0u; Half /= 2u)
	{
		if (Lane < Half) { Sums[Lane] += Sums[Lane + Half]; }
		barrier();
	}
	// The last row of groups may be longer than what there is.
	if (Lane == 0u && Group * REFIT_GROUP_SIZE * REFIT_GROUP_TRIANGLES < Push.TriangleCount)
	{
		FSumOut(Push.Sums).Data[Group] = FRefitQualitySum(Sums[0].x, Sums[0].y);
	}
}
