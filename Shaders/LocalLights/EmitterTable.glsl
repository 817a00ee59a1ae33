// What clusters of emissive triangles may bring to a box of surfaces, and which triangle of one a pixel takes.
#ifndef LANTERN_EMITTER_TABLE_GLSL
#define LANTERN_EMITTER_TABLE_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"
#include "ClusterLight.glsl"
#include "LightBox.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FEmitterHeaderRef { FEmitterHeader Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FEmitterRef { FEmitterCluster Data[]; };

const uint SizeOfEmitterHeader = 16u, SizeOfCluster = 64u; // bytes

FEmitterCluster LoadCluster(FAddress Emitters, uint Entry) { return FEmitterRef(Emitters + SizeOfEmitterHeader).Data[Entry & ~LIGHT_TRIANGLE]; }

// Returns FLightRegion[] of clusters, row by row, behind the clusters. 0: they are so few that tiles look at all.
FAddress EmitterRegions(FSceneConstants Scene, FAddress Emitters)
{
	return Scene.EmissiveClusterCount > REGION_EMITTERS ? Emitters + SizeOfEmitterHeader + Scene.EmissiveClusterCount * SizeOfCluster : FAddress(0);
}

// See EmissionOfRays.
float ReflectedRoughness(FAddress Emitters) { return Emitters != FAddress(0) ? FEmitterHeaderRef(Emitters).Data.ReflectedRoughness : 0.0; }

// Returns how bright what a pixel reflects of emitters must be for it to ask for a ray in each frame, as a share of white as the picture is
// exposed.
float DimEmitter(FAddress Emitters) { return max(FEmitterHeaderRef(Emitters).Data.Dim, 1.0e-20); }

// Returns the distance from a box to the cluster's, squared.
float BoxDistance(FEmitterCluster Cluster, vec3 Low, vec3 High)
{
	vec3 Outside = max(max(Low - (Cluster.Center + Cluster.Half), (Cluster.Center - Cluster.Half) - High), vec3(0.0));
	return dot(Outside, Outside);
}

// Whether the cluster may light a box: some of the box is before it. The slack is for what rounding tilts a plane by.
bool MayReachFromCluster(FEmitterCluster Cluster, vec3 Low, vec3 High)
{
	if (Cluster.Power <= 0.0) { return false; } // its material is dark for now
	if (!IsFlat(Cluster)) { return true; }
	vec3 Middle = 0.5 * (Low + High);
	float Highest = dot(Cluster.Normal, Middle) + dot(abs(Cluster.Normal), 0.5 * (High - Low));
	float Slack = 0.002 * (length(Middle - Cluster.Center) + length(High - Low) + length(Cluster.Half)) + 1.0e-4;
	return Highest + Slack > Cluster.Plane;
}

// Returns about the most that the cluster brings to a plane at any pixel, and never 0.
float BoundCluster(FEmitterCluster Cluster, vec3 Low, vec3 High)
{
	float DistanceSquared = BoxDistance(Cluster, Low, High);
	vec3 Edges = High - Low;
	float Diagonal = dot(Edges, Edges);
	if (DistanceSquared < 0.25 * Diagonal) // the box may be deep, with the cluster before what lies behind
	{
		float Nearest = Diagonal + DistanceSquared;
		[[dont_unroll]] for (uint I = 0u; I < BoxPoints; ++I)
		{
			vec3 P = BoxSamples[I].xyz;
			float Size = BoxSamples[I].w;
			Nearest = Size > 0.0 ? min(Nearest, max(BoxDistance(Cluster, P, P), Size * Size)) : Nearest;
		}
		DistanceSquared = max(DistanceSquared, Nearest);
	}
	return ClusterIrradiance(Cluster, DistanceSquared);
}

// Returns about the most that the cluster brings to the pixels that a sampler stands for.
float EstimateCluster(FEmitterCluster Cluster, vec3 P, vec3 N, float Reach)
{
	vec3 To = Cluster.Center - P;
	float Radius = length(Cluster.Half), Height = dot(To, N) + Radius + Reach;
	if (Height <= 0.0) { return 0.0; }
	float Distance = max(length(To), 1.0e-4), Coherent = length(Cluster.Normal);
	float Before = IsFlat(Cluster) ? dot(Cluster.Normal, P) - Cluster.Plane : -dot(Cluster.Normal, To);
	if (IsFlat(Cluster) && Before + Reach <= 0.0) { return 0.0; }
	// A closed surface shows a quarter of its area, a flat one what its angle leaves.
	float Facing = max(clamp((Before + Coherent * Reach) / Distance, 0.0, Coherent) + 0.25 * (1.0 - Coherent), 0.05);
	float Near = max(sqrt(BoxDistance(Cluster, P, P)) - Reach, 0.3 * Reach), DistanceSquared = Near * Near + 0.25 * Radius * Radius;
	return ClusterIrradiance(Cluster, DistanceSquared / Facing) * clamp(Height / Distance, 0.1, 1.0);
}

// Chooses a triangle of a cluster by power. X: uniform, in [0, 1). OutChance: with which it is chosen.
uint ChooseTriangle(FSceneConstants Scene, FEmitterCluster Cluster, float X, out float OutChance)
{
	FEmissiveRef Triangles = FEmissiveRef(Scene.EmissiveTriangles);
	uint First = Cluster.First, Last = Cluster.First + Cluster.Count - 1u;
	[[dont_unroll]] while (First < Last)
	{
		uint Middle = (First + Last) >> 1u;
		if (Triangles.Data[Middle].ClusterShare > X) { Last = Middle; }
		else { First = Middle + 1u; }
	}
	OutChance = Triangles.Data[First].ClusterShare - (First > Cluster.First ? Triangles.Data[First - 1u].ClusterShare : 0.0);
	return First;
}

#endif
