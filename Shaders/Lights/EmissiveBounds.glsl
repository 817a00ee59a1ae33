// Where the emissive triangles of a cluster lie, and to which side they shine. A work group finds it; all its threads call MeasureCluster.
#ifndef LANTERN_EMISSIVE_BOUNDS_GLSL
#define LANTERN_EMISSIVE_BOUNDS_GLSL

const float FlatCosine = 1.0 - 1.0e-6; // of the angle between normals that count as one

shared vec3 Lows[EMISSIVE_GROUP_SIZE], Highs[EMISSIVE_GROUP_SIZE], Normals[EMISSIVE_GROUP_SIZE];
shared float Areas[EMISSIVE_GROUP_SIZE];
shared vec2 Flats[EMISSIVE_GROUP_SIZE]; // least cosine to the mean normal, and least place along it

// What a thread knows of its triangles, and after JoinSides the group of all.
struct FSides
{
	vec3 Low, High; // of the box
	vec3 Normal;    // mean, by share
	float Area;
};

// Returns the normal of the side that shines; 0: both do.
vec3 ShiningNormal(FSceneConstants Scene, FEmissiveTriangle Triangle, out float Area)
{
	vec3 Cross = cross(Triangle.P1 - Triangle.P0, Triangle.P2 - Triangle.P0);
	float Doubled = length(Cross);
	Area = 0.5 * Doubled;
	if ((FSectionRef(Scene.Sections).Data[Triangle.Section].Flags & SECTION_DOUBLE_SIDED) != 0u) { return vec3(0.0); }
	return Cross / max(Doubled, 1.0e-30) * ((Triangle.Flags & OBJECT_MIRRORED) != 0u ? -1.0 : 1.0);
}

// Share: of the cluster's power.
void AddSide(FSceneConstants Scene, FEmissiveTriangle Triangle, float Share, inout FSides Sides)
{
	float Area;
	Sides.Normal += ShiningNormal(Scene, Triangle, Area) * Share;
	Sides.Area += Area;
	Sides.Low = min(Sides.Low, min(Triangle.P0, min(Triangle.P1, Triangle.P2)));
	Sides.High = max(Sides.High, max(Triangle.P0, max(Triangle.P1, Triangle.P2)));
}

FSides JoinSides(FSides Mine, uint Place)
{
	Lows[Place] = Mine.Low;
	Highs[Place] = Mine.High;
	Normals[Place] = Mine.Normal;
	Areas[Place] = Mine.Area;
	barrier();
	FSides All = FSides(Mine.Low, Mine.High, vec3(0.0), 0.0);
	for (uint I = 0u; I < EMISSIVE_GROUP_SIZE; ++I)
	{
		All.Low = min(All.Low, Lows[I]);
		All.High = max(All.High, Highs[I]);
		All.Normal += Normals[I];
		All.Area += Areas[I];
	}
	return All;
}

// Mine: AddSide of the triangles at Place, Place + EMISSIVE_GROUP_SIZE and so on, which the thread has written.
FEmitterCluster MeasureCluster(FSceneConstants Scene, FEmissiveCluster Cluster, FSides Mine, float Power, uint Place)
{
	FSides All = JoinSides(Mine, Place);
	vec3 Axis = NormalizeOr(All.Normal, vec3(0.0));
	vec2 Flat = vec2(1.0, 1.0e30);
	FTrianglesRef Triangles = FTrianglesRef(Scene.EmissiveTriangles);
	for (uint I = Place; I < Cluster.Count; I += EMISSIVE_GROUP_SIZE)
	{
		FEmissiveTriangle Triangle = Triangles.Data[Cluster.First + I];
		float Area;
		Flat.x = min(Flat.x, dot(ShiningNormal(Scene, Triangle, Area), Axis));
		Flat.y = min(Flat.y, min(dot(Triangle.P0, Axis), min(dot(Triangle.P1, Axis), dot(Triangle.P2, Axis))));
	}
	Flats[Place] = Flat;
	barrier();
	for (uint I = 0u; I < EMISSIVE_GROUP_SIZE; ++I) { Flat = min(Flat, Flats[I]); }
	FEmitterCluster Out;
	Out.Center = 0.5 * (All.Low + All.High);
	Out.Power = Power;
	Out.Half = 0.5 * (All.High - All.Low);
	Out.Area = All.Area;
	// Only flat ones have length 1.
	Out.Normal = Flat.x >= FlatCosine ? Axis : All.Normal * min(1.0, 0.99 / max(length(All.Normal), 1.0e-6));
	Out.Plane = Flat.y;
	Out.First = Cluster.First;
	Out.Count = Cluster.Count;
	Out.Pad0 = Out.Pad1 = 0u;
	return Out;
}

#endif
