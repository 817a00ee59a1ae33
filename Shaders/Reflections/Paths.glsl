// Reflections of listed pixels: a path through the specular lobe of each. Smooth surfaces show what they mirror by light sampling, and
// further surfaces by radiance cells; rough ones show cells. The ray-tracing pipeline and the ray-query path share it.
// RADIANCE_CELLS: there are cells. Else paths go on for as many bounces as they may.
// COUNTS_ENDS: what becomes of paths is counted. NO_RAY_CONES: see RayCone.glsl.
// HAS_SUN, HAS_SKY, HAS_LIGHTS, HAS_EMISSIVE, HAS_MASKED: defined if the scene has such.
#ifndef LANTERN_REFLECTION_PATHS_GLSL
#define LANTERN_REFLECTION_PATHS_GLSL

#define KEEPS_HIT
float EmissionRoughness; // the thread sets it before
#define REFLECTED_ROUGHNESS EmissionRoughness
#include "../Shared/DenoiseTypes.h"
#include "../Shared/ReflectionTypes.h"
#include "../Library/Rgbe.glsl"
#include "../Library/UintTextures.glsl"
#include "../Rays/IndirectSampling.glsl"
#include "../Rays/ThreadList.glsl"
#include "Fade.glsl"

layout(push_constant, scalar) uniform FPush { FReflectionPathConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FReflectionHitRef { FReflectionHit Data[]; };

#ifdef COUNTS_ENDS // r.RT.Rays.CountEnds
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FReflectionStatisticsRef { FReflectionStatistics Data; };

void CountEnd()
{
	if (Push.Statistics == FAddress(0)) { return; }
	FReflectionStatisticsRef Counts = FReflectionStatisticsRef(Push.Statistics);
	atomicAdd(Counts.Data.Ends[PathEnd], 1u);
	if (bPathLit) { atomicAdd(Counts.Data.Lit, 1u); }
	PathEnd = PATH_END_NONE;
	bPathLit = false;
}

void CountPixel(bool bMirror, bool bSharp)
{
	if (Push.Statistics == FAddress(0)) { return; } // a variant from before the variable was switched off
	FReflectionStatisticsRef Counts = FReflectionStatisticsRef(Push.Statistics);
	if (bMirror) { atomicAdd(Counts.Data.Mirrors, 1u); }
	else if (bSharp) { atomicAdd(Counts.Data.Sharp, 1u); }
	else { atomicAdd(Counts.Data.Wide, 1u); }
}

void CountFurther(uint Paths)
{
	if (Push.Statistics == FAddress(0)) { return; }
	atomicAdd(FReflectionStatisticsRef(Push.Statistics).Data.Further, Paths);
}
#endif

// Returns how many further paths the pixel gets. Chance decides on parts of one.
uint GetFurtherSamples(FViewConstants View, uint Thread)
{
	float All = float(FThreadListRef(Push.FirstList).Header.Launch[0]), Asking = float(FThreadListRef(Push.List).Header.Launch[0]);
	float Chance = float(HashPcg(Thread + HashPcg(View.FrameIndex + HashPcg(View.Seed))) >> 8u) * (1.0 / 16777216.0);
	return min(uint(min(float(Push.SamplesPerPixel), Push.FurtherPaths * All / Asking) + Chance), Push.SamplesPerPixel);
}

// Joins the mean of further paths with that of the first ones. What the filter could not hold is that of the first ones.
void JoinFirst(ivec2 Pixel, vec3 Radiance, uint Samples)
{
	float Sum = float(Push.FirstSamples + Samples);
	vec3 First = imageLoad(Images[Push.Radiance], Pixel).rgb;
	Radiance = (First * float(Push.FirstSamples) + Radiance * float(Samples)) / Sum;
	imageStore(Images[Push.Radiance], Pixel, RoundToHalf(vec4(Radiance, CHANCE_OF_SEVERAL + Sum / float(Push.FirstSamples))));
}

// Number: of the launch's thread.
void ReflectPixel(uint Number)
{
	uint Thread;
	if (!FindThread(Push.List, Number, Thread)) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	ivec2 Pixel = ivec2(Thread % View.Width, Thread / View.Width);
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, LoadDepth(Push.Pixels.Depth, Pixel));
	vec4 Material = texelFetch(Textures[Push.Pixels.Material], Pixel, 0);
	FBrdf Lobe = MakeSpecularLobe(MakeGBufferBrdf(texelFetch(Textures[Push.Pixels.BaseColor], Pixel, 0), Material));
	bool bMirror = IsMirror(Lobe);
	KeptHit = NothingKept;
	bLightsHits = Material.x < Push.LitRoughness;
	bKeepsEmission = bMirror;
	EmissionRoughness = Push.EmissionRoughness;
	FirstRayCone = MakePixelCone(View, dot(View.CameraForward, Point.Relative), bMirror ? 0.0 : Lobe.Alpha);
	bool bFurther = Push.FirstSamples > 0u;
	uint Samples = bFurther ? GetFurtherSamples(View, Thread) : Push.SamplesPerPixel;
	if (Samples == 0u) { return; }
#ifdef COUNTS_ENDS
	if (bFurther) { CountFurther(Samples); }
	else { CountPixel(bMirror, bLightsHits); }
#endif
#ifdef RADIANCE_CELLS
	BeginPixelLookUps(Push.RadianceCells, View, uvec2(Pixel), Push.FirstVoter);
	if (bFurther) { RadianceVoter.Note = FAddress(0); } // the first path has voted
	if (Push.RadianceCells != FAddress(0)) { RadianceNear = FRadianceGridRef(Push.RadianceCells).Data.NearCells; }
#endif
	// Numbers of further samples differ from frame to frame, and with them the places in a sequence.
	uint Salt = bFurther ? HashPcg(View.FrameIndex ^ 0x85ebca6bu) : 0x9e3779b9u;
	vec3 Radiance = AverageIndirectSamples(Scene, View, uvec2(Pixel), Point, Lobe, Samples, Push.MaxBounces, Salt);
	float NdotV = dot(Point.BentN, Point.V);
	vec3 Albedo = LobeAlbedo(Lobe, NdotV, Material.x);
	Radiance /= Albedo;
	if (bMirror)
	{
		// The filter gets what the mirrored surface receives, as it does elsewhere. Its texture is shown as it is.
		vec3 Least = vec3(MaxComponent(KeptHit.Albedo) / 128.0); // smaller ones would be packed as 0
		uint Packed = PackRgbe(max(KeptHit.Albedo, Least), vec3(0.5));
		vec3 Mirrored = UnpackRgbe(Packed), Emission = KeptHit.Emission * SpecularFresnel(Lobe, NdotV) / Albedo;
		Radiance /= Mirrored;
		Emission += max(Radiance - MaxHalf, vec3(0.0)) * Mirrored; // what the filter could not hold
		if (!bFurther) { imageStore(UintImages[Push.Mirrored], Pixel, uvec4(Packed, PackRgbe(min(Emission, vec3(1.0e9)), vec3(0.5)), 0u, 0u)); }
	}
	if (bFurther)
	{
		JoinFirst(Pixel, ClampToFinite(Radiance), Samples);
		return;
	}
	bool bNoise = !bMirror || KeptHit.Distance >= 0.0; // a mirror shows the sky as it is
	imageStore(Images[Push.Radiance], Pixel, RoundToHalf(vec4(ClampToFinite(Radiance), bNoise ? CHANCE_SOME : CHANCE_NONE)));
	FReflectionHitRef(Push.Hits).Data[Number] = FReflectionHit(KeptHit.Distance, PackOct(KeptHit.Normal), KeptHit.Object);
}

#endif
