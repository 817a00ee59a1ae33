// What the host's shadow map says of a pixel. A host whose map is none of cascades puts a file of its own in place of this
// (MakeHostShadowHeader). That file defines the three functions that do not take cascades: ClassifyHostShadow, IsHostShadowKept and
// FilterHostShadow. Their Data is then FHostShadow::ShaderData. Its includes are relative to the shader folder.
#ifndef LANTERN_HOST_SHADOW_GLSL
#define LANTERN_HOST_SHADOW_GLSL

#include "../Library/GBuffer.glsl"
#include "HostShadowAnswer.glsl"
#include "HostShadowMap.glsl"

// A surface as a cascade has it.
struct FMapPoint
{
	vec2 Texel;
	float Distance; // from the near plane along the sun's light, metres
	vec2 Slope;     // of its plane: metres for each texel
	float Error;    // by which texels of the surface itself may be nearer to the sun, metres
	float Footprint; // half width of what the disk's rays cross on the map, texels
};

FMapPoint ToMap(FAddress Cascade, FViewConstants View, FGBufferPoint Point)
{
	FMapPoint Out;
	vec4 P = vec4(Point.Relative, 1.0);
	Out.Texel = vec2(dot(FCascadeRef(Cascade).Data.ToMap[0], P), dot(FCascadeRef(Cascade).Data.ToMap[1], P));
	Out.Distance = dot(FCascadeRef(Cascade).Data.ToMap[2], P);
	vec3 N = vec3(dot(FCascadeRef(Cascade).Data.NormalToMap[0], Point.Ng), dot(FCascadeRef(Cascade).Data.NormalToMap[1], Point.Ng), dot(FCascadeRef(Cascade).Data.NormalToMap[2], Point.Ng));
	Out.Slope = -N.xy / (abs(N.z) > 1.0e-6 ? N.z : 1.0e-6);
	float Rise = abs(Out.Slope.x) + abs(Out.Slope.y), Along = dot(View.CameraForward, Point.Relative);
	float RasterError = View.DepthError.x + Along * (View.DepthError.y + Along * View.DepthError.z) + PixelHeight(View, Along) / 256.0;
	Out.Error = RasterError + FCascadeRef(Cascade).Data.Bias + 0.05 * Rise + View.NormalError * (FCascadeRef(Cascade).Data.TexelSize + Rise);
	Out.Footprint = 0.0;
	return Out;
}

bool IsInside(FAddress Cascade, vec2 Texel, float Margin)
{
	return all(greaterThanEqual(Texel, vec2(Margin))) && all(lessThan(Texel, vec2(FCascadeRef(Cascade).Data.Width, FCascadeRef(Cascade).Data.Height) - Margin));
}

// Narrows the footprint: no blocker that rays of the disk can meet is farther from the surface than the nearest texel of a footprint that
// was surely large enough.
void NarrowFootprint(FAddress Cascade, inout FMapPoint Point)
{
	[[dont_unroll]] for (int Step = 0; Step < 3 && Point.Footprint > 1.0; ++Step)
	{
		float Reach;
		float Nearest = LoadSquare(Cascade, Point.Texel, Point.Footprint, Reach).x;
		Point.Footprint = min(Point.Footprint, max(Point.Distance - Nearest, 0.0) * FCascadeRef(Cascade).Data.SpreadTexels);
	}
}

// Finds the finest cascade that has all of the footprint. False: none has.
bool FindCascade(FAddress Host, FViewConstants View, FGBufferPoint Surface, out uint OutCascade, out FMapPoint Out)
{
	uint Last = FHostShadowRef(Host).Data.CascadeCount - 1u;
	// The coarsest cascade holds the blockers of all others.
	FAddress Coarsest = GetCascade(Host, Last);
	Out = ToMap(Coarsest, View, Surface);
	OutCascade = Last;
	Out.Footprint = max(Out.Distance, 0.0) * FCascadeRef(Coarsest).Data.SpreadTexels;
	if (!IsInside(Coarsest, Out.Texel, 2.0) || Out.Distance < 0.0) { return false; }
	NarrowFootprint(Coarsest, Out);
	// Spreads are proportional to what a texel's width is; a metre has so many texels.
	float Metres = Out.Footprint / max(FCascadeRef(Coarsest).Data.SpreadTexels, 1.0e-30);
	bool bFound = false;
	for (uint I = 0u; I <= Last && !bFound; ++I)
	{
		FAddress Cascade = GetCascade(Host, I);
		Out = ToMap(Cascade, View, Surface);
		Out.Footprint = Metres * FCascadeRef(Cascade).Data.SpreadTexels;
		bFound = Out.Distance >= 0.0 && IsInside(Cascade, Out.Texel, Out.Footprint + 2.0);
		OutCascade = I;
	}
	if (bFound) { NarrowFootprint(GetCascade(Host, OutCascade), Out); }
	return bFound;
}

// Rays between two blockers that lie one above the other can pass where the map shows no gap. The gap is Range / Distance of the disk's
// radius wide at most. A tenth of it is 2 % of the disk; a gap narrower than a texel is below what a map can say.
bool HasNoGap(FAddress Cascade, float Distance, float Range)
{
	return Range <= 0.1 * Distance || 2.0 * Range * FCascadeRef(Cascade).Data.SpreadTexels <= 1.0;
}

// Looks at each of the 4 × 4 texels around a footprint that is not larger.
FHostShadowAnswer ClassifyTexels(FAddress Cascade, FMapPoint Point)
{
	ivec2 First = ivec2(floor(Point.Texel - 0.5)) - 1;
	int Blockers = 0;
	float Nearest = 1.0e30, Farthest = -1.0e30;
	[[dont_unroll]] for (int I = 0; I < 16; ++I)
	{
		ivec2 Texel = First + ivec2(I & 3, I >> 2);
		float Plane = Point.Distance + dot(Point.Slope, vec2(Texel) + 0.5 - Point.Texel);
		float Depth = LoadMapDepth(Cascade, Texel);
		if (Depth >= Plane - Point.Error) { continue; }
		++Blockers;
		Nearest = min(Nearest, Depth);
		Farthest = max(Farthest, Depth);
	}
	float Distance = Point.Distance - Nearest;
	if (Blockers == 0) { return FHostShadowAnswer(HOST_SHADOW_LIT, 0.0); }
	if (Blockers < 16 || Distance * FCascadeRef(Cascade).Data.SpreadTexels > 1.0) { return FHostShadowAnswer(HOST_SHADOW_UNSURE, Distance); }
	return FHostShadowAnswer(HasNoGap(Cascade, Distance, Farthest - Nearest) ? HOST_SHADOW_DARK : HOST_SHADOW_UNSURE, Distance);
}

FHostShadowAnswer ClassifySquare(FAddress Cascade, FMapPoint Point)
{
	float Reach;
	vec2 Square = LoadSquare(Cascade, Point.Texel, Point.Footprint + 1.0, Reach);
	float Rise = (abs(Point.Slope.x) + abs(Point.Slope.y)) * Reach;
	float Distance = Point.Distance - Square.x;
	bool bDark = Square.y < Point.Distance - Point.Error - Rise && HasNoGap(Cascade, Distance, Square.y - Square.x);
	return FHostShadowAnswer(bDark ? HOST_SHADOW_DARK : HOST_SHADOW_UNSURE, Distance);
}

FHostShadowAnswer ClassifyCascade(FAddress Cascade, FMapPoint Point)
{
	// Planes that the sun's light grazes have no depth at a texel.
	if (abs(Point.Slope.x) + abs(Point.Slope.y) > 8.0 * FCascadeRef(Cascade).Data.TexelSize) { return FHostShadowAnswer(HOST_SHADOW_UNSURE, 0.0); }
	return Point.Footprint <= 1.0 ? ClassifyTexels(Cascade, Point) : ClassifySquare(Cascade, Point);
}

// Says whether what the map holds shadows all of a pixel's rays, or none.
FHostShadowAnswer ClassifyHostShadow(FAddress Data, FViewConstants View, FGBufferPoint Surface)
{
	FMapPoint Point;
	uint Index;
	if (!Surface.bSure || !FindCascade(Data, View, Surface, Index, Point)) { return FHostShadowAnswer(HOST_SHADOW_UNSURE, 0.0); }
	FAddress Cascade = GetCascade(Data, Index);
	FHostShadowAnswer Answer = ClassifyCascade(Cascade, Point);
	// What is thinner than a texel may lie between texels.
	bool bCoarse = FCascadeRef(Cascade).Data.TexelSize > FHostShadowRef(Data).Data.TexelPixels * PixelHeight(View, length(Surface.Relative));
	if (Answer.Class == HOST_SHADOW_LIT && bCoarse && FHostShadowRef(Data).Data.bKept == 0u) { Answer.Class = HOST_SHADOW_UNSURE; }
	return Answer;
}

// Point of a disk of radius 1 (Vogel 1979): N of them cover it evenly.
vec2 DiskPoint(uint I, uint N) { return sqrt((float(I) + 0.5) / float(N)) * vec2(cos(float(I) * 2.39996323), sin(float(I) * 2.39996323)); }

// Mean distance of blockers in a disk, in metres, and the share of its points that have one. Radius: texels.
vec2 SampleBlockers(FAddress Cascade, FMapPoint Point, float Radius)
{
	const uint Count = 32u;
	float Sum = 0.0, Found = 0.0;
	[[dont_unroll]] for (uint I = 0u; I < Count; ++I)
	{
		ivec2 Texel = clamp(ivec2(floor(Point.Texel + Radius * DiskPoint(I, Count))), ivec2(0), ivec2(FCascadeRef(Cascade).Data.Width, FCascadeRef(Cascade).Data.Height) - 1);
		float Plane = Point.Distance + dot(Point.Slope, vec2(Texel) + 0.5 - Point.Texel);
		float Depth = LoadMapDepth(Cascade, Texel);
		if (Depth >= Plane - Point.Error) { continue; }
		Sum += Point.Distance - Depth;
		Found += 1.0;
	}
	return vec2(Sum / max(Found, 1.0), Found / float(Count));
}

// Whether FilterHostShadow counts in all pixels, because rays cannot meet all that the map holds.
bool IsHostShadowKept(FAddress Data) { return FHostShadowRef(Data).Data.bKept != 0u; }

// Returns the share of the sun's disk that what the map holds leaves to a pixel (percentage-closer soft shadows, Fernando 2005).
float FilterHostShadow(FAddress Data, FViewConstants View, FGBufferPoint Surface)
{
	FMapPoint Point;
	uint Index;
	if (!FindCascade(Data, View, Surface, Index, Point)) { return 1.0; }
	FAddress Cascade = GetCascade(Data, Index);
	float Blockers = SampleBlockers(Cascade, Point, max(Point.Footprint, 0.7)).x;
	return 1.0 - SampleBlockers(Cascade, Point, max(Blockers * FCascadeRef(Cascade).Data.SpreadTexels, 0.7)).y;
}

#endif
