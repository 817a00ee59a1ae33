// The fragment shader of the G-buffer. MASKED: with the alpha test. MOTION: also writes motion vectors. BACK: also writes FGBuffer::BackAlbedo.
#version 460
#define MATERIAL_IMPLICIT_LOD
#include "../Shared/GBufferTypes.h"
#include "../Materials/Material.glsl"
#include "../Library/GBuffer.glsl"
#ifdef MOTION
#include "../Library/Motion.glsl"
#endif

layout(push_constant, scalar) uniform FPush { FGBufferConstants Push; };

layout(location = 0) in vec3 InRelative;
layout(location = 1) in vec3 InNormal;
layout(location = 2) in vec4 InTangent;
layout(location = 3) in vec4 InUV;
layout(location = 4) in vec4 InColor;
layout(location = 5) flat in uint InObject;
layout(location = 6) flat in uint InSection;
#ifdef MOTION
layout(location = 7) in vec3 InPreviousRelative;
#endif

layout(location = 0) out vec4 OutNormals;   // shading and geometric normal, octahedral
layout(location = 1) out vec4 OutBaseColor; // a: metallic
layout(location = 2) out vec4 OutMaterial;  // roughness, occlusion, sqrt(F0), specular
layout(location = 3) out vec4 OutEmissive;
#ifdef MOTION
layout(location = 4) out vec4 OutMotion; // see FGBuffer::Motion
#endif

#ifdef BACK
#ifdef MOTION
layout(location = 5) out vec4 OutBack;
#else
layout(location = 4) out vec4 OutBack;
#endif
#endif

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FSectionData Section = FSectionRef(Scene.Sections).Data[InSection];
	FMaterialInputs Inputs;
	Inputs.Normal = InNormal;
	Inputs.Tangent = InTangent;
	Inputs.UV0 = InUV.xy;
	Inputs.UV1 = InUV.zw;
	Inputs.Color = InColor;
	Inputs.Footprint = 0.0;
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
	FMaterialSurface Surface = EvaluateMaterial(Material, Inputs, Scene.MaterialOverride);
	vec3 Ng = NormalizeOr(cross(dFdx(InRelative), dFdy(InRelative)), Surface.Normal);
#ifdef MASKED
	bool bLayer = Push.bLayers != 0u && (Section.Flags & SECTION_TRANSMISSIVE) != 0u && (Material.Flags & MATERIAL_BLENDED) != 0u;
	if (Surface.Opacity < (bLayer ? LeastSolidOpacity : Material.AlphaCutoff)) { discard; }
#endif
	// Turns both normals towards the camera, as the hit shaders do.
	if (dot(Ng, InRelative) > 0.0) { Ng = -Ng; }
	bool bMirrored = (FObjectRef(Scene.Objects).Data[InObject].Flags & OBJECT_MIRRORED) != 0u;
	if (gl_FrontFacing == bMirrored) { Surface.Normal = -Surface.Normal; }

	bool bBack = false;
#ifdef BACK
	OutBack = BackOf(Material, Surface);
	bBack = OutBack.rgb != vec3(0.0);
#endif
	OutNormals = vec4(OctEncode(Surface.Normal), MarkBack(OctEncode(Ng), bBack));
	OutBaseColor = vec4(Surface.BaseColor, Surface.Metallic);
	OutMaterial = vec4(Surface.Roughness, Surface.Occlusion, sqrt(Surface.F0), Surface.Specular);
	OutEmissive = vec4(Surface.Emissive, 0.0);
#ifdef MOTION
	OutMotion = vec4(ComputeMotion(FViewRef(Push.Pass.View).Data, InRelative, InPreviousRelative), float(InObject + 1u));
#endif
}
