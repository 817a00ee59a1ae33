// Linear blend skinning into the object's own vertex buffers (glTF 2.0, 3.7.3.3). Copies the old positions to
// PreviousPositions first.
#version 460
#include "../Shared/SkinningTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"

layout(local_size_x = SKIN_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSkinConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FSkinItemRef { FSkinItem Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FSkinVertexRef { FSkinVertex Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FJointRef { mat4 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FWritablePositionRef { vec3 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FWritableAttributeRef { FVertexAttributes Data[]; };

void main()
{
	FSkinItem Item = FSkinItemRef(Push.Items).Data[gl_WorkGroupID.z];
	uint Vertex = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * SKIN_GROUP_SIZE + gl_LocalInvocationID.x;
	if (Vertex >= Item.VertexCount) { return; }
	FSkinVertex Skin = FSkinVertexRef(Item.Weights).Data[Vertex];
	FJointRef Joints = FJointRef(Item.Joints);
	mat4 SkinMatrix = Joints.Data[Skin.Joints01 & 0xffffu] * Skin.Weights.x + Joints.Data[Skin.Joints01 >> 16] * Skin.Weights.y +
	         Joints.Data[Skin.Joints23 & 0xffffu] * Skin.Weights.z + Joints.Data[Skin.Joints23 >> 16] * Skin.Weights.w;
	FWritablePositionRef Positions = FWritablePositionRef(Item.Positions);
	if (Item.PreviousPositions != 0ul) { FWritablePositionRef(Item.PreviousPositions).Data[Vertex] = Positions.Data[Vertex]; }
	Positions.Data[Vertex] = (SkinMatrix * vec4(FPositionRef(Item.SourcePositions).Data[Vertex], 1.0)).xyz;

	FVertexAttributes Attributes = FAttributeRef(Item.SourceAttributes).Data[Vertex];
	mat3 Linear = mat3(SkinMatrix);
	mat3 Cofactors = mat3(cross(Linear[1], Linear[2]), cross(Linear[2], Linear[0]), cross(Linear[0], Linear[1]));
	// Cofactors transform normals. A joint that is scaled to zero hides its vertices; their directions must still not be NaN.
	vec3 Normal = UnpackOct(Attributes.Normal), Tangent = UnpackOct(Attributes.Tangent);
	Attributes.Normal = PackOct(NormalizeOr(Cofactors * Normal, Normal));
	uint BitangentSign = Attributes.Tangent & 0x10000u;
	Attributes.Tangent = (PackOct(NormalizeOr(Linear * Tangent, Tangent)) & ~0x10000u) | BitangentSign;
	FWritableAttributeRef(Item.Attributes).Data[Vertex] = Attributes;
}
