// Where points of objects were in the previous frame. A deforming object counts as if it had moved as a whole.
#ifndef LANTERN_MOVE_BACK_GLSL
#define LANTERN_MOVE_BACK_GLSL

#include "ObjectPosition.glsl"

const uint NoObject = 0xffffffffu;

mat3 LinearPart(vec4 Rows[3]) { return transpose(mat3(Rows[0].xyz, Rows[1].xyz, Rows[2].xyz)); }

// Returns whether the object has moved since the previous frame.
bool HasMoved(FSceneConstants Scene, FViewConstants View, uint Object)
{
	if (View.bHistory == 0u || Object == NoObject || Scene.ObjectMotions == FAddress(0)) { return false; }
	return FObjectRef(Scene.Objects).Data[Object].Motion != NO_MOTION;
}

// Relative: position relative to the camera. Returns the one relative to the previous camera. Object: into FObjectData[], or NoObject: the
// point stands still.
vec3 MoveBack(FSceneConstants Scene, FViewConstants View, uint Object, vec3 Relative)
{
	if (!HasMoved(Scene, View, Object)) { return Relative + View.CameraMotion; }
	FObjectData Now = FObjectRef(Scene.Objects).Data[Object];
	FObjectMotion Before = FObjectMotionRef(Scene.ObjectMotions).Data[Now.Motion];
	vec3 Pivot = CameraRelativePosition(Now.ObjectToWorld, CellOffset(Scene, Now.Cell), Now.Flags, vec3(0.0), View.CameraPosition);
	vec3 P = inverse(LinearPart(Now.ObjectToWorld)) * (Relative - Pivot);
	return CameraRelativePosition(Before.PreviousObjectToWorld, CellOffset(Scene, Before.PreviousCell), Before.PreviousFlags, P,
	                              View.CameraPosition) + View.CameraMotion;
}

// Returns the normal that a point of the object had. Normal: of unit length.
vec3 TurnBack(FSceneConstants Scene, FViewConstants View, uint Object, vec3 Normal)
{
	if (!HasMoved(Scene, View, Object)) { return Normal; }
	FObjectData Now = FObjectRef(Scene.Objects).Data[Object];
	FObjectMotion Before = FObjectMotionRef(Scene.ObjectMotions).Data[Now.Motion];
	mat3 Turn = LinearPart(Before.PreviousObjectToWorld) * inverse(LinearPart(Now.ObjectToWorld));
	return normalize(transpose(inverse(Turn)) * Normal);
}

#endif
