// Where a tile's table finds its entries: in lists of its region or of the whole scene, and in what the tile remembers. For TileTable.glsl,
// which declares what this needs.
#ifndef LANTERN_TILE_SOURCES_GLSL
#define LANTERN_TILE_SOURCES_GLSL

// What follows is for a light of the table, or for a cluster of emissive triangles.

bool MayReachEntry(FSceneConstants Scene, uint Entry, vec3 Low, vec3 High)
{
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Entry)) { return MayReachFromCluster(LoadCluster(Push.Emitters, Entry), Low, High); }
#endif
	return MayReach(Scene, FLightRef(Scene.Lights).Data[Entry], Low, High);
}

bool CastsShadow(FSceneConstants Scene, uint Entry)
{
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Entry)) { return true; }
#endif
	return (FLightRef(Scene.Lights).Data[Entry].Flags & LIGHT_CASTS_SHADOW) != 0u;
}

// Whether the tile's guide had the light in the previous frame.
bool IsRemembered(FViewConstants View, uint Light)
{
	return PreviousTile.x != NoTile && Remembered[GuidePlace(Light, GuideTileHash(TileIndex(View, PreviousTile)))].Light == Light;
}

// Where a tile finds its lights.
struct FTileSource
{
	uint Count;
	bool bDrawn; // the list is of a region, and was drawn
	FAddress Region; // FLightRegion; 0: all lights of the scene
};

FTileSource FindSource(FSceneConstants Scene, FViewConstants View)
{
	if (Push.Regions == FAddress(0)) { return FTileSource(Scene.LightCount, false, FAddress(0)); }
	FAddress Region = Push.Regions + RegionIndex(View, GROUP_TILE) * SizeOfRegion;
	uint Count = FLightRegionRef(Region).Data.Count;
	return FTileSource(min(Count, REGION_LIGHTS), Count > REGION_LIGHTS, Region);
}

uint SourceLight(FTileSource Source, uint I) { return Source.Region != FAddress(0) ? FLightRegionRef(Source.Region).Data.Lights[I] : I; }
float SourceStands(FTileSource Source, uint I) { return Source.bDrawn ? FLightRegionRef(Source.Region).Data.Stands[I] : 1.0; }

#ifdef LOCAL_EMISSIVE
FTileSource FindEmitterSource(FSceneConstants Scene, FViewConstants View)
{
	FAddress Regions = EmitterRegions(Scene, Push.Emitters);
	if (Regions == FAddress(0)) { return FTileSource(Scene.EmissiveClusterCount, false, FAddress(0)); }
	FAddress Region = Regions + RegionIndex(View, GROUP_TILE) * SizeOfRegion;
	uint Count = FLightRegionRef(Region).Data.Count;
	return FTileSource(min(Count, REGION_EMITTERS), Count > REGION_EMITTERS, Region);
}

uint SourceCluster(FTileSource Source, uint I) { return Source.Region != FAddress(0) ? SourceLight(Source, I) : I | LIGHT_TRIANGLE; }
#endif

// What the table is made of: the lights of a tile of many, and emissive triangles.
struct FTableSources
{
	FTileSource Lights;
#ifdef LOCAL_EMISSIVE
	FTileSource Emitters;
#endif
};

FTableSources FindSources(FSceneConstants Scene, FViewConstants View)
{
	FTableSources Sources;
	Sources.Lights = FindSource(Scene, View);
#ifdef LOCAL_EMISSIVE
	if (!ChoosesOfLights(Tile)) { Sources.Lights = FTileSource(0u, false, FAddress(0)); }
	Sources.Emitters = FindEmitterSource(Scene, View);
#endif
	return Sources;
}

// How many proposals begin with what the tile remembers. Where a list was drawn, that is there for certain, however many lights there
// are: its entries come first, and of what was drawn they are left out.
uint CountRemembered(FTableSources Sources)
{
	bool bDrawn = Sources.Lights.bDrawn;
#ifdef LOCAL_EMISSIVE
	bDrawn = bDrawn || Sources.Emitters.bDrawn;
#endif
	return bDrawn ? TILE_GUIDE_LIGHTS : 0u;
}

uint CountProposals(FTableSources Sources)
{
	uint Count = CountRemembered(Sources) + Sources.Lights.Count;
#ifdef LOCAL_EMISSIVE
	Count += Sources.Emitters.Count;
#endif
	return Count;
}

// Whether a light is of a list that was drawn.
bool IsOfDrawn(FTableSources Sources, uint Light)
{
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Light)) { return Sources.Emitters.bDrawn; }
#endif
	return Sources.Lights.bDrawn;
}

// Whether there is such a light or cluster.
bool IsListed(FSceneConstants Scene, uint Light)
{
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Light)) { return (Light & ~LIGHT_TRIANGLE) < Scene.EmissiveClusterCount; }
#endif
	return Light < Scene.LightCount;
}

// Returns the Number-th light that the table may hold if it reaches the tile, and NoGuideLight for none.
uint ProposeLight(FSceneConstants Scene, FViewConstants View, FTableSources Sources, uint Number, out float Stands)
{
	uint I = Number - CountRemembered(Sources), Light;
	bool bRemembered = Number < CountRemembered(Sources);
	Stands = 1.0;
	if (bRemembered) { Light = Remembered[Number].Light; }
#ifdef LOCAL_EMISSIVE
	else if (I >= Sources.Lights.Count)
	{
		Light = SourceCluster(Sources.Emitters, I - Sources.Lights.Count);
		Stands = SourceStands(Sources.Emitters, I - Sources.Lights.Count);
	}
#endif
	else
	{
		Light = SourceLight(Sources.Lights, I);
		Stands = SourceStands(Sources.Lights, I);
	}
	if (!IsListed(Scene, Light)) { return NoGuideLight; }
	bool bDrawn = IsOfDrawn(Sources, Light);
	return (bRemembered ? !bDrawn : (bDrawn && IsRemembered(View, Light))) ? NoGuideLight : Light;
}

#endif
