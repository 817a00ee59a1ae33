// Marks a tile whose pixels choose, and keeps the memory of those that do not. For Requests.comp.
#ifndef LANTERN_LIST_CHOOSER_GLSL
#define LANTERN_LIST_CHOOSER_GLSL

#include "../Rays/ThreadList.glsl"

shared uint AnyChooses;
shared uint FirstSurface; // Place of a pixel that shows one

// All threads, behind ListLights.
void ListChooser(FViewConstants View, FLocalPoint Point, bool bSurface, uvec2 Pixel, uint Place)
{
	bool bChooses = Tile.bChooses != 0u;
	if (Place == 0u)
	{
		AnyChooses = ChoosesOfLights(Tile) ? 1u : 0u;
		FirstSurface = TILE_PIXELS;
	}
	barrier();
	if (bChooses && bSurface) { atomicMin(FirstSurface, Place); }
#ifdef LOCAL_EMISSIVE
	if (bChooses && !ChoosesOfLights(Tile) && MakeEmitterSearch(View, Pixel, bSurface, Place).bLooks) { AnyChooses = 1u; }
#endif
	barrier();
	if (bChooses && AnyChooses != 0u)
	{
		if (Place != 0u) { return; }
		MarkThread(Push.Choices, BitOfThread(GROUP_TILE, (View.Width + TILE_SIZE - 1u) / TILE_SIZE));
		return;
	}
	if (!bChooses)
	{
		WriteGuide(View, Place, false);
		return;
	}
	if (Place == 0u) { Tile.bChooses = TILE_CHOOSES_NOBODY; }
	if (Place == FirstSurface) { FindPreviousTile(View, GROUP_TILE, Place, Point.P); }
	barrier();
	LoadRemembered(View, Place);
	CarryGuide(View, Place);
}

#endif
