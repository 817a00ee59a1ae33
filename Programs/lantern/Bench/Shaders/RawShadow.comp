#version 460
#extension GL_EXT_ray_query : require
#include "RawShadow.glsl"
#ifdef HAS_MASKED
#include "RawSections.glsl"
layout(set = 0, binding = 5, scalar) readonly buffer FSections { FRawSection Sections[]; };
#endif

layout(local_size_x = RAW_GROUP_X, local_size_y = RAW_GROUP_Y) in;

bool TraceSun(vec3 Origin, vec3 Direction)
{
	rayQueryEXT Query;
	rayQueryInitializeEXT(Query, Scene, gl_RayFlagsTerminateOnFirstHitEXT, Push.InstanceMask, Origin, 0.0, Direction, Push.MaxDistance);
#ifdef HAS_MASKED
	while (rayQueryProceedEXT(Query))
	{
		uint Section = rayQueryGetIntersectionInstanceShaderBindingTableRecordOffsetEXT(Query, false) +
		               rayQueryGetIntersectionGeometryIndexEXT(Query, false);
		if (!IsHole(Sections[Section], rayQueryGetIntersectionPrimitiveIndexEXT(Query, false),
		            rayQueryGetIntersectionBarycentricsEXT(Query, false)))
		{
			rayQueryConfirmIntersectionEXT(Query);
		}
	}
#else
	rayQueryProceedEXT(Query);
#endif
	return rayQueryGetIntersectionTypeEXT(Query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
}

void main()
{
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (Pixel.x >= (Push.Size & 0xffffu) || Pixel.y >= (Push.Size >> 16)) { return; }
	imageStore(Visibility, ivec2(Pixel), vec4(PixelVisibility(Pixel)));
}
