// Linear blend skinning into buffers of the object's own (glTF 2.0, 3.7.3.3). What they held goes to PreviousPositions.
#version 460
#include "../Shared/GBufferTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"

layout(local_size_x = SKIN_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSkinConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FSkinItemRef { FSkinItem Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FSkinVertexRef { FSkinVertex Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FJointRef { mat4 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FPositionInOut { vec3 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FAttributeOut { FVertexAttributes Data[]; };

void main()
{
	FSkinItem Item = FSkinItemRef(Push.Items).Data[gl_WorkGroupID.z];
	uint Vertex = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * SKIN_GROUP_SIZE + gl_LocalInvocationID.x;
	if (Vertex >= Item.VertexCount) { return; }
	FSkinVertex Skin = FSkinVertexRef(Item.Weights).Data[Vertex];
	FJointRef Joints = FJointRef(Item.Joints);
	mat4 M = Joints.Data[Skin.Joints01 & 0xffffu] * Skin.Weights.x + Joints.Data[Skin.Joints01 >> 16] * Skin.Weights.y +
	         Joints.Data[Skin.Joints23 & 0xffffu] * Skin.Weights.z + Joints.Data[Skin.Joints23 >> 16] * Skin.Weights.w;
	FPositionInOut Positions = FPositionInOut(Item.Positions);
	if (Item.PreviousPositions != 0ul) { FPositionInOut(Item.PreviousPositions).Data[Vertex] = Positions.Data[Vertex]; }
	Positions.Data[Vertex] = (M * vec4(FPositionRef(Item.SourcePositions).Data[Vertex], 1.0)).xyz;

	FVertexAttributes A = FAttributeRef(Item.SourceAttributes).Data[Vertex];
	mat3 L = mat3(M);
	mat3 Cofactors = mat3(cross(L[1], L[2]), cross(L[2], L[0]), cross(L[0], L[1]));
	// A joint scaled to nothing hides its part: the directions there no longer matter, but must stay numbers.
	vec3 Normal = UnpackOct(A.Normal), Tangent = UnpackOct(A.Tangent);
	A.Normal = PackOct(NormalizeOr(Cofactors * Normal, Normal));
	uint Sign = A.Tangent & 0x10000u;
	A.Tangent = (PackOct(NormalizeOr(L * Tangent, Tangent)) & ~0x10000u) | Sign;
	FAttributeOut(Item.Attributes).Data[Vertex] = A;
}
