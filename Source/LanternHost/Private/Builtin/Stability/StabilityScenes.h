// Small scenes in which methods are known to fail. `lantern stability` says what is measured in each.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

// ---------------------------------------------------------------------------------------------------- nothing moves

/// A sealed room of 4 m under open sky. Its walls are Centimetres thick; 0 makes them single double-sided faces. The camera is in
/// the dark inside. A slit of SlitCentimetres in the roof lets light in; 0 leaves it closed.
FSceneDescription BuildStabilityWall(float Centimetres, float SlitCentimetres);

/// Blocks on a plain, whose shadows tell the time of day.
FSceneDescription BuildStabilityTime();

/// A closed hall, lit by 24 candles of 1 cm² each.
FSceneDescription BuildStabilityCandles();

/// What divides by zero or overflows: roughness 0, faces seen edge-on, triangles without area. The sun has 10⁶ lux, an emitter
/// 10⁶ nits.
FSceneDescription BuildStabilityNan();

/// Spheres under a sky of 1. Roughness goes from 0 on the left to 1 on the right, dielectric above metal. The nodes are called
/// "dielectric 0" to "metal 4".
FSceneDescription BuildStabilityFurnace();

/// A wide penumbra over a floor, and a corner full of ambient occlusion. The light is smooth all over, so that a seam shows.
FSceneDescription BuildStabilitySeams(float Lamps);

/// An open room at Far · (16 km, 0.5 km, 16 km).
FSceneDescription BuildStabilityFar(float Far);

/// A wall of 20 × 10 quads of 1 m with a material each. The camera sees all of it. Quad i is node i.
FSceneDescription BuildStabilityMaterials();

/// A plane that fills the picture, under sun and sky. Every pixel of every signal has the same value. The plane is a mirror if
/// bMetal, otherwise Lambert.
FSceneDescription BuildStabilityFlat(bool bMetal);

// ---------------------------------------------------------------------------------------------------- something moves
// bLamp: a sphere lamp shines instead of sun and sky.

/// A ring of poles around the camera, before striped walls. A camera that strafes uncovers wall; one that turns sees it anew.
FSceneDescription BuildStabilityPoles(bool bLamp);

/// A glowing cube crosses a striped wall at 5 m/s, close before it, and its shadow goes with it. Node "cube" moves from −5 m to
/// 5 m in 2 s.
FSceneDescription BuildStabilityGhost(bool bLamp);

/// Four blades turn over a floor once a second, under a sun of 2°.
FSceneDescription BuildStabilityFan(bool bLamp);

/// A slab (node "lid") hovers over a floor and shadows it from sun, sky and walls.
FSceneDescription BuildStabilityLid(bool bLamp);

// ---------------------------------------------------------------------------------------------------- indirect light

/// A table top on a mast, 17 m above dark ground. Its front is in the sun, its underside is not. The camera sees both from below,
/// Distance metres from the lower front edge. The line from the camera to the edge is the same at all distances.
FSceneDescription BuildStabilityEdge(float Distance);

/// A room within a room, entered from the other side, with a screen behind its door. The sun reaches what the camera sees there by
/// five bounces or more.
FSceneDescription BuildStabilityTemple();

/// Smooth shapes in a room with light from a window only. The camera sees only indirect light. The measurement applies a ramp of three
/// bands to irradiance, and the edges of the bands lie on all shapes. Nothing moves.
FSceneDescription BuildStabilityToon();

/// A dark hall with a window, a shaft of sun through it, and a board (node "board") that slides past the window. A wall seals off a
/// chamber that no light reaches. The method decides what fills the air.
FSceneDescription BuildStabilityFog();

/// A corridor beside a lit room. A door between them, node "door", is shut, and slides towards +x. The camera sees the wall that faces it.
FSceneDescription BuildStabilityDoor();

/// A dark corridor. Node "torch" glows, and moves from -6 m to 6 m in 2.4 s, which is 5 m/s.
FSceneDescription BuildStabilityTorch();

// ---------------------------------------------------------------------------------------------------- lamps

/// A sealed room with one lamp behind a partition, which shines only by its light on walls. The lamp is on in the first half of each
/// Period of seconds.
FSceneDescription BuildStabilitySwitch(float Period);

/// A sealed hall with 32 lamps. Half of them are square waves of 5 Hz, half of 15 Hz, with phases spread.
FSceneDescription BuildStabilityFlicker();

/// A sealed hall with columns and 640 lamps of many colours. Nothing moves.
FSceneDescription BuildStabilityBoiling();

/// 640 equal lamps in a regular grid over a flat floor. Their light is smooth, so that steps show.
FSceneDescription BuildStabilityLightGrid(float Range);

// ---------------------------------------------------------------------------------------------------- mirrors and glints

/// A cube flies past a flat mirror and a convex one, once in 1.5 s. Its node is called "mover".
FSceneDescription BuildStabilityMirror();

/// A sealed room whose side walls and back are mirrors. Brightness: of its lamp, over what it should be.
FSceneDescription BuildStabilityMirrorRoom(float Brightness);

/// A railing of metal, roughness 0.15, whose bars are one pixel wide in a picture with this number of rows.
FSceneDescription BuildStabilityRailing(float Rows, int Lamps);

/// A pool of liquid metal whose surface is a travelling wave, y = a(sin kx + sin kz). The sun that it reflects draws moving caustics on
/// a wall that the sun itself does not reach. Nothing transmits light, because the reference refracts no path.
FSceneDescription BuildStabilityCaustics();

// ---------------------------------------------------------------------------------------------------- large worlds

/// One mesh of 2 km (node "land") and 2,000 small ones on it. The camera stands in the middle.
FSceneDescription BuildStabilityHugeMesh();

/// A street of 2 km between blocks, no two alike. An animation of the camera's node flies through it at 200 m/s, in 10 s.
FSceneDescription BuildStabilityHash();

/// A street of 400 m at night, towards −z. Node "lantern" glows behind the camera; what is streamed in looks like it.
FSceneDescription BuildStabilityStreaming();

} // namespace Lantern::Builtin
