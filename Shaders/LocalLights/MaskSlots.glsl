// Which lights of a tile are in the light mask, and in which slots. For Requests.comp, which declares what this needs.
// Few lights are all in it. Of many, those are that bring most to some of its pixels. A light keeps its slot while it is listed.
// MASK_ORDER: planted fault, r.RT.Debug.Lights.MaskOrder.
#ifndef LANTERN_MASK_SLOTS_GLSL
#define LANTERN_MASK_SLOTS_GLSL

#include "../Library/Motion.glsl"
#include "../Library/UintTextures.glsl"

const float KeptBonus = 1.5; // of lights that have a slot: others must bring more to take it

shared uint KeptNumbers[TILE_LIGHTS]; // of the tile's lights in the previous frame; 0: a free slot
shared uint MiddleKey;                // of the surface next to the tile's middle: its place, as Z order counts from there
shared ivec2 KeptTile;                // x < 0: the previous frame did not see the surface

// Finds the tile of the previous frame that showed this one's surface, as if nothing but the camera had moved. All threads.
void FindKeptNumbers(FViewConstants View, FLocalPoint Point, bool bSurface, uvec2 Pixel, uint Place)
{
	if (Place == 0u)
	{
		MiddleKey = TILE_PIXELS;
		KeptTile = ivec2(-1);
	}
	barrier();
	if (bSurface) { atomicMin(MiddleKey, Place ^ 15u); }
	barrier();
	if (bSurface && MiddleKey == (Place ^ 15u) && Push.PreviousLights != NO_TEXTURE)
	{
		vec3 Motion = ComputeMotion(View, Point.Surface.Relative, Point.Surface.Relative + View.CameraMotion);
		vec2 Size = vec2(View.PreviousWidth, View.PreviousHeight), At = (vec2(Pixel) + 0.5 + Motion.xy) * Size / vec2(View.Width, View.Height);
		bool bSeen = Motion.z > 0.0 && all(greaterThanEqual(At, vec2(0.0))) && all(lessThan(At, Size));
		if (bSeen) { KeptTile = ivec2(At) / TILE_SIZE; }
	}
	barrier();
	if (Place < TILE_LIGHTS)
	{
		KeptNumbers[Place] = 0u;
#ifndef MASK_ORDER
		if (KeptTile.x >= 0) { KeptNumbers[Place] = texelFetch(UintTextures[Push.PreviousLights], ivec2(KeptTile.x * TILE_SIZE + int(Place), KeptTile.y), 0).x; }
#endif
	}
	barrier();
}

// Returns the slot that a light had; TILE_LIGHTS: none.
uint FindKeptSlot(uint Number)
{
	uint Slot = 0u;
	while (Slot < TILE_LIGHTS && (Number == 0u || KeptNumbers[Slot] != Number)) { ++Slot; }
	return Slot;
}

uint LightNumber(FSceneConstants Scene, uint Light) { return FLightRef(Scene.Lights).Data[Light & ~TILE_LIGHT_UNSHADOWED].Number; }

// Puts the tile's lights into slots. One thread.
void AssignSlots(FSceneConstants Scene)
{
	uint Count = Tile.Count == TILE_LIGHTS_MANY ? TILE_LIGHTS : Tile.Count, Taken = 0u, Slots[TILE_LIGHTS];
	FTileLights Listed = Tile;
	for (uint I = 0u; I < Count; ++I)
	{
		Slots[I] = TILE_LIGHTS;
		bool bReaches = (Listed.Reached[2u * I] | Listed.Reached[2u * I + 1u]) != 0u;
		if (!bReaches) { Listed.Lights[I] = TILE_LIGHT_NONE; }
		if (Listed.Lights[I] != TILE_LIGHT_NONE) { Slots[I] = FindKeptSlot(LightNumber(Scene, Listed.Lights[I])); }
		Taken |= Slots[I] < TILE_LIGHTS ? 1u << Slots[I] : 0u;
	}
	for (uint I = 0u; I < TILE_LIGHTS; ++I)
	{
		Tile.Lights[I] = TILE_LIGHT_NONE;
		Tile.Reached[2u * I] = Tile.Reached[2u * I + 1u] = 0u;
	}
	for (uint I = 0u; I < Count; ++I)
	{
		if (Listed.Lights[I] == TILE_LIGHT_NONE) { continue; }
		uint Slot = Slots[I] < TILE_LIGHTS ? Slots[I] : uint(findLSB(~Taken));
		Taken |= 1u << Slot;
		Tile.Lights[Slot] = Listed.Lights[I];
		Tile.Reached[2u * Slot] = Listed.Reached[2u * I];
		Tile.Reached[2u * Slot + 1u] = Listed.Reached[2u * I + 1u];
	}
	Tile.Count = uint(findMSB(Taken) + 1);
	if (Listed.Count == TILE_LIGHTS_MANY) { Tile.bChooses = TILE_CHOOSES_REST; }
}

#ifdef GUIDED
// Where a region's list was drawn, the lights of the mask must not depend on what was drawn, or the rest had a bias. They are of those that
// the tile remembers.
uint CountMaskProposals(FTileSource Source) { return Source.bDrawn ? TILE_GUIDE_LIGHTS : Source.Count; }
uint ProposeForMask(FSceneConstants Scene, FTileSource Source, uint I)
{
	if (!Source.bDrawn) { return SourceLight(Source, I); }
	uint Light = Remembered[I].Light;
	return Light < Scene.LightCount ? Light : NoGuideLight; // an emissive triangle's number is larger than any
}

// Lists the lights of the mask by what they bring. Uses the memory of the table, which is made later. All threads.
void RankLights(FSceneConstants Scene, FViewConstants View, uint Place)
{
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	FLightRef Lights = FLightRef(Scene.Lights);
	FTileSource Source = FindSource(Scene, View);
	if (Place == 0u)
	{
		TableCount = 0u;
		bDrawnMask = Source.bDrawn ? 1u : 0u;
	}
	if (Place < TILE_LIGHTS) { Tile.Lights[Place] = TILE_LIGHT_NONE; }
	barrier();
	uint Most = CountMaskProposals(Source);
	[[dont_unroll]] for (uint I = Place; I < Most; I += TILE_PIXELS)
	{
		uint Light = ProposeForMask(Scene, Source, I);
		if (Light == NoGuideLight || !MayReach(Scene, Lights.Data[Light], Low, High)) { continue; }
		float Brings = 0.0;
		[[dont_unroll]] for (uint S = 0u; S < TileSamplers; ++S) { Brings += EstimateAround(Scene, Lights.Data[Light], S); }
		uint Number = atomicAdd(TableCount, 1u);
		if (Number >= TILE_TABLE_MOST) { continue; }
		TableEntries[Number] = Light;
		Cumulative[Number] = Brings * (FindKeptSlot(Lights.Data[Light].Number) < TILE_LIGHTS ? KeptBonus : 1.0);
	}
	barrier();
	uint Count = min(TableCount, TILE_TABLE_MOST);
	[[dont_unroll]] for (uint I = Place; I < Count; I += TILE_PIXELS)
	{
		uint Rank = 0u;
		[[dont_unroll]] for (uint J = 0u; J < Count; ++J)
		{
			bool bBefore = Cumulative[J] > Cumulative[I] || (Cumulative[J] == Cumulative[I] && TableEntries[J] < TableEntries[I]);
			Rank += bBefore ? 1u : 0u;
		}
		if (Rank >= TILE_LIGHTS) { continue; }
		bool bCasts = (Lights.Data[TableEntries[I]].Flags & LIGHT_CASTS_SHADOW) != 0u;
		Tile.Lights[Rank] = TableEntries[I] | (bCasts ? 0u : TILE_LIGHT_UNSHADOWED);
	}
	barrier();
}

// Marks the lights of the mask that the pixel may be lit by.
void MarkRanked(FSceneConstants Scene, FLocalPoint Point, uint Place)
{
	for (uint I = 0u; I < TILE_LIGHTS; ++I)
	{
		if (Tile.Lights[I] == TILE_LIGHT_NONE) { continue; }
		FLightData Light = FLightRef(Scene.Lights).Data[Tile.Lights[I] & ~TILE_LIGHT_UNSHADOWED];
		if (!MayLight(Scene, Light, Point)) { continue; }
		atomicOr(Tile.Reached[2u * I + (Place >> 5u)], 1u << (Place & 31u));
	}
}
#endif

// All threads, behind ListLights.
void ListMask(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, bool bSurface, uvec2 Pixel, uint Place)
{
	FindKeptNumbers(View, Point, bSurface, Pixel, Place);
#ifdef GUIDED
	if (Place == 0u) { bDrawnMask = 0u; }
	if (Tile.bChooses != 0u) { PrepareTable(View, Point, bSurface, Place); }
	if (Tile.Count == TILE_LIGHTS_MANY)
	{
		RankLights(Scene, View, Place);
		if (bSurface) { MarkRanked(Scene, Point, Place); }
		barrier();
	}
#endif
	if (Place == 0u) { AssignSlots(Scene); }
	barrier();
}

#endif
