#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) buffer Words { uint Item[]; };
layout(push_constant, scalar) uniform Push { Words Output; uint Count; uint Factor; };
void main()
{
	uint Index = gl_GlobalInvocationID.x;
	if (Index < Count) { Output.Item[Index] = Index * Factor; }
}
