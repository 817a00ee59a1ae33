// The sample engine's sky: a gradient, a glow about the sun, ground, and two layers of clouds. A host puts a file of its own in place of
// this (MakeSkyProgramHeader), which defines EvaluateSky alone. Its includes are relative to the shader folder.
#ifndef LANTERN_SKY_PROGRAM_GLSL
#define LANTERN_SKY_PROGRAM_GLSL

// Values[0]: cover of the low and of the high clouds, 0 to 1; wind of the low ones along x and z, metres a second. The high ones drift
// half as fast.

const float LowClouds = 1200.0, HighClouds = 6000.0; // metres above the camera; clouds are far enough to be without parallax

float HashSky(ivec2 Cell)
{
	uint H = uint(Cell.x) * 0x9E3779B1u ^ uint(Cell.y) * 0x85EBCA77u;
	H = (H ^ (H >> 15)) * 0x2C1B3C6Du;
	H = (H ^ (H >> 12)) * 0x297A2D39u;
	return float((H ^ (H >> 15)) >> 8) * (1.0 / 16777216.0);
}

// Noise of values on a grid, 0 to 1.
float ValueNoise(vec2 P)
{
	ivec2 Cell = ivec2(floor(P));
	vec2 T = P - floor(P);
	T = T * T * (3.0 - 2.0 * T);
	return mix(mix(HashSky(Cell), HashSky(Cell + ivec2(1, 0)), T.x), mix(HashSky(Cell + ivec2(0, 1)), HashSky(Cell + ivec2(1, 1)), T.x), T.y);
}

float FractalNoise(vec2 P, int Octaves)
{
	float Sum = 0.0, Weight = 0.5;
	for (int Octave = 0; Octave < Octaves; ++Octave)
	{
		Sum += Weight * ValueNoise(P);
		P = mat2(1.6, 1.2, -1.2, 1.6) * P + 17.3; // twice as fine, and turned, so that no grid shows
		Weight *= 0.5;
	}
	return Sum / (1.0 - 2.0 * Weight);
}

float CloudDensity(vec2 P, float Cover, int Octaves)
{
	float Least = mix(0.78, 0.22, Cover);
	return Cover > 0.0 ? smoothstep(Least, Least + 0.28, FractalNoise(P, Octaves)) : 0.0;
}

// Where a direction meets a layer of a round world, metres.
vec2 MeetLayer(vec3 Direction, float Height)
{
	const float WorldRadius = 6.36e6;
	float B = WorldRadius * Direction.y;
	float Distance = (2.0 * WorldRadius * Height + Height * Height) / (B + sqrt(B * B + 2.0 * WorldRadius * Height + Height * Height));
	return Direction.xz * Distance;
}

// Share of the sun's light that reaches the air.
float DayShare(FSkyData Sky) { return smoothstep(-0.1, 0.1, Sky.ToSun.y); }

// Radiance without clouds, above the horizon.
vec3 ClearSky(vec3 Direction, FSkyData Sky)
{
	float Up = max(Direction.y, 0.0), Towards = dot(Direction, Sky.ToSun);
	float Low = 1.0 - smoothstep(0.0, 0.35, abs(Sky.ToSun.y)); // dusk
	vec3 Horizon = mix(vec3(1.05, 1.2, 1.35), vec3(1.5, 0.95, 0.6), Low * (0.5 + 0.5 * Towards));
	vec3 L = Sky.Radiance * mix(Horizon, vec3(0.55, 0.85, 1.45), 1.0 - pow(1.0 - Up, 4.0));
	// Haze scatters forward: Henyey and Greenstein 1941, g = 0.8.
	float Haze = 0.36 / (4.0 * Pi * pow(max(1.64 - 1.6 * Towards, 1.0e-3), 1.5));
	return L + Sky.SunIrradiance * (DayShare(Sky) * 0.04 * Haze * mix(1.0, 3.0, Low));
}

// Adds a layer of clouds in front of what Behind says.
vec3 AddClouds(vec3 Direction, vec3 Behind, FSkyData Sky, float Height, float Scale, float Cover, vec2 Drift, int Octaves)
{
	vec2 P = (MeetLayer(Direction, Height) + Drift) / Scale;
	float Density = CloudDensity(P, Cover, Octaves);
	if (Density <= 0.0) { return Behind; }
	// Thickness towards the sun, by one more look: light that is left after it.
	vec2 Aside = Sky.ToSun.xz / max(abs(Sky.ToSun.y), 0.2) * (0.25 * Height / Scale) * 0.3;
	float Lit = exp(-2.5 * CloudDensity(P + Aside, Cover, max(Octaves - 2, 2)) * Density);
	float Day = DayShare(Sky), Forward = pow(max(dot(Direction, Sky.ToSun), 0.0), 16.0);
	vec3 Light = Sky.Radiance * (0.6 + 0.5 * Lit) + Sky.SunIrradiance * (Day * Lit * (0.12 + 0.25 * Forward * (1.0 - 0.7 * Density)));
	float Alpha = Density * smoothstep(0.0, 0.12, Direction.y); // haze hides those at the horizon
	return mix(Behind, Light, 0.95 * Alpha);
}

// Radiance of the sky without the sun's disk, nits. Direction: of unit length, y up.
vec3 EvaluateSky(vec3 Direction, FSkyData Sky)
{
	vec3 Ground = Sky.Radiance * 0.35 + Sky.SunIrradiance * (0.05 * max(Sky.ToSun.y, 0.0));
	if (Direction.y < -0.05) { return Ground; }
	vec3 Above = normalize(vec3(Direction.x, max(Direction.y, 0.0), Direction.z) + vec3(0.0, 1.0e-4, 0.0));
	vec3 L = ClearSky(Above, Sky);
	vec2 Drift = -Sky.Seconds * Sky.Values[0].zw;
	L = AddClouds(Above, L, Sky, HighClouds, 4000.0, Sky.Values[0].y, 0.5 * Drift, 4);
	L = AddClouds(Above, L, Sky, LowClouds, 900.0, Sky.Values[0].x, Drift, 6);
	return mix(Ground, L, smoothstep(-0.05, 0.0, Direction.y));
}

#endif
