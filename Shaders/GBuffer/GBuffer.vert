#version 460
#include "../Shared/GBufferTypes.h"
#include "../Library/VertexFetch.glsl"

layout(push_constant, scalar) uniform FPush { FGBufferConstants Push; };

layout(location = 0) out vec3 OutRelative; // position relative to the camera
layout(location = 1) out vec3 OutNormal;
layout(location = 2) out vec4 OutTangent;
layout(location = 3) out vec4 OutUV;
layout(location = 4) out vec4 OutColor;
layout(location = 5) flat out uint OutObject;
layout(location = 6) flat out uint OutSection;

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	OutObject = FIndexRef(Push.Objects).Data[gl_InstanceIndex];
	FObjectData Object = FObjectRef(Scene.Objects).Data[OutObject];
	OutSection = Object.FirstSection + Push.Section;
	FSectionData Section = FSectionRef(Scene.Sections).Data[OutSection];
	vec4 Position = vec4(FPositionRef(Section.Positions).Data[gl_VertexIndex], 1.0);
	FMaterialInputs Inputs = InputsFromVertex(FAttributeRef(Section.Attributes).Data[gl_VertexIndex], Section.Flags);

	mat3 Linear = transpose(mat3(Object.ObjectToWorld[0].xyz, Object.ObjectToWorld[1].xyz, Object.ObjectToWorld[2].xyz));
	vec3 InCell = vec3(dot(Object.ObjectToWorld[0], Position), dot(Object.ObjectToWorld[1], Position), dot(Object.ObjectToWorld[2], Position));
	vec3 CellCenter = vec3(Object.Cell - Scene.OriginCell) * CELL_SIZE;
	OutRelative = InCell + (CellCenter - FViewRef(Push.Pass.View).Data.CameraPosition);
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
