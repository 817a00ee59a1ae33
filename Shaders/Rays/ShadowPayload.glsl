// The payload of shadow rays: 4 bytes, the distance of the blocker. It starts as BlockedAtUnknownDistance, so that a hit need
// not run a shader. If Shadow.rchit runs (see FRayType), it writes the distance of the hit that ended the ray, which need not
// be the nearest one. Light shines through some surfaces: their any-hit shader adds −ln of what each leaves of it to what the payload starts
// with, and the miss shader leaves minus their product. The sum may fall: light that enters a volume is denser there.
#ifndef LANTERN_SHADOW_PAYLOAD_GLSL
#define LANTERN_SHADOW_PAYLOAD_GLSL
struct FShadowPayload
{
	float BlockerDistance; // metres; < 0: not blocked, and minus the share of light that arrives
};
// Greater than any sum falls, so that no sum of a ray that something ends looks like that of a miss.
const float BlockedAtUnknownDistance = 64.0;
const float NotBlocked = -1.0;
float GetTransmittance(FShadowPayload Payload) { return max(-Payload.BlockerDistance, 0.0); }
// Whether most of the light arrives.
bool IsVisible(FShadowPayload Payload) { return Payload.BlockerDistance < -0.5; }
#endif
