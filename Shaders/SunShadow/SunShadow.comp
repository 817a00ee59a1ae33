// Sun visibility of a pixel, and the width of its penumbra, from the answers of its rays.
#version 460
#include "../Shared/SunShadowTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Rays/RayQueue.glsl"
#include "../Tiles/Tile.glsl"
#ifdef ADAPTIVE
#include "../Tiles/Fill.glsl"
#include "../Tiles/Settle.glsl"
#endif
#ifdef CONTACT
#include "../Tiles/Contact.glsl"
#endif
#ifdef HAS_HOST_SHADOW
#include "../Tiles/HostShadow.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FSunShadowConstants Push; };

// Returns a penumbra's width in pixels: the diameter of the sun's disk, projected past the mean blocker onto the surface. Width: across the
// sun's direction, metres; negative: no ray met anything.
float MeasurePenumbra(FViewConstants View, uvec2 Pixel, float Width)
{
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

#ifdef CONTACT
float FindContact(FViewConstants View, uvec2 Pixel)
{
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), LoadDepth(Push.Depth, ivec2(Pixel)));
	// Depth knows nothing of what lies behind a leaf, and would take the leaf itself for a blocker.
	if (Point.bBack && dot(Point.Ng, -FSceneRef(Push.Pass.Scene).Data.SunDirection) < 0.0) { return -1.0; }
	return FindContact(Push.Contact, FSceneRef(Push.Pass.Scene).Data, View, Push.Depth, Pixel, Point);
}
#endif

#ifdef ADAPTIVE
// Fills a pixel whose tile left it out because it is far away: from the traced ones of its plane, else from what is known of it, else from
// the tile's other planes. Called by all threads. Returns Visibility if there is nothing to fill.
float FillLeftOut(FViewConstants View, uint Place, uvec2 Pixel, bool bFill, bool bTraced, float Visibility)
{
	float Depth = IsOutsideView(View, Pixel) ? 0.0 : LoadDepth(Push.Depth, ivec2(Pixel));
	vec3 Position = Depth > 0.0 ? RelativePositionFromDepth(View, Pixel, Depth) : vec3(0.0);
	OfferValue(Place, bTraced ? Visibility : -1.0, Position);
	barrier();
	if (!bFill) { return Visibility; }
	vec3 Normal = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth).Ng;
	float Value = FillFromTile(Place, Position, Normal, PixelHeight(View, DistanceFromDepth(View, Depth)));
	uint Known = Push.Settled != NO_TEXTURE ? LoadKnown(Push.Settled, ivec2(Pixel)) : 0u;
	if (Value < 0.0 && Known != 0u) { Value = (Known & SETTLED_LIT) != 0u ? 1.0 : 0.0; }
	return Value < 0.0 ? FillFromTile(Place, Position, vec3(0.0), 1.0) : Value;
}
#endif

#ifdef HAS_HOST_SHADOW
// Returns what the host's map leaves of the sun, where rays do not take its place.
float LoadHostVisibility(FViewConstants View, uvec2 Pixel)
{
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Push.HostShadow == 0ul || Depth <= 0.0 || !IsHostShadowKept(Push.HostShadow)) { return 1.0; }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
	FaceDirection(Point, -FSceneRef(Push.Pass.Scene).Data.SunDirection);
	return FilterHostShadow(Push.HostShadow, View, Point);
}
#endif

void main()
{
	uint Place = gl_LocalInvocationIndex;
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	bool bInside = !IsOutsideView(View, Pixel);
	uint Index = Pixel.y * View.Width + Pixel.x, Answer = bInside ? FAnswerRef(Push.Answers).Data[Index] : 0u;
	FTile Tile = FTileRef(Push.Tiles).Data[TileIndex(View, gl_WorkGroupID.xy)];
	bool bAnswered = SunSeen(Answer) + SunUnseen(Answer) > 0u;
	bool bAsked = IsMarked(Tile.SunRays, Place), bTraced = bAsked && bAnswered;
	float Visibility = bAnswered ? float(SunSeen(Answer)) / float(SunSeen(Answer) + SunUnseen(Answer)) : -1.0;
#ifdef ADAPTIVE
	bool bFill = bInside && !bAnswered && !bAsked;
	Visibility = FillLeftOut(View, Place, Pixel, bFill, bTraced, Visibility);
	if (bInside && Push.Settled != NO_TEXTURE && !bFill && (bAsked || !IsMarked(Tile.SunRest, Place)))
	{
		Settle(Push.Settled, ivec2(Pixel), bAsked ? Answer : 0u);
	}
#endif
	if (!bInside) { return; }
	if (Visibility < 0.0) { Visibility = KeepVisibility(Pixel); }
	bool bFilled = !bAsked && !bAnswered, bLeftOut = bFilled || (!bAsked && IsMarked(Tile.SunRest, Place));
	float Contact = -1.0; // distance of what is in the way, metres
#ifdef CONTACT
	bool bFacing = bAsked || bLeftOut;
	if (bFacing && Visibility > 0.0) { Contact = FindContact(View, Pixel); }
	if (Contact >= 0.0) { Visibility = 0.0; }
#endif
#ifdef HAS_HOST_SHADOW
	Visibility *= LoadHostVisibility(View, Pixel);
#endif
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Visibility));
	if (Push.OutKept != NO_TEXTURE) { imageStore(Images[Push.OutKept], ivec2(Pixel), vec4(Visibility)); }
	if (Push.OutPenumbra == NO_TEXTURE) { return; }
	// The width is 0 without a blocker, and where a pixel without rays of its own knows of none. It is set to 1e-3 if a surface turns away
	// from the sun, or if its rays had no room: these give no blocker distance. A pixel that was filled has -1.
	float Penumbra = Visibility < 1.0 && !bLeftOut ? -1.0 : 0.0;
#ifdef HAS_HOST_SHADOW
	bTraced = bTraced || (bAnswered && Push.HostShadow != 0ul); // all pixels have a width
#endif
	if (bTraced && Penumbra < 0.0) { Penumbra = MeasurePenumbra(View, Pixel, FWidthRef(Push.Widths).Data[Index]); }
	if (Contact >= 0.0) { Penumbra = MeasurePenumbra(View, Pixel, 2.0 * sqrt(2.0 * Push.SunOneMinusCos) * Contact); }
	uint Rays = SunSeen(Answer) + SunUnseen(Answer);
	// Those that were traced later measure none.
	if (bTraced && Penumbra < 0.0 && Rays > Push.SamplesPerPixel) { Penumbra = 0.0; }
	Penumbra = min(Penumbra < 0.0 ? 1.0e-3 : Penumbra, 65504.0);
	imageStore(Images[Push.OutPenumbra], ivec2(Pixel), vec4(bFilled ? -1.0 : Penumbra, bTraced ? float(Rays) : 0.0, 0.0, 0.0));
}
