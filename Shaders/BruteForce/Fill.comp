// Gives pixels that traced no path in this frame the mean of neighbours that did, on their plane where there are such.
// CHECKERBOARD or QUARTER: see Rate.glsl.
#version 460
#include "../Library/Planes.glsl"
#include "../Shared/BruteForceTypes.h"
#include "../Shared/DenoiseTypes.h"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FFillConstants Push; };

// What lies alone on its plane takes what there is: leaves and wires have no others.
uint FindOthers(uint FrameIndex, ivec2 InTile)
{
	uint Found = 0u;
	for (uint I = 0u; I < 9u; ++I)
	{
		ivec2 At = InTile + ivec2(I % 3u, I / 3u) - 1;
		bool bTurn = I != 4u && HasTurn(FrameIndex, TilePlace(uvec2(At & (TILE_SIZE - 1))));
		if (bTurn && RingNormals[RingPlace(At)] != NoRingNormal) { Found |= 1u << I; }
	}
	return Found;
}

void FillPixel(uint Image, ivec2 Pixel, uint Neighbors)
{
	vec3 Sum = vec3(0.0);
	for (uint I = 0u; I < 9u; ++I)
	{
		if ((Neighbors & (1u << I)) != 0u) { Sum += imageLoad(Images[Image], Pixel + ivec2(I % 3u, I / 3u) - 1).rgb; }
	}
	imageStore(Images[Image], Pixel, RoundToHalf(vec4(Sum / float(max(bitCount(Neighbors), 1)), CHANCE_OF_OTHERS)));
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	LoadPlanes(View, Push.Depth, Push.Normals);
	barrier();
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy), InTile = ivec2(gl_LocalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel)) || HasTurn(View.FrameIndex, TilePlace(uvec2(Pixel)))) { return; }
	uint Neighbors = RingNormals[RingPlace(InTile)] == NoRingNormal ? 0u : FindNeighbors(View, InTile, false);
	if (Neighbors == 0u && RingNormals[RingPlace(InTile)] != NoRingNormal) { Neighbors = FindOthers(View.FrameIndex, InTile); }
	FillPixel(Push.Radiance, Pixel, Neighbors);
	if (Push.Second != NO_TEXTURE) { FillPixel(Push.Second, Pixel, Neighbors); }
}
