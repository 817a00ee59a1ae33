// Bakes tiles of the sky's map: SKY_MAP_ROOTS.
#version 460
#include "RunSkyProgram.glsl"

layout(local_size_x = SKY_GROUP_SIZE, local_size_y = SKY_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSkyBakeConstants Push; };

void main()
{
	uint TilesInRow = (Push.Size + SKY_TILE_SIZE - 1u) / SKY_TILE_SIZE, Tile = Push.FirstTile + gl_WorkGroupID.z;
	uvec2 Texel = uvec2(Tile % TilesInRow, Tile / TilesInRow) * SKY_TILE_SIZE + gl_GlobalInvocationID.xy;
	if (any(greaterThanEqual(Texel, uvec2(Push.Size)))) { return; }
	vec3 Direction = OctDecode((vec2(Texel) + 0.5) * (2.0 / float(Push.Size)) - 1.0);
	vec3 Roots = min(sqrt(RunSkyProgram(Push.Sky, Direction)), vec3(65504.0));
	imageStore(Images[Push.Output], ivec2(Texel), RoundToHalf(vec4(Roots, 1.0)));
}
