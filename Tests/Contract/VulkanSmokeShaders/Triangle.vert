#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
layout(buffer_reference, scalar) readonly buffer Positions { vec3 Item[]; };
layout(push_constant, scalar) uniform Push { Positions Input; vec4 Color; };
void main() { gl_Position = vec4(Input.Item[gl_VertexIndex], 1); }
