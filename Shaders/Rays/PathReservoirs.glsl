// Keeps the paths of a pixel for the pixels around it (PATH_RESERVOIRS), after Ouyang et al. 2021, "ReSTIR GI: Path Resampling for Real-Time
// Path Tracing". Paths that meet something near light only the pixel itself: what they meet, others may not see.
#ifndef LANTERN_PATH_RESERVOIRS_GLSL
#define LANTERN_PATH_RESERVOIRS_GLSL

#include "../Shared/PathReservoirTypes.h"
#include "../Library/Random.glsl"
#include "../Library/Rgbe.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FPathReservoirRef { FPathReservoir Data[]; };

// What the thread keeps.
struct FKeptPath
{
	vec3 Hit; // relative to the camera; of the sky: direction
	bool bSky;
	vec3 Radiance;
	float Share, Light; // see FPathReservoir; what it was chosen by
	float Sum;          // of the light of all paths
	uint Paths;
};
const FKeptPath NoKeptPath = FKeptPath(vec3(0.0, 0.0, 1.0), true, vec3(0.0), 0.0, 0.0, 0.0, 0u);

FKeptPath KeptPath;
float PathNear; // distance up to which paths meet something near, metres

// Offers a path to the pixels around. Start: relative to the camera. Distance: below 0: to the sky. U: random. Returns whether it is for
// them; else it is near.
bool OfferPath(vec3 Start, vec3 Direction, float Distance, vec3 Radiance, float Share, float U)
{
	const float MostLight = 1.0e15;
	if (Distance >= 0.0 && Distance < PathNear) { return false; }
	Radiance = mix(clamp(Radiance, vec3(0.0), vec3(MostLight)), vec3(0.0), isnan(Radiance));
	float Light = Luminance(Radiance) * Share;
	KeptPath.Sum += Light;
	if (KeptPath.Paths++ > 0u && U * KeptPath.Sum >= Light) { return true; }
	KeptPath.Hit = Distance < 0.0 ? Direction : Start + Direction * Distance;
	KeptPath.bSky = Distance < 0.0;
	KeptPath.Radiance = Radiance;
	KeptPath.Share = Share;
	KeptPath.Light = Light;
	return true;
}

// Samples: of the pixel, near ones included. Near, NearSpecular: their means over all samples.
FPathReservoir PackReservoir(uint Samples, vec3 Near, vec3 NearSpecular, inout FRandom Random)
{
	// A path alone counts as it was drawn, dark or not. One that was chosen counts for the others as well.
	float Factor = KeptPath.Paths <= 1u ? 1.0 : KeptPath.Light > 0.0 ? KeptPath.Sum / KeptPath.Light : 0.0;
	vec3 Radiance = KeptPath.Radiance * (Factor / float(max(Samples, 1u)));
	return FPathReservoir(KeptPath.Hit, KeptPath.bSky ? 1u : 0u, PackRgbe(Radiance, NextRandom4(Random).xyz), KeptPath.Share, PackRgbe(Near, NextRandom4(Random).xyz),
	                      PackRgbe(NearSpecular, NextRandom4(Random).xyz));
}

#endif
