// As Trace.rgen with Hit.rchit, without records: non-opaque triangles are confirmed where D is not 0.
#version 460
#extension GL_EXT_ray_query : require
#extension GL_GOOGLE_include_directive : require
#include "Rays.glsl"
layout(local_size_x = 8) in;
void main()
{
	const uint i = gl_GlobalInvocationID.x;
	if (i >= E) { return; }
	rayQueryEXT Query;
	rayQueryInitializeEXT(Query, Scenes[A], B, C, GetOrigin(uvec2(i, 0)), 0.0, Down, Far);
	while (rayQueryProceedEXT(Query))
	{
		if (D != 0) { rayQueryConfirmIntersectionEXT(Query); }
	}
	uint Result = 0xf0000001u;
	if (rayQueryGetIntersectionTypeEXT(Query, true) == gl_RayQueryCommittedIntersectionTriangleEXT)
	{
		Result = (rayQueryGetIntersectionInstanceCustomIndexEXT(Query, true) << 8) |
		         (rayQueryGetIntersectionGeometryIndexEXT(Query, true) << 4) |
		         (rayQueryGetIntersectionFrontFaceEXT(Query, true) ? 0u : 8u) |
		         rayQueryGetIntersectionPrimitiveIndexEXT(Query, true);
	}
	Output.Item[i] = Result;
}
