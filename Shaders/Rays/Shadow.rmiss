// Miss of a shadow ray: nothing blocks the light. HAS_TRANSMISSION: some may have shone through surfaces.
#version 460
#extension GL_EXT_ray_tracing : require
#include "ShadowPayload.glsl"

layout(location = 0) rayPayloadInEXT FShadowPayload Payload;

void main()
{
#ifdef HAS_TRANSMISSION
	Payload.BlockerDistance = -exp(BlockedAtUnknownDistance - Payload.BlockerDistance);
#else
	Payload.BlockerDistance = NotBlocked;
#endif
}
