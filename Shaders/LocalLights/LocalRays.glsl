// Traces rays to local lights, for ShadowQueue.glsl, which declares what this needs.
#ifndef LANTERN_LOCAL_RAYS_GLSL
#define LANTERN_LOCAL_RAYS_GLSL

#include "../Library/Casters.glsl"
#include "../Tiles/Tile.glsl"
#define EMITTER_SHAPES
#include "LocalPoint.glsl"

const uint FirstLocalNumber = 64u; // behind those of the sun

// Number: of the pixel's rays to local lights. More: see LocalNumbers. bFiltered: what it brings counts as chance. What shines from one
// point does not, unless it was chosen of many (IsCertain in Shade.comp).
bool SeesLight(uint Index, uint Light, uint Number, uint More, bool bFiltered)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uvec2 Pixel = uvec2(Index % View.Width, Index / View.Width);
	FLocalPoint Point = LoadLocalPoint(Scene, View, Push.Normals, Pixel, LoadDepth(Push.Depth, ivec2(Pixel)));
	FLightSample Sample = SampleLocalLight(Scene, View, Point, Pixel, Light, More);
	if (!ReachesLight(View, Point, Sample)) { return false; }
	DrawLeastTransmittance(Index, FirstLocalNumber + Number, bFiltered);
	FaceDirection(Point.Surface, Sample.Direction);
	vec3 Origin = RasterRayOrigin(Scene, View, Point.Surface), Direction = Sample.Direction;
	float Length = LightRayLength(Sample, Point.P, Scene.ObjectReach);
	if (Sample.Distance < LightInfinity)
	{
		// From where rays start, the point lies a little elsewhere.
		vec3 To = Point.P + Direction * Sample.Distance - Origin;
		float Distance = max(length(To), 1.0e-6);
		Direction = To / Distance;
		Length = max(Length + Distance - Sample.Distance, 0.0);
	}
	return TraceShadowRay(Origin, Direction, Length, Push.RayFlags, LocalCasters(ShowsCharacter(Scene, Pixel))) < 0.0;
}

// MoreSample: of Push.MoreSamples.
void TraceLocal(uint Index, uint Slot, uint MoreSample)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Tile = uvec2(Index % View.Width, Index / View.Width) / TILE_SIZE;
	uint Light = FTileLightsRef(Push.TileLights).Data[TileIndex(View, Tile)].Lights[Slot];
	bool bExtent = HasExtent(FLightRef(FSceneRef(Push.Pass.Scene).Data.Lights).Data[Light]);
	bool bMore = Push.MoreSamples > 0u;
	uint More = bMore ? MoreSample + 1u : 0u;
	bool bSees = SeesLight(Index, Light, Slot + TILE_LIGHTS * More, More, bExtent);
	if (bMore)
	{
		if (bSees) { atomicOr(FAnswerRef(Push.MoreAnswers).Data[Index], MoreSeenBit(Slot, MoreSample)); }
		return;
	}
	uint Answer = (1u << (ANSWER_LOCAL_TRACED + Slot)) | (bSees ? 1u << (ANSWER_LOCAL_SEEN + Slot) : 0u);
	atomicOr(FAnswerRef(Push.Answers).Data[Index], Answer);
}

#ifdef MANY_LIGHTS
void TraceChosen(uint Index, uint Which)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Light = FLightChoiceRef(Push.Choices).Data[ChoiceIndex(View, Index, Which)].Light;
	uint Answer = (1u << ChosenTracedBit(Which)) | (SeesLight(Index, Light, Which, 0u, true) ? 1u << ChosenSeenBit(Which) : 0u);
	atomicOr(FAnswerRef(Push.Answers).Data[Index], Answer);
}
#endif

#endif
