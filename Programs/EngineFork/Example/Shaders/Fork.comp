#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
layout(local_size_x = 64) in;

struct FSkinVertex
{
	vec3 Position;
	float Weight;
};
struct FVertex
{
	vec3 Position, Normal, Previous;
	vec2 UV;
};
layout(buffer_reference, scalar) readonly buffer FBindPose { FSkinVertex Items[]; };
layout(buffer_reference, scalar) buffer FVertices { FVertex Items[]; };
layout(buffer_reference, scalar) writeonly buffer FPositions { vec3 Items[]; };
layout(push_constant, scalar) uniform FPush
{
	FBindPose BindPose;
	FVertices Vertices;
	FPositions Traced; // 0: none
	float Sine, Cosine;
	uint Count;
} Push;

// Linear blend of two bones: one rests, one turns about y.
void main()
{
	uint Index = gl_GlobalInvocationID.x;
	if (Index >= Push.Count) { return; }
	FSkinVertex Vertex = Push.BindPose.Items[Index];
	vec3 P = Vertex.Position;
	vec3 Turned = vec3(P.x * Push.Cosine - P.z * Push.Sine, P.y, P.x * Push.Sine + P.z * Push.Cosine);
	vec3 Skinned = mix(P, Turned, Vertex.Weight);
	Push.Vertices.Items[Index] = FVertex(Skinned, vec3(0), Push.Vertices.Items[Index].Position, vec2(0));
	if (uint64_t(Push.Traced) != 0) { Push.Traced.Items[Index] = Skinned; }
}
