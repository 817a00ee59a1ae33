// Tells what is known of the light of one pixel: the radiance cells that a long ray which ends there would try, and its light cell. It votes
// for nothing and marks nothing, so that looking changes nothing.
#version 460
#include "../Library/GBuffer.glsl"
#include "../Library/LightCells.glsl"
#include "../Shared/ExplainTypes.h"
#include "Chain.glsl"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform FPush { FExplainConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer FExplainedPixelRef { FExplainedPixel Data; };

FExplainedCell ExplainCell(FRadianceGrid Grid, FRadianceLink Link, vec3 Camera, out bool bKnown)
{
	bool bFull;
	FExplainedCell Out = FExplainedCell(FindRadianceCell(Grid, Link.Key, bFull), 0u, 0u, 0u, 0u, 0u, vec3(0.0), vec3(0.0));
	bKnown = false;
	if (Out.Slot == NO_RADIANCE_CELL) { return Out; }
	FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[Out.Slot];
	bKnown = IsLinkKnown(Link, Cell);
	Out.Key = Link.Key.Check;
	Out.Level = Link.Level;
	Out.Updates = RadianceCellCount(Cell.State);
	Out.SinceUpdate = RadianceTurnsSince(Grid, RadianceCellUpdated(Cell.State));
	Out.SinceLookUp = RadianceTurnsSince(Grid, RadianceCellAsked(Cell.State));
	Out.Light = UnpackRgbe(Cell.Light);
	Out.Place = FromRadianceSteps(Grid, Cell.Place) - Camera;
	return Out;
}

void ExplainLights(vec3 P, inout FExplainedPixel Out)
{
	if (Push.Lights == 0ul) { return; }
	FLightGrid Grid = FLightGridRef(Push.Lights).Data;
	FLightCellPlace Place = FindLightCell(Grid, P, vec3(0.0));
	if (Place.Cell == NoLight) { return; }
	Out.LightCell = Place.Cell;
	FLightCell Cell = FLightCellRef(Grid.Cells).Data[Place.Cell];
	if (HasLightCellList(Grid, Cell, Place.Key)) { Out.ListedLights = Cell.State & LIGHT_CELL_COUNT_MASK; }
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(Push.X, Push.Y);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	float Depth = LoadDepth(Push.Depth, Pixel);
	if (Depth <= 0.0) { return; }
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	FExplainedPixel Out;
	Out.bSurface = 1u;
	Out.Position = Point.Relative;
	Out.Normal = Point.Ng;
	Out.Used = Out.LightCell = Out.ListedLights = EXPLAINED_UNKNOWN;
	vec3 P = RasterRayOrigin(FSceneRef(Push.Pass.Scene).Data, View, Point);
	ivec3 Steps = ToRadianceSteps(Grid, P);
	uint Level = RadianceLevel(Grid, length(Point.Relative), 0.5);
	for (uint I = 0u; I < EXPLAINED_CELLS; ++I)
	{
		bool bKnown;
		Out.Cells[I] = ExplainCell(Grid, MakeRadianceLink(Grid, Steps, Level, Point.Ng, I), View.CameraPosition, bKnown);
		if (bKnown && Out.Used == EXPLAINED_UNKNOWN) { Out.Used = I; }
	}
	ExplainLights(P, Out);
	FExplainedPixelRef(Push.Out).Data = Out;
}
