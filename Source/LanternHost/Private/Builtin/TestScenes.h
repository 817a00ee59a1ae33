// Scenes whose light is known in closed form. What the camera sees, and what value it should read, is said with each.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// A closed room that emits 0.5 everywhere, all surfaces Lambert of this albedo: L = 0.5 / (1 − albedo) in every pixel.
FSceneDescription BuildFurnace(float Albedo);

/// Inside of a Lambert sphere of area 96 m², a point light of 10,000 lm at its centre. Irradiance is
/// Φ/S / (1 − albedo), of which Φ/S · albedo / (1 − albedo) indirect; every pixel reads albedo/π times that.
FSceneDescription BuildSphere(float Albedo);

/// A unit square emitter, L = 1, 1 m above a Lambert floor of albedo 0.5. Every pixel reads 0.5/π · E at the point
/// (X, 0, 0) of the floor.
FSceneDescription BuildPolygonLight(float X);

/// Two unit squares, one with L = 1 and black, one Lambert of albedo 0.5. The camera's square picture is exactly the
/// second: the mean of all pixels is 0.5 · F. Parallel at distance 1, or perpendicular with a shared edge.
FSceneDescription BuildFormFactors(bool bPerpendicular);

/// A disk of radius 1 m, L = 1, Height above a Lambert floor of albedo 0.5. Every pixel reads 0.5/π · π/(1 + Height²).
FSceneDescription BuildDisk(float Height);

/// A sphere of radius 0.5 m, L = 1, Distance away from a point of the same floor, AngleDegrees from its normal. Every
/// pixel reads 0.5/π · π · (0.5/Distance)² · cos(angle).
FSceneDescription BuildSphereLight(float Distance, float AngleDegrees);

/// A metal of F = 1 under a sky of 1: every pixel reads the GGX lobe's directional albedo E(μ), seen at cos = Mu.
FSceneDescription BuildGgx(float Roughness, float Mu);

/// The straight edge of an occluder that covers x < 0, Height above the floor, under a vertical sun of 0.533° and
/// irradiance π on a floor of albedo 1. The camera looks straight down from under the occluder's edge; a row of pixels
/// runs from shadow to light over 4 widths of the penumbra, with x = 0 in the middle. Lit: 1.
FSceneDescription BuildPenumbra(float Height);

/// Three squares between a steep sun and a floor, single-sided facing up, single-sided facing down, double-sided: each
/// must cast the same shadow.
FSceneDescription BuildPlanes();

/// A camera, and a sky of (0.5, 0.7, 1).
FSceneDescription BuildEmptySky();

} // namespace Lantern::Builtin
