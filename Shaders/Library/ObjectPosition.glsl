// Where rasters see an object's vertices: relative to the camera, so that precision does not degrade far from the origin.
#ifndef LANTERN_OBJECT_POSITION_GLSL
#define LANTERN_OBJECT_POSITION_GLSL

#include "Bindings.glsl"

// Unpacks what rounding to fp32 took from an object's translation; FObjectData::Flags holds it in units of 2^-25 m. Without
// it, an object 512 m from its cell's centre is off by up to 0.015 mm, which shows in motion vectors of edge-on surfaces.
vec3 UnpackTranslationRemainder(uint Flags)
{
	int Packed = int(Flags);
	return vec3(bitfieldExtract(Packed, 2, 10), bitfieldExtract(Packed, 12, 10), bitfieldExtract(Packed, 22, 10)) * (1.0 / 33554432.0);
}

// Large terms are added first, as in the instances of the acceleration structure: near the origin they nearly cancel out.
// CellOffset: of the object's cell, from the scene's origin.
vec3 CameraRelativePosition(vec4 ObjectToWorld[3], vec3 CellOffset, uint Flags, vec3 Position, vec3 Camera)
{
	vec3 Translation = vec3(ObjectToWorld[0].w, ObjectToWorld[1].w, ObjectToWorld[2].w);
	vec3 ObjectOrigin = (CellOffset + Translation) - Camera + UnpackTranslationRemainder(Flags);
	return ObjectOrigin + vec3(dot(ObjectToWorld[0].xyz, Position), dot(ObjectToWorld[1].xyz, Position), dot(ObjectToWorld[2].xyz, Position));
}

#endif
