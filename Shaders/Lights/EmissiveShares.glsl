// The chance by which light sampling chooses one of several emitters.
#ifndef LANTERN_EMISSIVE_SHARES_GLSL
#define LANTERN_EMISSIVE_SHARES_GLSL

// Total, Count: the power of all, and how many have any. All chances sum to 1.
float ShareOf(float Power, float Total, uint Count)
{
#ifdef NO_FLOOR
	const float Floor = 0.0;
#else
	const float Floor = EMISSIVE_FLOOR;
#endif
	return Power > 0.0 ? (1.0 - Floor) * (Power / Total) + Floor / float(Count) : 0.0;
}

#endif
