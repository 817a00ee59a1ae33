// Resamples the path of a pixel with those that it kept from the frame before, and with those of pixels around (PATH_RESERVOIRS). Ouyang et
// al. 2021, "ReSTIR GI: Path Resampling for Real-Time Path Tracing". Weights are the defensive pairwise ones of Lin et al. 2022, "Generalized
// Resampled Importance Sampling".
// What a pixel keeps is chosen over time alone. What it takes over from pixels around lights it, and is not handed on.
// NO_RESERVOIR_JACOBIAN: planted fault (r.RT.Debug.GI.Jacobian).
#ifndef LANTERN_PATH_RESERVOIRS_GLSL
#define LANTERN_PATH_RESERVOIRS_GLSL

#include "../Shared/PathReservoirTypes.h"
#include "SharedPaths.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FPathReservoirRef { FPathReservoir Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FPathReservoirsRef { FPathReservoirs Data; };

const float MostJacobian = 8.0; // Beyond it, and below one over it, a path is another one as seen from elsewhere.
const float MostWeight = 1.0e20;

#if defined(QUARTER)
const vec2 ThreadPitch = vec2(2.0, 2.0); // pixels from one thread to the next
#elif defined(CHECKERBOARD)
const vec2 ThreadPitch = vec2(2.0, 1.0);
#else
const vec2 ThreadPitch = vec2(1.0, 1.0);
#endif

uint ReservoirCount(FPathReservoir R) { return R.State & PATH_RESERVOIR_COUNT_MASK; }
bool IsSkyPath(FPathReservoir R) { return (R.State & PATH_RESERVOIR_SKY) != 0u; }

// A surface that paths leave.
struct FPathStart
{
	vec3 Place, Normal; // see FPathReservoir
	float Near;         // paths that meet something nearer are not resampled
};

// Returns the density for which a path is wanted there, up to a factor; 0: it is not one of those. OutDirection: towards what it met.
float WantPath(FPathStart Start, FPathReservoir R, out vec3 OutDirection)
{
	vec3 To = R.Hit - Start.Place;
	float Distance = length(To);
	bool bSky = IsSkyPath(R);
	OutDirection = bSky ? R.Hit : To / max(Distance, 1.0e-20);
	if (!bSky && Distance < Start.Near) { return 0.0; }
	return Luminance(UnpackRgbe(R.Radiance)) * max(dot(Start.Normal, OutDirection), 0.0);
}

// Returns the solid angle that a path's first hit has from one place, over that which it has from another; 0: see MostJacobian.
float GetReservoirJacobian(vec3 From, vec3 To, FPathReservoir R)
{
	if (IsSkyPath(R)) { return 1.0; }
	vec3 Normal = UnpackOct24(R.HitNormal), Before = From - R.Hit, After = To - R.Hit;
	float CosBefore = dot(Normal, Before), CosAfter = dot(Normal, After);
	if (CosBefore <= 0.0 || CosAfter <= 0.0) { return 0.0; }
	float Squares = dot(Before, Before) / dot(After, After);
	float Jacobian = CosAfter / CosBefore * Squares * sqrt(Squares);
#ifdef NO_RESERVOIR_JACOBIAN
	return 1.0;
#else
	return Jacobian <= MostJacobian && Jacobian * MostJacobian >= 1.0 ? Jacobian : 0.0;
#endif
}

// Paths that meet glass are not resampled, so what lies behind it is not seen.
bool SeesHit(FSceneConstants Scene, FViewConstants View, vec3 Place, FPathReservoir R)
{
	vec3 Origin = View.CameraPosition + Place;
	CountPathRay(Scene, PATH_RAY_CHECK);
	if (IsSkyPath(R)) { return Transmittance(Scene, GatherMask, Origin, R.Hit, 1.0e30) >= 1.0; }
	vec3 Hit = View.CameraPosition + R.Hit;
	vec3 To = OffsetRayOrigin(Hit, UnpackOct24(R.HitNormal), Scene.ObjectReach, distance(Hit, Origin)) - Origin;
	float Distance = length(To);
	return Transmittance(Scene, GatherMask, Origin, To / max(Distance, 1.0e-20), Distance) >= 1.0;
}

// Returns WantPath of what is seen from there, and 0 of all else.
float WantSeenPath(FSceneConstants Scene, FViewConstants View, FPathStart Start, FPathReservoir R)
{
	vec3 Direction;
	float Wanted = WantPath(Start, R, Direction);
	return Wanted > 0.0 && SeesHit(Scene, View, Start.Place, R) ? Wanted : 0.0;
}

// Reservoirs of the frame before that a pixel takes.
struct FReservoirNeighbors
{
	uint Count, Threads[PATH_RESERVOIR_MOST_NEIGHBORS];
	float Total; // sum of their counts
};

// Returns a reservoir of the frame before as this frame's camera has it.
FPathReservoir LoadPreviousReservoir(FPathReservoirs Reservoirs, FViewConstants View, uint Thread)
{
	FPathReservoir R = FPathReservoirRef(Reservoirs.Previous).Data[Thread];
	R.Place -= View.CameraMotion;
	if (!IsSkyPath(R)) { R.Hit -= View.CameraMotion; }
	return R;
}

bool IsAlikeStart(FPathStart Start, FPathReservoir R, float PixelWidth, uint Flags)
{
	vec3 To = R.Place - Start.Place;
	bool bPlane = dot(Start.Normal, UnpackOct24(R.Normal)) >= 0.9 && abs(dot(Start.Normal, To)) <= 0.1 * length(To) + PixelWidth;
	return bPlane && ReservoirCount(R) > 0u && (R.State & PATH_RESERVOIR_SPHERE) == (Flags & PATH_RESERVOIR_SPHERE);
}

// Returns reservoirs within Radius pixels of where the surface was; 0: the one that was there.
FReservoirNeighbors FindReservoirNeighbors(FPathReservoirs Reservoirs, FViewConstants View, FPathStart Start, uint Flags, float PixelWidth, float Radius,
                                           uint Most, inout FRandom Random)
{
	FReservoirNeighbors Found;
	Found.Count = 0u;
	Found.Total = 0.0;
	if (Reservoirs.Previous == FAddress(0) || View.bHistory == 0u) { return Found; }
	vec3 Before = Start.Place + View.CameraMotion;
	vec4 Clip = View.PreviousRelativeToClip * vec4(Before, 1.0);
	vec2 Size = vec2(View.PreviousWidth, View.PreviousHeight), At = (Clip.xy / Clip.w * 0.5 + 0.5) * Size;
	const float Farthest = 1.0e6; // pixels
	if (dot(View.PreviousForward, Before) <= 0.5 * View.PreviousNear || !all(lessThan(abs(At), vec2(Farthest)))) { return Found; }
	uvec2 Threads = TurnThreads(uvec2(Size));
	for (uint I = 0u; I < min(Most, PATH_RESERVOIR_MOST_NEIGHBORS); ++I)
	{
		vec2 U = Radius > 0.0 ? NextRandom4(Random).xy : vec2(0.0);
		vec2 Shift = Radius * sqrt(U.x) * vec2(cos(2.0 * Pi * U.y), sin(2.0 * Pi * U.y));
		ivec2 Place = ivec2(floor((At + Shift) / ThreadPitch));
		if (any(lessThan(Place, ivec2(0))) || any(greaterThanEqual(Place, ivec2(Threads)))) { continue; }
		uint Thread = uint(Place.y) * Threads.x + uint(Place.x);
		FPathReservoir R = LoadPreviousReservoir(Reservoirs, View, Thread);
		if (!IsAlikeStart(Start, R, PixelWidth, Flags)) { continue; }
		Found.Threads[Found.Count++] = Thread;
		Found.Total += float(ReservoirCount(R));
	}
	return Found;
}

// A choice among paths, each with a probability proportional to its weight.
struct FPathChoice
{
	FPathReservoir Chosen;
	float Wanted, Sum; // of the chosen one, see WantPath; of weights
};

void OfferReservoir(FPathReservoir R, float Wanted, float Weight, float U, inout FPathChoice Choice)
{
	if (!(Weight > 0.0) || isinf(Weight)) { return; }
	Choice.Sum += Weight;
	if ((1.0 - U) * Choice.Sum > Weight) { return; }
	Choice.Chosen = R;
	Choice.Wanted = Wanted;
}

// Own: the pixel's, whose weight is 0 if it has no path to be resampled. Returns it with a path chosen of its own and of those found, and with
// the sum of their counts.
FPathReservoir Resample(FSceneConstants Scene, FViewConstants View, FPathReservoirs Reservoirs, FReservoirNeighbors Found, FPathStart Start,
                        FPathReservoir Own, inout FRandom Random)
{
	vec3 Direction;
	float OwnCount = float(ReservoirCount(Own)), Total = OwnCount + Found.Total, OwnShare = OwnCount / Total;
	float OwnWanted = Own.Weight > 0.0 ? WantPath(Start, Own, Direction) : 0.0;
	FPathChoice Choice = FPathChoice(Own, OwnWanted, 0.0);
	for (uint I = 0u; I < Found.Count; ++I)
	{
		FPathReservoir R = LoadPreviousReservoir(Reservoirs, View, Found.Threads[I]);
		FPathStart Its = FPathStart(R.Place, UnpackOct24(R.Normal), unpackHalf2x16(R.State).y);
		float Part = float(ReservoirCount(R)) / Total;
		if (OwnWanted > 0.0) // what the neighbour would have made of this pixel's path
		{
			float Jacobian = GetReservoirJacobian(Start.Place, Its.Place, Own);
			float Theirs = Jacobian > 0.0 ? WantSeenPath(Scene, View, Its, Own) * Jacobian : 0.0;
			OwnShare += Part * OwnCount * OwnWanted / (Found.Total * Theirs + OwnCount * OwnWanted);
		}
		if (R.Weight <= 0.0) { continue; }
		float Jacobian = GetReservoirJacobian(R.Place, Start.Place, R), Wanted = Jacobian > 0.0 ? WantSeenPath(Scene, View, Start, R) : 0.0;
		if (Wanted <= 0.0) { continue; }
		float Theirs = Found.Total * WantSeenPath(Scene, View, Its, R) / Jacobian; // of as large an angle there as here
		float Share = Part * Theirs / (Theirs + OwnCount * Wanted);
		OfferReservoir(R, Wanted, Share * Wanted * R.Weight * Jacobian, NextRandom4(Random).x, Choice);
	}
	OfferReservoir(Own, OwnWanted, OwnShare * OwnWanted * Own.Weight, NextRandom4(Random).x, Choice);
	FPathReservoir Out = Choice.Chosen;
	Out.Weight = Choice.Sum > 0.0 ? min(Choice.Sum / Choice.Wanted, MostWeight) : 0.0;
	const uint OfPixel = PATH_RESERVOIR_SPHERE | PATH_RESERVOIR_NEAR_MASK;
	Out.State = (Out.State & PATH_RESERVOIR_SKY) | (Own.State & OfPixel) | min(uint(Total), Reservoirs.MostCount);
	Out.Place = Own.Place;
	Out.Normal = Own.Normal;
	return Out;
}

// Leaves nothing for the next frame. The path that OfferPath has kept stays as it is.
void ClearReservoir(FAddress Address, uint Thread)
{
	FPathReservoirRef(FPathReservoirsRef(Address).Data.Current).Data[Thread].State = 0u;
}

// Replaces what OfferPath has kept by a path of the pixel's reservoir. Place: that the pixel's rays leave, relative to the camera. Flags:
// PATH_RESERVOIR_SPHERE or 0.
void ResampleKeptPath(FSceneConstants Scene, FViewConstants View, FAddress Address, uint Thread, FGBufferPoint Point, vec3 Place, uint Flags,
                      inout FRandom Random)
{
	FPathReservoirs Reservoirs = FPathReservoirsRef(Address).Data;
	uint Near = packHalf2x16(vec2(0.0, PathNear)) & PATH_RESERVOIR_NEAR_MASK;
	FPathReservoir Own;
	Own.Hit = KeptPath.Hit;
	Own.HitNormal = PackOct24(KeptNormal);
	Own.Radiance = PackRgbe(KeptPath.Radiance, NextRandom4(Random).xyz);
	Own.State = 1u | (KeptPath.bSky ? PATH_RESERVOIR_SKY : 0u) | Flags | Near;
	Own.Place = Place;
	Own.Normal = PackOct24(Point.BentN);
	float PixelWidth = PixelHeight(View, dot(View.CameraForward, Point.Relative));
	FPathStart Start = FPathStart(Place, UnpackOct24(Own.Normal), unpackHalf2x16(Near).y);
	vec3 Direction = KeptPath.bSky ? KeptPath.Hit : normalize(KeptPath.Hit - Place);
	float Cosine = dot(Start.Normal, Direction);
	Own.Weight = Cosine > 0.0 ? min(KeptPath.Share * Pi / Cosine, MostWeight) : 0.0;
	// What is out of date must go. To drop old paths would drop those that have become worth little, and make light too bright.
	uint Most = NextRandom4(Random).x < Reservoirs.Chance ? 0u : 1u;
	FReservoirNeighbors Found = FindReservoirNeighbors(Reservoirs, View, Start, Flags, PixelWidth, 0.0, Most, Random);
	FPathReservoir R = Resample(Scene, View, Reservoirs, Found, Start, Own, Random);
	FPathReservoirRef(Reservoirs.Current).Data[Thread] = R;
	if (Reservoirs.Neighbors > 0u)
	{
		Found = FindReservoirNeighbors(Reservoirs, View, Start, Flags, PixelWidth, Reservoirs.Radius, Reservoirs.Neighbors, Random);
		R = Resample(Scene, View, Reservoirs, Found, Start, R, Random);
	}
	Direction = IsSkyPath(R) ? R.Hit : normalize(R.Hit - Place);
	float Share = R.Weight * max(dot(Start.Normal, Direction), 0.0) / Pi;
	KeptPath = FKeptPath(R.Hit, IsSkyPath(R), UnpackRgbe(R.Radiance), Share, KeptPath.Gone);
}

#endif
