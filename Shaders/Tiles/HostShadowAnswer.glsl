// What Tiles/HostShadow.glsl answers, for that of the plugin and that of a host.
#ifndef LANTERN_HOST_SHADOW_ANSWER_GLSL
#define LANTERN_HOST_SHADOW_ANSWER_GLSL

#define HOST_SHADOW_LIT 0u
#define HOST_SHADOW_DARK 1u
#define HOST_SHADOW_UNSURE 2u // rays must say, or FilterHostShadow where the map holds what rays cannot meet

struct FHostShadowAnswer
{
	uint Class;            // HOST_SHADOW_…
	float BlockerDistance; // metres; of HOST_SHADOW_DARK, for the width of the penumbra
};

#endif
