// Finds where the emissive triangles of a cluster lie and how much each shines, from the vertices that rays meet in this frame, and the
// bounds of the cluster. A work group does one cluster, whose sums have the same order in each frame.
// NO_FLOOR (r.RT.Debug.Lights.EmissiveFloor): chances go by power alone.
#version 460
#include "../Shared/EmissiveTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"
#include "../Library/Sampling.glsl"
#include "../Materials/Standard.glsl"
#include "../Rays/MaterialPayload.glsl"
#include "EmissiveShares.glsl"

layout(local_size_x = EMISSIVE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FEmissiveConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FClusterListRef { uint Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FTrianglesRef { FEmissiveTriangle Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer FPowersRef
{
	FEmissivePowerHeader Header;
	FEmissivePower Data[];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer FBoundsRef { FEmitterCluster Data[]; };

#include "EmissiveBounds.glsl"

shared float Powers[EMISSIVE_GROUP_SIZE];
shared uint Counts[EMISSIVE_GROUP_SIZE];

// Returns the mean emission's weight over points of a triangle (R2 sequence, Roberts 2018). The mean over the whole texture stays a part
// of it, since points may miss what is small.
float MeanWeight(FMaterialData Material, FSectionData Section, uint Primitive)
{
	bool bCut = (Material.Flags & MATERIAL_MASKED) != 0u;
	if (!bCut && !HasTexture(Material, TEXTURE_EMISSIVE)) { return Material.EmissiveWeight; }
	float Sum = 0.0;
	[[dont_unroll]] for (uint I = 0u; I < EMISSIVE_TEXTURE_POINTS; ++I)
	{
		vec2 U = fract(vec2(0.5) + float(I) * vec2(0.7548776662, 0.5698402910));
		FMaterialInputs Inputs = FetchTextureInputs(Section, Primitive, SampleTriangle(U));
		if (bCut && IsCutAway(Material, Inputs)) { continue; }
		Sum += Luminance(min(EvaluateLightEmission(Material, Inputs), vec3(MaxEmission)));
	}
	return mix(Material.EmissiveWeight, Sum * EmissionScale / float(EMISSIVE_TEXTURE_POINTS), 0.75);
}

FEmissiveTriangle FindTriangle(FSceneConstants Scene, FEmissiveCluster Cluster, uint Index)
{
	FEmissiveRangeRef Ranges = FEmissiveRangeRef(Scene.EmissiveRanges);
	uint Range = Cluster.Range;
	while (Ranges.Data[Range + 1u].First <= Index) { ++Range; }
	FObjectData Object = FObjectRef(Scene.Objects).Data[Cluster.Object];
	FEmissiveTriangle Triangle;
	Triangle.Object = Cluster.Object;
	Triangle.Section = Ranges.Data[Range].Section;
	Triangle.Primitive = Index - Ranges.Data[Range].First;
	Triangle.Flags = Object.Flags & OBJECT_MIRRORED;
	FSectionData Section = FSectionRef(Scene.Sections).Data[Triangle.Section];
	vec3 P0, P1, P2;
	FetchPositions(Section, Triangle.Primitive, P0, P1, P2);
	Triangle.P0 = vec4(P0, 1.0) * mat3x4(Object.ObjectToWorld[0], Object.ObjectToWorld[1], Object.ObjectToWorld[2]);
	Triangle.P1 = vec4(P1, 1.0) * mat3x4(Object.ObjectToWorld[0], Object.ObjectToWorld[1], Object.ObjectToWorld[2]);
	Triangle.P2 = vec4(P2, 1.0) * mat3x4(Object.ObjectToWorld[0], Object.ObjectToWorld[1], Object.ObjectToWorld[2]);
	float Area = 0.5 * length(cross(Triangle.P1 - Triangle.P0, Triangle.P2 - Triangle.P0));
	bool bShines = Area > 0.0 && Area < 1.0e30; // false where vertices are no numbers
	Triangle.Power = bShines ? Area * MeanWeight(FMaterialRef(Scene.Materials).Data[Section.Material], Section, Triangle.Primitive) : 0.0;
	return Triangle;
}

void main()
{
	uint Item = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
	if (Item >= Push.Count) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Index = Push.Clusters != 0ul ? FClusterListRef(Push.Clusters).Data[Item] : Item, Place = gl_LocalInvocationIndex;
	FEmissiveCluster Cluster = FEmissiveClusterRef(Scene.EmissiveClusters).Data[Index];
	FTrianglesRef Triangles = FTrianglesRef(Scene.EmissiveTriangles);
	float Power = 0.0;
	uint Count = 0u;
	for (uint I = Place; I < Cluster.Count; I += EMISSIVE_GROUP_SIZE)
	{
		FEmissiveTriangle Triangle = FindTriangle(Scene, Cluster, Cluster.First + I);
		Triangle.Cluster = Index;
		Triangle.ClusterShare = 1.0;
		Triangles.Data[Cluster.First + I] = Triangle;
		Power += Triangle.Power;
		Count += Triangle.Power > 0.0 ? 1u : 0u;
	}
	Powers[Place] = Power;
	Counts[Place] = Count;
	barrier();
	Power = 0.0;
	Count = 0u;
	for (uint I = 0u; I < EMISSIVE_GROUP_SIZE; ++I)
	{
		Power += Powers[I];
		Count += Counts[I];
	}
	float Before = 0.0;
	FSides Sides = FSides(vec3(1.0e30), vec3(-1.0e30), vec3(0.0), 0.0);
	for (uint First = 0u; First < Cluster.Count; First += EMISSIVE_GROUP_SIZE)
	{
		barrier();
		uint I = First + Place;
		Powers[Place] = I < Cluster.Count ? ShareOf(Triangles.Data[Cluster.First + I].Power, Power, Count) : 0.0;
		if (I < Cluster.Count) { AddSide(Scene, Triangles.Data[Cluster.First + I], Powers[Place], Sides); }
		barrier();
		float Share = Before;
		for (uint J = 0u; J < EMISSIVE_GROUP_SIZE; ++J)
		{
			Before += Powers[J];
			Share = J <= Place ? Before : Share;
		}
		if (I < Cluster.Count) { Triangles.Data[Cluster.First + I].ClusterShare = I + 1u < Cluster.Count ? min(Share, 1.0) : 1.0; }
	}
	FEmitterCluster Bounds = MeasureCluster(Scene, Cluster, Sides, Power, Place);
	if (Place != 0u) { return; }
	FPowersRef(Scene.EmissivePowers).Data[Index].Power = Power;
	FBoundsRef(Scene.EmissiveBounds).Data[Index] = Bounds;
}
