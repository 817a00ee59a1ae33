// Where a cluster of emissive triangles lies, and about what it brings to a place.
#ifndef LANTERN_CLUSTER_LIGHT_GLSL
#define LANTERN_CLUSTER_LIGHT_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"

bool IsFlat(FEmitterCluster Cluster) { return dot(Cluster.Normal, Cluster.Normal) > 0.999; }

// Offset: CellOffset of the cluster's object.
FEmitterCluster MoveCluster(FEmitterCluster Cluster, vec3 Offset)
{
	Cluster.Center += Offset;
	Cluster.Plane += dot(Cluster.Normal, Offset);
	return Cluster;
}

// Returns what the cluster brings to a plane that faces it, about, at a distance from its box, at its best angle. No light covers more
// than a hemisphere, which brings π times the radiance.
float ClusterIrradiance(FEmitterCluster Cluster, float DistanceSquared)
{
	return Cluster.Power * min(1.0 / max(DistanceSquared, 1.0e-12), Pi / max(Cluster.Area, 1.0e-12));
}

#endif
