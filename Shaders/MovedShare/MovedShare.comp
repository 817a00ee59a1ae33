// How much of the light that reaches each pixel, from all around or within its specular lobe, may have changed. Objects that moved hid it, shone, or reflected it: they
// give a share. Lamps that changed give a radiance. The filter forgets as much (FDenoiseInputs::ChangedShare).
#version 460
#include "../Shared/MovedShareTypes.h"
#include "../Library/Brdf.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/GroupBounds.glsl"
#include "../Library/RadianceEvents.glsl"
#include "../Tiles/Tile.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FMovedShareConstants Push; };

const float LeastShare = 1.0e-3;
const float LeastShareOfLobes = 1.0e-5; // these are up to a hundred times as narrow
const float LeastShining = 0.01; // nits, times LeastShare: below any light that is seen
const float MostRadiance = 65504.0; // of fp16

shared uint Near[SETTLED_MOST_CASTERS / 32u]; // casters that matter to the tile

void FindNear(FViewConstants View, uint Place)
{
	if (!HasBounds()) { return; } // no surface
	vec4 Bound = BoundGroup(View, gl_WorkGroupID.xy * TILE_SIZE, TILE_SIZE);
	Bound.xyz += View.CameraPosition;
	for (uint I = Place; I < Push.CasterCount; I += TILE_PIXELS)
	{
		FMovedCaster Caster = FMovedCasterRef(Push.Casters).Data[I];
		float Away = max(distance(Caster.To, Bound.xyz) - distance(Caster.From, Caster.To) - Bound.w, Caster.Radius);
		float Least = (Push.Material == NO_TEXTURE ? LeastShare : LeastShareOfLobes) * Away * Away / (Caster.Radius * Caster.Radius);
		if (2.0 * Caster.Changed > Least || Caster.Emission > LeastShining * Least) { atomicOr(Near[I >> 5u], 1u << (I & 31u)); }
	}
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Place = gl_LocalInvocationIndex;
	if (Place < SETTLED_MOST_CASTERS / 32u) { Near[Place] = 0u; }
	if (Place == 0u) { StartBounds(); }
	barrier();
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	bool bInside = !IsOutsideView(View, uvec2(Pixel));
	float Depth = bInside ? LoadDepth(Push.Depth, Pixel) : 0.0;
	vec3 P = vec3(0.0), Normal = vec3(0.0), Axis = vec3(0.0);
	float Alpha = 1.0;
	bool bMirror = false; // its image is followed by its own motion
	if (Depth > 0.0)
	{
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
		P = View.CameraPosition + Point.Relative;
		Normal = Point.BentN;
		Axis = reflect(-Point.V, Point.BentN);
		if (Push.Material != NO_TEXTURE) { Alpha = texelFetch(Textures[Push.Material], Pixel, 0).x; }
		Alpha *= Alpha;
		bMirror = Alpha < MinAlpha;
		NoteDistance(dot(View.CameraForward, Point.Relative));
	}
	barrier();
	FindNear(View, Place);
	barrier();
	if (!bInside) { return; }
	vec2 Moved = vec2(0.0, Depth > 0.0 ? GetLampChange(Push.Lamps, Push.LampCount, P) : 0.0);
	for (uint Word = 0u; Word < SETTLED_MOST_CASTERS / 32u && Depth > 0.0; ++Word)
	{
		for (uint Bits = Near[Word]; Bits != 0u; Bits &= Bits - 1u)
		{
			FMovedCaster Mover = FMovedCasterRef(Push.Casters).Data[Word * 32u + uint(findLSB(Bits))];
			vec2 Share = GetMovedShare(Mover, P, Normal);
			if (Push.Material != NO_TEXTURE) { Share.x = bMirror ? 0.0 : GetMovedShareOfLobe(Mover, P, Axis, Alpha); }
			Moved += Share;
		}
	}
	Moved = mix(Moved, vec2(0.0), isnan(Moved)); // of an object whose place is no number
	imageStore(Images[Push.Output], Pixel, vec4(min(Moved, vec2(1.0, MostRadiance)), 0.0, 0.0));
}
