// The material ray's payload: 32 bytes hold all that shading needs. The quantisation is finer than any figure
// the reference has to reach: base colours in unorm16, since a closed room of albedo 0.9 multiplies their error by
// ten, emission in fp16 (relative error ≤ 0.05 %), directions octahedral.
//   W0 distance                      W4 base colour b unorm16 | roughness unorm16
//   W1 shading normal, octahedral    W5 flags 2 | sqrt(F0) 12 | specular 8 | metallic 10
//   W2 geometric normal, octahedral  W6 emission rg fp16
//   W3 base colour rg unorm16        W7 emission b fp16 | light-sampling weight fp16
#ifndef LANTERN_MATERIAL_PAYLOAD_GLSL
#define LANTERN_MATERIAL_PAYLOAD_GLSL

#include "../Library/Math.glsl"

struct FMaterialPayload
{
	float Distance; // < 0: nothing was hit
	uint W1, W2, W3, W4, W5, W6, W7;
};

// Emission is scaled by this before fp16, so that lamps of millions of nits survive; what is dimmer than 0.004 nits
// loses digits instead.
const float EmissionScale = 1.0 / 64.0;
const float MaxEmission = 65504.0 / EmissionScale; // nits

#define HIT_CULLED_SIDE 1u // the back of a single-sided surface: camera rays do not see it

struct FMaterialHit
{
	float Distance;
	vec3 Normal;
	vec3 GeometricNormal;
	vec3 BaseColor;
	float Roughness, Metallic, F0, Specular;
	vec3 Emissive;
	float EmissiveWeight; // 0: no light sampling reaches this surface
	uint Flags;
};

FMaterialPayload PackHit(FMaterialHit H)
{
	FMaterialPayload P;
	P.Distance = H.Distance;
	P.W1 = PackOct(H.Normal);
	P.W2 = PackOct(H.GeometricNormal);
	P.W3 = packUnorm2x16(H.BaseColor.rg);
	P.W4 = packUnorm2x16(vec2(H.BaseColor.b, H.Roughness));
	P.W5 = (H.Flags & 3u) | (uint(sqrt(clamp(H.F0, 0.0, 1.0)) * 4095.0 + 0.5) << 2) |
	       (uint(clamp(H.Specular, 0.0, 1.0) * 255.0 + 0.5) << 14) | (uint(clamp(H.Metallic, 0.0, 1.0) * 1023.0 + 0.5) << 22);
	vec3 E = min(H.Emissive, vec3(MaxEmission)) * EmissionScale;
	P.W6 = packHalf2x16(E.rg);
	P.W7 = packHalf2x16(vec2(E.b, H.EmissiveWeight));
	return P;
}

FMaterialHit UnpackHit(FMaterialPayload P)
{
	FMaterialHit H;
	H.Distance = P.Distance;
	H.Normal = UnpackOct(P.W1);
	H.GeometricNormal = UnpackOct(P.W2);
	vec2 BlueAndRoughness = unpackUnorm2x16(P.W4);
	H.BaseColor = vec3(unpackUnorm2x16(P.W3), BlueAndRoughness.x);
	H.Roughness = BlueAndRoughness.y;
	H.Flags = P.W5 & 3u;
	float RootF0 = float((P.W5 >> 2) & 0xfffu) / 4095.0;
	H.F0 = RootF0 * RootF0;
	H.Specular = float((P.W5 >> 14) & 0xffu) / 255.0;
	H.Metallic = float(P.W5 >> 22) / 1023.0;
	vec2 BlueAndWeight = unpackHalf2x16(P.W7);
	H.Emissive = vec3(unpackHalf2x16(P.W6), BlueAndWeight.x) / EmissionScale;
	H.EmissiveWeight = BlueAndWeight.y;
	return H;
}

#endif
