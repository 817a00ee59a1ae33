// Path tracing for ray generation shaders: the reference and the brute-force passes. Combines next-event estimation for each
// kind of light with BRDF sampling by multiple importance sampling (Veach 1997), and ends paths by Russian roulette.
// RAY_QUERY: rays are traced inline, in compute shaders; otherwise through a ray-tracing pipeline.
// RADIANCE_CELLS: paths end where a radiance cell knows the light; the thread calls BeginRadianceLookUps first.
// AUDITS_CELLS: some go on although one does, see CellAudit.glsl.
// DEFERS_PATHS: paths also end where none does; bRadianceDeferred then says that what they bring is void.
// KEEPS_HIT: what the first ray of a gathered path met is kept, behind mirrors as well. See FKeptHit.
// COUNTS_ENDS: PathEnd says how a gathered path ended, and bPathLit whether light was sampled at its first hit. With ReflectionTypes.h before.
// ENDS_ON_SCREEN: paths end at surfaces that the frame's picture shows, see Transmission/Looks.glsl, which is included before.
// NO_CAUSTICS: mirrors show no sun's disk to what they light. Few paths would find it, and each would be a bright blotch.
// HAS_TRANSMISSION: light shines through some surfaces, see Transmission.glsl. Paths go on behind them, and rays to lights pass straight on.
//   TINTED_SHADOWS: these rays take what such surfaces leave of the light, as the reference does. Else they take its luminance alone.
//   HAS_SCATTERING: some volumes scatter light. Paths that end in radiance cells take it from that of the surface, in closed form: see
//   GatherScattered. Others are scattered.
//   LIKELIEST_PASSAGE: paths take the likelier side of such surfaces, and cells of one size. Neither has noise, which no filter removes.
// HAS_DIFFUSE_TRANSMISSION: some surfaces scatter light through. Paths leave them on either side.
// STANDARD_HITS, STANDARD_HITS_UNSEEN: see MaterialRay.glsl.
// GUIDED_PATHS, SECOND_LOBE: see PathDirections.glsl. Gather then takes a white Lambert lobe alone.
// HAS_SUN, HAS_SKY, HAS_LIGHTS, HAS_AREA_LIGHTS, HAS_LIGHT_PROFILES, HAS_LIGHT_CHANNELS, HAS_EMISSIVE, HAS_MASKED, HAS_CHARACTERS:
// defined if the scene has such.
#ifndef LANTERN_PATH_TRACING_GLSL
#define LANTERN_PATH_TRACING_GLSL

#include "../Library/Bindings.glsl"
#include "../Library/BrdfSample.glsl"
#include "../Library/EmissionShare.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Random.glsl"
#include "../Library/SkyMap.glsl"
#include "../Library/Sun.glsl"
#include "../Materials/Standard.glsl"
#include "MaterialRay.glsl"
#ifdef HAS_TRANSMISSION
#include "Transmission.glsl"
#endif
#include "PathLights.glsl"
#ifdef RADIANCE_CELLS
#include "RadianceLookUps.glsl"
#endif
#ifdef AUDITS_CELLS
#include "CellAudit.glsl"
#endif
#if defined(GUIDED_PATHS) || defined(SECOND_LOBE)
#define MIXED_DIRECTIONS
#include "PathDirections.glsl"
#endif

#ifndef REFLECTED_ROUGHNESS
#define REFLECTED_ROUGHNESS 1.0 // see EmissionOfRays, for the first lobe of a path
#endif

#ifdef PATH_RESERVOIRS
vec3 KeptNormal = vec3(0.0, 0.0, 1.0); // geometric, of what the first ray of a gathered path met
bool bSameFromAll = true;              // seen from elsewhere, what it met would send the path about as much light
#endif

uint GatherMask = MASK_VISIBLE; // what the first ray of a gathered path sees. The thread sets it before, see ChooseGatherMask

// ToonPixels: sampled index of what ToonSurface.comp writes; NO_TEXTURE: no object has a style.
void ChooseGatherMask(uint ToonPixels, ivec2 Pixel)
{
	bool bSphere = ToonPixels != NO_TEXTURE && texelFetch(Textures[ToonPixels], Pixel, 0).x > 0.0;
	GatherMask = bSphere ? MASK_OUTSIDE_SPHERES : MASK_VISIBLE;
}

const float RouletteThreshold = 0.25; // throughput below which Russian roulette may end a path

#ifdef COUNTS_ENDS
uint PathEnd = PATH_END_NONE;
bool bPathLit = false;
#define NOTE_END(End) PathEnd = End
#define NOTE_LIT(Bounce) bPathLit = bPathLit || Bounce == 1u
#else
#define NOTE_END(End)
#define NOTE_LIT(Bounce)
#endif

#ifdef NO_CAUSTICS
bool bSeenInMirrors = false; // mirrors alone lie between the camera and the end of the path
#endif

// Returns the radiance of the sky and the sun's disk along a ray that hits nothing, weighted against next-event estimation.
// Pdf: with which Direction was sampled; NdotL: π times the density that light sampling of the sky has there; Channels: of the object there.
vec3 ShadeMiss(FSceneConstants Scene, vec3 Direction, float Pdf, float NdotL, uint Channels)
{
	vec3 L = vec3(0.0);
#ifdef HAS_SKY
#ifdef RADIANCE_CELLS
	if (Pdf > 0.0) { L += SampleSkyRadiance(Scene, Direction); } // see SampleLights
#else
	L += SampleSkyRadiance(Scene, Direction) * PowerHeuristic(Pdf, NdotL / Pi);
#endif
#endif
#ifdef HAS_SUN
#ifdef NO_CAUSTICS
	bool bDisk = !isinf(Pdf) || bSeenInMirrors;
#else
	const bool bDisk = true;
#endif
	if (bDisk && Scene.SunOneMinusCos > 0.0 && SunSharesChannel(Scene, Channels) && IsInSunDisk(Scene, Direction))
	{
		L += SunRadiance(Scene) * PowerHeuristic(Pdf, SunPdf(Scene));
	}
#endif
	return L;
}

// Returns the emission of a hit surface, weighted against next-event estimation. Pdf: with which Direction was sampled. Before: length of the
// path from there to where its last part starts.
vec3 ShadeEmission(FSceneConstants Scene, FMaterialHit Hit, vec3 Direction, float Pdf, float Before)
{
	if (MaxComponent(Hit.Emissive) <= 0.0) { return vec3(0.0); }
	float CosAtLight = abs(dot(Hit.GeometricNormal, Direction));
	float LightPdf = 0.0;
#ifdef HAS_EMISSIVE
	if (Hit.EmissiveWeight > 0.0)
	{
		float Distance = Before + Hit.Distance;
		LightPdf = EmissiveAreaPdf(Scene, Hit.EmissiveWeight) * Distance * Distance / max(CosAtLight, 1.0e-8);
	}
#endif
	return LightPdf > 0.0 ? Hit.Emissive * PowerHeuristic(Pdf, LightPdf) : Hit.Emissive;
}

FBrdf MakeBrdf(FMaterialHit Hit)
{
	FBrdf Brdf = MakeWhiteLambert();
	Brdf.BaseColor = Hit.BaseColor;
	Brdf.Metallic = Hit.Metallic;
	Brdf.Alpha = Hit.Roughness * Hit.Roughness;
	Brdf.F0 = Hit.F0;
	Brdf.Specular = Hit.Specular;
#ifdef HAS_DIFFUSE_TRANSMISSION
	Brdf.Diffuse -= Hit.DiffuseTransmission;
	Brdf.BackAlbedo = Hit.BackAlbedo;
#endif
	return Brdf;
}

#ifdef HAS_DIFFUSE_TRANSMISSION
// What BackStep has beside the offset of a hit, at a first vertex that lies off its surface already. The thread may set it before.
vec3 FirstBackStep = vec3(0.0);

void SetBackStep(FSceneConstants Scene, vec3 P, vec3 Ng, float Distance)
{
	BackStep = FirstBackStep - 2.0 * PositionError(P, Scene.ObjectReach, Distance) * Ng;
	FirstBackStep = vec3(0.0);
}
#endif

// Returns a number that chooses the size of a radiance cell.
float ChooseLevel(inout FRandom Random)
{
#ifdef LIKELIEST_PASSAGE
	return 0.5;
#else
	return NextRandom4(Random).x;
#endif
}

// Survivors continue with a throughput of RouletteThreshold. Roulette on the throughput itself would cause most of the noise in bright rooms
// (closed, albedo 0.9: 10 times the samples for the same error).
bool EndsByRoulette(inout vec3 Throughput, inout FRandom Random)
{
	float SurvivalProbability = min(MaxComponent(Throughput) / RouletteThreshold, 1.0);
	if (NextRandom4(Random).x >= SurvivalProbability) { return true; }
	Throughput /= SurvivalProbability;
	return false;
}

#ifdef HAS_TRANSMISSION
#include "Passages.glsl"
#endif

#ifdef KEEPS_HIT
#include "KeptHit.glsl"
#endif

// Chooses whether a path goes on to what materials look like, by its share of what is reflected. Returns the factor of what it finds.
vec3 ChooseShown(vec3 Share, float U, out bool bShown)
{
	float Chance = Luminance(Share);
	bShown = U < Chance;
	return bShown ? Share / Chance : (vec3(1.0) - Share) / max(1.0 - Chance, 1.0e-6);
}

#ifdef HAS_TRANSMISSION
#define LENGTH_PASSED Passages.Length
#else
#define LENGTH_PASSED 0.0
#endif

#ifdef AUDITS_CELLS
// Ends a path that has brought Radiance, or lets it go on behind what a cell has answered: see GoesOnBehindAnswer. Returns whether it ends.
bool EndsAtAnswer(vec3 Answered, inout vec3 Radiance, inout uint MaxBounces)
{
	if (GoesOnBehindAnswer(Radiance, Answered))
	{
#ifdef DEFERS_PATHS
		bRadianceDeferred = true;
		return true;
#else
		MaxBounces = AuditBounces;
		return false;
#endif
	}
	Radiance += Answered;
	return true;
}
#endif

#ifdef RADIANCE_CELLS
float LightGone = 0.0; // luminance by which what a gathered path has found in cells was more a moment ago

// Adds what a radiance cell knows of the light at a hit, or weighs the path for what it has not found, and returns whether the path ends.
// bLooksUp: also before its last hit.
bool EndsInCells(FMaterialHit Hit, FBrdf Brdf, vec3 P, mat3 Basis, vec3 LocalV, uint Bounce, inout uint MaxBounces, bool bLooksUp,
                 inout vec3 Throughput, inout vec3 Radiance, inout FRandom Random)
{
	vec3 Known;
	float NearCells = Bounce == 1u ? RadianceNear : 0.0;
	bool bLast = Bounce >= MaxBounces;
#ifdef AUDITS_CELLS
	if (CellAudit.Answer != RADIANCE_AUDIT_NONE) { return bLast; } // it has had its answer
#endif
	if ((bLast || bLooksUp) && LookUpReflected(Hit, Brdf, P, Basis, LocalV, NearCells, bLast, ChooseLevel(Random), Known))
	{
		NOTE_END(bLast && IsMirror(Brdf) ? PATH_END_STAND_IN : PATH_END_CELL);
		LightGone += Luminance(Throughput * Known) * (RadianceBefore - 1.0);
#ifdef AUDITS_CELLS
		return EndsAtAnswer(Throughput * Known, Radiance, MaxBounces);
#else
		Radiance += Throughput * Known;
		return true;
#endif
	}
	Throughput *= TakeRadianceRest();
#ifdef AUDITS_CELLS
	if (bLast && Throughput != vec3(0.0))
	{
		RadianceAnswer = RADIANCE_AUDIT_LOST;
		return EndsAtAnswer(vec3(0.0), Radiance, MaxBounces);
	}
#endif
	if (bLast || Throughput == vec3(0.0)) { return true; }
#ifdef DEFERS_PATHS
	bRadianceDeferred = true;
	return true;
#else
	return false;
#endif
}
#endif

// Returns the radiance that arrives along a ray traced from Origin to Hit. Pdf and NdotL belong to its direction at the vertex
// that it left; they weigh it against the next-event estimation there. Bounce: how often the path was scattered before. bShown: whether
// only mirrors have scattered it.
vec3 FollowPath(FSceneConstants Scene, FMaterialHit Hit, vec3 Origin, vec3 Direction, float Pdf, float NdotL, uint Bounce, uint MaxBounces,
                bool bShown, inout FRandom Random)
{
	vec3 Radiance = vec3(0.0), Throughput = vec3(1.0);
	uint Channels = AllChannels; // of the vertex before
#ifdef KEEPS_HIT
	bool bMirrored = true; // only mirrors have scattered the path, but for its first vertex
#endif
#ifdef HAS_TRANSMISSION
	FPassages Passages = StartPassages();
#endif
	for (;; ++Bounce)
	{
#ifdef HAS_TRANSMISSION
		if (PassVolume(Scene, Passages, Hit, Origin, Direction, Throughput, Pdf, Radiance, Bounce, MaxBounces, Random))
		{
			NdotL = 0.0; // paths alone find the sky from there
			bShown = false;
			Channels = AllChannels;
		}
		if (Throughput == vec3(0.0)) { return Radiance; }
#endif
		NOTE_END(Hit.Distance < 0.0 ? PATH_END_SKY : PATH_END_DARK);
		if (Hit.Distance < 0.0) { return Radiance + Throughput * ShadeMiss(Scene, Direction, Pdf, NdotL, Channels); }
#ifdef ENDS_ON_SCREEN
		if (Hit.Transmission <= 0.0 && EndOnScreen(Origin + Direction * Hit.Distance, Hit.GeometricNormal, Throughput)) { return Radiance; }
#endif
		Radiance += Throughput * ShadeEmission(Scene, Hit, Direction, Pdf, LENGTH_PASSED);
#ifdef HAS_TRANSMISSION
		if (TakePassage(Scene, bShown, Hit, Passages, Origin, Direction, Throughput, Pdf, Random))
		{
			if (Throughput == vec3(0.0)) { return Radiance; }
			--Bounce; // no scattering event
			continue;
		}
#endif
#ifndef RADIANCE_CELLS
		if (Bounce >= MaxBounces) { return Radiance; }
#endif

		vec3 P = OffsetRayOrigin(Origin + Direction * Hit.Distance, Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
#ifdef HAS_DIFFUSE_TRANSMISSION
		SetBackStep(Scene, P, Hit.GeometricNormal, Hit.Distance);
#endif
		vec3 V = -Direction;
		mat3 Basis = MakeBasis(BendNormal(Hit.Normal, V));
		FBrdf Brdf = MakeBrdf(Hit);
		vec3 LocalV = V * Basis;
#ifdef RADIANCE_CELLS
#ifdef KEEPS_HIT
		bool bLooksUp = !(bLightsHits && bMirrored);
#else
		const bool bLooksUp = true;
#endif
		if (EndsInCells(Hit, Brdf, P, Basis, LocalV, Bounce, MaxBounces, bLooksUp, Throughput, Radiance, Random)) { return Radiance; }
#endif
#ifdef HAS_CHARACTERS
		bool bCharacter = (Hit.Flags & HIT_CHARACTER) != 0u;
#else
		const bool bCharacter = false;
#endif
#ifdef TINTED_SHADOWS
		PlaceVolume = Passages.Volume;
#endif
		NOTE_LIT(Bounce);
		uint Shows = bShown ? SHOWS_MIRRORED : SHOWS_NOTHING;
		Radiance += Throughput * SampleLights(Scene, Brdf, Basis, LocalV, P, Hit.GeometricNormal, bCharacter, Hit.Channels, Shows, Random);

		vec4 U = NextRandom4(Random);
		FBrdfSample Sample = SampleBrdf(Brdf, LocalV, U.xyz);
		if (Sample.Weight == vec3(0.0)) { return Radiance; }
		Throughput *= Sample.Weight;
#ifdef HAS_LIGHT_EMISSION
		Throughput *= ChooseShown(isinf(Sample.Pdf) ? vec3(Shows == SHOWS_MIRRORED) : ShownShare(Brdf, LocalV, Sample.Direction, Shows), U.w, bShown);
#endif
		Direction = Basis * Sample.Direction;
		if (!IsLitFrom(Brdf, Direction, Hit.GeometricNormal, Sample.Direction.z)) { return Radiance; }
		Pdf = bCharacter && !isinf(Sample.Pdf) ? 0.0 : Sample.Pdf; // see OtherPdf
		NdotL = abs(Sample.Direction.z) * SkyChance(Brdf, Sample.Direction.z);

		if (Bounce >= 3u && EndsByRoulette(Throughput, Random)) { return Radiance; }
		Channels = Hit.Channels;
		Origin = StartOfRay(P, Direction, Hit.GeometricNormal);
#ifdef HAS_TRANSMISSION
		ScatterPassages(Passages);
#endif
		SEES_HITS(bSeesHits && isinf(Sample.Pdf));
		if (isinf(Sample.Pdf)) { WidenRayCone(Hit.Distance); }
		else { RayCone = vec2(0.0); }
		Hit = TraceMaterial(Scene, MASK_VISIBLE, Origin, Direction, Infinity, bShown ? SHOWS_ALL : SHOWS_NOTHING);
#ifdef KEEPS_HIT
		bMirrored = bMirrored && isinf(Sample.Pdf) && SpecularProbability(Brdf, LocalV) >= 1.0; // else the choice is chance
		if (bMirrored) { KeepHit(Hit, Direction, Throughput, KeptHit.Distance); }
#ifdef NO_CAUSTICS
		bSeenInMirrors = bMirrored && bKeepsEmission;
#endif
#endif
	}
}

// What one lobe reflects at the first vertex of a path, and from where.
struct FGathered
{
	vec3 Light, Direction;            // of the path
	vec3 Emission, EmissionDirection; // of a triangle that light sampling has found; zero if there is none
#ifdef RADIANCE_CELLS
	float Gone; // part of itself by which Light was more a moment ago, see RadianceChange.glsl
#endif
#ifdef SHARED_PATHS
	vec3 Radiance;         // along Direction: Light is Share times it
	float Share, Distance; // Distance: to what the path met; below 0: the sky
#endif
};

// Gathers the indirect light that one lobe reflects at the first vertex of a path. It excludes the sun's disk and local
// lights that shine there directly; the lighting pass adds those. It includes the sky and emissive triangles.
// EMISSIVE_IS_DIRECT: local lights include emissive triangles that light sampling lists, which then count here as EmissionShare.glsl says.
// Lobe: MakeWhiteLambert or MakeSpecularLobe. U: chooses the direction. Other parameters: see PathLights.glsl.
// G-buffers do not say which pixels show a character, so the first vertex counts as none.
// Only the lobe samples the sky. Light sampling would reduce no noise of a uniform sky, and it knows no bright spots of a map.
FGathered Gather(FSceneConstants Scene, FBrdf Lobe, mat3 Basis, vec3 V, vec3 P, vec3 Ng, vec2 U, uint MaxBounces, inout FRandom Random)
{
	FGathered Gathered;
	Gathered.Light = Gathered.Emission = vec3(0.0);
	Gathered.Direction = Gathered.EmissionDirection = Ng;
#ifdef RADIANCE_CELLS
	LightGone = Gathered.Gone = 0.0;
#endif
#ifdef SHARED_PATHS
	Gathered.Radiance = vec3(0.0);
	Gathered.Share = 0.0;
	Gathered.Distance = -1.0;
#endif
#ifdef TINTED_SHADOWS
	PlaceVolume = Air(); // none is known at the first vertex
#endif
	if (MaxBounces == 0u) { return Gathered; }
	float Specular = SpecularProbability(Lobe, V); // 0 or 1
	if (Specular <= 0.0 && Lobe.Diffuse <= 0.0) { return Gathered; }
	float EmissionShare = 1.0;
#ifdef EMISSIVE_IS_DIRECT
	EmissionShare = Specular <= 0.0 ? 0.0 : EmissionOfRays(sqrt(Lobe.Alpha), REFLECTED_ROUGHNESS);
	uint Shows = SHOWS_ALL; // the rest is light sampling's
#else
	uint Shows = Specular <= 0.0 ? SHOWS_NOTHING : SHOWS_MIRRORED;
#endif
	bool bShown = false;
#ifdef HAS_LIGHT_EMISSION
	if (Specular > 0.0) { bShown = NextRandom4(Random).x < EmissionOfRays(sqrt(Lobe.Alpha), REFLECTED_ROUGHNESS); }
#endif
#ifdef HAS_EMISSIVE
	vec4 LightSample = NextRandom4(Random);
	if (EmissionShare > 0.0 && (Specular <= 0.0 || !IsMirror(Lobe)))
	{
		uint Casters = GatherMask == MASK_VISIBLE ? LocalCasters(false) : GatherMask; // as the path itself sees it
		Gathered.Emission = EmissionShare * SampleEmissive(Scene, Lobe, Basis, V, P, Ng, false, Casters, LightSample, true, Shows,
		                                                   Gathered.EmissionDirection);
	}
#endif
#ifdef MIXED_DIRECTIONS
	float CosineShare;
	FBrdfSample Sample = SampleDirection(Basis, V, U, CosineShare);
#ifdef RADIANCE_CELLS
	// Cells average over the places that vote. These must be spread as the cosine spreads them.
	if (NextRandom4(Random).x >= Sample.Weight.x * CosineShare) { RadianceVoter.Note = FAddress(0); }
#endif
#else
	FBrdfSample Sample = SampleBrdf(Lobe, V, vec3(U, 0.5));
#endif
	vec3 Direction = Gathered.Direction = Basis * Sample.Direction;
	if (Sample.Direction.z <= 0.0 || dot(Direction, Ng) <= 0.0) { return Gathered; }
	SEES_HITS(true);
	RayCone = FirstRayCone;
	FMaterialHit Hit = TraceMaterial(Scene, GatherMask, P, Direction, Infinity, bShown ? SHOWS_ALL : SHOWS_NOTHING);
	NOTE_END(PATH_END_SKY);
	vec3 Radiance = vec3(0.0);
#ifdef SHARED_PATHS
	Gathered.Share = Sample.Weight.x;
	Gathered.Distance = Hit.Distance;
#endif
#ifdef PATH_RESERVOIRS
	KeptNormal = Hit.GeometricNormal;
	bSameFromAll = Hit.Distance < 0.0 || Hit.Roughness >= LeastCellRoughness;
#if defined(HAS_EMISSIVE) && !defined(EMISSIVE_IS_DIRECT) // its weight is that of one pixel's density
	bSameFromAll = bSameFromAll && (Hit.Distance < 0.0 || Hit.EmissiveWeight <= 0.0);
#endif
#ifdef HAS_TRANSMISSION
	bSameFromAll = bSameFromAll && (Hit.Distance < 0.0 || Hit.Transmission <= 0.0);
#endif
#endif
	if (Hit.Distance < 0.0)
	{
#ifdef HAS_SKY
		Radiance = SampleSkyRadiance(Scene, Direction);
#endif
	}
	else
	{
#if defined(HAS_LIGHT_EMISSION) && defined(EMISSIVE_IS_DIRECT)
		EmissionShare = bShown ? 1.0 : 0.0; // their mean is the share
#endif
		if (Hit.EmissiveWeight > 0.0) { Hit.Emissive *= EmissionShare; }
#ifdef HAS_TRANSMISSION
		FirstEmissionShare = EmissionShare; // also of what lies behind glass
#endif
#ifdef KEEPS_HIT
		KeepHit(Hit, Direction, vec3(1.0), 0.0);
#endif
		Radiance = FollowPath(Scene, Hit, P, Direction, Sample.Pdf, Sample.Direction.z, 1u, MaxBounces, bShown, Random);
#ifdef AUDITS_CELLS
		Radiance = SettleAnswer(Radiance, Luminance(Sample.Weight));
#endif
	}
	Gathered.Light = Sample.Weight * Radiance;
#ifdef RADIANCE_CELLS
	float Gone = LightGone / max(Luminance(Radiance), 1.0e-30);
	Gathered.Gone = isnan(Gone) || isinf(Gone) ? 0.0 : clamp(Gone, -1.0, MostGone);
#endif
#ifdef SHARED_PATHS
	Gathered.Radiance = Radiance;
#endif
	return Gathered;
}

vec3 GatherIndirect(FSceneConstants Scene, FBrdf Lobe, mat3 Basis, vec3 V, vec3 P, vec3 Ng, vec2 U, uint MaxBounces, inout FRandom Random)
{
	FGathered Gathered = Gather(Scene, Lobe, Basis, V, P, Ng, U, MaxBounces, Random);
	return Gathered.Light + Gathered.Emission;
}

#endif
