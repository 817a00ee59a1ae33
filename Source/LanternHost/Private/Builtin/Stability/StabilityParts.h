// What the scenes of `lantern stability` share.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

/// A dielectric with a specular layer, so that reflections have something to do.
int32_t AddPaint(FSceneBuilder& Builder, const char* Name, const glm::vec3& Albedo, float Roughness);
int32_t AddMetal(FSceneBuilder& Builder, const char* Name, const glm::vec3& Color, float Roughness);
void AddBoxNode(FSceneBuilder& Builder, const char* Name, int32_t Material, const glm::vec3& Min, const glm::vec3& Max);
/// A floor of Size metres each way at height Y.
void AddGround(FSceneBuilder& Builder, int32_t Material, float Size, float Y = 0.0f);
/// Vertical stripes of two materials over the quad that stands at Center, facing Normal (horizontal).
void AddStripes(FSceneBuilder& Builder, const char* Name, int32_t A, int32_t B, const glm::vec3& Center, const glm::vec3& Normal,
    float Width, float Height, float Stripe);
/// Keys at constant speed; Path: Translation (xyz) or Rotation (quaternion xyzw).
void AddKeys(FSceneBuilder& Builder, int32_t Node, EAnimationPath Path, float Seconds, std::vector<glm::vec4> Values);

} // namespace Lantern::Builtin
