// The vertex shader of the sample engine's shadow map. MASKED: with what the alpha test reads.
#version 460
#include "../Shared/ShadowMapTypes.h"
#include "../Library/ObjectPosition.glsl"
#include "../Library/VertexFetch.glsl"

layout(push_constant, scalar) uniform FPush { FShadowMapConstants Push; };

#ifdef MASKED
layout(location = 0) out vec4 OutUV;
layout(location = 1) out vec4 OutColor;
layout(location = 2) flat out uint OutMaterial;
#endif

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FObjectData Object = FObjectRef(Scene.Objects).Data[FIndexRef(Push.Objects).Data[gl_InstanceIndex]];
	FSectionData Section = FSectionRef(Scene.Sections).Data[Object.FirstSection + Push.Section];
	vec3 Position = FPositionRef(Section.Positions).Data[gl_VertexIndex];
	vec3 Camera = FViewRef(Push.Pass.View).Data.CameraPosition;
	vec4 P = vec4(CameraRelativePosition(Object.ObjectToWorld, CellOffset(Scene, Object.Cell), Object.Flags, Position, Camera), 1.0);
	gl_Position = vec4(dot(Push.ToClip[0], P), dot(Push.ToClip[1], P), dot(Push.ToClip[2], P), 1.0);
	// Casters before the near plane still cast.
	gl_Position.z = min(gl_Position.z, 1.0);
#ifdef MASKED
	FMaterialInputs Inputs = UnpackVertex(FAttributeRef(Section.Attributes).Data[gl_VertexIndex], Section.Flags);
	OutUV = vec4(Inputs.UV0, Inputs.UV1);
	OutColor = Inputs.Color;
	OutMaterial = Section.Material;
#endif
}
