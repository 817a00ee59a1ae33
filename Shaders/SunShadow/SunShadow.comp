// Sun visibility of a pixel, and the width of its penumbra, from the answers of its rays.
#version 460
#include "../Shared/SunShadowTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Rays/RayQueue.glsl"
#include "../Tiles/Tile.glsl"
#ifdef HAS_HOST_SHADOW
#include "../Tiles/HostShadow.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FSunShadowConstants Push; };

// Returns the width of the penumbra in pixels: the diameter of the sun's disk, projected past the mean blocker onto the surface.
// Negative: no ray met anything.
float MeasurePenumbra(FViewConstants View, uvec2 Pixel, uint Index)
{
	float Width = FWidthRef(Push.Widths).Data[Index];
	if (Width < 0.0) { return Width; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
	return Width * abs(dot(Point.Ng, Point.V)) / PixelHeight(View, DistanceFromDepth(View, Depth));
}

// Returns the visibility of a pixel whose rays had no room in the queue.
float KeepVisibility(uvec2 Pixel)
{
	if (Push.Kept == NO_TEXTURE) { return 1.0; }
	float Kept = texelFetch(Textures[Push.Kept], ivec2(Pixel), 0).x;
	return Kept >= 0.0 && Kept <= 1.0 ? Kept : 1.0; // not a number is neither
}

#ifdef HAS_HOST_SHADOW
// Returns what the host's map leaves of the sun, where rays do not take its place.
float LoadHostVisibility(FViewConstants View, uvec2 Pixel)
{
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Push.HostShadow == 0ul || Depth <= 0.0 || !IsHostShadowKept(Push.HostShadow)) { return 1.0; }
	return FilterHostShadow(Push.HostShadow, View, LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth));
}
#endif

void main()
{
	uint Place = gl_LocalInvocationIndex;
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	if (IsOutsideView(View, Pixel)) { return; }
	uint Index = Pixel.y * View.Width + Pixel.x, Answer = FAnswerRef(Push.Answers).Data[Index];
	bool bAnswered = SunSeen(Answer) + SunUnseen(Answer) > 0u;
	float Visibility = bAnswered ? float(SunSeen(Answer)) / float(Push.SamplesPerPixel) : KeepVisibility(Pixel);
#ifdef HAS_HOST_SHADOW
	Visibility *= LoadHostVisibility(View, Pixel);
#endif
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Visibility));
	if (Push.OutKept != NO_TEXTURE) { imageStore(Images[Push.OutKept], ivec2(Pixel), vec4(Visibility)); }
	if (Push.OutPenumbra == NO_TEXTURE) { return; }
	// Without a blocker, the width is 0. A surface that turns away from the sun gives no blocker distance; its width is set to 1e-3.
	float Penumbra = Visibility < 1.0 ? -1.0 : 0.0;
	FTile Tile = FTileRef(Push.Tiles).Data[TileIndex(View, gl_WorkGroupID.xy)];
	bool bTraced = (Tile.SunRays[Place >> 5u] & (1u << (Place & 31u))) != 0u;
#ifdef HAS_HOST_SHADOW
	bTraced = bTraced || Push.HostShadow != 0ul; // all pixels have a width
#endif
	if (bTraced && bAnswered && Penumbra < 0.0) { Penumbra = MeasurePenumbra(View, Pixel, Index); }
	imageStore(Images[Push.OutPenumbra], ivec2(Pixel), vec4(min(Penumbra < 0.0 ? 1.0e-3 : Penumbra, 65504.0)));
}
