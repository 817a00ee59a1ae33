// What surfaces in front of the G-buffer's send to the camera, and what they leave of what lies behind: glass, and water. A ray from the
// camera meets such objects alone. Smooth sheets are passed straight, so that what the raster shows behind them stays as it is. What bends
// light, or scatters it, is followed by rays. Paths end in radiance cells where there are any, which have little noise.
// The ray-tracing pipeline and the ray-query path share it.
#ifndef LANTERN_TRANSMISSION_PASS_GLSL
#define LANTERN_TRANSMISSION_PASS_GLSL

#ifndef HAS_TRANSMISSION
#define HAS_TRANSMISSION
#endif
#define LIKELIEST_PASSAGE
#undef NO_CAUSTICS // the camera sees the sun in glass
#define ENDS_ON_SCREEN
#define SMOOTH_RADIANCE
#include "../Shared/TransmissionTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/UintTextures.glsl"
#include "Looks.glsl"

layout(push_constant, scalar) uniform FPush { FTransmissionConstants Push; };

FLook Look;               // of the path that is followed; a weight of 0: it has ended elsewhere
float LookDistance;       // by how far the place of Look is from where the path began
vec3 PathStart;
bool bAsksLook = false;   // whether paths may end on the screen

// Ends a path at a point if the picture shows it, and returns whether it does.
bool EndOnScreen(vec3 P, vec3 Normal, vec3 Throughput)
{
	const float DepthError = 0.005, LeastCosine = 0.9;
	if (!bAsksLook) { return false; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	vec3 Relative = P - View.CameraPosition;
	float Distance = dot(Relative, View.CameraForward);
	if (Distance <= View.Near) { return false; }
	vec2 Aside = vec2(dot(Relative, View.CameraRight), dot(Relative, View.CameraUp)) / (View.bOrthographic != 0u ? 1.0 : Distance);
	vec2 At = (Aside - View.RayOffset) / View.RayScale, Size = vec2(View.Width, View.Height);
	if (any(lessThan(At, vec2(0.5))) || any(greaterThan(At, Size - 0.5))) { return false; }
	float Depth = LoadDepth(Push.Depth, ivec2(At));
	if (Depth <= 0.0 || abs(DistanceFromDepth(View, Depth) - Distance) > DepthError * Distance) { return false; }
	if (dot(LoadGBufferPoint(View, Push.Normals, ivec2(At), Depth).Ng, Normal) < LeastCosine) { return false; }
	Look = FLook(At / Size, Throughput);
	LookDistance = distance(P, PathStart);
	return true;
}

#include "../Rays/IndirectSampling.glsl"
#include "Layers.glsl"

const float LeastShare = 1.0 / 256.0; // of what the camera sees, that is followed

// Two looks of a pixel, and how far rough surfaces spread them.
struct FLooks
{
	FLook Of[2];
	float Spread[2];
};

// Returns the spread of what lies behind a surface. Bends: by how much of a microfacet's angle a ray is turned. Behind: distance from the
// surface to what is seen. Before: from the camera.
float SpreadOf(FViewConstants View, FMaterialHit Hit, float Bends, float Behind, float Before)
{
	float Alpha = Hit.Roughness * Hit.Roughness, Part = View.bOrthographic != 0u ? Behind : Behind / max(Behind + Before, 1.0e-6);
	return Alpha < MinAlpha ? 0.0 : Bends * Alpha * Part / (abs(View.RayScale.y) * float(View.Height));
}

// A ray from the camera, on its way through layers.
struct FCameraRay
{
	vec3 Origin, Direction; // of its last part
	float Left, Length;     // up to what the G-buffer shows, and so far
	vec2 Place;             // of its pixel, 0 to 1
};

// What the layers of a pixel send.
struct FShown
{
	vec3 Light, Through;
	FLooks Looks;
};

// Parts of what a surface sends to the camera, each of which a path finds.
const uint FromBase = 0u, FromReflection = 1u, FromBehind = 2u, Parts = 3u;

// Returns the radiance of a part, without that of Look. OutWeight: of it.
vec3 FollowPart(FSceneConstants Scene, uint Part, FMaterialHit Hit, FCameraRay Ray, out vec3 OutWeight, inout FRandom Random)
{
	Look.Weight = OutWeight = vec3(0.0);
	FMaterialHit Next = Hit;
	vec3 L = vec3(0.0), Origin = Ray.Origin, Direction = Ray.Direction;
	FirstVolume = Air();
	SEES_HITS(true);
	if (Part == FromBase)
	{
		OutWeight = vec3(1.0);
		Next.Transmission = 0.0;
		Next.Emissive = vec3(0.0);
	}
	else
	{
		mat3 Basis = MakeBasis(BendNormal(Hit.Normal, -Direction));
		FPassage Passage = SamplePassage(Hit, Basis, -Direction * Basis, vec3(0.0, 0.0, Part == FromBehind ? 1.0 : 0.0));
		OutWeight = Passage.Weight;
		if (OutWeight == vec3(0.0)) { return vec3(0.0); }
		vec3 Side = Passage.bThrough ? -Hit.GeometricNormal : Hit.GeometricNormal;
		Origin = PathStart = OffsetRayOrigin(Origin + Direction * Hit.Distance, Side, Scene.ObjectReach, Hit.Distance);
		Direction = Passage.Direction;
		bool bInside = (Hit.Flags & HIT_INSIDE) != 0u;
		if (Passage.bThrough != bInside) { FirstVolume = VolumeOf(Scene, Hit); }
		FirstSlope = abs(dot(Direction, Hit.GeometricNormal));
		float Alpha = Hit.Roughness * Hit.Roughness;
		RayCone = MakePixelCone(FViewRef(Push.Pass.View).Data, Ray.Length + Hit.Distance, Alpha < MinAlpha ? 0.0 : Alpha);
		Next = TraceMaterial(Scene, MASK_VISIBLE, Origin, Direction, Infinity, SHOWS_ALL);
#ifdef SCATTERS_BY_CELLS
		if (Passage.bThrough && !bInside) { L = FindScattered(Scene, Hit, Ray.Origin, Ray.Direction, Direction, Next.Distance, ChooseLevel(Random)); }
#endif
	}
	L += FollowPath(Scene, Next, Origin, Direction, uintBitsToFloat(0x7f800000u), 1.0, 1u, Push.MaxBounces, true, Random);
	return mix(L, vec3(0.0), isnan(L));
}

// Adds what a part sends to Shown.Light, or a look. Weight: of what the camera sees.
void AddPart(FSceneConstants Scene, FViewConstants View, uint Part, vec3 Weight, FMaterialHit Hit, FCameraRay Ray, inout FShown Shown,
             inout FRandom Random)
{
	uint Place = Part == FromBehind ? 1u : 0u;
	bAsksLook = Part != FromBase && Shown.Looks.Of[Place].Weight == vec3(0.0);
	vec3 Passed;
	vec3 L = FollowPart(Scene, Part, Hit, Ray, Passed, Random);
	Shown.Light += Weight * Passed * L;
	if (Look.Weight != vec3(0.0))
	{
		float Bends = Part == FromBehind ? 2.0 * abs(1.0 - 1.0 / IndexOf(Hit.F0)) : 2.0;
		Shown.Looks.Of[Place] = FLook(Look.Place, Weight * Passed * Look.Weight);
		Shown.Looks.Spread[Place] = SpreadOf(View, Hit, Bends, LookDistance, Ray.Length + Hit.Distance);
	}
	bAsksLook = false;
}

// Adds one layer, and takes from Through what it keeps from passing. Returns whether the ray goes straight on.
bool AddLayer(FSceneConstants Scene, FViewConstants View, FMaterialHit Hit, FCameraRay Ray, inout FShown Shown, inout FRandom Random)
{
	float Share = InterfaceShare(Hit), Reflected = InterfaceReflectance(Hit, abs(dot(Hit.Normal, Ray.Direction)), EtaOf(Hit));
	bool bSheet = (Hit.Flags & HIT_SOLID) == 0u, bSmooth = PassesStraight(Hit);
	// A camera in the volume.
	if ((Hit.Flags & HIT_INSIDE) != 0u)
	{
#ifdef SCATTERS_BY_CELLS
		vec3 Extinction = SeenExtinction(VolumeOf(Scene, Hit));
#else
		vec3 Extinction = VolumeOf(Scene, Hit).Extinction;
#endif
		Shown.Through *= exp(-Extinction * Hit.Distance);
	}
	Shown.Light += Shown.Through * Hit.Emissive;
	// One loop: paths are much code.
	vec3 Weights = vec3(1.0 - Share, Share * Reflected, bSheet ? 0.0 : Share * (1.0 - Reflected));
	for (uint Part = 0u; Part < Parts; ++Part)
	{
		vec3 Weight = Shown.Through * Weights[Part];
		if (MaxComponent(Weight) > LeastShare) { AddPart(Scene, View, Part, Weight, Hit, Ray, Shown, Random); }
	}
	vec3 Behind = Shown.Through * InterfaceTint(Hit) * (Share * (1.0 - Reflected));
	Shown.Through = bSheet && bSmooth ? Behind : vec3(0.0);
	if (bSheet && !bSmooth)
	{
		// The picture behind is spread, the sky as well.
		Shown.Looks.Of[1] = FLook(Ray.Place, Behind);
		Shown.Looks.Spread[1] = SpreadOf(View, Hit, 2.0, min(Ray.Left - Hit.Distance, 1.0e6), Ray.Length + Hit.Distance);
	}
	return MaxComponent(Shown.Through) > LeastShare;
}

void ShowLayers(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	vec2 At = vec2(Pixel) + 0.5;
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	FCameraRay Ray = FCameraRay(View.CameraPosition + CameraRayStart(View, At), CameraRay(View, At), Infinity, 0.0, At / vec2(View.Width, View.Height));
	if (Depth > 0.0) { Ray.Left = DistanceOfLayers(DistanceFromDepth(View, Depth) / dot(Ray.Direction, View.CameraForward)); }
#ifdef RADIANCE_CELLS
	if (Push.RadianceCells != FAddress(0) && VotesInTurn(View, Pixel))
	{
		FAddress Votes = FRadianceGridRef(Push.RadianceCells).Data.Votes;
		FRadianceVoteRef(Votes).Data[Push.FirstVoter + VoterOfPixel(View, Pixel)].Slot = NO_RADIANCE_CELL;
	}
#endif
	FRandom Random = MakeRandom(Pixel, View.FrameIndex, HashPcg(View.Seed + 0x7f4a7c15u));
	const FLook None = FLook(vec2(0.0), vec3(0.0));
	FShown Shown = FShown(vec3(0.0), vec3(1.0), FLooks(FLook[2](None, None), float[2](0.0, 0.0)));
	FMaterialHit Hit;
	for (uint Layer = 0u; Layer < Push.MostLayers; ++Layer)
	{
		float LeftBefore = Ray.Left;
		RayCone = MakePixelCone(View, Ray.Length, 0.0);
		if (!FindLayer(Scene, Ray.Origin, Ray.Direction, Ray.Left, Hit)) { break; }
		Ray.Length += Depth > 0.0 ? LeftBefore - Ray.Left : 0.0; // backs that were passed
#ifdef RADIANCE_CELLS
		// RadianceNear stays 0: nothing smooths what a path finds that goes on.
		if (Layer == 0u) { BeginPixelLookUps(Push.RadianceCells, View, Pixel, Push.FirstVoter); }
#endif
		if (!AddLayer(Scene, View, Hit, Ray, Shown, Random)) { break; }
		Ray.Origin = OffsetRayOrigin(Ray.Origin + Ray.Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
		Ray.Left -= Hit.Distance;
		Ray.Length += Hit.Distance;
	}
	imageStore(Images[Push.Light], ivec2(Pixel), RoundToHalf(vec4(ClampToFinite(Shown.Light), PackSpread(Shown.Looks.Spread[0]))));
	imageStore(Images[Push.Transmittance], ivec2(Pixel), vec4(Shown.Through, PackSpread(Shown.Looks.Spread[1])));
	imageStore(UintImages[Push.Looks], ivec2(Pixel), uvec4(PackLook(Shown.Looks.Of[0]), PackLook(Shown.Looks.Of[1])));
}

#endif
