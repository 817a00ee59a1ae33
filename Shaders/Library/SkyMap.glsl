// Radiance of the sky along a direction: uniform, or from a map, which a host gave or Sky/Bake.comp made.
// SKY_IN_PLACE: of the sky's program itself.
#ifndef LANTERN_SKY_MAP_GLSL
#define LANTERN_SKY_MAP_GLSL

#include "Bindings.glsl"
#include "Math.glsl"
#ifdef SKY_IN_PLACE
#include "../Sky/RunSkyProgram.glsl"
#endif

// The same descriptors as Textures: those of textures with FRTTextureDesc::bCube.
layout(set = 0, binding = 0) uniform textureCube Cubes[];

// Direction: in the world, of unit length.
vec3 SampleSkyRadiance(FSceneConstants Scene, vec3 Direction)
{
#ifdef SKY_IN_PLACE
	if (Scene.SkyData != FAddress(0)) { return RunSkyProgram(Scene.SkyData, Direction); } // else the program has gone, and the shader not yet
#endif
	if (Scene.SkyMap == NO_TEXTURE) { return Scene.SkyRadiance; }
	uint Texture = SLOT_TEXTURE(Scene.SkyMap), Sampler = SLOT_SAMPLER(Scene.SkyMap);
	vec3 InMap = vec3(dot(Scene.SkyMapAxes[0], Direction), dot(Scene.SkyMapAxes[1], Direction), dot(Scene.SkyMapAxes[2], Direction));
	vec3 Texel = Scene.SkyMapKind == SKY_MAP_CUBE
	                 ? textureLod(samplerCube(Cubes[Texture], Samplers[Sampler]), InMap, 0.0).rgb
	                 : textureLod(sampler2D(Textures[Texture], Samplers[Sampler]), 0.5 * OctEncode(InMap) + 0.5, 0.0).rgb;
	if (Scene.SkyMapKind == SKY_MAP_ROOTS) { return Texel * Texel; }
	return Scene.SkyRadiance * max(Texel, vec3(0.0));
}

#endif
