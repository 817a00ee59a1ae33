// Step "neighbourhood" of the temporal filter: mean brightness, and variance by outliers, of 5×5 pixels of one surface.
//   Takes: the tile of Load.glsl.
//   Gives: FNeighborhood. MeasureOutliers needs the tile complete; MeasureNeighborhood needs the outliers complete.
//   Why: the spread of neighbours says nothing about noise, because edges and lines have a spread too. They also have company:
//   of four neighbours, two continue a line. A pixel that differs from nearly all of its neighbours is therefore noise.
#ifndef LANTERN_TEMPORAL_NEIGHBORHOOD_GLSL
#define LANTERN_TEMPORAL_NEIGHBORHOOD_GLSL

#include "Load.glsl"

const int NeighborhoodRadius = 2;

#ifndef QUARTER
shared float OutlierVariance[InnerSize * InnerSize]; // of each pixel; negative: unknown
#endif

struct FNeighborhood
{
	float Mean;            // brightness
	float OutlierVariance; // negative: unknown
	float Count;           // pixels at about the depth of the middle, at least 1, as if each had one ray
};

#ifdef QUARTER
void MeasureOutliers() {} // no pixel has a neighbour with a value
void ClearOutliers() {}
#else
// Where all signals are 0.
void ClearOutliers()
{
	for (int I = int(gl_LocalInvocationIndex); I < InnerSize * InnerSize; I += GroupSize * GroupSize) { OutlierVariance[I] = 0.0; }
}

// Whether pixel I of the tile and those one Step before and behind it lie on one plane.
bool IsPlanar(int I, int Step)
{
	float Sum = TileInverseDepth[I - Step] + TileInverseDepth[I + Step];
	return HasValue(I - Step) && HasValue(I + Step) &&
	       abs(Sum - 2.0 * TileInverseDepth[I]) < 0.02 * TileInverseDepth[I];
}

// Square of the least amount by which the pixel differs from at least three of its four neighbours. If only two of them
// are on its surface, from these two. For random zeros and ones its mean is the variance within a quarter. Negative: unknown.
float MeasureOutlier(int I)
{
	if (!HasValue(I)) { return -1.0; }
	int StepX = 1, StepY = TileSize;
#if CHANNELS != 1
	if (TileRays[I - 1] <= 0.0 || TileRays[I + 1] <= 0.0) // every other pixel has a value: the next ones lie across corners
	{
		StepX = TileSize + 1;
		StepY = TileSize - 1;
	}
#endif
	bool bX = IsPlanar(I, StepX), bY = IsPlanar(I, StepY);
	if (!bX && !bY) { return -1.0; }
	vec2 X = vec2(GetBrightness(TileSignal[I - StepX]), GetBrightness(TileSignal[I + StepX]));
	vec2 Y = vec2(GetBrightness(TileSignal[I - StepY]), GetBrightness(TileSignal[I + StepY]));
	vec2 Range = bX ? X : Y;
	// The second and the third of the four in order.
	if (bX && bY) { Range = vec2(max(min(X.x, X.y), min(Y.x, Y.y)), min(max(X.x, X.y), max(Y.x, Y.y))); }
	float Value = GetBrightness(TileSignal[I]);
	float Outlier = Value - clamp(Value, min(Range.x, Range.y), max(Range.x, Range.y));
#if CHANNELS != 1
	// As if all had one ray.
	vec2 Others = 0.5 * (1.0 / vec2(TileRays[I - StepX], TileRays[I - StepY]) + 1.0 / vec2(TileRays[I + StepX], TileRays[I + StepY]));
	float Inverse = bX && bY ? 0.5 * (Others.x + Others.y) : bX ? Others.x : Others.y;
	return Outlier * Outlier * 2.0 / (1.0 / TileRays[I] + Inverse);
#else
	return Outlier * Outlier;
#endif
}

void MeasureOutliers()
{
	[[dont_unroll]] for (int I = int(gl_LocalInvocationIndex); I < InnerSize * InnerSize; I += GroupSize * GroupSize)
	{
		OutlierVariance[I] = MeasureOutlier((I / InnerSize + 1) * TileSize + I % InnerSize + 1);
	}
}
#endif

FNeighborhood MeasureNeighborhood()
{
	float InverseDepth = TileInverseDepth[GetTileIndex(ivec2(0))];
	ivec2 Inner = ivec2(gl_LocalInvocationID.xy) + WindowRadius;
	float Sum = 0.0, Count = 0.0, Inverses = 0.0, OutlierSum = 0.0, OutlierCount = 0.0, Missing = 0.0;
	ivec2 First = GetStepsToValue(ivec2(gl_LocalInvocationID.xy) - NeighborhoodRadius) - NeighborhoodRadius;
	[[dont_unroll]] for (int Y = First.y; Y <= NeighborhoodRadius; Y += ValueStep)
	{
		[[dont_unroll]] for (int X = First.x; X <= NeighborhoodRadius; X += ValueStep)
		{
			int I = GetTileIndex(ivec2(X, Y));
			if (IsAtOtherDepth(I, InverseDepth)) { continue; }
			if (!HasValue(I))
			{
				Missing += 1.0;
				continue;
			}
			Sum += GetBrightness(TileSignal[I]);
			Count += 1.0;
#if CHANNELS != 1
			Inverses += 1.0 / TileRays[I];
#endif
#ifdef QUARTER
			Missing += 3.0;
#else
			float Outlier = OutlierVariance[(Inner.y + Y) * InnerSize + Inner.x + X];
			if (Outlier < 0.0) { continue; }
			OutlierSum += Outlier;
			OutlierCount += 1.0;
#endif
		}
	}
#ifdef WITH_EXTENT
	if (Count == 0.0) { Sum = max(-1.0 - TileSignal[GetTileIndex(ivec2(0))], 0.0); } // what it was filled with
#endif
#if CHANNELS != 1
	if (Count == 0.0) { Sum = GetBrightness(TileSignal[GetTileIndex(ivec2(0))]); } // what it was filled with
	float Mean = Sum / max(Count, 1.0);
	if (Inverses > 0.0 && Inverses < Count) // means of several rays are worth more pixels
	{
		Count *= Count / Inverses;
		Sum = Mean * Count;
	}
	if (Missing > 0.0) // rays of some pixels are spread less evenly than those of all
	{
		Count *= Count / (Count + Missing);
		Sum = Mean * max(Count, 1.0);
	}
#else
	if (Missing > 0.0 && OutlierCount == 0.0) // whose neighbours are missing cannot be told from an outlier: each ray sees by chance
	{
		float Mean = clamp(Sum / max(Count, 1.0), 0.0, 1.0);
		OutlierSum = Mean * (1.0 - Mean) / Push.RaysPerPixel;
		OutlierCount = 1.0;
	}
#endif
	return FNeighborhood(Sum / max(Count, 1.0), OutlierCount > 0.0 ? OutlierSum / OutlierCount : -1.0, max(Count, 1.0));
}

#endif
