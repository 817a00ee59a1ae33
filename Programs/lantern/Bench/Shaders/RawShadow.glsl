// The yardstick of `lantern bench rays`: one sun ray per pixel, written against plain Vulkan for exactly this
// job. It has descriptors and tables of its own and no settings; constants of the view and the sun arrive ready
// for use. It shares with the plugin only what decides which ray a pixel casts: G-buffer encoding, ray offset and
// sample sequence. The includer defines
//   bool TraceSun(vec3 Origin, vec3 Direction)
#ifndef LANTERN_RAW_SHADOW_GLSL
#define LANTERN_RAW_SHADOW_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "Library/Math.glsl"
#include "Library/Random.glsl"

layout(set = 0, binding = 0) uniform accelerationStructureEXT Scene;
layout(set = 0, binding = 1) uniform texture2D Depth;
layout(set = 0, binding = 2) uniform texture2D Normals;
layout(set = 0, binding = 3) writeonly uniform image2D Visibility;

layout(push_constant, scalar) uniform FRawPush
{
	vec3 Camera;
	float Near;
	vec3 FirstRay; // through the centre of pixel (0, 0), times near
	uint FrameIndex;
	vec3 StepX; // from one pixel to the next, times near
	uint Seed;  // hashed
	vec3 StepY;
	float OneMinusCos;
	vec3 SunTangent;
	uint Size; // width | height << 16
	vec3 SunBitangent;
	float MaxDistance;
	vec3 TowardsSun;
	uint InstanceMask;
	float ObjectReach;
}
Push;

bool TraceSun(vec3 Origin, vec3 Direction);

vec3 SunDirection(vec2 U)
{
	float Z1 = U.x * Push.OneMinusCos;
	float Sin = sqrt(Z1 * (2.0 - Z1));
	float Phi = 2.0 * Pi * U.y;
	return Push.SunTangent * (Sin * cos(Phi)) + Push.SunBitangent * (Sin * sin(Phi)) + Push.TowardsSun * (1.0 - Z1);
}

float PixelVisibility(uvec2 Pixel)
{
	float Z = texelFetch(Depth, ivec2(Pixel), 0).x;
	if (Z <= 0.0)
	{
#ifdef COUNT_RAYS
		return 0.0;
#else
		return 1.0;
#endif
	}
	vec3 Ng = OctDecode(texelFetch(Normals, ivec2(Pixel), 0).zw);
	FTileSequence Sequence = MakeTileSequence(Pixel, Push.FrameIndex, Push.Seed);
	vec3 Direction = SunDirection(SobolOwen2(Sequence.Index, Sequence.Seed));
	if (dot(Ng, Direction) <= 0.0) { return 0.0; }
#ifdef COUNT_RAYS
	return 1.0;
#else
	vec3 Relative = (Push.FirstRay + Push.StepX * float(Pixel.x) + Push.StepY * float(Pixel.y)) / Z;
	return TraceSun(OffsetRasterPoint(Push.Camera + Relative, Ng, Push.ObjectReach, length(Relative) * length(Push.StepY) / Push.Near, 0.0), Direction) ? 1.0 : 0.0;
#endif
}

#endif
