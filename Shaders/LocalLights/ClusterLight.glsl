// About what a cluster of emissive triangles brings to a place.
#ifndef LANTERN_CLUSTER_LIGHT_GLSL
#define LANTERN_CLUSTER_LIGHT_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"

bool IsFlat(FEmitterCluster Cluster) { return dot(Cluster.Normal, Cluster.Normal) > 0.999; }

// Returns the distance from a box to the cluster's, squared.
float BoxDistance(FEmitterCluster Cluster, vec3 Low, vec3 High)
{
	vec3 Outside = max(max(Low - (Cluster.Center + Cluster.Half), (Cluster.Center - Cluster.Half) - High), vec3(0.0));
	return dot(Outside, Outside);
}

// Returns what the cluster brings to a plane that faces it, about, at a distance from its box, at its best angle. No light covers more
// than a hemisphere, which brings π times the radiance.
float ClusterIrradiance(FEmitterCluster Cluster, float DistanceSquared)
{
	return Cluster.Power * min(1.0 / max(DistanceSquared, 1.0e-12), Pi / max(Cluster.Area, 1.0e-12));
}

// Returns what the cluster brings to a plane that faces it, about, at places up to Reach metres from P. Luminance.
float ClusterToward(FEmitterCluster Cluster, vec3 P, float Reach)
{
	vec3 To = Cluster.Center - P;
	float Radius = length(Cluster.Half), Distance = max(length(To), 1.0e-4), Coherent = length(Cluster.Normal);
	float Before = IsFlat(Cluster) ? dot(Cluster.Normal, P) - Cluster.Plane : -dot(Cluster.Normal, To);
	if (IsFlat(Cluster) && Before + Reach <= 0.0) { return 0.0; }
	// A closed surface shows a quarter of its area, a flat one what its angle leaves.
	float Facing = max(clamp((Before + Coherent * Reach) / Distance, 0.0, Coherent) + 0.25 * (1.0 - Coherent), 0.05);
	float Near = max(sqrt(BoxDistance(Cluster, P, P)) - Reach, 0.3 * Reach), DistanceSquared = Near * Near + 0.25 * Radius * Radius;
	return ClusterIrradiance(Cluster, DistanceSquared / Facing);
}

#endif
