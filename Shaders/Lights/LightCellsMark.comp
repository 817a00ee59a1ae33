// Asks for the light cells of all pixels that are not filled.
#version 460
#include "../Library/LightCells.glsl"
#include "../Library/GBuffer.glsl"

layout(local_size_x = LIGHT_CELL_MARK_SIZE, local_size_y = LIGHT_CELL_MARK_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightCellConstants Push; };

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Depth <= 0.0) { return; }
	FLightGrid Grid = FLightGridRef(Push.Grid).Data;
	FLightCellPlace Place = FindLightCell(Grid, View.CameraPosition + RelativePositionFromDepth(View, Pixel, Depth), vec3(0.0));
	if (Place.Cell == NoLight) { return; }
	RequestLightCell(Grid, Place, FLightCellRef(Grid.Cells).Data[Place.Cell], Grid.Turn);
}
