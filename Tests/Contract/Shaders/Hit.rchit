// Record value · 65536 + custom index · 256 + section · 16 + 8 if a back face + primitive.
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_scalar_block_layout : require
layout(shaderRecordEXT, scalar) buffer Record { uint Value; };
layout(location = 0) rayPayloadInEXT uint Payload;
void main()
{
	const uint Back = gl_HitKindEXT == gl_HitKindBackFacingTriangleEXT ? 8u : 0u;
	Payload = (Value << 16) | (gl_InstanceCustomIndexEXT << 8) | (gl_GeometryIndexEXT << 4) | Back | gl_PrimitiveID;
}
