#version 460
#extension GL_EXT_ray_query : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_GOOGLE_include_directive : require
#include "Trace.glsl"
layout(local_size_x = 1) in;
layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];
void main()
{
	uint Index = gl_GlobalInvocationID.x;
	rayQueryEXT Query;
	vec3 Origin = vec3(0.25 + Step * Index, 0.25, 5);
	rayQueryInitializeEXT(Query, Scenes[Scene], gl_RayFlagsOpaqueEXT, Mask, Origin, 0.0, vec3(0, 0, -1), 100.0);
	while (rayQueryProceedEXT(Query)) {}
	FHit Hit = FHit(MissValue, 0, 0, -1);
	if (rayQueryGetIntersectionTypeEXT(Query, true) == gl_RayQueryCommittedIntersectionTriangleEXT)
	{
		Hit.Value = rayQueryGetIntersectionGeometryIndexEXT(Query, true) + Add;
		Hit.Kind = rayQueryGetIntersectionFrontFaceEXT(Query, true) ? 0xFE : 0xFF;
		Hit.Custom = rayQueryGetIntersectionInstanceCustomIndexEXT(Query, true);
		Hit.Distance = rayQueryGetIntersectionTEXT(Query, true);
	}
	Output.Item[Index] = Hit;
}
