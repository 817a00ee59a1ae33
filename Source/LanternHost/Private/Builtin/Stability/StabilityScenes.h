// Small scenes in which methods are known to fail; `lantern stability` says what is measured in each.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// A sealed room of 4 m under open sky, its walls Centimetres thick (0: single double-sided faces). The camera is inside,
/// where no light is, but for what comes through a slit in the roof, if it has one.
FSceneDescription BuildStabilityWall(float Centimetres, float SlitCentimetres);

/// Blocks on a plain, whose shadows tell the time of day.
FSceneDescription BuildStabilityTime();

/// A closed hall, lit by 24 candles of 1 cm² each.
FSceneDescription BuildStabilityCandles();

/// A ring of poles around the camera, before striped walls: who strafes uncovers wall, who turns sees it anew.
FSceneDescription BuildStabilityPoles();

/// A cube that glows crosses a striped wall at 5 m/s, close before it; its shadow goes with it. Node "cube"; from −5 m to
/// 5 m in 2 s.
FSceneDescription BuildStabilityGhost();

/// Four blades turn over a floor once a second, under a sun of 2°.
FSceneDescription BuildStabilityFan();

/// What divides by zero or overflows: roughness 0, faces seen edge-on, triangles without area, a sun of 10⁶ lux and an
/// emitter of 10⁶ nits.
FSceneDescription BuildStabilityNan();

/// A slab ("lid") hovers over a floor and shadows it from sun, sky and walls.
FSceneDescription BuildStabilityLid();

/// Spheres under a sky of 1: roughness 0 to 1 from left to right, dielectric above metal. Nodes "dielectric 0" …
/// "metal 4".
FSceneDescription BuildStabilityFurnace();

/// A wide penumbra over a floor and a corner full of ambient occlusion: smooth all over, so that a seam shows.
FSceneDescription BuildStabilitySeams();

/// An open room at Far · (16 km, 0.5 km, 16 km).
FSceneDescription BuildStabilityFar(float Far);

/// A wall of 20 × 10 quads of 1 m with a material each; the camera sees all of it. Quad i is node i.
FSceneDescription BuildStabilityMaterials();

/// A plane that fills the picture, under sun and sky: every pixel of every signal has the same value. Metal: a mirror,
/// else Lambert.
FSceneDescription BuildStabilityFlat(bool bMetal);

} // namespace Lantern::Builtin
