// Cones of rays: how wide what a ray stands for is where it meets a surface, and the level of detail of textures there.
// Akenine-Möller et al. 2019, "Texture Level of Detail Strategies for Real-Time Ray Tracing".
#ifndef LANTERN_RAY_CONE_GLSL
#define LANTERN_RAY_CONE_GLSL

#include "../Library/View.glsl"

// Of this thread's next ray. x: width where it starts, metres; y: by which it widens, metres in each. Both 0: textures have their finest level.
vec2 RayCone = vec2(0.0);

vec2 FirstRayCone = vec2(0.0); // of paths that begin

// Where a ray goes on behind what it has met: straight, bent or mirrored.
void WidenRayCone(float Distance) { RayCone.x += RayCone.y * Distance; }

// Returns the cone of a pixel. Distance: from the camera, metres. Alpha: squared roughness of what reflects or bends it there. Others share
// its lobe, so that half of it is safe.
vec2 MakePixelCone(FViewConstants View, float Distance, float Alpha)
{
#ifdef NO_RAY_CONES // r.RT.Rays.Cones
	return vec2(0.0);
#else
	return vec2(PixelHeight(View, Distance), (View.bOrthographic != 0u ? 0.0 : View.PixelSize) + 0.5 * Alpha);
#endif
}

// Returns the width of a cone on a triangle in its texture coordinates, as a square of the area of what the cone covers. Area: of the
// triangle times two, along its normal, metres²; UVArea: the same of its texture coordinates. Direction: of the ray.
float GetConeFootprint(vec2 Cone, float Distance, vec3 Area, float UVArea, vec3 Direction)
{
	const float LeastCosine = 0.05;
	float Size = max(length(Area), 1.0e-20), Cosine = max(abs(dot(Area, Direction)) / Size, LeastCosine);
	return (Cone.x + Cone.y * Distance) * sqrt(UVArea / (Size * Cosine));
}

#endif
