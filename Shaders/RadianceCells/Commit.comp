// Takes the samples of a round's updates into the means of their cells.
#version 460
#include "RadianceCellSlots.glsl"
#include "../Library/MovedShare.glsl"
#include "../Library/RadianceEvents.glsl"

const float LeastWindow = 4.0;    // updates
const float LivelyUpdates = 32.0; // that a cell has at least within the frames that it averages over, if there are rounds enough
const float TrendUpdates = 4.0;   // over which the trend of a cell's light is averaged
const float LeastLeft = 1.0 / 16; // of a cell's light, with one update: who looks it up learns by what is left how much has gone

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
	vec3 P = FromRadianceSteps(Grid, Cell.Place), Normal = UnpackOct24(Cell.Normal);
	vec2 Moved = vec2(0.0, GetLampChange(Grid.Events, Grid.EventCount, P));
	for (uint I = 0u; I < Grid.MoverCount; ++I) { Moved += GetMovedShare(FMovedCasterRef(Grid.Movers).Data[I], P, Normal); }
	float Brightness = max(Luminance(UnpackRgbe(Cell.Light)), Luminance(Light));
	float Share = Moved.x + min(Moved.y / max(Brightness, 1.0e-20), 1.0);
	// What changes by so much in a frame may be averaged over as many as make the whole, and be it one update.
	if (Window.Frames * Share > 1.0) { Window = FWindow(1.0 / Share, 1.0); }
	if (Grid.Moment > 0.0)
	{
		// The trend before this update: light that chose its own weight would count too much.
		float Trend = max(abs(UnpackTrend(Cell.Normal)) - NoiseOfTrend, 0.0);
		float Frames = GetFramesOfChange(Trend, ChangeInCells, Grid.Moment);
		Window.Frames = min(Window.Frames, Frames);
	}
	return Window;
}

struct FChange
{
	float Before, Now; // luminance of the cell's light
	float Found, Gone; // luminance of the update's light, and by how much it was more a moment ago
	float Waited;      // frames since the update before
	uint Known, Most;  // updates before this one, see RadianceCellCount, and those that it may average over
};

// Keeps what the cell remembers of its light a moment ago, and how the light of the cells around changes its own.
void NoteChange(FRadianceGrid Grid, uint Slot, FChange Change, vec4 U)
{
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	uint Geometric = Cells.Data[Slot].GeometricNormal, Shading = Cells.Data[Slot].Normal;
	// What changes has a low count as well, but knows what it was.
	bool bYoung = Change.Known == 0u || (!KnowsBefore(Geometric) && Change.Known < min(uint(LeastWindow), Change.Most));
	float Ratio = 1.0, Trend = 0.0;
	if (Grid.Moment > 0.0 && !bYoung && Change.Now > 0.0)
	{
		float Then = mix(Change.Before * UnpackBefore(Geometric), Change.Now, 1.0 - exp(-Change.Waited / Grid.Moment));
		Ratio = Then / Change.Now;
		Trend = UnpackTrend(Shading);
		// A bright path counts no more than a usual one: the next ones would else replace bright means sooner than dark ones.
		float Whole = max(max(Change.Found, Change.Found + Change.Gone), Change.Before);
		Trend += (-Change.Gone / max(Whole, 1.0e-20) - Trend) / TrendUpdates;
	}
	Cells.Data[Slot].GeometricNormal = (Geometric & NormalMask) | (bYoung ? 0u : PackBefore(Ratio, U.w));
	Cells.Data[Slot].Normal = (Shading & NormalMask) | PackTrend(Trend, U.x);
}

void CountUpdates(FRadianceGrid Grid, uint Updated)
{
	FRadianceStatisticsRef Statistics = FRadianceStatisticsRef(Grid.Statistics);
	Statistics.Data.Updated = Updated + (Push.Round > 0u ? Statistics.Data.Updated : 0u);
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	uint Updated = CountListed(Grid, Push.Round);
	if (Number == 0u && Grid.Statistics != FAddress(0)) { CountUpdates(Grid, Updated); }
	if (Number >= Updated) { return; }
	uint Entry = PlaceInList(Push.Round, Number), Slot = FRadianceWordRef(Grid.List).Data[Entry];
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	FRadianceCell Cell = Cells.Data[Slot];
	// The window is one of time: a cell that waits for its turn averages over fewer samples.
	float Waited = Push.Round == 0u ? float(max(RadianceTurnsSince(Grid, RadianceCellUpdated(Cell.State)), 1u)) : 0.0;
	FRadianceResult Result = FRadianceResultRef(Grid.Results).Data[Number];
	FWindow Window = GetWindow(Grid, Cell, Result.Light);
	float Wanted = clamp(min(LivelyUpdates, Grid.StillWindow) / Window.Frames, 1.0, float(Grid.Rounds));
	// Where the budget does not suffice, a mean over as many updates would be one over a longer time.
	float Rounds = 1.0 + (Wanted - 1.0) * FRadianceCountersRef(Grid.Counters).Data.Further;
	// Later rounds know more: with a window of one frame, the mean is that of the last half of them.
	float OfThisFrame = float((Push.Round + 2u) / 2u);
	float Updates = max(Window.Frames / max(Waited, 1.0) - 1.0, 0.0) * Rounds + OfThisFrame;
	uint Most = uint(clamp(Updates, Window.Least, float(RADIANCE_CELL_COUNT_MASK)));
	uint Known = RadianceCellCount(Cell.State);
	vec4 U = vec4(HashPcg4(uvec4(RadianceSeed(Grid, Cell), Grid.Turn, Known, 0x51ed270bu + Push.Round)) >> 8u) * (1.0 / 16777216.0);
	// The first updates know too little of what comes by many surfaces. A cell averages over this part of its age.
	bool bGrows = float(Known) < LeastWindow || U.w * 6.0 < 1.0;
	uint Count = clamp(Known + (bGrows ? 1u : 0u), 1u, Most);
	vec3 Before = UnpackRgbe(Cell.Light), Mean = Before;
	vec3 Moment = UnpackMeanDirection(Cell.From) * Luminance(Before);
	Mean += (Result.Light - Mean) / float(Count);
	if (Grid.Moment > 0.0) { Mean = max(Mean, Before * max(LeastLeft, UnpackBefore(Cell.GeometricNormal) / MostGone)); }
	Moment += (Result.Moment - Moment) / float(Count);
	Cells.Data[Slot].Light = PackRgbe(max(Mean, vec3(0.0)), U.xyz);
	float Sum = Luminance(Mean);
	NoteChange(Grid, Slot, FChange(Luminance(Before), Sum, Luminance(Result.Light), Result.Gone, Waited, Known, Most), U);
	Cells.Data[Slot].From = PackMeanDirection(Sum > 0.0 ? Moment / Sum : vec3(0.0), U.yzx) | (Cell.From & ~MeanDirectionMask);
	// One number for the rounds of a frame.
	float Chance = float(HashPcg(RadianceSeed(Grid, Cell) ^ HashPcg(Grid.Turn ^ 0x68bc21ebu)) >> 8u) * (1.0 / 16777216.0);
	if (Push.Round + 1u < uint(Wanted + Chance))
	{
		FRadianceWordRef(Grid.List).Data[Entry] = Slot | LivelySlot;
		atomicAdd(FRadianceCountersRef(Grid.Counters).Data.Lively[Push.Round], 1u);
	}
	const uint Kept = ~((1u << RADIANCE_CELL_ASKED_SHIFT) - 1u) | RADIANCE_CELL_COARSE;
	Cells.Data[Slot].State = Count | (Grid.Turn << RADIANCE_CELL_UPDATED_SHIFT) | (Cell.State & Kept);
}
