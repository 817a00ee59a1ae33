// Finds where each cluster of emissive triangles lies in this frame, and to which side it shines. A work group does one.
#version 460
#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"

layout(local_size_x = EMITTER_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FEmitterClustersConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer FOutRef
{
	FEmitterHeader Header;
	FEmitterCluster Data[];
};

const float FlatCosine = 1.0 - 1.0e-6; // of the angle between normals that count as one

shared vec3 Lows[EMITTER_GROUP_SIZE], Highs[EMITTER_GROUP_SIZE], Normals[EMITTER_GROUP_SIZE];
shared float Areas[EMITTER_GROUP_SIZE];
shared vec2 Flats[EMITTER_GROUP_SIZE]; // least cosine to the mean normal, and least place along it

struct FCorners
{
	vec3 A, B, C; // relative to the scene's origin
	vec3 Normal;  // of the side that shines; 0: both do
	float Area;
};

FCorners LoadCorners(FSceneConstants Scene, FEmissiveTriangle Triangle)
{
	vec3 Offset = CellOffset(Scene, FObjectRef(Scene.Objects).Data[Triangle.Object].Cell);
	vec3 Cross = cross(Triangle.P1 - Triangle.P0, Triangle.P2 - Triangle.P0);
	float Doubled = length(Cross);
	vec3 Normal = Cross / max(Doubled, 1.0e-30) * ((Triangle.Flags & OBJECT_MIRRORED) != 0u ? -1.0 : 1.0);
	if ((FSectionRef(Scene.Sections).Data[Triangle.Section].Flags & SECTION_DOUBLE_SIDED) != 0u) { Normal = vec3(0.0); }
	return FCorners(Triangle.P0 + Offset, Triangle.P1 + Offset, Triangle.P2 + Offset, Normal, 0.5 * Doubled);
}

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FEmissiveRef Triangles = FEmissiveRef(Scene.EmissiveTriangles);
	FEmissiveCluster Cluster = FEmissiveClusterRef(Scene.EmissiveClusters).Data[gl_WorkGroupID.x];
	uint Place = gl_LocalInvocationIndex;
	vec3 Low = vec3(1.0e30), High = vec3(-1.0e30), Normal = vec3(0.0);
	float Area = 0.0;
	for (uint I = Place; I < Cluster.Count; I += EMITTER_GROUP_SIZE)
	{
		FEmissiveTriangle Triangle = Triangles.Data[Cluster.First + I];
		float Share = Triangle.ClusterShare - (I > 0u ? Triangles.Data[Cluster.First + I - 1u].ClusterShare : 0.0);
		FCorners Corners = LoadCorners(Scene, Triangle);
		Low = min(Low, min(Corners.A, min(Corners.B, Corners.C)));
		High = max(High, max(Corners.A, max(Corners.B, Corners.C)));
		Normal += Corners.Normal * Share;
		Area += Corners.Area;
	}
	Lows[Place] = Low;
	Highs[Place] = High;
	Normals[Place] = Normal;
	Areas[Place] = Area;
	barrier();
	Normal = vec3(0.0);
	Area = 0.0;
	for (uint I = 0u; I < EMITTER_GROUP_SIZE; ++I)
	{
		Low = min(Low, Lows[I]);
		High = max(High, Highs[I]);
		Normal += Normals[I];
		Area += Areas[I];
	}
	vec3 Axis = NormalizeOr(Normal, vec3(0.0));
	vec2 Flat = vec2(1.0, 1.0e30);
	for (uint I = Place; I < Cluster.Count; I += EMITTER_GROUP_SIZE)
	{
		FCorners Corners = LoadCorners(Scene, Triangles.Data[Cluster.First + I]);
		Flat.x = min(Flat.x, dot(Corners.Normal, Axis));
		Flat.y = min(Flat.y, min(dot(Corners.A, Axis), min(dot(Corners.B, Axis), dot(Corners.C, Axis))));
	}
	Flats[Place] = Flat;
	barrier();
	if (Place != 0u) { return; }
	for (uint I = 0u; I < EMITTER_GROUP_SIZE; ++I) { Flat = min(Flat, Flats[I]); }
	bool bFlat = Flat.x >= FlatCosine;
	FEmitterCluster Out;
	Out.Center = 0.5 * (Low + High);
	Out.Power = FEmissivePowerRef(Scene.EmissivePowers).Data[gl_WorkGroupID.x].Power;
	Out.Half = 0.5 * (High - Low);
	Out.Area = Area;
	Out.Normal = bFlat ? Axis : Normal * min(1.0, 0.99 / max(length(Normal), 1.0e-6)); // only flat ones have length 1
	Out.Plane = Flat.y;
	Out.First = Cluster.First;
	Out.Count = Cluster.Count;
	Out.Pad0 = Out.Pad1 = 0u;
	FOutRef(Push.Clusters).Data[gl_WorkGroupID.x] = Out;
	if (gl_WorkGroupID.x == 0u) { FOutRef(Push.Clusters).Header = FEmitterHeader(Push.ReflectedRoughness, uint[3](0u, 0u, 0u)); }
}
