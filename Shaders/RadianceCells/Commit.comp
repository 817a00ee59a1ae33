// Takes the samples of this frame's updates into the means of their cells.
#version 460
#include "RadianceCellSlots.glsl"
#include "../Library/MovedShare.glsl"
#include "../Library/RadianceEvents.glsl"

const float LeastWindow = 4.0; // updates

// What a cell may average over, by what has changed around it.
struct FWindow
{
	float Frames;
	float Least; // updates
};

// Light: what the update has brought.
FWindow GetWindow(FRadianceGrid Grid, FRadianceCell Cell, vec3 Light)
{
	FWindow Window = FWindow(Grid.Window, LeastWindow);
	vec3 P = FromRadianceSteps(Grid, Cell.Place), Normal = UnpackOct(Cell.Normal);
	vec2 Moved = vec2(0.0, GetLampChange(Grid.Events, Grid.EventCount, P));
	for (uint I = 0u; I < Grid.MoverCount; ++I) { Moved += GetMovedShare(FMovedCasterRef(Grid.Movers).Data[I], P, Normal); }
	float Brightness = max(Luminance(UnpackRgbe(Cell.Light)), Luminance(Light));
	float Share = Moved.x + min(Moved.y / max(Brightness, 1.0e-20), 1.0);
	// What changes by so much in a frame may be averaged over as many as make the whole, and be it one update.
	if (Window.Frames * Share > 1.0) { Window = FWindow(1.0 / Share, 1.0); }
	return Window;
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	uint Updated = min(FRadianceCountersRef(Grid.Counters).Data.Listed, Grid.Room);
	if (Number == 0u && Grid.Statistics != FAddress(0)) { FRadianceStatisticsRef(Grid.Statistics).Data.Updated = Updated; }
	if (Number >= Updated) { return; }
	uint Slot = FRadianceWordRef(Grid.List).Data[Number];
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	FRadianceCell Cell = Cells.Data[Slot];
	// The window is one of time: a cell that waits for its turn averages over fewer samples.
	float Waited = float(max(RadianceTurnsSince(Grid, RadianceCellUpdated(Cell.State)), 1u));
	FRadianceResult Result = FRadianceResultRef(Grid.Results).Data[Number];
	FWindow Window = GetWindow(Grid, Cell, Result.Light);
	uint Most = uint(clamp(Window.Frames / Waited, Window.Least, float(RADIANCE_CELL_COUNT_MASK)));
	uint Known = RadianceCellCount(Cell.State);
	vec4 U = vec4(HashPcg4(uvec4(RadianceSeed(Grid, Cell), Grid.Turn, Known, 0x51ed270bu)) >> 8u) * (1.0 / 16777216.0);
	// The first updates know too little of what comes by many surfaces. A cell averages over this part of its age.
	bool bGrows = float(Known) < LeastWindow || U.w * 6.0 < 1.0;
	uint Count = clamp(Known + (bGrows ? 1u : 0u), 1u, Most);
	vec3 Mean = UnpackRgbe(Cell.Light);
	vec3 Moment = UnpackMeanDirection(Cell.From) * Luminance(Mean);
	Mean += (Result.Light - Mean) / float(Count);
	Moment += (Result.Moment - Moment) / float(Count);
	Cells.Data[Slot].Light = PackRgbe(max(Mean, vec3(0.0)), U.xyz);
	float Sum = Luminance(Mean);
	Cells.Data[Slot].From = PackMeanDirection(Sum > 0.0 ? Moment / Sum : vec3(0.0), U.yzx);
	const uint Kept = ~((1u << RADIANCE_CELL_ASKED_SHIFT) - 1u) | RADIANCE_CELL_COARSE;
	Cells.Data[Slot].State = Count | (Grid.Turn << RADIANCE_CELL_UPDATED_SHIFT) | (Cell.State & Kept);
}
