// Marks the pixels whose reflections are traced. OrderThreads.comp lists them.
#version 460
#include "../Shared/ReflectionTypes.h"
#include "../Shared/TileTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/RadianceCells.glsl"
#include "../Library/UintTextures.glsl"
#include "../Rays/MarkThreads.glsl"
#include "Fade.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FReflectionListConstants Push; };

const float LeastReflectance = 0.004; // nobody sees less

bool IsTraced(FViewConstants View, ivec2 Pixel)
{
	float Depth = LoadDepth(Push.Pixels.Depth, Pixel);
	if (!(Depth > 0.0)) { return false; }
	vec4 Material = texelFetch(Textures[Push.Pixels.Material], Pixel, 0);
	if (ReflectedShare(Push.Fade, Material.x) <= 0.0) { return false; }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, Depth);
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[Push.Pixels.BaseColor], Pixel, 0), Material);
	return MaxComponent(SpecularReflectance(Brdf, dot(Point.BentN, Point.V), Material.x)) >= LeastReflectance;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	bool bInside = !IsOutsideView(View, uvec2(Pixel));
	bool bTraced = bInside && IsTraced(View, Pixel);
	MarkThreads(Push.List, BitOfThread(gl_WorkGroupID.xy * TILE_SIZE, View.Width), bTraced);
	if (!bInside) { return; }
	if (Push.RadianceCells != FAddress(0) && all(equal(Pixel & 1, ivec2(0))))
	{
		FAddress Votes = FRadianceGridRef(Push.RadianceCells).Data.Votes;
		FRadianceVoteRef(Votes).Data[Push.FirstVoter + VoterOfPixel(View, uvec2(Pixel))].Slot = NO_RADIANCE_CELL;
	}
	if (bTraced) { return; }
	imageStore(Images[Push.Radiance], Pixel, vec4(0.0));
	imageStore(UintImages[Push.Mirrored], Pixel, uvec4(0u));
	if (Push.Picture != NO_TEXTURE) { imageStore(Images[Push.Picture], Pixel, vec4(0.0, 0.0, 0.0, 1.0)); }
	if (Push.Reach != NO_TEXTURE) { imageStore(Images[Push.Reach], Pixel, vec4(0.0)); }
	if (Push.Surface == NO_TEXTURE) { return; }
	imageStore(Images[Push.Surface], Pixel, vec4(0.0));
	imageStore(UintImages[Push.Anchors], Pixel, uvec4(0u));
}
