#version 460
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform texture2D Textures[];
layout(set = 0, binding = 2) uniform sampler Samplers[];
layout(buffer_reference, scalar) buffer Colors { vec4 Item[]; };
layout(push_constant, scalar) uniform Push { Colors Output; uint Texture; uint Sampler; };
void main()
{
	uint Lod = gl_GlobalInvocationID.x;
	Output.Item[Lod] = textureLod(sampler2D(Textures[Texture], Samplers[Sampler]), vec2(0.5), Lod);
}
