#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// The engine's lighting. It shows how the plugin's outputs are read, and what null outputs mean.
#define LIGHT_MASK_TEXTURE utexture2D
#include "LocalLights/LightMask.glsl" // of the plugin's Shaders

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D Normals;
layout(set = 0, binding = 1) uniform texture2D BaseColor;
layout(set = 0, binding = 2) uniform texture2D Depth;
layout(set = 0, binding = 3) uniform texture2D SunShadow; // these six are the plugin's
layout(set = 0, binding = 4) uniform texture2D AmbientOcclusion;
layout(set = 0, binding = 5) uniform texture2D DiffuseGI;
layout(set = 0, binding = 6) uniform texture2D LocalDiffuse;
layout(set = 0, binding = 7) uniform utexture2D MaskVisibility;
layout(set = 0, binding = 8) uniform utexture2D MaskLights;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D Lit;
layout(push_constant, scalar) uniform FPush
{
	ivec2 Offset, Size; // of the view in the engine's textures
	vec3 ToSun;         // in view space
	float Sun, Ambient;
	uint Given;          // bits: SunShadow, AmbientOcclusion, DiffuseGI, LocalDiffuse, the light mask are not null
	vec3 Lamp;           // in view space, centimetres
	float LampIntensity; // candela
	uint LampNumber;
	float Near, Far;
	vec2 Tangents, Jitter; // of half the view's angles; pixels
} Push;

// Returns the point that a pixel shows, in view space.
vec3 GetPosition(ivec2 Texel, float D)
{
	vec2 Ndc = (vec2(Texel) + 0.5 - Push.Jitter) / vec2(Push.Size) * 2.0 - 1.0;
	float Distance = Push.Near * Push.Far / (Push.Far - D * (Push.Far - Push.Near));
	return Distance * vec3(Ndc.x * Push.Tangents.x, -Ndc.y * Push.Tangents.y, -1.0);
}

// Returns what a white surface reflects of the lamp if nothing hides it.
float ShadeLamp(ivec2 Texel, ivec2 Pixel, vec3 Normal)
{
	const float Metre = 100.0, Pi = 3.14159265;
	vec3 ToLamp = (Push.Lamp - GetPosition(Texel, texelFetch(Depth, Pixel, 0).x)) / Metre;
	float Square = dot(ToLamp, ToLamp);
	return Push.LampIntensity * max(dot(Normal, ToLamp), 0.0) / (Square * sqrt(Square) * Pi);
}

void main()
{
	// Outputs have the size of the view and start at 0: the engine's pixel minus the view's offset.
	ivec2 Texel = ivec2(gl_GlobalInvocationID.xy), Pixel = Texel + Push.Offset;
	if (any(greaterThanEqual(Texel, Push.Size))) { return; }
	vec3 Base = texelFetch(BaseColor, Pixel, 0).rgb;
	vec3 Normal = normalize(texelFetch(Normals, Pixel, 0).xyz * 2.0 - 1.0);
	// Null: the engine lights as if there were no such pass. That is visibility 1, and its own ambient light.
	float Visibility = (Push.Given & 1u) != 0u ? texelFetch(SunShadow, Texel, 0).x : 1.0;
	float Openness = (Push.Given & 2u) != 0u ? texelFetch(AmbientOcclusion, Texel, 0).x : 1.0;
	vec3 Indirect = (Push.Given & 4u) != 0u ? texelFetch(DiffuseGI, Texel, 0).rgb : vec3(Push.Ambient * Openness);
	vec3 Light = Push.Sun * max(dot(Normal, Push.ToSun), 0.0) * Visibility + Indirect;
	// Lamps shine by the plugin alone: it lights, or this engine does by the plugin's mask. What is not in the mask is in the signal.
	if ((Push.Given & 8u) != 0u) { Light += texelFetch(LocalDiffuse, Texel, 0).rgb; }
	if ((Push.Given & 16u) != 0u)
	{
		Light += ShadeLamp(Texel, Pixel, Normal) * SampleLightMask(MaskVisibility, MaskLights, Texel, Push.LampNumber);
	}
	bool bSurface = texelFetch(Depth, Pixel, 0).x < 1.0;
	imageStore(Lit, Pixel, bSurface ? vec4(Base * Light, 1.0) : vec4(0.0));
}
