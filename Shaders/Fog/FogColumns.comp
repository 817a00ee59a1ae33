// Finds how far the view sees into each column, by what the frame before saw.
// CURRENT_DEPTH: by what this frame sees. Depth and the previous columns are then its own.
#version 460
#include "Froxels.glsl"

layout(local_size_x = FOG_GROUP_SIZE, local_size_y = FOG_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FFogColumnsConstants Push; };

// Returns how far columns of the frame before showed anything (x), and up to where they showed air alone (y), unless they show an edge of
// something: behind that there is air again. 0: unlimited. Low, High: of these columns.
vec2 FarthestOf(ivec2 Low, ivec2 High)
{
	ivec2 Last = ivec2(Push.PreviousColumns, Push.PreviousRows) - 1;
	float Farthest = 0.0, Nearest = 1.0e30, Air = 0.0;
	for (int Y = Low.y; Y <= High.y; ++Y)
	{
		for (int X = Low.x; X <= High.x; ++X)
		{
			vec2 Distances = texelFetch(Textures[Push.Depth], clamp(ivec2(X, Y), ivec2(0), Last), 0).xy;
			if (!(Distances.x > 0.0)) { return vec2(0.0); } // the sky, or no number
			Farthest = max(Farthest, Distances.x);
			Air = max(Air, Distances.y);
			Nearest = min(Nearest, Distances.y);
		}
	}
	return vec2(Farthest, Air <= FOG_EDGE * Nearest ? Nearest : Air);
}

bool IsWithin(float Distance, float Farthest) { return Farthest <= 0.0 || Distance <= Farthest; }

// Finds where Depth knows a point of a column: see FindPreviousPlace.
bool FindKnownPlace(FViewConstants View, vec3 Place, out vec2 Pixel, out float Distance)
{
#ifdef CURRENT_DEPTH
	Pixel = Place.xy * float(Push.Grid.PixelSize);
	Distance = FroxelDistance(Push.Grid, Place.z);
	return true;
#else
	return FindPreviousPlace(View, FroxelPosition(Push.Grid, View, Place), Pixel, Distance);
#endif
}

bool IsDepthKnown(FViewConstants View)
{
#ifdef CURRENT_DEPTH
	return true;
#else
	return Push.Depth != NO_TEXTURE && View.bHistory != 0u;
#endif
}

// Returns how many slices are lit (x), and where what the column shows ends (y), in slices.
vec2 FindEnd(FViewConstants View, uvec2 Column)
{
	vec2 Everything = vec2(Push.Grid.Slices), End = vec2(-1.0);
	if (!IsDepthKnown(View)) { return Everything; }
	float Behind = 0.0; // distance at which the slice ends
	[[dont_unroll]] for (uint Slice = Push.Grid.Slices + 1u; Slice > 0u; --Slice)
	{
		vec2 Pixel;
		float Distance, Begin = float(Slice - 1u);
		if (!FindKnownPlace(View, vec3(vec2(Column) + 0.5, Begin), Pixel, Distance)) { return Everything; }
		if (Slice > Push.Grid.Slices)
		{
			Behind = Distance;
			continue;
		}
		vec2 Place = Pixel / float(Push.Grid.PixelSize);
		ivec2 Middle = ivec2(Place);
		// Things move, so neighbours count. One slice more: readers interpolate.
		if (End.x < 0.0 && IsWithin(Distance, FarthestOf(Middle - 1, Middle + 1).x)) { End.x = min(Begin + 2.0, Everything.x); }
		float Farthest = FarthestOf(ivec2(floor(Place - 0.499)), ivec2(floor(Place - 0.501)) + 1).y;
		if (End.x >= 0.0 && IsWithin(Distance, Farthest))
		{
			End.y = Farthest <= 0.0 ? Begin + 1.0 : Begin + clamp((Farthest - Distance) / max(Behind - Distance, 1.0e-6), 0.0, 1.0);
			return End;
		}
		Behind = Distance;
	}
	return vec2(max(End.x, 1.0), 0.0);
}

void main()
{
	uvec2 Column = gl_GlobalInvocationID.xy;
	if (Column.x >= Push.Grid.Columns || Column.y >= Push.Grid.Rows) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	// The turn is the view's own: numbers of frames are shared by several views.
	uint Turn = 0u;
	if (Push.PreviousCounts != NO_TEXTURE) { Turn = 1u - (uint(max(texelFetch(Textures[Push.PreviousCounts], ivec2(0), 0).x, 0.0)) & 1u); }
	vec2 End = FindEnd(View, Column);
	imageStore(Images[Push.OutCounts], ivec2(Column), vec4(2.0 * End.x + float(Turn), End.y, 0.0, 0.0));
}
