// The shadow ray's payload: 4 bytes. Starts at 0; only the miss shader writes, so that hits run nothing.
#ifndef LANTERN_SHADOW_PAYLOAD_GLSL
#define LANTERN_SHADOW_PAYLOAD_GLSL
struct FShadowPayload
{
	uint bVisible;
};
#endif
