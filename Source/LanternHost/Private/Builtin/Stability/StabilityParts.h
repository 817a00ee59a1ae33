// What the scenes of `lantern stability` share.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

/// Adds a dielectric with a specular layer, so that reflections have something to do.
int32_t AddPaint(FSceneBuilder& Builder, const char* Name, const glm::vec3& Albedo, float Roughness);
int32_t AddMetal(FSceneBuilder& Builder, const char* Name, const glm::vec3& Color, float Roughness);
void AddBoxNode(FSceneBuilder& Builder, const char* Name, int32_t Material, const glm::vec3& Min, const glm::vec3& Max);
/// Adds a floor of Size × Size metres at height Y.
void AddGround(FSceneBuilder& Builder, int32_t Material, float Size, float Y = 0.0f);
/// Adds a standing quad with vertical stripes of two materials. It faces Normal, which is horizontal.
void AddStripes(FSceneBuilder& Builder, const char* Name, int32_t A, int32_t B, const glm::vec3& Center, const glm::vec3& Normal,
    float Width, float Height, float Stripe);
/// Animates Node at constant speed through Values. Path is Translation (xyz) or Rotation (quaternion xyzw).
void AddKeys(FSceneBuilder& Builder, int32_t Node, EAnimationPath Path, float Seconds, std::vector<glm::vec4> Values);
/// Removes sun and sky, and sets the exposure, in stops.
void SetDarkness(FSceneBuilder& Builder, float Exposure);
/// Puts a sphere lamp in the place of the sun and the sky. It is Distance metres from Center, where it is as bright and as wide as the
/// sun was.
void LightByLamp(FSceneBuilder& Builder, const glm::vec3& Center, float Distance);
/// Makes the light that was added last a square wave. Phase is in periods.
void AddFlicker(FSceneBuilder& Builder, float Hz, float Phase);

} // namespace Lantern::Builtin
