// What shaders know of the scene. One name on both sides.
#ifndef LANTERN_SCENE_TYPES_H
#define LANTERN_SCENE_TYPES_H

#include "SharedTypes.h"

LANTERN_SHARED_BEGIN

// Vertex data beside the position (which has a buffer of its own: float3, 12 bytes).
struct FVertexAttributes
{
	uint Normal;  // octahedral, 2 × snorm16 (Cigolle et al. 2014)
	uint Tangent; // octahedral, 2 × snorm16; the lowest bit of y holds the sign of the bitangent (1: −)
	vec2 UV0;
	vec2 UV1;
	uint Color; // unorm8 × 4, linear
};
LANTERN_ASSERT_SIZE(FVertexAttributes, 28);

// FSectionData::Flags
#define SECTION_INDEX_16 1u      // indices are 16 bits wide (else 32)
#define SECTION_MASKED 2u        // alpha-tested
#define SECTION_DOUBLE_SIDED 4u
#define SECTION_TANGENTS 8u      // the vertices carry tangents
#define SECTION_INDEX_ODD 32u    // 16-bit indices that start in the upper half of the word at Indices
#define SECTION_LIGHT 16u        // its triangles are in the list of emissive triangles
#define SECTION_OPACITY_UV1 64u  // the base colour uses the second set of texture coordinates
// The base colour's coordinates are not transformed and every vertex's alpha is 1: the alpha test reads neither.
#define SECTION_PLAIN_OPACITY 128u
// Rays may meet pieces of the section's triangles: what lies at a hit is found anew, from the ray and the whole triangle,
// so that it is the same whether it was a piece or not.
#define SECTION_PIECES 256u
// These are the pieces. They reach beyond their triangles by a little, where there is nothing.
#define SECTION_IS_PIECES 512u

// One section of an object: which triangles, and what they are made of. The local data of a hit record, and
// an entry of the section table that inline ray queries read.
struct FSectionData
{
	FAddress Positions;  // float3[]
	FAddress Attributes; // FVertexAttributes[]
	FAddress Indices;
	uint Material; // index into FMaterialData[]
	uint Flags;
};
LANTERN_ASSERT_SIZE(FSectionData, 32);

// FMaterialData::Flags
#define MATERIAL_MASKED 1u
#define MATERIAL_DOUBLE_SIDED 2u

#define NO_TEXTURE 0xffffffffu

// A texture with its sampler: sampled index in the low 24 bits, sampler index in the high 8; or NO_TEXTURE.
// Bit i of UVSets: which texture coordinate set slot i uses.
#define TEXTURE_BASE_COLOR 0
#define TEXTURE_METALLIC_ROUGHNESS 1
#define TEXTURE_NORMAL 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_SLOTS 5

// glTF 2.0 metallic-roughness, with the extensions emissive_strength, ior, specular, transmission, texture_transform.
struct FMaterialData
{
	vec4 BaseColor; // linear; a: opacity
	vec3 Emissive;  // nits, strength included
	float Metallic;
	float Roughness; // perceptual
	float NormalScale;
	float OcclusionStrength;
	float AlphaCutoff;
	float Ior;
	float Specular; // KHR_materials_specular: specularFactor
	float Transmission;
	uint Flags;
	uint UVSets;
	uint Textures[TEXTURE_SLOTS];
	vec4 UVTransform[TEXTURE_SLOTS]; // 2×2 matrix, rows xy and zw …
	vec2 UVOffset[TEXTURE_SLOTS];    // … and translation
	float EmissiveWeight; // luminance of the mean emission, rounded to fp16: sets the density of light sampling
};
LANTERN_ASSERT_SIZE(FMaterialData, 212);

// The world in cells: fp32 positions relative to the centre of a cell, and offsets between cells, which fp32 holds
// exactly, stay right far away from the world's origin.
#define CELL_SIZE 1024.0f // metres; a multiple of the step of the scene's origin

// One object, as instances refer to it by custom index.
struct FObjectData
{
	vec4 ObjectToWorld[3]; // rows; relative to the centre of its cell
	uint FirstSection;     // into FSectionData[]
	uint Flags;            // OBJECT_…, and what rounding took from the translation: see UnpackTranslationRemainder in GBuffer.vert
	ivec3 Cell;            // of the world; see CellOffset in Bindings.glsl
	uint Motion;           // into FObjectMotion[], or NO_MOTION
};
LANTERN_ASSERT_SIZE(FObjectData, 72);

#define NO_MOTION 0xffffffffu // the object was where it is, and as it is, in the frame before

// Where an object was in the frame before.
struct FObjectMotion
{
	vec4 PreviousObjectToWorld[3]; // as FObjectData::ObjectToWorld …
	ivec3 PreviousCell;            // … and Cell
	uint PreviousFlags;            // … and Flags
	FAddress PreviousPositions; // float3[], what the vertices of a deformed geometry were; 0: as they are now
};
LANTERN_ASSERT_SIZE(FObjectMotion, 72);

// Bits of an object's mask by convention; rays name those that they want to see.
#define MASK_VISIBLE 1u      // camera, reflection and GI rays
#define MASK_CASTS_SHADOW 2u // shadow rays

#define OBJECT_MIRRORED 1u // negative determinant: front faces appear clockwise

#define LIGHT_POINT 0u
#define LIGHT_SPOT 1u
#define LIGHT_DIRECTIONAL 2u

// A punctual light, KHR_lights_punctual.
struct FLightData
{
	vec3 Position; // relative to the scene's origin
	uint Type;
	vec3 Direction; // in which the light travels
	float Range;    // metres; 0: unlimited
	vec3 Color;     // intensity included: cd, or lux where directional
	float SpotScale; // angular attenuation: saturate(cos · scale + offset)²
	float SpotOffset;
};
LANTERN_ASSERT_SIZE(FLightData, 52);

// A triangle that emits, for next-event estimation. Corners are relative to the centre of the object's cell, so that a moving
// origin rewrites none.
struct FEmissiveTriangle
{
	vec3 P0;
	float CumulativePower; // normalised: the last one is 1
	vec3 P1;
	uint Object;
	vec3 P2;
	uint Section; // into FSectionData[]
	uint Primitive;
	uint Flags; // OBJECT_MIRRORED: the winding is turned around
	uint Pad0, Pad1;
};
LANTERN_ASSERT_SIZE(FEmissiveTriangle, 64);

// The scene as passes see it: one block a frame.
struct FSceneConstants
{
	FAddress Objects;   // FObjectData[]
	FAddress Sections;  // FSectionData[]
	FAddress Materials; // FMaterialData[]
	FAddress Lights;    // FLightData[]
	FAddress EmissiveTriangles;
	uint LightCount;
	uint EmissiveTriangleCount;
	float EmissivePower; // sum of weight · area
	uint Tlas;           // index in the bindless heap
	vec3 SunDirection;   // in which its light travels
	float SunIrradiance; // on a plane that faces it, lux
	vec3 SunColor;
	float SunOneMinusCos; // 1 − cosine of its angular radius; 0: a point
	vec3 SkyRadiance;
	uint MaterialOverride; // r.RT.Material.Override
	ivec3 OriginCell;      // that the scene's origin lies in
	float ObjectReach;     // see OffsetRayOrigin in Math.glsl, metres
	vec3 OriginInCell;     // from its cell's centre, metres
	uint Pad0;
	FAddress AnyHitCounter; // of alpha tests under rays, where they count (r.RT.Opacity.Count)
	FAddress StandInHits;   // uint[], by material: rays that hit its stand-in; 0: nobody counts
	FAddress ObjectMotions; // FObjectMotion[]; 0: nothing moved
};
LANTERN_ASSERT_SIZE(FSceneConstants, 160);

// A camera. Positions are relative to the scene's origin.
struct FViewConstants
{
	mat4 RelativeToClip; // of positions relative to the camera; reversed, infinite depth
	vec3 CameraPosition;
	float TanHalfFovY;
	vec3 CameraRight;
	float Aspect;
	vec3 CameraUp;
	float Near;
	vec3 CameraForward;
	uint FrameIndex;
	uint Width;
	uint Height;
	uint Seed;
	float Exposure; // factor, not stops
	// The frame before, for what is carried over from it. A point's position relative to its camera is the position
	// relative to this one, plus CameraMotion.
	mat4 PreviousRelativeToClip;
	vec3 CameraMotion; // from the previous camera's position to this one's, metres
	float PreviousNear;
	vec3 PreviousForward; // unit length
	float DeltaSeconds; // since that frame
	uint bHistory; // 0: nothing may be carried over (first frame, cut, another size); the members above are this frame's
};
LANTERN_ASSERT_SIZE(FViewConstants, 244);

// First push constants of every pass; a pass's own follow.
struct FPassConstants
{
	FAddress Scene; // FSceneConstants
	FAddress View;  // FViewConstants
};
LANTERN_ASSERT_SIZE(FPassConstants, 16);

LANTERN_SHARED_END

#endif
