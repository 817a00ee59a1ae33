// Counts the slices of each column that the view may see into, by what the frame before saw.
#version 460
#include "Froxels.glsl"

layout(local_size_x = FOG_GROUP_SIZE, local_size_y = FOG_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FFogColumnsConstants Push; };

// Returns the farthest distance around a pixel of the frame before: neighbours are in it, since things move. 0: unlimited.
float FarthestAround(vec2 Pixel)
{
	ivec2 Size = ivec2(Push.PreviousColumns, Push.PreviousRows);
	ivec2 Column = clamp(ivec2(Pixel / float(Push.Grid.PixelSize)), ivec2(0), Size - 1);
	float Farthest = 0.0;
	for (int Y = -1; Y <= 1; ++Y)
	{
		for (int X = -1; X <= 1; ++X)
		{
			float Distance = texelFetch(Textures[Push.Depth], clamp(Column + ivec2(X, Y), ivec2(0), Size - 1), 0).x;
			if (!(Distance > 0.0)) { return 0.0; } // the sky, or no number
			Farthest = max(Farthest, Distance);
		}
	}
	return Farthest;
}

uint CountSlices(FViewConstants View, uvec2 Column)
{
	if (Push.Depth == NO_TEXTURE || View.bHistory == 0u) { return Push.Grid.Slices; }
	[[dont_unroll]] for (uint Slice = Push.Grid.Slices; Slice > 0u; --Slice)
	{
		vec2 Pixel;
		float Distance;
		vec3 Near = FroxelPosition(Push.Grid, View, vec3(vec2(Column) + 0.5, float(Slice - 1u)));
		if (!FindPreviousPlace(View, Near, Pixel, Distance)) { return Push.Grid.Slices; }
		float Farthest = FarthestAround(Pixel);
		// One slice more: readers interpolate.
		if (Farthest <= 0.0 || Distance <= Farthest) { return min(Slice + 1u, Push.Grid.Slices); }
	}
	return 1u;
}

void main()
{
	uvec2 Column = gl_GlobalInvocationID.xy;
	if (Column.x >= Push.Grid.Columns || Column.y >= Push.Grid.Rows) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	// The turn is the view's own: numbers of frames are shared by several views.
	uint Turn = 0u;
	if (Push.PreviousCounts != NO_TEXTURE) { Turn = 1u - (uint(max(texelFetch(Textures[Push.PreviousCounts], ivec2(0), 0).x, 0.0)) & 1u); }
	imageStore(Images[Push.OutCounts], ivec2(Column), vec4(float(2u * CountSlices(View, Column) + Turn)));
}
