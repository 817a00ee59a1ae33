// Step "window" of the temporal filter, for colours: mean and spread of the signal in 7×7 pixels, whatever surfaces they show.
//   Takes: the tile of Load.glsl.
//   Gives: FWindow. SumWindowRows needs the tile complete; MeasureWindow needs the rows of the whole group complete.
//   Why: the history is clamped to this range (Clamp.glsl). Sums of rows, then of columns, read 14 values instead of 49.
#ifndef LANTERN_TEMPORAL_WINDOW_GLSL
#define LANTERN_TEMPORAL_WINDOW_GLSL

#include "Load.glsl"

#if CHANNELS != 1

const int WindowWidth = 2 * WindowRadius + 1;

shared FSignal RowSums[InnerSize * GroupSize], RowSquares[InnerSize * GroupSize];
shared float RowCounts[InnerSize * GroupSize];

struct FWindow
{
	FSignal Mean, Sigma; // Sigma: standard deviation between pixels
	float Variance;      // of the brightness, between pixels
};

void SumWindowRows()
{
	[[dont_unroll]] for (int Number = int(gl_LocalInvocationIndex); Number < InnerSize / ValueStep * GroupSize; Number += GroupSize * GroupSize)
	{
		ivec2 InTile = ivec2(Number % GroupSize + 1, Number / GroupSize * ValueStep + 1);
		ivec2 ToValue = GetStepsToValue(InTile);
		InTile.y += ToValue.y;
		int I = (InTile.y - 1) * GroupSize + Number % GroupSize, Start = InTile.y * TileSize + InTile.x;
		FSignal Sum = FSignal(0.0), Squares = FSignal(0.0);
		float Count = 0.0;
		[[dont_unroll]] for (int X = ToValue.x; X < WindowWidth; X += ValueStep)
		{
			if (TileRays[Start + X] <= 0.0) { continue; } // means of others have less spread
			FSignal Value = TileSignal[Start + X];
			Sum += Value;
			Squares += Value * Value;
			Count += TileInverseDepth[Start + X] > 0.0 ? 1.0 : 0.0;
		}
		RowSums[I] = Sum;
		RowSquares[I] = Squares;
		RowCounts[I] = Count;
	}
}

FWindow MeasureWindow()
{
	FSignal Sum = FSignal(0.0), Squares = FSignal(0.0);
	float Count = 0.0;
	[[dont_unroll]] for (int Y = GetStepsToValue(ivec2(0, gl_LocalInvocationID.y + 1u)).y; Y < WindowWidth; Y += ValueStep)
	{
		int I = (int(gl_LocalInvocationID.y) + Y) * GroupSize + int(gl_LocalInvocationID.x);
		Sum += RowSums[I];
		Squares += RowSquares[I];
		Count += RowCounts[I];
	}
	FWindow Window;
	Window.Mean = Sum / max(Count, 1.0);
	FSignal Variance = max(Squares / max(Count, 1.0) - Window.Mean * Window.Mean, FSignal(0.0));
	// Rounding leaves a small variance where all values are equal.
	Variance *= FSignal(greaterThan(vec3(Variance), 1.0e-6 * vec3(Window.Mean * Window.Mean)));
	Window.Sigma = sqrt(Variance);
	float Sigma = GetBrightness(Window.Sigma);
	Window.Variance = Sigma * Sigma;
	return Window;
}
#endif

#endif
