// What the passes of screen probes share. After the screen probes of Lumen ("Radiance Caching for Real-Time Global Illumination", Wright
// 2021) and of GI-1.0 (Boissé et al. 2022).
#ifndef LANTERN_SCREEN_PROBES_GLSL
#define LANTERN_SCREEN_PROBES_GLSL

#include "../Shared/ScreenProbeTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/OctahedralMap.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FScreenProbeGridRef { FScreenProbeGrid Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FScreenProbeRef { FScreenProbe Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FScreenProbePlanRef { FScreenProbePlan Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FScreenProbeRayRef { FScreenProbeRay Data[]; };

const uint ProbeTexels = uint(SCREEN_PROBE_TEXELS);
const float TexelReach = 0.2; // of a texel, as a cosine: parts of it may lie above a horizon that its centre is below

uvec2 ProbePixel(uint Packed) { return uvec2(Packed & 0xffffu, Packed >> 16u); }

// Returns the solid angle of a texel around a direction.
float ProbeSolidAngle(vec3 Direction)
{
#ifndef NO_SOLID_ANGLE // r.RT.Debug.GI.SolidAngle
	return OctMapSolidAngle(Direction);
#else
	return 4.0 * Pi / float(SCREEN_PROBE_TEXELS);
#endif
}

// Returns the place of a normal in a map of irradiance, [0, 1]². Local: in the basis of the probe's geometric normal. What lies below its
// surface has the place of what is nearest to it.
vec2 IrradiancePlace(vec3 Local)
{
	Local.z = max(Local.z, 0.0);
	vec2 P = Local.xy / max(abs(Local.x) + abs(Local.y) + Local.z, 1.0e-6);
	return vec2(P.x + P.y, P.x - P.y) * 0.5 + 0.5;
}

// Returns the normal of a place, in that basis.
vec3 IrradianceNormal(vec2 Place)
{
	Place = Place * 2.0 - 1.0;
	vec2 P = vec2(Place.x + Place.y, Place.x - Place.y) * 0.5;
	return normalize(vec3(P, 1.0 - abs(P.x) - abs(P.y)));
}

#endif
