// Where curved mirrors showed a point in the frame before.
//
// A mirror showed the point where it reflected the previous camera's ray to it. That place is searched among the pixels around, moved back
// with the mirror's object, by Newton's method in pixels. Derivatives come from neighbours some pixels away, so that bumps average out. Each
// step corrects them (Broyden 1965, "A Class of Methods for Solving Nonlinear Simultaneous Equations"). It needs no history of normals, since
// the mirror's surface is that of this frame.
// NO_MIRROR_CURVATURE: planted fault (r.RT.Debug.Reflections.Curvature).
#ifndef LANTERN_REFLECTIONS_CURVED_GLSL
#define LANTERN_REFLECTIONS_CURVED_GLSL

const int FarReach = 8, NearReach = 2; // pixels to neighbours: where a mirror hardly curves, and where it does
const float FlatMirror = 1.0e-4;   // radians that the normal turns over the pixels beside a flat one; half of it is rounding
const float StrongTurn = 0.05;     // radians, beyond which closer pixels are taken
const float OtherTurn = 0.85;      // cosine, below which a neighbour is another surface
const float OtherRoughness = 0.05; // between pixels of one mirror
const int MirrorSteps = 6;
const float LongestStep = 48.0;    // pixels
const float NoMiss = 0.01;         // pixels: nothing has moved
const float FoundMiss = 0.05;      // pixels: no further step is worth it
const float MostMiss = 1.0;        // pixels: farther off, the place counts as not found

// The surface of a mirror in the frame before, around a pixel of this frame.
struct FMirrorPatch
{
	uint Object;     // into FObjectData[], or NoObject
	float Identity;  // texel of FGBuffer::Motion, w; compared if bNamed
	float Roughness;
	vec3 Normal;     // of the pixel, now
	bool bNamed;
};

struct FMirrorPlace
{
	vec3 Position, Normal; // relative to the previous camera
	bool bKnown;
};

struct FMirrorTexel
{
	vec3 Position, Normal; // relative to the camera
	bool bKnown;
};

FMirrorTexel LoadMirrorTexel(FViewConstants View, FMirrorPatch Patch, ivec2 Pixel)
{
	FMirrorTexel Texel = FMirrorTexel(vec3(0.0), vec3(0.0, 0.0, 1.0), false);
	if (any(lessThan(Pixel, ivec2(0))) || any(greaterThanEqual(Pixel, ivec2(View.Width, View.Height)))) { return Texel; }
	float Depth = LoadDepth(Push.Pixels.Depth, Pixel);
	if (!(Depth > 0.0)) { return Texel; }
	if (Patch.bNamed && texelFetch(Textures[Push.Motion], Pixel, 0).w != Patch.Identity) { return Texel; }
	if (abs(texelFetch(Textures[Push.Pixels.Material], Pixel, 0).x - Patch.Roughness) > OtherRoughness) { return Texel; }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, Depth);
	Texel.Position = Point.Relative;
	Texel.Normal = Point.BentN;
	Texel.bKnown = dot(Texel.Normal, Patch.Normal) > OtherTurn;
	return Texel;
}

// Place: between the centres of pixels, from that of the first one.
FMirrorPlace FindMirrorPlace(FSceneConstants Scene, FViewConstants View, FMirrorPatch Patch, vec2 Place)
{
	FMirrorPlace Found = FMirrorPlace(vec3(0.0), vec3(0.0, 0.0, 1.0), false);
	if (any(lessThan(Place, vec2(-1.0))) || any(greaterThan(Place, vec2(View.Width, View.Height)))) { return Found; }
	ivec2 Base = ivec2(floor(Place));
	vec2 F = Place - vec2(Base);
	vec3 Position = vec3(0.0), Normal = vec3(0.0);
	for (int Tap = 0; Tap < 4; ++Tap)
	{
		float Weight = ((Tap & 1) != 0 ? F.x : 1.0 - F.x) * ((Tap & 2) != 0 ? F.y : 1.0 - F.y);
		if (Weight <= 0.0) { continue; }
		FMirrorTexel Texel = LoadMirrorTexel(View, Patch, GetTap(Base, Tap));
		if (!Texel.bKnown) { return Found; }
		Position += Weight * Texel.Position;
		Normal += Weight * Texel.Normal;
	}
	Found.Position = MoveBack(Scene, View, Patch.Object, Position);
	Found.Normal = TurnBack(Scene, View, Patch.Object, normalize(Normal));
	Found.bKnown = true;
	return Found;
}

// Returns how far the ray of the previous camera, reflected at a place, is off the direction of the point: tangents along the first two axes.
vec2 MissPoint(FViewConstants View, FMirrorPlace Place, vec3 PointBefore, mat3 Axes)
{
	vec3 From = View.bOrthographic != 0u ? View.PreviousForward : normalize(Place.Position);
	vec3 Miss = normalize(PointBefore - Place.Position) - reflect(From, Place.Normal);
	return (Miss * Axes).xy;
}

// Finds how the miss changes from pixel to pixel. Here: place of the pixel. bFlat: the mirror does not curve, or nothing around it is known.
mat2 FindMissSlopes(FSceneConstants Scene, FViewConstants View, FMirrorPatch Patch, FMirrorPlace Here, ivec2 Pixel, vec3 PointBefore,
                    mat3 Axes, out bool bFlat)
{
	mat2 Slopes = mat2(0.0);
	bFlat = true;
	for (int Reach = FarReach; Reach >= NearReach; Reach /= FarReach / NearReach)
	{
		float Turn = 0.0;
		bool bComplete = true;
		for (int Axis = 0; Axis < 2; ++Axis)
		{
			vec2 Step = Axis == 0 ? vec2(Reach, 0.0) : vec2(0.0, Reach), At = vec2(Pixel);
			FMirrorPlace Before = FindMirrorPlace(Scene, View, Patch, At - Step), After = FindMirrorPlace(Scene, View, Patch, At + Step);
			float Pixels = float(Reach) * (float(Before.bKnown) + float(After.bKnown));
			bComplete = Pixels > 0.0;
			if (!bComplete) { break; }
			if (!Before.bKnown) { Before = Here; }
			if (!After.bKnown) { After = Here; }
			Slopes[Axis] = (MissPoint(View, After, PointBefore, Axes) - MissPoint(View, Before, PointBefore, Axes)) / Pixels;
			Turn = max(Turn, distance(Before.Normal, After.Normal));
		}
		if (!bComplete || (Turn > StrongTurn && Reach == FarReach)) { continue; }
		bFlat = Turn < FlatMirror;
		return Slopes;
	}
	return Slopes;
}

struct FCurvedImage
{
	vec3 Position; // of the mirror's place that showed the point, relative to the previous camera
	vec2 Rest;     // what it is off, pixels
	float Spread;  // how much faster what is shown changes from pixel to pixel than in a flat mirror, at least 1
	bool bFlat, bFound; // bFlat: nothing else is known
};

// PointBefore: relative to the previous camera. Length: from the mirror to the point, metres. Reach: from the camera to the point by way of
// the mirror.
FCurvedImage FindInCurvedMirror(FSceneConstants Scene, FViewConstants View, FMirrorPatch Patch, ivec2 Pixel, vec3 PointBefore, float Length,
                                float Reach)
{
	FCurvedImage Image = FCurvedImage(vec3(0.0), vec2(0.0), 1.0, true, false);
#ifndef NO_MIRROR_CURVATURE
	FMirrorPlace Here = FindMirrorPlace(Scene, View, Patch, vec2(Pixel));
	if (!Here.bKnown) { return Image; }
	mat3 Axes = MakeBasis(normalize(PointBefore - Here.Position));
	vec2 At = vec2(Pixel), Miss = MissPoint(View, Here, PointBefore, Axes);
	float PixelReach = View.PixelSize * (View.bOrthographic != 0u ? 1.0 : Reach);
	if (length(Miss) * Length < NoMiss * PixelReach)
	{
		Image.Position = Here.Position;
		Image.bFlat = false;
		Image.bFound = true;
		return Image;
	}
	mat2 Slopes = FindMissSlopes(Scene, View, Patch, Here, Pixel, PointBefore, Axes, Image.bFlat);
	if (Image.bFlat) { return Image; }
	Image.Spread = max(max(length(Slopes[0]), length(Slopes[1])) * Length / PixelReach, 1.0);
	for (int Step = 0; Step < MirrorSteps; ++Step)
	{
		float Area = determinant(Slopes);
		if (!(abs(Area) > 1.0e-12)) { return Image; } // a focus: the point is everywhere
		vec2 Move = -(inverse(Slopes) * Miss);
		float Pixels = length(Move);
		if (Pixels < MostMiss)
		{
			Image.Position = Here.Position;
			Image.Rest = Move;
			Image.bFound = true;
			if (Pixels < FoundMiss) { break; }
		}
		Move *= min(1.0, LongestStep / Pixels);
		FMirrorPlace Next = FindMirrorPlace(Scene, View, Patch, At + Move);
		if (!Next.bKnown) { break; }
		vec2 NextMiss = MissPoint(View, Next, PointBefore, Axes);
		Slopes += outerProduct(NextMiss - Miss - Slopes * Move, Move / max(dot(Move, Move), 1.0e-12));
		At += Move;
		Miss = NextMiss;
		Here = Next;
	}
#endif
	return Image;
}

#endif
