#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "ForkDraw.glsl"

layout(location = 0) flat in vec3 InNormal;
layout(location = 1) in vec3 InPosition;
layout(location = 2) in vec4 InClip;
layout(location = 3) in vec4 InPreviousClip;
layout(location = 4) in vec2 InUV;
layout(location = 0) out vec4 OutNormal; // view space, from 0 to 1
layout(location = 1) out vec2 OutMotion; // from where the surface was to where it is, in parts of the picture
layout(location = 2) out vec4 OutColor;  // a: metalness
layout(location = 3) out vec4 OutMaterial; // roughness, occlusion, sqrt(F0), weight of the specular lobe

void main()
{
	// The window of MakeCutOutMap.
	if (Push.bCutOut != 0u && all(lessThan(abs(InUV - 0.5), vec2(0.25)))) { discard; }
	// Skinned meshes have no normals: that of the triangle serves.
	vec3 Normal = InNormal;
	if (InNormal == vec3(0.0))
	{
		Normal = normalize(cross(dFdx(InPosition), dFdy(InPosition)));
		Normal = dot(Normal, InPosition) > 0.0 ? -Normal : Normal;
	}
	OutNormal = vec4(Normal * 0.5 + 0.5, 0.0);
	OutMotion = (InClip.xy / InClip.w - InPreviousClip.xy / InPreviousClip.w) * 0.5;
	OutColor = vec4(Push.Color, 0.0);
	OutMaterial = vec4(1.0, 1.0, 0.2, 1.0);
}
