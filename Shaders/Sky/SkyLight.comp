// Projects the sky's radiance onto spherical harmonics, and turns it into light that a Lambert surface reflects: its irradiance
// divided by π (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps").
#version 460
#include "../Shared/SkyLightTypes.h"
#include "../Library/SkyMap.glsl"
#include "../Library/SphericalHarmonics.glsl"

layout(local_size_x = SKY_LIGHT_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSkyLightConstants Push; };

// Directions on an octahedral grid of SKY_LIGHT_GROUP_SIZE in each direction. One that lies between many texels of a map without
// mips may miss a small bright spot; the sun is none of it.
shared vec4 Sums[SKY_LIGHT_GROUP_SIZE];

// Solid angle of a cell of the grid, up to a factor: the octahedron's face lies at 1 / sqrt(3).
float CellWeight(vec3 OnOctahedron) { return 1.0 / pow(dot(OnOctahedron, OnOctahedron), 1.5); }

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Lane = gl_LocalInvocationID.x;
	vec3 Terms[SKY_LIGHT_TERMS];
	for (int Term = 0; Term < SKY_LIGHT_TERMS; ++Term) { Terms[Term] = vec3(0.0); }
	float Weights = 0.0;
	for (uint Column = 0; Column < SKY_LIGHT_GROUP_SIZE; ++Column)
	{
		vec2 E = (vec2(Column, Lane) + 0.5) * (2.0 / SKY_LIGHT_GROUP_SIZE) - 1.0;
		vec3 Direction = OctDecode(E);
		float Weight = CellWeight(Direction / (abs(Direction.x) + abs(Direction.y) + abs(Direction.z)));
		float Basis[9] = EvaluateHarmonics(Direction);
		vec3 Radiance = Weight * SampleSkyRadiance(Scene, Direction);
		for (int Term = 0; Term < SKY_LIGHT_TERMS; ++Term) { Terms[Term] += Basis[Term] * Radiance; }
		Weights += Weight;
	}
	for (int Term = 0; Term < SKY_LIGHT_TERMS; ++Term)
	{
		Sums[Lane] = vec4(Terms[Term], Weights);
		barrier();
		for (uint Stride = SKY_LIGHT_GROUP_SIZE / 2; Stride > 0u; Stride /= 2u)
		{
			if (Lane < Stride) { Sums[Lane] += Sums[Lane + Stride]; }
			barrier();
		}
		float Band = Term == 0 ? 1.0 : (Term < 4 ? 2.0 / 3.0 : 0.25);
		if (Lane == 0u) { imageStore(Images[Push.Output], ivec2(Term, 0), vec4(Sums[0].rgb * (4.0 * Pi * Band / Sums[0].w), 0.0)); }
		barrier();
	}
}
