// Bakes tiles of the sky's octahedral map.
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
	imageStore(Images[Push.Output], ivec2(Texel), vec4(min(RunSkyProgram(Push.Sky, Direction) * Push.PerTexel, vec3(65504.0)), 1.0));
}
