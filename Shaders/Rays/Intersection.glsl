// For intersection shaders of material programs (FMaterialProgramDesc::IntersectionPath): the box that a ray met, and how
// to report a surface in it.
#ifndef LANTERN_INTERSECTION_GLSL
#define LANTERN_INTERSECTION_GLSL

#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"

layout(shaderRecordEXT, scalar) readonly buffer FRecord { FSectionData Section; };
layout(push_constant, scalar) uniform FPush { FPassConstants Pass; };
hitAttributeEXT vec2 NormalAttribute; // octahedral, object space, towards the outside

// Object space.
void GetBox(out vec3 Min, out vec3 Max)
{
	FPositionRef Corners = FPositionRef(Section.Positions);
	Min = Corners.Data[2 * gl_PrimitiveID];
	Max = Corners.Data[2 * gl_PrimitiveID + 1];
}

// T along the object-space ray (gl_ObjectRayOriginEXT, gl_ObjectRayDirectionEXT). False: not within the ray's range.
bool ReportSurface(float T, vec3 ObjectNormal)
{
	NormalAttribute = OctEncode(normalize(ObjectNormal));
	return reportIntersectionEXT(T, 0u);
}

#endif
