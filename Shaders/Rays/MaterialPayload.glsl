// The payload of material rays: 36 bytes, and 8 more with each of HAS_TRANSMISSION and HAS_DIFFUSE_TRANSMISSION, hold all that shading needs,
// and who was hit. The quantisation is finer than the accuracy that the reference must reach. Base colours are unorm16, since a closed room of
// albedo 0.9 multiplies their error by ten. Emission is fp16 (relative error ≤ 0.05 %), directions are octahedral.
//   W0 distance                      W4 base colour b 15 | foliage 1 | roughness 12 | channels 4, the lower ones
//   W1 shading normal, octahedral    W5 flags 2 | sqrt(F0) 12 | specular 8 | metallic 10
//   W2 geometric normal, octahedral  W6 emission rg fp16
//   W3 base colour rg unorm16        W7 emission b fp16 | light-sampling weight fp16
//                                    W8 object
// HAS_TRANSMISSION: the upper 8 bits of W8, which no object needs, are inside 1 | solid 1 | transmissive 1 | blended 1. Two words are added.
//   W9 material of a solid           W10 transmission
// HAS_DIFFUSE_TRANSMISSION: two words are added.
//   W11 albedo of the other side, rg unorm16   W12 its b unorm16 | share of the diffuse layer that leaves there unorm16
// The four fp16 are never negative: their signs are the upper channels.
#ifndef LANTERN_MATERIAL_PAYLOAD_GLSL
#define LANTERN_MATERIAL_PAYLOAD_GLSL

#include "../Library/Math.glsl"

struct FMaterialPayload
{
	float Distance; // metres; < 0: nothing was hit
	uint W1, W2, W3, W4, W5, W6, W7, W8;
#ifdef HAS_TRANSMISSION
	uint W9, W10;
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	uint W11, W12;
#endif
};

// Emission is scaled by this before it is stored as fp16, so that lamps of millions of nits fit. Emission below 0.004 nits
// loses precision instead.
const float EmissionScale = 1.0 / 64.0;
const float MaxEmission = 65504.0 / EmissionScale; // nits

// What a ray sets W1 to before it is traced, if it looks for light: FMaterialData::LightEmissive. HAS_LIGHT_EMISSION only.
#define ASKS_FOR_LIGHT 0x4c494748u

// A ray sets W2 to the halves of its RayCone (RayCone.glsl), or to 0 for textures' finest levels.

#define HIT_CULLED_SIDE 1u  // the back of a single-sided surface: camera rays do not see it
#define HIT_CHARACTER 2u    // characters do not shadow the surface
#define HIT_FOLIAGE 4u      // alpha-tested and seen from both sides
#define HIT_INSIDE 8u       // the ray arrives from within a solid
#define HIT_SOLID 16u       // the surface of a volume that light shines through
#define HIT_TRANSMISSIVE 32u // light shines through its material, if not through this place of it
#define HIT_BLENDED 64u      // light passes beside what the surface covers. Transmission is the share that it leaves uncovered

struct FMaterialHit
{
	float Distance;
	vec3 Normal;
	vec3 GeometricNormal;
	vec3 BaseColor;
	float Roughness, Metallic, F0, Specular;
	vec3 Emissive;
	float EmissiveWeight; // FMaterialData::EmissiveWeight; 0: light sampling does not sample this surface
	uint Flags;           // HIT_…
	uint Channels;        // 8 bits, of the object: see LightProfile.glsl
	uint Object;          // into FObjectData[]
#ifdef HAS_TRANSMISSION
	float Transmission;   // FMaterialSurface::Transmission
	uint Material;        // of HIT_SOLID: into FMaterialData[], see VolumeOf
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	vec3 BackAlbedo;      // see FBrdf
	float DiffuseTransmission; // FMaterialSurface::DiffuseTransmission
#endif
};

#ifdef HAS_TRANSMISSION
const float LeastTransmission = 1.0 / 65536.0; // what lets less through is opaque
#endif

// Two bits where two fp16 have their signs.
uint SignsOf(uint Bits) { return ((Bits & 1u) << 15) | ((Bits & 2u) << 30); }
uint BitsOf(uint Signs) { return ((Signs >> 15) & 1u) | ((Signs >> 30) & 2u); }

FMaterialPayload PackHit(FMaterialHit Hit)
{
	FMaterialPayload Payload;
	Payload.Distance = Hit.Distance;
	Payload.W1 = PackOct(Hit.Normal);
	Payload.W2 = PackOct(Hit.GeometricNormal);
	Payload.W3 = packUnorm2x16(Hit.BaseColor.rg);
	Payload.W4 = uint(clamp(Hit.BaseColor.b, 0.0, 1.0) * 32767.0 + 0.5) | ((Hit.Flags & HIT_FOLIAGE) << 13) | (uint(clamp(Hit.Roughness, 0.0, 1.0) * 4095.0 + 0.5) << 16) |
	       (Hit.Channels << 28);
	Payload.W5 = (Hit.Flags & 3u) | (uint(sqrt(clamp(Hit.F0, 0.0, 1.0)) * 4095.0 + 0.5) << 2) |
	       (uint(clamp(Hit.Specular, 0.0, 1.0) * 255.0 + 0.5) << 14) | (uint(clamp(Hit.Metallic, 0.0, 1.0) * 1023.0 + 0.5) << 22);
	vec3 Emission = clamp(Hit.Emissive, vec3(0.0), vec3(MaxEmission)) * EmissionScale;
	Payload.W6 = (packHalf2x16(Emission.rg) & ~SignsOf(3u)) | SignsOf(Hit.Channels >> 4);
	Payload.W7 = (packHalf2x16(vec2(Emission.b, Hit.EmissiveWeight)) & ~SignsOf(3u)) | SignsOf(Hit.Channels >> 6);
	Payload.W8 = Hit.Object;
#ifdef HAS_TRANSMISSION
	Payload.W8 |= (Hit.Flags & (HIT_INSIDE | HIT_SOLID | HIT_TRANSMISSIVE | HIT_BLENDED)) << 21;
	Payload.W9 = Hit.Material;
	Payload.W10 = floatBitsToUint(Hit.Transmission < LeastTransmission ? 0.0 : min(Hit.Transmission, 1.0));
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	Payload.W11 = packUnorm2x16(Hit.BackAlbedo.rg);
	Payload.W12 = packUnorm2x16(vec2(Hit.BackAlbedo.b, Hit.DiffuseTransmission));
#endif
	return Payload;
}

FMaterialHit UnpackHit(FMaterialPayload Payload)
{
	FMaterialHit Hit;
	Hit.Distance = Payload.Distance;
	Hit.Normal = UnpackOct(Payload.W1);
	Hit.GeometricNormal = UnpackOct(Payload.W2);
	Hit.BaseColor = vec3(unpackUnorm2x16(Payload.W3), float(Payload.W4 & 0x7fffu) / 32767.0);
	Hit.Roughness = float((Payload.W4 >> 16) & 0xfffu) / 4095.0;
	Hit.Channels = (Payload.W4 >> 28) | (BitsOf(Payload.W6) << 4) | (BitsOf(Payload.W7) << 6);
	Hit.Flags = (Payload.W5 & 3u) | ((Payload.W4 >> 13) & HIT_FOLIAGE);
	float RootF0 = float((Payload.W5 >> 2) & 0xfffu) / 4095.0;
	Hit.F0 = RootF0 * RootF0;
	Hit.Specular = float((Payload.W5 >> 14) & 0xffu) / 255.0;
	Hit.Metallic = float(Payload.W5 >> 22) / 1023.0;
	vec2 BlueAndWeight = unpackHalf2x16(Payload.W7 & ~SignsOf(3u));
	Hit.Emissive = vec3(unpackHalf2x16(Payload.W6 & ~SignsOf(3u)), BlueAndWeight.x) / EmissionScale;
	Hit.EmissiveWeight = BlueAndWeight.y;
#ifdef HAS_TRANSMISSION
	Hit.Object = Payload.W8 & 0xffffffu;
	Hit.Flags |= (Payload.W8 >> 21) & (HIT_INSIDE | HIT_SOLID | HIT_TRANSMISSIVE | HIT_BLENDED);
	Hit.Transmission = uintBitsToFloat(Payload.W10);
	Hit.Material = Payload.W9;
#else
	Hit.Object = Payload.W8;
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	vec2 BlueAndShare = unpackUnorm2x16(Payload.W12);
	Hit.BackAlbedo = vec3(unpackUnorm2x16(Payload.W11), BlueAndShare.x);
	Hit.DiffuseTransmission = BlueAndShare.y;
#endif
	return Hit;
}

#endif
