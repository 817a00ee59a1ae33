#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Puts glass, which this engine does not draw, in front of its picture. It shows how FRTModuleOutputs::Transmission is read.
#include "Transmission/Looks.glsl" // of the plugin's Shaders

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D Light; // these three are the plugin's
layout(set = 0, binding = 1) uniform texture2D Transmittance;
layout(set = 0, binding = 2) uniform utexture2D Looks;
layout(set = 0, binding = 3, rgba16f) uniform readonly image2D Lit;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D Shown;
layout(push_constant, scalar) uniform FPush
{
	ivec2 Offset, Size; // of the view in the engine's textures
	uint bGiven;        // 0: the plugin's textures are null, and there is no glass
} Push;

// This engine's glass is smooth: Composite.comp of the plugin spreads the looks of rough glass.
vec3 SampleLook(uvec2 Packed)
{
	FLook Look = UnpackLook(Packed);
	ivec2 Texel = clamp(ivec2(Look.Place * vec2(Push.Size)), ivec2(0), Push.Size - 1);
	return Look.Weight == vec3(0.0) ? vec3(0.0) : Look.Weight * imageLoad(Lit, Texel + Push.Offset).rgb;
}

void main()
{
	ivec2 Texel = ivec2(gl_GlobalInvocationID.xy), Pixel = Texel + Push.Offset;
	if (any(greaterThanEqual(Texel, Push.Size))) { return; }
	vec4 Picture = imageLoad(Lit, Pixel);
	if (Push.bGiven != 0u)
	{
		uvec4 Packed = texelFetch(Looks, Texel, 0);
		Picture.rgb = Picture.rgb * texelFetch(Transmittance, Texel, 0).rgb + texelFetch(Light, Texel, 0).rgb + SampleLook(Packed.xy) +
		              SampleLook(Packed.zw);
	}
	imageStore(Shown, Pixel, Picture);
}
