// How the pixels of a tile of many lights, or of emissive triangles, choose of them. The includer has Tile, and the light cells if not GUIDED.
#ifndef LANTERN_CHOOSE_OF_MANY_GLSL
#define LANTERN_CHOOSE_OF_MANY_GLSL

#if defined(MANY_LIGHTS) && !defined(GUIDED)
// Chooses a light with a probability proportional to EstimateLight, by weighted reservoir sampling over all that reach
// the pixel. Returns whether it asks for a ray.
bool ChooseLight(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, uvec2 Pixel, out FLightChoice Choice)
{
	FLightRef Lights = FLightRef(Scene.Lights);
	float U = LocalNumbers(View, Pixel, 0xffffffffu).x, Total = 0.0, Chosen = 0.0;
	Choice = FLightChoice(0u, 0.0);
	FLightWalk Walk = WalkLights(Scene, Point.P, false); // the cells of all pixels are asked for
	for (uint I = NextLight(Walk); I < Scene.LightCount; I = NextLight(Walk))
	{
		float Weight = EstimateLightAt(Scene, Lights.Data[I], Point);
		if (Weight <= 0.0 || !SharesChannel(Lights.Data[I], Point.Channels)) { continue; }
		Total += Weight;
		float Probability = Weight / Total;
		bool bTake = U < Probability;
		U = bTake ? U / Probability : (U - Probability) / (1.0 - Probability);
		U = min(U, 0.99999994);
		if (bTake)
		{
			Choice.Light = I;
			Chosen = Weight;
		}
	}
	if (Chosen <= 0.0) { return false; }
	Choice.Weight = Total / Chosen;
#ifdef NO_CHOICE_WEIGHT // r.RT.Debug.Lights.Weight
	Choice.Weight = 1.0;
#endif
	return (Lights.Data[Choice.Light].Flags & LIGHT_CASTS_SHADOW) != 0u;
}
#endif

#ifdef SPARSE
#include "../Library/Planes.glsl"

// Returns whether the pixel chooses a light in this frame: it has its turn, or no neighbour of its tile can stand for it. All threads.
bool Chooses(FViewConstants View, FLocalPoint Point, bool bSurface, uint Place)
{
	ivec2 InTile = ivec2(TilePixel(uvec2(0u), Place));
	SetPlane(RingPlace(InTile), false, vec3(0.0), vec3(0.0));
	if (bSurface) { SetPlane(RingPlace(InTile), true, Point.Surface.Relative, Point.Surface.Ng); }
	barrier();
	bool bChooses = bSurface && (HasTurn(View.FrameIndex, Place) || FindNeighbors(View, InTile, true) == 0u);
	if (bChooses) { atomicOr(Tile.Chose[Place >> 5u], 1u << (Place & 31u)); }
	return bChooses;
}
#endif

// If the tile has many lights, or emissive triangles, each pixel chooses of them. All threads.
void ChooseOfMany(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, bool bSurface, uvec2 Pixel, uint Place)
{
	bool bMany = Tile.bChooses != 0u, bAsks[CHOSEN_RAYS];
	FLightChoice Choices[CHOSEN_RAYS];
	for (uint I = 0u; I < CHOSEN_RAYS; ++I)
	{
		bAsks[I] = false;
		Choices[I] = FLightChoice(0u, 0.0);
	}
	uint Count = CountChosen(Tile);
	bool bChooses = bMany && bSurface;
#ifdef SPARSE
	if (ChoosesOfLights(Tile)) { bChooses = Chooses(View, Point, bSurface, Place); } // emitters alone: each pixel
#endif
#ifdef LOCAL_EMISSIVE
	FEmitterSearch Search = FEmitterSearch(bChooses, 1.0, MostCandidates());
	if (bMany && !ChoosesOfLights(Tile)) { Search = MakeEmitterSearch(View, Pixel, bSurface, Place); }
	bChooses = Search.bLooks;
#endif
#ifdef GUIDED
	FLobes Lit[CHOSEN_RAYS];
	for (uint I = 0u; I < CHOSEN_RAYS; ++I) { Lit[I] = FLobes(vec3(0.0), vec3(0.0)); }
	if (bMany)
	{
#ifndef LIGHT_MASK // which has done so
		PrepareTable(View, Point, bSurface, Place);
#endif
		MakeTable(Scene, View, Place, BoxCorner(LowBits), BoxCorner(HighBits));
	}
	WriteGuide(View, Place, bMany);
	if (bChooses)
	{
		float Reflected = 0.0;
		uint Candidates = MostCandidates();
#ifdef LOCAL_EMISSIVE
		Reflected = ReflectedRoughness(Push.Emitters);
		Candidates = Search.Candidates;
#endif
		FLocalBrdf Local = LoadLocalBrdf(Point, Push.BaseColor, Push.Material, Push.BackAlbedo, Pixel, Reflected);
		ChooseOfTable(Scene, View, Point, Local, Pixel, Candidates, Count, Choices, Lit, bAsks);
#ifdef LOCAL_EMISSIVE
		for (uint I = 0u; I < CHOSEN_RAYS; ++I)
		{
			ScaleChoice(Search.Scale, Choices[I], Lit[I]);
			DropDim(View, Pixel, I, Choices[I], Lit[I], bAsks[I]);
		}
#endif
	}
#else
	if (bChooses) { bAsks[0] = ChooseLight(Scene, View, Point, Pixel, Choices[0]); }
#endif
	if (!bMany || IsOutsideView(View, Pixel)) { return; }
	for (uint I = 0u; I < CHOSEN_RAYS; ++I)
	{
		if (I >= Count) { break; }
		uint Index = ChoiceIndex(View, Pixel.y * View.Width + Pixel.x, I);
		FLightChoiceRef(Push.Choices).Data[Index] = Choices[I];
#ifdef GUIDED
		if (Push.Lit != FAddress(0) && Choices[I].Weight > 0.0) { FLitPixelRef(Push.Lit).Data[Index].Lobes = PackLobes(Lit[I]); }
#endif
		// One ray answers for neighbouring choices of one light.
		bool bAnswered = I > 0u && bAsks[max(I, 1u) - 1u] && Choices[max(I, 1u) - 1u].Light == Choices[I].Light;
		if (bAsks[I] && !bAnswered) { atomicOr(Tile.Asking[2u * I + (Place >> 5u)], 1u << (Place & 31u)); }
	}
}
#endif
