// What surfaces in front of the G-buffer's send to the camera, and what they leave of what lies behind: glass, and water. A ray from the
// camera meets such objects alone. Smooth sheets are passed straight, so that what the raster shows behind them stays as it is. What bends
// light, or scatters it, is followed by rays. Paths end in radiance cells where there are any, which have no noise.
// The ray-tracing pipeline and the ray-query path share it.
#ifndef LANTERN_TRANSMISSION_PASS_GLSL
#define LANTERN_TRANSMISSION_PASS_GLSL

#define LIKELIEST_PASSAGE
#undef NO_CAUSTICS // the camera sees the sun in glass
#include "../Shared/TransmissionTypes.h"
#include "../Rays/IndirectSampling.glsl"
#include "Layers.glsl"

layout(push_constant, scalar) uniform FPush { FTransmissionConstants Push; };

const float LeastShare = 1.0 / 256.0; // of what the camera sees, that is followed

#ifdef RADIANCE_CELLS
void BeginLookUps(FViewConstants View, uvec2 Pixel)
{
	if (Push.RadianceCells == FAddress(0)) { return; }
	FRadianceGrid Grid = FRadianceGridRef(Push.RadianceCells).Data;
	FAddress Votes = VotesInTurn(View, Pixel) ? Grid.Votes : FAddress(0);
	BeginRadianceLookUps(Push.RadianceCells, View, Votes, Push.FirstVoter + VoterOfPixel(View, Pixel), 2u, HashLookUps(View, Pixel));
	RadianceNear = Grid.NearCells;
}
#endif

// Returns the radiance from a direction, of which the camera sees a share. Absorption: of the volume that the ray starts in.
vec3 LookAlong(FSceneConstants Scene, vec3 Origin, vec3 Direction, vec3 Absorption, inout FRandom Random)
{
	FirstAbsorption = Absorption;
	FMaterialHit Hit = TraceMaterial(Scene, MASK_VISIBLE, Origin, Direction, Infinity, SHOWS_ALL);
	vec3 L = FollowPath(Scene, Hit, Origin, Direction, uintBitsToFloat(0x7f800000u), 1.0, 1u, Push.MaxBounces, true, Random);
	return mix(L, vec3(0.0), isnan(L));
}

// Returns what an interface sends to the camera along either of its sides. U.z chooses the side.
vec3 FollowSide(FSceneConstants Scene, FMaterialHit Hit, vec3 Origin, vec3 Direction, vec3 U, inout FRandom Random)
{
	mat3 Basis = MakeBasis(BendNormal(Hit.Normal, -Direction));
	FPassage Passage = SamplePassage(Hit, Basis, -Direction * Basis, U);
	if (Passage.Weight == vec3(0.0)) { return vec3(0.0); }
	bool bInto = Passage.bThrough != ((Hit.Flags & HIT_INSIDE) != 0u);
	vec3 From = OffsetRayOrigin(Origin + Direction * Hit.Distance, Passage.bThrough ? -Hit.GeometricNormal : Hit.GeometricNormal,
	                            Scene.ObjectReach, Hit.Distance);
	return Passage.Weight * LookAlong(Scene, From, Passage.Direction, bInto ? Hit.Absorption : vec3(0.0), Random);
}

// What the base of a surface sends that is no interface: its colour, lit.
vec3 ShadeBase(FSceneConstants Scene, FMaterialHit Hit, vec3 Origin, vec3 Direction, inout FRandom Random)
{
	Hit.Transmission = 0.0;
	vec3 L = FollowPath(Scene, Hit, Origin, Direction, uintBitsToFloat(0x7f800000u), 1.0, 1u, max(Push.MaxBounces, 2u), true, Random);
	return mix(L, vec3(0.0), isnan(L));
}

// Adds what one surface sends, and takes from Through what it keeps from passing. Returns whether the ray goes straight on.
bool AddLayer(FSceneConstants Scene, FMaterialHit Hit, vec3 Origin, vec3 Direction, inout vec3 Light, inout vec3 Through, inout FRandom Random)
{
	float Share = InterfaceShare(Hit);
	float Reflected = InterfaceReflectance(Hit, abs(dot(Hit.Normal, Direction)), EtaOf(Hit));
	vec2 U = NextRandom4(Random).xy;
	if (1.0 - Share > LeastShare) { Light += Through * (1.0 - Share) * ShadeBase(Scene, Hit, Origin, Direction, Random); }
	else { Light += Through * Hit.Emissive; }
	if (Share * Reflected > LeastShare)
	{
		Light += Through * (Share * Reflected) * FollowSide(Scene, Hit, Origin, Direction, vec3(U, 0.0), Random);
	}
	bool bStraight = (Hit.Flags & HIT_SOLID) == 0u && Hit.Roughness * Hit.Roughness < MinAlpha;
	if (!bStraight && Share * (1.0 - Reflected) > LeastShare)
	{
		Light += Through * (Share * (1.0 - Reflected)) * FollowSide(Scene, Hit, Origin, Direction, vec3(U, 1.0), Random);
	}
	Through *= bStraight ? Hit.BaseColor * (Share * (1.0 - Reflected)) : vec3(0.0);
	return MaxComponent(Through) > LeastShare;
}

void ShowLayers(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	vec3 Direction = CameraRay(View, vec2(Pixel) + 0.5), Origin = View.CameraPosition + CameraRayStart(View, vec2(Pixel) + 0.5);
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	float Left = Infinity;
	if (Depth > 0.0) { Left = DistanceBefore(DistanceFromDepth(View, Depth) / dot(Direction, View.CameraForward)); }
	FRandom Random = MakeRandom(Pixel, View.FrameIndex, HashPcg(View.Seed + 0x7f4a7c15u));
	vec3 Light = vec3(0.0), Through = vec3(1.0);
	FMaterialHit Hit;
	for (uint Layer = 0u; Layer < Push.MostLayers && FindLayer(Scene, Origin, Direction, Left, Hit); ++Layer)
	{
#ifdef RADIANCE_CELLS
		if (Layer == 0u) { BeginLookUps(View, Pixel); }
#endif
		if (!AddLayer(Scene, Hit, Origin, Direction, Light, Through, Random)) { break; }
		Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
		Left -= Hit.Distance;
	}
	imageStore(Images[Push.Light], ivec2(Pixel), RoundToHalf(vec4(ClampToFinite(Light), 1.0)));
	imageStore(Images[Push.Transmittance], ivec2(Pixel), vec4(Through, 1.0));
}

#endif
