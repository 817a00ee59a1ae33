// What the scenes in closed form share.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

inline constexpr float PointFov = 0.05f; ///< degrees; so narrow that all pixels read one point
inline constexpr float FloorAlbedo = 0.5f;
inline constexpr float FloorSize = 40.0f; ///< metres; so large that its edge does not matter
inline constexpr glm::vec3 Down(0, -1, 0);

/// A Lambert floor at y = 0.
void AddFloor(FSceneBuilder& Builder, float Albedo);
/// A black material that emits a radiance of 1.
int32_t AddEmitter(FSceneBuilder& Builder);
/// Adds a camera that looks at Point on the floor from a low height, where no emitter is in the way.
void AddPointCamera(FSceneBuilder& Builder, const glm::dvec3& Point);
/// Removes sun and sky.
void Darken(FSceneBuilder& Builder);

} // namespace Lantern::Builtin
