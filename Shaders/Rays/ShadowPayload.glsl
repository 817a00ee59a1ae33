// The payload of shadow rays: 4 bytes, the distance of the blocker. It starts as BlockedAtUnknownDistance, so that a hit need
// not run a shader. If Shadow.rchit runs (see FRayType), it writes the distance of the hit that ended the ray, which need not
// be the nearest one.
#ifndef LANTERN_SHADOW_PAYLOAD_GLSL
#define LANTERN_SHADOW_PAYLOAD_GLSL
struct FShadowPayload
{
	float BlockerDistance; // metres; < 0: not blocked
};
const float BlockedAtUnknownDistance = 0.0, NotBlocked = -1.0;
bool IsVisible(FShadowPayload Payload) { return Payload.BlockerDistance < 0.0; }
#endif
