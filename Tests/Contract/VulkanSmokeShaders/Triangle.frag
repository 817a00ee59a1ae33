#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
layout(buffer_reference, scalar) readonly buffer Positions { vec3 Item[]; };
layout(push_constant, scalar) uniform Push { Positions Input; vec4 Color; };
layout(location = 0) out vec4 Result;
void main() { Result = Color; }
