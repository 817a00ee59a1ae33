// The vertex shader of the G-buffer. MOTION: also outputs the previous position.
#version 460
#include "../Shared/GBufferTypes.h"
#include "../Library/ObjectPosition.glsl"
#include "../Library/VertexFetch.glsl"

layout(push_constant, scalar) uniform FPush { FGBufferConstants Push; };

layout(location = 0) out vec3 OutRelative; // position relative to the camera
layout(location = 1) out vec3 OutNormal;
layout(location = 2) out vec4 OutTangent;
layout(location = 3) out vec4 OutUV;
layout(location = 4) out vec4 OutColor;
layout(location = 5) flat out uint OutObject;
layout(location = 6) flat out uint OutSection;
#ifdef MOTION
layout(location = 7) out vec3 OutPreviousRelative; // to the previous camera
#endif

#ifdef MOTION
vec3 PreviousCameraRelativePosition(FSceneConstants Scene, FViewConstants View, FObjectData Object, vec3 Position, vec3 Relative)
{
	if (View.bHistory == 0u) { return Relative; }
	if (Object.Motion == NO_MOTION) { return Relative + View.CameraMotion; }
	FObjectMotion Motion = FObjectMotionRef(Scene.ObjectMotions).Data[Object.Motion];
	if (Motion.PreviousPositions != 0ul) { Position = FPositionRef(Motion.PreviousPositions).Data[gl_VertexIndex]; }
	return CameraRelativePosition(Motion.PreviousObjectToWorld, CellOffset(Scene, Motion.PreviousCell), Motion.PreviousFlags, Position,
	                              View.CameraPosition) + View.CameraMotion;
}
#endif

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	OutObject = FIndexRef(Push.Objects).Data[gl_InstanceIndex];
	FObjectData Object = FObjectRef(Scene.Objects).Data[OutObject];
	OutSection = Object.FirstSection + Push.Section;
	FSectionData Section = FSectionRef(Scene.Sections).Data[OutSection];
	vec3 Position = FPositionRef(Section.Positions).Data[gl_VertexIndex];
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FMaterialInputs Inputs = UnpackVertex(FAttributeRef(Section.Attributes).Data[gl_VertexIndex], Section.Flags);

	mat3 Linear = transpose(mat3(Object.ObjectToWorld[0].xyz, Object.ObjectToWorld[1].xyz, Object.ObjectToWorld[2].xyz));
	OutRelative = CameraRelativePosition(Object.ObjectToWorld, CellOffset(Scene, Object.Cell), Object.Flags, Position, View.CameraPosition);
	// The cofactor matrix is the inverse transpose times the determinant.
	mat3 Cofactors = mat3(cross(Linear[1], Linear[2]), cross(Linear[2], Linear[0]), cross(Linear[0], Linear[1]));
	// Mirroring flips cross products. The normal keeps pointing to the object's outside; the bitangent keeps its direction.
	float Handedness = (Object.Flags & OBJECT_MIRRORED) != 0u ? -1.0 : 1.0;
	OutNormal = Cofactors * Inputs.Normal * Handedness;
	OutTangent = vec4(Linear * Inputs.Tangent.xyz, Inputs.Tangent.w * Handedness);
	OutUV = vec4(Inputs.UV0, Inputs.UV1);
	OutColor = Inputs.Color;
	gl_Position = View.RelativeToClip * vec4(OutRelative, 1.0);
	gl_Position.xy += View.ClipJitter * gl_Position.w;
#ifdef MOTION
	OutPreviousRelative = PreviousCameraRelativePosition(Scene, View, Object, Position, OutRelative);
#endif
}
