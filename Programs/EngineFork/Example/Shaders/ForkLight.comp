#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// The engine's lighting. It shows how the plugin's outputs are read, and what null outputs mean.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D Normals;
layout(set = 0, binding = 1) uniform texture2D BaseColor;
layout(set = 0, binding = 2) uniform texture2D SunShadow; // these three are the plugin's
layout(set = 0, binding = 3) uniform texture2D AmbientOcclusion;
layout(set = 0, binding = 4) uniform texture2D DiffuseGI;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D Lit;
layout(push_constant, scalar) uniform FPush
{
	ivec2 Offset, Size; // of the view in the engine's textures
	vec3 ToSun;         // in view space
	float Sun, Ambient;
	uint Given; // bits: SunShadow, AmbientOcclusion, DiffuseGI are not null
} Push;

void main()
{
	// Outputs have the size of the view and start at 0: the engine's pixel minus the view's offset.
	ivec2 Texel = ivec2(gl_GlobalInvocationID.xy), Pixel = Texel + Push.Offset;
	if (any(greaterThanEqual(Texel, Push.Size))) { return; }
	vec4 Base = texelFetch(BaseColor, Pixel, 0);
	vec3 Normal = normalize(texelFetch(Normals, Pixel, 0).xyz * 2.0 - 1.0);
	// Null: the engine lights as if there were no such pass. That is visibility 1, and its own ambient light.
	float Visibility = (Push.Given & 1u) != 0u ? texelFetch(SunShadow, Texel, 0).x : 1.0;
	float Openness = (Push.Given & 2u) != 0u ? texelFetch(AmbientOcclusion, Texel, 0).x : 1.0;
	vec3 Indirect = (Push.Given & 4u) != 0u ? texelFetch(DiffuseGI, Texel, 0).rgb : vec3(Push.Ambient * Openness);
	vec3 Light = Push.Sun * max(dot(Normal, Push.ToSun), 0.0) * Visibility + Indirect;
	imageStore(Lit, Pixel, vec4(Base.rgb * Light, Base.a));
}
