// What callable 0 makes of the record's value.
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_scalar_block_layout : require
layout(shaderRecordEXT, scalar) buffer Record { uint Value; };
layout(location = 0) rayPayloadInEXT uint Payload;
layout(location = 0) callableDataEXT uint Data;
void main()
{
	Data = Value;
	executeCallableEXT(0, 0);
	Payload = Data;
}
