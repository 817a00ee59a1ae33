// By how much light in radiance cells has changed of late. A cell remembers what its light was a moment ago (FRadianceGrid::Moment), so that who
// looks it up gets the light of now and of then along one path. Their difference has the noise of cells and not that of paths. Schied et al.
// 2018, "Gradient Estimation for Real-Time Adaptive Temporal Filtering", trace paths again for that.
#ifndef LANTERN_RADIANCE_CHANGE_GLSL
#define LANTERN_RADIANCE_CHANGE_GLSL

const uint ChangeShift = 24u; // of the bits beside a normal
const uint NormalMask = (1u << ChangeShift) - 1u;

// Light a moment ago over that of now, from 2^-8 to 2^8. U: random, in [0, 1): rounds. 0: the cell is too young to know.
uint PackBefore(float Ratio, float U) { return uint(clamp(log2(max(Ratio, 1.0e-6)) * 16.0 + 128.0 + U, 1.0, 255.0)) << ChangeShift; }
const float MostGone = 255.0; // of what light now is
bool KnowsBefore(uint P) { return P >> ChangeShift != 0u; }
float UnpackBefore(uint P) { return KnowsBefore(P) ? exp2((float(P >> ChangeShift) - 128.0) / 16.0) : 1.0; }

// Returns what UnpackBefore gives after some frames without an update. Moment: 0: nothing has changed for long.
float AgeBefore(float Ratio, float Frames, float Moment) { return Moment > 0.0 ? 1.0 + (Ratio - 1.0) * exp(-Frames / Moment) : 1.0; }

const float MostTrend = 1.0;

// By what part of itself the light that reaches a cell has risen within a moment, from -MostTrend to MostTrend. Small ones have finer steps.
uint PackTrend(float Trend, float U)
{
	float Steps = sign(Trend) * sqrt(min(abs(Trend) / MostTrend, 1.0)) * 127.0;
	return uint(clamp(int(floor(Steps + U)), -127, 127) & 0xff) << ChangeShift;
}
float UnpackTrend(uint P)
{
	float Part = float(bitfieldExtract(int(P), int(ChangeShift), 8)) / 127.0;
	return sign(Part) * Part * Part * MostTrend;
}

// Part of the light that may change within the time over which it is averaged. Cells are passed on from one to the next, and pixels are not.
const float ChangeInCells = 0.05, ChangeInPixels = 0.1;

// Returns the frames over which light may be averaged that changes by a part of itself in a moment. Moment: frames. May: of itself.
float GetFramesOfChange(float Part, float May, float Moment) { return Moment * May / max(abs(Part), 1.0e-6); }

#endif
