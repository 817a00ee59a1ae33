// Draws what tiles and pixels asked of local lights, for r.RT.Debug.View.
#version 460
#include "../Shared/LocalLightTypes.h"
#include "../Shared/RayQueueTypes.h"
#include "../Library/View.glsl"
#include "../Tiles/Tile.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLampViewConstants Push; };

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FTileLightsRef { FTileLights Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FAnswersRef { uint Data[]; };

// Black: no light reaches the tile. Green: each light has its rays, the brighter the more there are. Red: pixels choose of many.
// Blue is added where they choose of emissive triangles alone.
vec3 TileColor(FTileLights Tile)
{
	bool bMany = Tile.Count == TILE_LIGHTS_MANY || Tile.bChooses == TILE_CHOOSES_REST;
	if (bMany) { return vec3(0.9, 0.35, 0.1); }
	float Green = Tile.Count > 0u ? 0.2 + 0.8 * float(Tile.Count) / float(TILE_LIGHTS) : 0.0;
	return vec3(0.0, Green, Tile.bChooses != 0u ? 0.8 : 0.0);
}

// The more rays, the brighter. Yellow: none of them got through.
vec3 RayColor(uint Answer)
{
	const uint Slots = (1u << TILE_LIGHTS) - 1u;
	uint Traced = ((Answer >> ANSWER_LOCAL_TRACED) & Slots) | (((Answer >> ANSWER_CHOSEN_TRACED) & 1u) << TILE_LIGHTS);
	uint Seen = ((Answer >> ANSWER_LOCAL_SEEN) & Slots) | (((Answer >> ANSWER_CHOSEN_SEEN) & 1u) << TILE_LIGHTS);
	float Share = sqrt(float(bitCount(Traced)) / float(TILE_LIGHTS));
	return (Traced & Seen) != 0u ? vec3(Share) : Share * vec3(1.0, 0.8, 0.1);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, gl_LocalInvocationIndex);
	if (IsOutsideView(View, Pixel)) { return; }
	vec3 Color = vec3(0.0);
	if (Push.bRays == 0u) { Color = TileColor(FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)]); }
	else if (Push.Answers != FAddress(0)) { Color = RayColor(FAnswersRef(Push.Answers).Data[Pixel.y * View.Width + Pixel.x]); }
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Color, 1.0));
}
