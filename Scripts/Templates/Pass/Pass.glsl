// What the pipeline and the ray-query path of @LOWER@ share.
#ifndef LANTERN_@UPPER@_GLSL
#define LANTERN_@UPPER@_GLSL

#include "../Shared/@NAME@Types.h"
#include "../Library/Bindings.glsl"
#include "../Library/View.glsl"

layout(push_constant, scalar) uniform FPush { F@NAME@Constants Push; };

void ShadePixel(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { return; }
	bool bSurface = texelFetch(Textures[Push.Depth], ivec2(Pixel), 0).x > 0.0;
	float Value = bSurface ? texelFetch(Textures[Push.Material], ivec2(Pixel), 0).x : 1.0;
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Value));
}

#endif
