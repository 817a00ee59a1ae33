// Adds what a frame's paths brought to the maps of directions that guide the next frame's paths. One group for each tile.
// CHECKERBOARD, QUARTER: see Rate.glsl.
#version 460
#include "../Library/Rate.glsl"
#include "../Rays/PathGuide.glsl"

layout(local_size_x = PATH_GUIDE_BINS) in;
layout(push_constant, scalar) uniform FPush { FPathGuideConstants Push; };

const uint NoPlace = 0xffffffffu;
const float Steps = 65535.0;

shared uint Nearest;            // place of the pixel that stands for the tile
shared uint Brightest, Highest; // bits of floats that are not negative, whose order is the same
shared uint Paths;
shared uint Sums[PATH_GUIDE_BINS];
shared float Means[PATH_GUIDE_BINS];

// Returns the pixel that a thread looks at to find the tile's place.
uvec2 PixelOf(uvec2 Tile, uint Place) { return Tile * PATH_GUIDE_TILE + 2u * uvec2(Place & 7u, Place >> 3u); }

uint LoadRecord(FViewConstants View, uvec2 Tile, uint Number)
{
	uvec2 Size = TurnThreads(uvec2(PATH_GUIDE_TILE)), Threads = TurnThreads(uvec2(View.Width, View.Height));
	uvec2 Thread = Tile * Size + uvec2(Number % Size.x, Number / Size.x);
	return all(lessThan(Thread, Threads)) ? FPathRecordRef(Push.Records).Data[Thread.y * Threads.x + Thread.x] : PATH_GUIDE_NO_PATH;
}
float ValueOf(uint Record) { return uintBitsToFloat(Record & ~uint(PATH_GUIDE_BINS - 1)); }

// Sums of integers do not depend on the order in which threads add.
void SumRecords(FViewConstants View, uvec2 Tile, uint Place)
{
	uint Most = TurnThreads(uvec2(PATH_GUIDE_TILE)).x * TurnThreads(uvec2(PATH_GUIDE_TILE)).y;
	for (uint Number = Place; Number < Most; Number += PATH_GUIDE_BINS)
	{
		uint Record = LoadRecord(View, Tile, Number);
		if (Record != PATH_GUIDE_NO_PATH) { atomicMax(Brightest, floatBitsToUint(ValueOf(Record))); }
	}
	barrier();
	float Scale = Steps / max(uintBitsToFloat(Brightest), 1.0e-30);
	for (uint Number = Place; Number < Most; Number += PATH_GUIDE_BINS)
	{
		uint Record = LoadRecord(View, Tile, Number);
		if (Record == PATH_GUIDE_NO_PATH) { continue; }
		atomicAdd(Paths, 1u);
		atomicAdd(Sums[Record & uint(PATH_GUIDE_BINS - 1)], uint(ValueOf(Record) * Scale + 0.5));
	}
	barrier();
}

// Returns the address of the tile that this one goes on. 0: there is none.
FAddress FindPrevious(FViewConstants View, uvec2 Tile)
{
	if (Nearest == NoPlace) { return FAddress(0); }
	ivec2 Pixel = ivec2(PixelOf(Tile, Nearest ^ 27u));
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, LoadDepth(Push.Depth, Pixel));
	return FindGuideTile(View, Push.Previous, Point.Relative, vec2(Pixel) + 0.5, vec2(0.0));
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Tile = gl_WorkGroupID.xy;
	uint Place = gl_LocalInvocationIndex;
	if (Place == 0u)
	{
		Nearest = NoPlace;
		Brightest = Highest = Paths = 0u;
	}
	Sums[Place] = 0u;
	barrier();
	uvec2 Pixel = PixelOf(Tile, Place);
	if (all(lessThan(Pixel, uvec2(View.Width, View.Height))) && LoadDepth(Push.Depth, ivec2(Pixel)) > 0.0) { atomicMin(Nearest, Place ^ 27u); }
	SumRecords(View, Tile, Place);

	FAddress Previous = FindPrevious(View, Tile);
	float Past = 0.0, PastScale = 0.0;
	uint Frames = 0u;
	if (Previous != FAddress(0))
	{
		uint Packed = FPathGuideTileRef(Previous).Data.Bins[Place >> 1u];
		PastScale = FPathGuideTileRef(Previous).Data.Scale;
		Frames = min(FPathGuideTileRef(Previous).Data.Frames, PATH_GUIDE_FRAMES - 1u);
		Past = GuideLight(Packed, Place);
	}
	if (!(PastScale > 0.0 && PastScale < 1.0e30)) { Frames = 0u; } // memory may hold anything
	float Now = float(Sums[Place]) * uintBitsToFloat(Brightest) / Steps / max(float(Paths), 1.0);
	float Mean = Frames == 0u ? Now : Paths == 0u ? Past * PastScale : mix(Past * PastScale, Now, 1.0 / float(Frames + 1u));
	Means[Place] = Mean;
	atomicMax(Highest, floatBitsToUint(Mean));
	barrier();

	float Scale = uintBitsToFloat(Highest) / Steps;
	FPathGuideTileRef Out = FPathGuideTileRef(GuideTileAddress(View, Push.Current, Tile));
	if (Place < PATH_GUIDE_BINS / 2)
	{
		float Inverse = Scale > 0.0 ? 1.0 / Scale : 0.0;
		uvec2 Pair = uvec2(min(vec2(Means[2u * Place], Means[2u * Place + 1u]) * Inverse + 0.5, vec2(Steps)));
		Out.Data.Bins[Place] = Pair.x | (Pair.y << 16u);
	}
	if (Place == 0u)
	{
		float Known = Frames == 0u ? 0.0 : FPathGuideTileRef(Previous).Data.Paths;
		float Kept = Frames + 1u < PATH_GUIDE_FRAMES || Paths == 0u ? 1.0 : 1.0 - 1.0 / float(PATH_GUIDE_FRAMES);
		Out.Data.Paths = (Known > 0.0 && Known < 1.0e6 ? Known : 0.0) * Kept + float(Paths);
		Out.Data.Scale = Scale;
		Out.Data.Frames = Scale > 0.0 ? Frames + (Paths > 0u ? 1u : 0u) : 0u;
	}
}
