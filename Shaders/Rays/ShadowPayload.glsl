// The shadow ray's payload: 4 bytes, how far off what is in the way is. Starts at BlockedAnywhere, so that hits need run
// nothing; where Shadow.rchit runs (see FRayType), it writes the distance of the hit that the ray ended at, which need not be
// the nearest.
#ifndef LANTERN_SHADOW_PAYLOAD_GLSL
#define LANTERN_SHADOW_PAYLOAD_GLSL
struct FShadowPayload
{
	float Blocker; // metres
};
const float BlockedAnywhere = 0.0, NotBlocked = -1.0;
bool IsVisible(FShadowPayload Payload) { return Payload.Blocker < 0.0; }
#endif
