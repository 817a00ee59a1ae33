// Tools for intersection shaders of material programs (FMaterialProgramDesc::IntersectionPath): the box that the ray met,
// and the report of a surface in it.
#ifndef LANTERN_INTERSECTION_GLSL
#define LANTERN_INTERSECTION_GLSL

#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"

layout(shaderRecordEXT, scalar) readonly buffer FRecord { FSectionData Section; };
layout(push_constant, scalar) uniform FPush { FPassConstants Pass; };
hitAttributeEXT vec2 NormalAttribute; // octahedral, object space, towards the outside

// Returns the corners of the box, in object space.
void GetBox(out vec3 Min, out vec3 Max)
{
	FPositionRef Corners = FPositionRef(Section.Positions);
	Min = Corners.Data[2 * gl_PrimitiveID];
	Max = Corners.Data[2 * gl_PrimitiveID + 1];
}

// Reports a hit at parameter T of the object-space ray (gl_ObjectRayOriginEXT, gl_ObjectRayDirectionEXT). Returns false if T is
// outside of the ray's range. ObjectNormal: towards the outside, any length.
bool ReportSurface(float T, vec3 ObjectNormal)
{
	NormalAttribute = OctEncode(normalize(ObjectNormal));
	return reportIntersectionEXT(T, 0u);
}

#endif
