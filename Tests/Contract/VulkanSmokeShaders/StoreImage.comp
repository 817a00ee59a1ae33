#version 460
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_shader_image_load_formatted : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1) uniform image2D Images[];
layout(push_constant) uniform Push { uint Image; uint Width; uint Height; };
void main()
{
	uvec2 At = gl_GlobalInvocationID.xy;
	if (At.x < Width && At.y < Height)
	{
		imageStore(Images[Image], ivec2(At), vec4(At, At.x * At.y, 1));
	}
}
