// Step "load" of the temporal filter: copies the signal of a work group's pixels, and of those around them, to shared memory.
//   Takes: the images Push.Signal, Push.Surface and Push.Extent.
//   Gives: TileSignal, TileInverseDepth and TileExtent, after a barrier.
//   Why: up to 49 windows contain the same pixel, and each would fetch it. A pixel of the sky, or with a signal that is not
//   finite, has the inverse depth 0: no later step counts it.
#ifndef LANTERN_TEMPORAL_LOAD_GLSL
#define LANTERN_TEMPORAL_LOAD_GLSL

#include "../../Library/Rate.glsl"
#include "../Signal.glsl"
#include "Even.glsl"

const int GroupSize = GROUP_SIZE;
#if CHANNELS == 1 && !defined(WITH_EXTENT)
const int WindowRadius = 2; // the neighbourhood's
#else
const int WindowRadius = DENOISE_WINDOW_RADIUS;
#endif
// Pixels that lie in the window of at least one of the group's pixels. The tile has one ring more: the neighbours of these.
const int InnerSize = GroupSize + 2 * WindowRadius;
const int TileSize = InnerSize + 2;

// With WITH_EXTENT, a pixel without a value of its own (a negative extent) has -1 minus what it was filled with.
shared FSignal TileSignal[TileSize * TileSize];
shared float TileInverseDepth[TileSize * TileSize]; // 1 / distance, linear in screen space over a plane; 0: no value
#if CHANNELS != 1
shared float TileRays[TileSize * TileSize]; // rays that a value is worth, of what most have; 0: the mean of other pixels stands for it
#endif
#ifdef WITH_EXTENT
shared float TileExtent[TileSize * TileSize]; // pixels; 0: unknown
#endif

// Distance from one pixel with a value of its own to the next, and from a pixel of the group, or the tile, to the first of these.
#ifdef QUARTER
const int ValueStep = 2;
ivec2 TurnInBlock; // of 2×2 pixels: the one that has a value. The group and the tile begin at even pixels
ivec2 GetStepsToValue(ivec2 P) { return (TurnInBlock + P) & 1; }
void FindTurn(uint FrameIndex) { TurnInBlock = ivec2(TurnPixel(uvec2(0u), FrameIndex)); }
#else
const int ValueStep = 1;
ivec2 GetStepsToValue(ivec2 P) { return ivec2(0); }
void FindTurn(uint FrameIndex) {}
#endif

// Index into the tile of the pixel at Offset from the invocation's own.
int GetTileIndex(ivec2 Offset)
{
	ivec2 P = ivec2(gl_LocalInvocationID.xy) + WindowRadius + 1 + Offset;
	return P.y * TileSize + P.x;
}

#if CHANNELS != 1
// Chance: CHANCE_….
float GetRays(float Chance) { return Chance > CHANCE_OF_SEVERAL && IsFinite(Chance) ? Chance - CHANCE_OF_SEVERAL : Chance == CHANCE_OF_OTHERS ? 0.0 : 1.0; }
#endif

// Returns whether any pixel that the thread has loaded has a signal.
bool LoadTile(ivec2 Size)
{
	bool bAny = false;
	uint Values = 0u;
	ivec2 First = ivec2(gl_WorkGroupID.xy) * GroupSize - (WindowRadius + 1);
	[[dont_unroll]] for (int I = int(gl_LocalInvocationIndex); I < TileSize * TileSize; I += GroupSize * GroupSize)
	{
		ivec2 P = First + ivec2(I % TileSize, I / TileSize);
		bool bInside = all(greaterThanEqual(P, ivec2(0))) && all(lessThan(P, Size));
		P = clamp(P, ivec2(0), Size - 1);
		vec4 Texel = texelFetch(Textures[Push.Signal], P, 0);
		FSignal Value = GetSignal(Texel);
		float Distance = texelFetch(Textures[Push.Surface], P, 0).x;
		bool bValid = bInside && Distance > 0.0 && IsFinite(Distance) && IsSignalFinite(Value);
		TileInverseDepth[I] = bValid ? 1.0 / Distance : 0.0;
#ifdef WITH_EXTENT
		float Extent = bValid ? texelFetch(Textures[Push.Extent], P, 0).x : 0.0;
		TileExtent[I] = IsFinite(Extent) ? max(Extent, 0.0) : 0.0;
		TileSignal[I] = Extent < 0.0 ? -1.0 - SanitizeSignal(Value, bValid) : SanitizeSignal(Value, bValid);
#else
		TileSignal[I] = SanitizeSignal(Value, bValid);
#endif
#ifdef FINDS_EVEN
		if (bValid) { Values |= CompareValue(TileSignal[I]); }
#endif
#if CHANNELS != 1
		TileRays[I] = GetRays(Texel.w);
		bAny = bAny || GetBrightness(TileSignal[I]) > 0.0;
#endif
	}
#ifdef FINDS_EVEN
	NoteValues(Values);
#endif
	return bAny;
}

#if CHANNELS != 1
// Returns CHANCE_… of the pixel's value.
float LoadChance() { return texelFetch(Textures[Push.Signal], ivec2(gl_GlobalInvocationID.xy), 0).w; }

// Whether the mean of other pixels stands for the pixel's own value.
bool IsFilled() { return TileRays[GetTileIndex(ivec2(0))] <= 0.0; }

// Whether the pixel has a value without noise, which other frames could only blur.
bool IsCertain() { return LoadChance() == CHANCE_NONE && TileInverseDepth[GetTileIndex(ivec2(0))] > 0.0; }
#endif

// Whether a pixel of the tile has a value of its own.
bool HasValue(int I)
{
#ifdef WITH_EXTENT
	if (TileSignal[I] < 0.0) { return false; }
#endif
#if CHANNELS != 1
	if (TileRays[I] <= 0.0) { return false; }
#endif
	return TileInverseDepth[I] > 0.0;
}

// Whether a pixel of the tile is more than a tenth nearer or farther than the invocation's own, hence of another surface.
bool IsAtOtherDepth(int I, float InverseDepth) { return abs(TileInverseDepth[I] - InverseDepth) > 0.1 * InverseDepth; }

#endif
