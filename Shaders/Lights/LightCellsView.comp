// Shows how many lights the cells of pixels list. Every other cell is a little darker.
#version 460
#include "../Library/GBuffer.glsl"
#include "../Library/LightCells.glsl"

layout(local_size_x = LIGHT_CELL_MARK_SIZE, local_size_y = LIGHT_CELL_MARK_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightCellConstants Push; };

// 0 to 1: black, blue, green, yellow, red.
vec3 HeatColor(float Heat)
{
	const vec3 Colors[5] = vec3[5](vec3(0.0), vec3(0.1, 0.2, 1.0), vec3(0.1, 0.8, 0.2), vec3(1.0, 0.9, 0.1), vec3(1.0, 0.1, 0.05));
	float At = clamp(Heat, 0.0, 1.0) * 4.0;
	uint First = min(uint(At), 3u);
	return mix(Colors[First], Colors[First + 1u], At - float(First));
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	vec3 Color = vec3(0.0);
	if (Depth > 0.0)
	{
		FLightGrid Grid = FLightGridRef(Push.Grid).Data;
		vec3 P = View.CameraPosition + RelativePositionFromDepth(View, Pixel, Depth);
		FLightCellPlace Place = FindLightCell(Grid, P, vec3(0.0));
		Color = vec3(1.0);
		if (Place.Cell != NoLight)
		{
			FLightCell Cell = FLightCellRef(Grid.Cells).Data[Place.Cell];
			if (HasLightCellList(Grid, Cell, Place.Key)) { Color = HeatColor(sqrt(float(Cell.State & LIGHT_CELL_COUNT_MASK) / LIGHT_CELL_MOST)); }
			Color *= ((Place.Cell + (Place.Cell >> LIGHT_CELL_BITS_X) + (Place.Cell >> (LIGHT_CELL_BITS_X + LIGHT_CELL_BITS_Y))) & 1u) != 0u ? 1.0 : 0.8;
		}
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Color, 1.0));
}
