// Scenes of `lantern stability` for signals that have no method yet: local lights, caches, caustics, fog, a toon look.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// A table top on a mast, 17 m above dark ground: its front is in the sun, its underside is not. The camera is Distance
/// metres away from the lower front edge, below it, and sees both; the line from it to the edge is the same at all
/// distances.
FSceneDescription BuildStabilityEdge(float Distance);

/// A room within a room, entered from the other side, with a screen behind its door: of what the camera sees there, the
/// sun reaches nothing but by five bounces or more.
FSceneDescription BuildStabilityTemple();

/// A sealed room with a partition, behind which one lamp shines only by its light on walls. The lamp is on in the first
/// half of each period.
FSceneDescription BuildStabilitySwitch(float Period);

/// A sealed hall with 32 lamps: every other one a square wave of 5 Hz, the others of 15 Hz, phases spread.
FSceneDescription BuildStabilityFlicker();

/// A sealed hall with columns and 640 lamps of many colours. Nothing moves.
FSceneDescription BuildStabilityBoiling();

/// A cube flies past a flat mirror and a convex one, once a second and a half. Node "mover".
FSceneDescription BuildStabilityMirror();

/// A railing of metal, roughness 0.15, whose bars are one pixel wide in a picture of so many Rows.
FSceneDescription BuildStabilityRailing(float Rows);

/// One mesh of 2 km (node "land") and 2,000 small ones on it; the camera stands in the middle.
FSceneDescription BuildStabilityHugeMesh();

/// A street of 2 km between blocks, no two alike, that the camera flies through at 200 m/s: in 10 s, as an animation of
/// its node.
FSceneDescription BuildStabilityHash();

/// 640 lamps, all alike, in a regular grid over a flat floor: its light is smooth, so that steps show.
FSceneDescription BuildStabilityLightGrid();

/// A pool of liquid metal whose surface is a travelling wave, z = a(sin kx + sin kz): the sun that it reflects draws
/// moving caustics on a wall that the sun itself does not reach. Transmission is no part of it, because no path of the
/// reference is refracted.
FSceneDescription BuildStabilityCaustics();

/// Smooth shapes in a room with light from a window only, and that all indirect where the camera looks: a ramp of three
/// bands, which the measurement applies to irradiance, has its edges on all of them. Nothing moves.
FSceneDescription BuildStabilityToon();

/// A dark hall with a window, a shaft of sun through it, a board (node "board") that slides past the window, and behind
/// a wall a chamber that no light reaches. What fills the air is the method's to say.
FSceneDescription BuildStabilityFog();

} // namespace Lantern::Builtin
