// The light mask over time: means of what pixels saw of lights with an extent, in bytes, and the frames that they are worth. For Mask.comp,
// which declares what this needs. Slots are matched by the numbers of their lights, since a tile that showed the surface before may have
// them elsewhere. MASK_ORDER: planted fault, r.RT.Debug.Lights.MaskOrder.
#ifndef LANTERN_MASK_HISTORY_GLSL
#define LANTERN_MASK_HISTORY_GLSL

#include "../Library/History.glsl"
#include "../Library/MovedCasters.glsl"

const uint BlockTiles = 3u;           // along an edge of the block of tiles whose slots are matched once
const float DoubtedFrames = 8.0;      // that a history counts at most where a shadow may have moved
const float DisagreeSquared = 9.0;    // standard errors: a tile's rays say otherwise than its history
const uint FixedOne = 1024u;          // of sums over a tile

shared uint NearestBits, FarthestBits; // distances as bits: of positive floats they have the order
shared uint BlockKey;                  // of the surface whose tile of the previous frame is the block's middle
shared ivec2 BlockFirst;               // tile
shared uint BlockMaps[BlockTiles * BlockTiles];
shared uint Touched;                   // a bit for each slot whose light's shadows may have moved here
shared uint PastSums[TILE_LIGHTS], VarianceSums[TILE_LIGHTS], NowSums[TILE_LIGHTS]; // in 1 / FixedOne

// Where the slots of this tile were in another of the previous frame: 4 bits for each, 15 for nowhere.
uint MapSlots(ivec2 Tile)
{
#ifdef MASK_ORDER
	return 0x76543210u;
#else
	uint Map = 0xffffffffu;
	[[dont_unroll]] for (uint Its = 0u; Its < TILE_LIGHTS; ++Its)
	{
		uint Number = texelFetch(UintTextures[Push.PreviousLights], ivec2(Tile.x * TILE_SIZE + int(Its), Tile.y), 0).x;
		for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot)
		{
			if (Number != 0u && Number == Numbers[Slot]) { Map = bitfieldInsert(Map, Its, int(4u * Slot), 4); }
		}
	}
	return Map;
#endif
}

uint FindMap(ivec2 Tile)
{
	ivec2 In = Tile - BlockFirst;
	bool bKnown = all(greaterThanEqual(In, ivec2(0))) && all(lessThan(In, ivec2(BlockTiles)));
	return bKnown ? BlockMaps[In.y * int(BlockTiles) + In.x] : MapSlots(Tile);
}

struct FSlotPast
{
	float Mean, Frames; // Frames 0: nothing is known
};

// Matches the slots of the tiles where the surfaces of this one were. All threads. bKnown: R is of a surface that was seen.
void MatchBlock(FViewConstants View, FReprojection R, bool bKnown, uint Place)
{
	if (bKnown) { atomicMin(BlockKey, Place ^ 15u); }
	barrier();
	if (bKnown && BlockKey == (Place ^ 15u)) { BlockFirst = R.Base / TILE_SIZE - 1; }
	barrier();
	ivec2 Last = (ivec2(View.PreviousWidth, View.PreviousHeight) - 1) / TILE_SIZE;
	ivec2 Tile = BlockFirst + ivec2(Place % BlockTiles, Place / BlockTiles);
	bool bInside = all(greaterThanEqual(Tile, ivec2(0))) && all(lessThanEqual(Tile, Last));
	if (Place < BlockTiles * BlockTiles) { BlockMaps[Place] = BlockKey < TILE_PIXELS && bInside ? MapSlots(Tile) : 0xffffffffu; }
	barrier();
}

void RecallSlots(FReprojection R, out FSlotPast Past[TILE_LIGHTS])
{
	float Weights[TILE_LIGHTS];
	for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot)
	{
		Past[Slot] = FSlotPast(0.0, 0.0);
		Weights[Slot] = 0.0;
	}
	for (int Tap = 0; Tap < 4; ++Tap)
	{
		float Weight = R.Weights[Tap];
		if (Weight <= 0.01) { continue; } // there by rounding
		ivec2 Texel = GetTap(R, Tap);
		uint Map = FindMap(Texel / TILE_SIZE), Frames = texelFetch(UintTextures[Push.PreviousCounts], Texel, 0).x;
		uvec2 Means = texelFetch(UintTextures[Push.PreviousMeans], Texel, 0).xy;
		for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot)
		{
			uint Its = (Map >> (4u * Slot)) & 15u, Its4 = 4u * (Its & 7u), Known = (Frames >> Its4) & 15u;
			if (Its >= TILE_LIGHTS || Known == 0u) { continue; }
			Past[Slot].Mean += Weight * float((Its < 4u ? Means.x : Means.y) >> (8u * (Its & 3u)) & 255u) / 255.0;
			Past[Slot].Frames += Weight * float(Known);
			Weights[Slot] += Weight;
		}
	}
	for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot)
	{
		if (Weights[Slot] > 0.0) { Past[Slot] = FSlotPast(Past[Slot].Mean / Weights[Slot], Past[Slot].Frames / Weights[Slot]); }
	}
}

// Finds the slots whose light a caster that moved may hide from the tile. All threads.
void FindTouched(FSceneConstants Scene, FViewConstants View, FTileLights Tile, uint Place)
{
	if (Push.bChangesKnown == 0u || Push.CasterCount == 0u || NearestBits > FarthestBits) { return; }
	vec4 Bound = BoundTile(View, gl_WorkGroupID.xy * TILE_SIZE, TILE_SIZE, uintBitsToFloat(NearestBits), uintBitsToFloat(FarthestBits));
	uint Slot = Place % TILE_LIGHTS;
	if ((Extended & (1u << Slot)) == 0u) { return; }
	FLightData Light = FLightRef(Scene.Lights).Data[Tile.Lights[Slot] & ~TILE_LIGHT_UNSHADOWED];
	[[dont_unroll]] for (uint I = Place / TILE_LIGHTS; I < Push.CasterCount; I += TILE_PIXELS / TILE_LIGHTS)
	{
		FMovedCaster Caster = FMovedCasterRef(Push.Casters).Data[I];
		if (MayShadowLamp(Scene, Caster, Light, View.CameraPosition + Bound.xyz, Bound.w)) { atomicOr(Touched, 1u << Slot); }
	}
}

// Adds what the pixel saw, and what it was expected to see. Frames that agree prove little if they are few (Laplace).
void AddToSums(uint Slot, float Now, FSlotPast Past)
{
	float Expected = (Past.Mean * Past.Frames + 0.5) / (Past.Frames + 1.0), Variance = Expected * (1.0 - Expected) * (1.0 + 1.0 / Past.Frames);
	atomicAdd(NowSums[Slot], uint(Now * float(FixedOne) + 0.5));
	atomicAdd(PastSums[Slot], uint(Past.Mean * float(FixedOne) + 0.5));
	atomicAdd(VarianceSums[Slot], uint(Variance * float(FixedOne) + 0.5));
}

bool Disagrees(uint Slot)
{
	float Difference = (float(NowSums[Slot]) - float(PastSums[Slot])) / float(FixedOne);
	return Difference * Difference > DisagreeSquared * (float(VarianceSums[Slot]) / float(FixedOne));
}

void StartHistory(uint Place)
{
	if (Place < TILE_LIGHTS) { PastSums[Place] = VarianceSums[Place] = NowSums[Place] = 0u; }
	if (Place != 0u) { return; }
	NearestBits = 0x7f7fffffu;
	FarthestBits = Touched = 0u;
	BlockKey = TILE_PIXELS;
	BlockFirst = ivec2(0);
}

// Returns the mean with this frame's value, and how many frames it is worth.
FSlotPast BlendSlot(FSlotValue Value, FSlotPast Past, bool bMayHaveChanged, bool bDisagrees)
{
	if (Value.bCertain || Past.Frames <= 0.0) { return FSlotPast(Value.Visibility, Value.bOwn ? 1.0 : 0.0); }
	if (!Value.bOwn) { return Past; } // what it would take is the mean of its tile
	if (bMayHaveChanged) { Past.Frames = min(Past.Frames, bDisagrees ? 0.0 : DoubtedFrames); }
	float Least = Past.Frames + 0.5 < float(LIGHT_MASK_FRAMES_MOST) ? 1.0 / (Past.Frames + 1.0) : 0.0;
	return FSlotPast(mix(Past.Mean, Value.Visibility, max(Least, Push.MinAlpha)), min(Past.Frames + 1.0, float(LIGHT_MASK_FRAMES_MOST)));
}

// Makes means over time of what pixels see in this frame, and keeps them. All threads.
void AccumulateSlots(FSceneConstants Scene, FViewConstants View, FTileLights Tile, bool bSurface, uvec2 Pixel, uint Place, uvec2 Chance,
                     inout FSlotValue Values[TILE_LIGHTS])
{
	StartHistory(Place);
	barrier();
	FSlotPast Past[TILE_LIGHTS];
	FReprojection R = NotSeen;
	FSurface Surface = FSurface(0.0, vec3(0.0, 0.0, 1.0), 0.0);
	if (bSurface && Push.Surface != NO_TEXTURE)
	{
		Surface = LoadSurface(Push.Surface, ivec2(Pixel));
		atomicMin(NearestBits, floatBitsToUint(max(Surface.Distance, 0.0)));
		atomicMax(FarthestBits, floatBitsToUint(max(Surface.Distance, 0.0)));
		if (Push.PreviousMeans != NO_TEXTURE) { R = LoadReprojection(Push.Reprojection, ivec2(Pixel)); }
	}
	MatchBlock(View, R, R.Coverage > 0.0, Place);
	RecallSlots(R, Past);
	FindTouched(Scene, View, Tile, Place);
	for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot)
	{
		bool bCounts = bSurface && Values[Slot].bOwn && !Values[Slot].bCertain && Past[Slot].Frames > 0.0;
		if (bCounts) { AddToSums(Slot, Values[Slot].Visibility, Past[Slot]); }
	}
	barrier();
	if (IsOutsideView(View, Pixel)) { return; }
	bool bMoved = bSurface && Push.Motion != NO_TEXTURE && MovedItself(View, Surface.Distance, Pixel, texelFetch(Textures[Push.Motion], ivec2(Pixel), 0));
	uint Means[2] = uint[2](0u, 0u), Frames = 0u;
	for (uint Slot = 0u; Slot < TILE_LIGHTS && bSurface; ++Slot)
	{
		bool bMayHaveChanged = Push.bChangesKnown == 0u || bMoved || (Touched & (1u << Slot)) != 0u;
		FSlotPast Now = BlendSlot(Values[Slot], Past[Slot], bMayHaveChanged, Disagrees(Slot));
		Values[Slot].Visibility = Now.Mean;
		Means[Slot >> 2u] |= Dither(Now.Mean * 255.0, ChanceByte(Chance, Slot)) << (8u * (Slot & 3u));
		Frames |= uint(Now.Frames + 0.5) << (4u * Slot);
	}
	imageStore(UintImages[Push.OutMeans], ivec2(Pixel), uvec4(Means[0], Means[1], 0u, 0u));
	imageStore(UintImages[Push.OutCounts], ivec2(Pixel), uvec4(Frames));
}

#endif
