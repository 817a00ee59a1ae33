// The fragment shader of the sample engine's shadow map. MASKED: with the alpha test, of the finest texels, as rays have it.
#version 460
#ifdef MASKED
#include "../Shared/ShadowMapTypes.h"
#include "../Materials/Material.glsl"

layout(push_constant, scalar) uniform FPush { FShadowMapConstants Push; };

layout(location = 0) in vec4 InUV;
layout(location = 1) in vec4 InColor;
layout(location = 2) flat in uint InMaterial;

void main()
{
	FMaterialInputs Inputs;
	Inputs.Normal = vec3(0.0, 0.0, 1.0);
	Inputs.Tangent = vec4(0.0);
	Inputs.UV0 = InUV.xy;
	Inputs.UV1 = InUV.zw;
	Inputs.Color = InColor;
	Inputs.Footprint = 0.0;
	FMaterialData Material = FMaterialRef(FSceneRef(Push.Pass.Scene).Data.Materials).Data[InMaterial];
	if (EvaluateMaterial(Material, Inputs, 0u).Opacity < Material.AlphaCutoff) { discard; }
}
#else
void main() {}
#endif
