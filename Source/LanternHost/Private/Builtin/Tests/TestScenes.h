// Scenes whose light is known in closed form. Each comment says what the camera sees and which value a pixel must have.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// A closed room that emits 0.5 everywhere. All surfaces are Lambert of this albedo: L = 0.5 / (1 − albedo) in every pixel.
FSceneDescription BuildFurnace(float Albedo);

/// The inside of a Lambert sphere of area S = 96 m², with a point light of Φ = 10,000 lm at its centre. Irradiance is
/// Φ/S / (1 − albedo). Its indirect part is Φ/S · albedo / (1 − albedo). Every pixel reads albedo/π times the irradiance.
FSceneDescription BuildSphere(float Albedo);

/// A unit square emitter, L = 1, 1 m above a Lambert floor of albedo 0.5. Every pixel reads 0.5/π · E at the point (X, 0, 0) of the
/// floor.
FSceneDescription BuildPolygonLight(float X);

/// Two unit squares. The first emits L = 1 and is black; the second is Lambert of albedo 0.5 and fills the camera's square picture. The
/// mean of all pixels is 0.5 · F. The squares are parallel at a distance of 1 m, or perpendicular with a shared edge.
FSceneDescription BuildFormFactors(bool bPerpendicular);

/// A disk of radius 1 m, L = 1, Height above a Lambert floor of albedo 0.5. Every pixel reads 0.5/π · π/(1 + Height²).
FSceneDescription BuildDisk(float Height);

/// A sphere of radius 0.5 m, L = 1, over a Lambert floor of albedo 0.5. It is Distance away from a point of the floor, AngleDegrees
/// from the normal there. Every pixel reads 0.5/π · π · (0.5/Distance)² · cos(angle).
FSceneDescription BuildSphereLight(float Distance, float AngleDegrees);

/// A metal of F = 1 under a sky of 1. Every pixel reads the directional albedo E(μ) of the GGX lobe, seen at cos = Mu.
FSceneDescription BuildGgx(float Roughness, float Mu);

/// The straight edge of an occluder that covers x < 0, Height above a floor of albedo 1. The sun is vertical, has a diameter of 0.533°
/// and an irradiance of π. The camera looks straight down from below the edge. A row of pixels runs from shadow to light over 4
/// widths of the penumbra, with x = 0 in the middle. A lit pixel reads 1.
FSceneDescription BuildPenumbra(float Height);

/// Three squares between a steep sun and a floor: single-sided facing up, single-sided facing down, double-sided. Each must cast the same
/// shadow.
FSceneDescription BuildPlanes();

/// A camera, and a sky of (0.5, 0.7, 1).
FSceneDescription BuildEmptySky();

} // namespace Lantern::Builtin
