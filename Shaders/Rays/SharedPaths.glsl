// Keeps the path of a pixel for the pixels around it (SHARED_PATHS). Paths that meet something near light no pixels but the nearest: what
// they meet, others may not see.
#ifndef LANTERN_SHARED_PATHS_GLSL
#define LANTERN_SHARED_PATHS_GLSL

#include "../Shared/SharedPathTypes.h"
#include "../Library/Random.glsl"
#include "../Library/Rgbe.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FSharedPathRef { FSharedPath Data[]; };

// What the thread keeps.
struct FKeptPath
{
	vec3 Hit; // relative to the camera; of the sky: direction
	bool bSky;
	vec3 Radiance;
	float Share; // see FSharedPath
	float Gone;  // see FGathered
};
const FKeptPath NoKeptPath = FKeptPath(vec3(0.0, 0.0, 1.0), true, vec3(0.0), 0.0, 0.0);

FKeptPath KeptPath;
float PathNear; // distance up to which paths meet something near, metres

// Offers a path to the pixels around. Start: relative to the camera. Distance: below 0: to the sky. Returns whether it is for them; else it
// is near.
bool OfferPath(vec3 Start, vec3 Direction, float Distance, vec3 Radiance, float Share, float Gone)
{
	const float MostLight = 1.0e15;
	KeptPath.Gone = Gone;
	if (Distance >= 0.0 && Distance < PathNear) { return false; }
#ifdef PATH_RESERVOIRS
	if (!bSameFromAll) { return false; }
#endif
	Radiance = mix(clamp(Radiance, vec3(0.0), vec3(MostLight)), vec3(0.0), isnan(Radiance));
	KeptPath = FKeptPath(Distance < 0.0 ? Direction : Start + Direction * Distance, Distance < 0.0, Radiance, Share, Gone);
	return true;
}

// Near, NearSpecular: see FSharedPath.
FSharedPath PackSharedPath(vec3 Near, vec3 NearSpecular, inout FRandom Random)
{
	uint SkyAndGone = (KeptPath.bSky ? 1u : 0u) | (packHalf2x16(vec2(0.0, KeptPath.Gone)) & 0xffff0000u);
	return FSharedPath(KeptPath.Hit, SkyAndGone, PackRgbe(KeptPath.Radiance, NextRandom4(Random).xyz), KeptPath.Share,
	                   PackRgbe(Near, NextRandom4(Random).xyz), PackRgbe(NearSpecular, NextRandom4(Random).xyz));
}

#endif
