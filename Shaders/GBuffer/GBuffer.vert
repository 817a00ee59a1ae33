#version 460
#include "../Shared/GBufferTypes.h"
#include "../Library/VertexFetch.glsl"

layout(push_constant, scalar) uniform FPush { FGBufferConstants Push; };

layout(location = 0) out vec3 OutRelative; // position relative to the camera
layout(location = 1) out vec3 OutNormal;
layout(location = 2) out vec4 OutTangent;
layout(location = 3) out vec4 OutUV;
layout(location = 4) out vec4 OutColor;

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FObjectData Object = FObjectRef(Scene.Objects).Data[Push.Object];
	FSectionData Section = FSectionRef(Scene.Sections).Data[Push.Section];
	vec4 Position = vec4(FPositionRef(Section.Positions).Data[gl_VertexIndex], 1.0);
	FMaterialInputs Inputs = InputsFromVertex(FAttributeRef(Section.Attributes).Data[gl_VertexIndex], Section.Flags);

	mat3 Linear = transpose(mat3(Object.ObjectToWorld[0].xyz, Object.ObjectToWorld[1].xyz, Object.ObjectToWorld[2].xyz));
	vec3 World = vec3(dot(Object.ObjectToWorld[0], Position), dot(Object.ObjectToWorld[1], Position), dot(Object.ObjectToWorld[2], Position));
	OutRelative = World - FViewRef(Push.Pass.View).Data.CameraPosition;
	// Cofactors: the inverse transpose up to a positive factor, times the determinant's sign.
	mat3 Cofactors = mat3(cross(Linear[1], Linear[2]), cross(Linear[2], Linear[0]), cross(Linear[0], Linear[1]));
	// A mirror turns cross products around: the normal keeps the object's outside, the bitangent its direction.
	float Handedness = (Object.Flags & OBJECT_MIRRORED) != 0u ? -1.0 : 1.0;
	OutNormal = Cofactors * Inputs.Normal * Handedness;
	OutTangent = vec4(Linear * Inputs.Tangent.xyz, Inputs.Tangent.w * Handedness);
	OutUV = vec4(Inputs.UV0, Inputs.UV1);
	OutColor = Inputs.Color;
	gl_Position = FViewRef(Push.Pass.View).Data.RelativeToClip * vec4(OutRelative, 1.0);
}
