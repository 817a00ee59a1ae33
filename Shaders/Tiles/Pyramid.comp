// Makes four levels of the pyramid over the host's shadow map: nearest and farthest blocker of each cell.
#version 460
#include "HostShadowMap.glsl"

layout(local_size_x = HOST_SHADOW_GROUP_SIZE, local_size_y = HOST_SHADOW_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FPyramidConstants Push; };

shared vec2 Cells[HOST_SHADOW_GROUP_SIZE][HOST_SHADOW_GROUP_SIZE];

const vec2 Nothing = vec2(1.0e30, -1.0e30);

vec2 Join(vec2 A, vec2 B) { return vec2(min(A.x, B.x), max(A.y, B.y)); }

// The texels of one cell of the first level.
vec2 JoinTexels(FAddress Cascade, uvec2 Cell)
{
	const uint Edge = 1u << HOST_SHADOW_FIRST_LEVEL;
	vec2 Joined = Nothing;
	[[dont_unroll]] for (uint I = 0u; I < Edge * Edge; ++I)
	{
		uvec2 Texel = Cell * Edge + uvec2(I % Edge, I / Edge);
		if (any(greaterThanEqual(Texel, uvec2(FCascadeRef(Cascade).Data.Width, FCascadeRef(Cascade).Data.Height)))) { continue; }
		Joined = Join(Joined, vec2(LoadMapDepth(Cascade, ivec2(Texel))));
	}
	return Joined;
}

vec2 JoinCells(FAddress Cascade, uvec2 Cell)
{
	uvec2 Size = LevelSize(Cascade, Push.InputLevel);
	vec2 Joined = Nothing;
	for (uint I = 0u; I < 4u; ++I)
	{
		uvec2 From = Cell * 2u + uvec2(I & 1u, I >> 1u);
		if (all(lessThan(From, Size))) { Joined = Join(Joined, LoadCell(Cascade, Push.InputLevel, From)); }
	}
	return Joined;
}

void Store(FAddress Cascade, uint Level, uvec2 Cell, vec2 Value)
{
	if (Level > FCascadeRef(Cascade).Data.TopLevel) { return; }
	uvec2 Size = LevelSize(Cascade, Level);
	if (all(lessThan(Cell, Size))) { FCellRef(FCascadeRef(Cascade).Data.Pyramid).Data[FCascadeRef(Cascade).Data.Levels[Level] + Cell.y * Size.x + Cell.x] = Value; }
}

void main()
{
	FAddress Cascade = GetCascade(Push.HostShadow, gl_WorkGroupID.z);
	uint Level = Push.InputLevel == 0u ? uint(HOST_SHADOW_FIRST_LEVEL) : Push.InputLevel + 1u;
	uvec2 Cell = gl_GlobalInvocationID.xy, Local = gl_LocalInvocationID.xy;
	vec2 Value = Push.InputLevel == 0u ? JoinTexels(Cascade, Cell) : JoinCells(Cascade, Cell);
	Store(Cascade, Level, Cell, Value);
	for (uint Step = 1u; Step < HOST_SHADOW_GROUP_LEVELS; ++Step)
	{
		Cells[Local.y][Local.x] = Value;
		barrier();
		uvec2 From = Local * 2u;
		if (all(lessThan(From, uvec2(HOST_SHADOW_GROUP_SIZE >> (Step - 1u)))))
		{
			Value = Join(Join(Cells[From.y][From.x], Cells[From.y][From.x + 1u]), Join(Cells[From.y + 1u][From.x], Cells[From.y + 1u][From.x + 1u]));
			Store(Cascade, Level + Step, gl_WorkGroupID.xy * (HOST_SHADOW_GROUP_SIZE >> Step) + Local, Value);
		}
		barrier();
	}
}
