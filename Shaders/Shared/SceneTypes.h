// The scene as shaders see it: structures that C++ and GLSL share.
#ifndef LANTERN_SCENE_TYPES_H
#define LANTERN_SCENE_TYPES_H

#include "LightTypes.h"
#include "SharedTypes.h"

LANTERN_SHARED_BEGIN

// Vertex data except the position, which has a buffer of its own (float3, 12 bytes).
struct FVertexAttributes
{
	uint Normal;  // octahedral, 2 × snorm16 (Cigolle et al. 2014)
	uint Tangent; // octahedral, 2 × snorm16; the lowest bit of y holds the sign of the bitangent (1: −)
	vec2 UV0;
	vec2 UV1;
	uint Color; // unorm8 × 4, linear
};
LANTERN_ASSERT_SIZE(FVertexAttributes, 28);

// How a vertex of a stream is coded. The values are those of ERTModuleVertex (ModuleMesh.h), which says more.
#define VERTEX_FLOAT2 0u
#define VERTEX_FLOAT3 1u
#define VERTEX_FLOAT4 2u
#define VERTEX_HALF2 3u
#define VERTEX_HALF4 4u
#define VERTEX_UNORM16X2 5u
#define VERTEX_SNORM16X2 6u
#define VERTEX_SNORM16X4 7u
#define VERTEX_UNORM8X4 8u
#define VERTEX_SNORM8X4 9u
#define VERTEX_BGRA8 10u
#define VERTEX_UNORM10X3 11u
#define VERTEX_SNORM10X3 12u
#define VERTEX_OCTAHEDRAL16 13u

// One attribute of vertices that lie in a host's own buffers.
struct FVertexStream
{
	FAddress Address; // of the section's vertex 0, a multiple of 4; 0: there is none
	uint Stride;      // bytes, a multiple of 4
	uint Format;      // VERTEX_…
};

#define STREAM_POSITIONS 0u
#define STREAM_NORMALS 1u
#define STREAM_TANGENTS 2u
#define STREAM_UV0 3u
#define STREAM_UV1 4u
#define STREAM_COLORS 5u

#define STREAMS_SIGN_IN_NORMAL 1u // w of normals, not of tangents, is the sign of the bitangent

// The vertices of a section with SECTION_STREAMS, in place of FVertexAttributes.
struct FVertexStreams
{
	FVertexStream Positions, Normals, Tangents, UV0, UV1, Colors; // in the order of STREAM_…
	uint Flags; // STREAMS_…
	uint Pad;
};
LANTERN_ASSERT_SIZE(FVertexStreams, 104);

// FSectionData::Flags
#define SECTION_INDEX_16 1u      // indices are 16 bits wide (else 32)
#define SECTION_MASKED 2u        // alpha-tested
#define SECTION_DOUBLE_SIDED 4u
#define SECTION_TANGENTS 8u      // the vertices carry tangents
#define SECTION_INDEX_ODD 32u    // 16-bit indices that start in the upper half of the word at Indices
#define SECTION_LIGHT 16u        // its triangles are emissive triangles, of which light sampling knows
#define SECTION_OPACITY_UV1 64u  // the base colour uses the second set of texture coordinates
// The base colour's texture coordinates are not transformed, and every vertex has alpha 1: the alpha test reads neither.
#define SECTION_PLAIN_OPACITY 128u
// The acceleration structure may hold pieces of the section's triangles. Shaders therefore recompute a hit from the ray and the
// whole triangle, so that pieces do not change the result.
#define SECTION_PIECES 256u
// The section consists of such pieces. They extend slightly beyond their triangles; hits there are ignored.
#define SECTION_IS_PIECES 512u
// The vertices lie in a host's own buffers: Attributes is the address of an FVertexStreams.
#define SECTION_STREAMS 1024u
#define SECTION_TRANSMISSIVE 2048u // light shines through, or between: rays to lights pass, others meet it

// One section of an object: its triangles and its material. It is the local data of a hit record, and an entry of the section
// table that inline ray queries read.
struct FSectionData
{
	FAddress Positions;  // float3[]
	FAddress Attributes; // FVertexAttributes[]; or see SECTION_STREAMS
	FAddress Indices;    // 16 or 32 bits each, see SECTION_INDEX_…
	uint Material; // index into FMaterialData[]
	uint Flags;
};
LANTERN_ASSERT_SIZE(FSectionData, 32);

// FMaterialData::Flags
#define MATERIAL_MASKED 1u
#define MATERIAL_DOUBLE_SIDED 2u
#define MATERIAL_BLENDED 8u // the opacity is the share that the surface covers; without transmission it is cut at AlphaCutoff
#define MATERIAL_SOLID 4u // what light shines through is the surface of a volume, which bends and absorbs it. Else it is a thin sheet

#define NO_TEXTURE 0xffffffffu

// A texture slot holds a texture with its sampler: sampled index in the low bits, sampler index in the high ones; or NO_TEXTURE.
// The Vulkan peer has 65,536 textures and 1,024 samplers. MakeTextureSlot refuses what does not fit.
#define TEXTURE_INDEX_BITS 22
#define SLOT_TEXTURE(Slot) ((Slot) & ((1u << TEXTURE_INDEX_BITS) - 1u))
#define SLOT_SAMPLER(Slot) ((Slot) >> TEXTURE_INDEX_BITS)
// Bit i of UVSets is the texture coordinate set that slot i uses.
#define TEXTURE_BASE_COLOR 0
#define TEXTURE_METALLIC_ROUGHNESS 1
#define TEXTURE_NORMAL 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_TRANSMISSION 5
#define TEXTURE_DIFFUSE_TRANSMISSION 6       // a: factor
#define TEXTURE_DIFFUSE_TRANSMISSION_COLOR 7 // rgb
#define TEXTURE_SLOTS 8

// glTF 2.0 metallic-roughness, with the extensions emissive_strength, ior, specular, transmission, volume, volume_scatter,
// diffuse_transmission, texture_transform.
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
	vec4 UVTransform[TEXTURE_SLOTS]; // 2×2 matrix, rows xy and zw
	vec2 UVOffset[TEXTURE_SLOTS];    // added after UVTransform
	vec3 LightEmissive;   // as Emissive, where it lights something: cameras and mirrors do not see it
	float EmissiveWeight; // luminance of the mean of LightEmissive, rounded to fp16
	vec3 Extinction;      // of MATERIAL_SOLID: coefficient of what is absorbed and scattered, 1/m
	vec3 ScatterAlbedo;   // of MATERIAL_SOLID: share of Extinction that is scattered, once
	float ScatterAnisotropy; // mean cosine of the angle by which that turns light (Henyey & Greenstein 1941)
	vec3 DiffuseTransmissionColor;
	float DiffuseTransmission; // share of the diffuse layer's light that leaves the surface on its other side
};
LANTERN_ASSERT_SIZE(FMaterialData, 352);

// The world is divided into cells. Positions are fp32, relative to the centre of a cell, and offsets between cells are exact in
// fp32. Precision thus does not degrade far away from the world's origin.
#define CELL_SIZE 1024.0f // metres; a multiple of the step of the scene's origin

// One object. Instances refer to it by custom index.
struct FObjectData
{
	vec4 ObjectToWorld[3]; // rows; relative to the centre of its cell
	uint FirstSection;     // into FSectionData[]
	uint Flags;            // OBJECT_…, and the rounding error of the translation: see UnpackTranslationRemainder in ObjectPosition.glsl
	ivec3 Cell;            // cell of the world; see CellOffset in Bindings.glsl
	uint Motion;           // into FObjectMotion[], or NO_MOTION
	float CasterRadius;    // of its bounding sphere, metres; larger than any if unknown, or if it casts no shadows
};
LANTERN_ASSERT_SIZE(FObjectData, 76);

#define NO_MOTION 0xffffffffu // the object has neither moved nor deformed since the previous frame

// The placement and shape of an object in the previous frame.
struct FObjectMotion
{
	vec4 PreviousObjectToWorld[3]; // see FObjectData::ObjectToWorld
	ivec3 PreviousCell;            // see FObjectData::Cell
	uint PreviousFlags;            // see FObjectData::Flags
	FAddress PreviousPositions;    // float3[], previous vertices of a deformed geometry; 0: unchanged
};
LANTERN_ASSERT_SIZE(FObjectMotion, 72);

// Bits of an object's instance mask, by convention. A ray meets an object if their masks share a bit.
#define MASK_VISIBLE 1u    // camera, reflection and GI rays
#define MASK_SUN 2u        // casts from the sun and the sky, and stands still
#define MASK_SUN_MOVING 4u // casts from the sun and the sky, and moves
#define MASK_CHARACTER 8u  // casts on everything but characters, from all lights
#define MASK_LOCAL 16u     // casts from local lights
// Rays that light a surface with a toon sphere meet objects without one alone. Objects that are visible have it, but those with a sphere.
#define MASK_OUTSIDE_SPHERES 32u
#define MASK_TRANSMISSIVE 64u // objects that light shines through somewhere; the scene takes it away from others
// Rays for shadows. Whose mask has none of these casts none.
#define MASK_CASTERS (MASK_SUN | MASK_SUN_MOVING | MASK_CHARACTER | MASK_LOCAL)
// Rays from a surface to a light: SunCasters and LocalCasters in Casters.glsl say what surface they leave.
#define MASK_SUN_CASTERS (MASK_SUN | MASK_SUN_MOVING | MASK_CHARACTER)
#define MASK_LOCAL_CASTERS (MASK_LOCAL | MASK_CHARACTER)

#define OBJECT_MIRRORED 1u  // negative determinant: front faces appear clockwise
#define OBJECT_CHARACTER 2u // characters do not shadow it

// An emissive triangle, for next-event estimation. EmissiveTriangles.comp writes it. Its corners are relative to the centre of the
// object's cell, so that they stay valid when the scene's origin moves.
struct FEmissiveTriangle
{
	vec3 P0;
	float Power; // area · EmissiveWeight, the latter by points of the emissive texture if there is one
	vec3 P1;
	uint Object;
	vec3 P2;
	uint Section; // into FSectionData[]
	uint Primitive;
	uint Flags;         // OBJECT_MIRRORED: the winding is reversed
	uint Cluster;       // into FEmissiveCluster[]
	float ClusterShare; // chance of this one and those before it, if one of its cluster is chosen; the last value is 1
};
LANTERN_ASSERT_SIZE(FEmissiveTriangle, 64);

#define EMISSIVE_CLUSTERS 512u // that triangles are divided into; each object that emits has one more at most
// Chances are by power up to this part, which is by number: what is dim beside a floodlight still has a chance that fp32 sums keep.
#define EMISSIVE_FLOOR 0.0625f

// Consecutive emissive triangles of one object, which light sampling weighs as one.
struct FEmissiveCluster
{
	uint First, Count; // FEmissiveTriangle[]
	uint Object;
	uint Range; // into FEmissiveRange[]: that of the first triangle
};
LANTERN_ASSERT_SIZE(FEmissiveCluster, 16);

// The emissive triangles of a section, which are consecutive. It ends where the next range begins; the last one is empty.
struct FEmissiveRange
{
	uint First;   // FEmissiveTriangle[]
	uint Section; // into FSectionData[]
};
LANTERN_ASSERT_SIZE(FEmissiveRange, 8);

// What EmissiveTriangles.comp finds of a cluster.
struct FEmissivePower
{
	float Power; // sum of FEmissiveTriangle::Power
	float Share; // chance of this cluster and those before it; the last value is 1
};
LANTERN_ASSERT_SIZE(FEmissivePower, 8);

// What precedes FEmissivePower[].
struct FEmissivePowerHeader
{
	float Power; // of all clusters
	uint Pad;
};
LANTERN_ASSERT_SIZE(FEmissivePowerHeader, 8);

// Where a cluster of emissive triangles lies, and to which side it shines. EmissiveTriangles.comp finds it relative to the centre of its
// object's cell, and EmitterClusters.comp relative to the scene's origin.
struct FEmitterCluster
{
	vec3 Center; // of its box
	float Power; // FEmissivePower::Power: luminance · area · EmissionScale
	vec3 Half;   // of the box's edges
	float Area;  // of its triangles, m²
	vec3 Normal; // mean of their normals by power; 1 long: the cluster is flat and shines to this side alone
	float Plane; // of a flat one: the least Normal · position of a corner
	uint First, Count; // FEmissiveTriangle[]
	uint Pad0, Pad1;
};
LANTERN_ASSERT_SIZE(FEmitterCluster, 64);

// How indirect light falls on an object of a stylised look: FToonStyle.
struct FToonData
{
	vec3 Center;
	uint Object; // into FObjectData[]
	float SphereWeight;
	float Bend;
	float MaxSaturation;
	float MaxValue;
	float Occlusion;
	vec3 Tint;
};
LANTERN_ASSERT_SIZE(FToonData, 48);

#define SKY_MAP_CUBE 0u
#define SKY_MAP_OCTAHEDRAL 1u
#define SKY_MAP_ROOTS 2u // octahedral, of square roots of nits: half floats then hold moonless nights and blinding suns

// Rays that paths trace in a frame (r.RT.Rays.CountPaths), by kind.
#define PATH_RAY_SURFACE 0u // looks for a surface; of the reference, also for what tints a light
#define PATH_RAY_LIGHT 1u   // from a surface to a light
#define PATH_RAY_CHECK 2u   // whether a surface sees the place of a radiance cell, or what a kept path has met
#define PATH_RAY_KINDS 3u
struct FPathRayStatistics
{
	uint Rays[PATH_RAY_KINDS];
};
LANTERN_ASSERT_SIZE(FPathRayStatistics, 12);

// Constants of the scene, one block a frame.
struct FSceneConstants
{
	FAddress Objects;   // FObjectData[]
	FAddress Sections;  // FSectionData[]
	FAddress Materials; // FMaterialData[]
	FAddress Lights;    // FLightData[]
	FAddress EmissiveTriangles; // FEmissiveTriangle[]
	uint LightCount;    // slots, free ones included; 0: no light
	uint EmissiveTriangleCount;
	uint EmissiveClusterCount;
	uint Tlas;           // index in the bindless heap
	vec3 SunDirection;   // in which its light travels
	float SunIrradiance; // on a plane that faces it, lux
	vec3 SunColor;       // multiplies SunIrradiance
	float SunOneMinusCos; // 1 − cosine of its angular radius; 0: a point
	vec3 SkyRadiance;      // nits; times the texels of the sky's map if there is one
	uint MaterialOverride; // r.RT.Material.Override
	ivec3 OriginCell;      // cell that the scene's origin lies in
	float ObjectReach;     // see OffsetRayOrigin in Math.glsl, metres
	vec3 OriginInCell;     // scene's origin relative to the centre of its cell, metres
	uint SkyMap;           // slot of a texture as in FMaterialData; NO_TEXTURE: the sky is uniform
	vec3 SkyMapAxes[3];    // rows: directions in the world to directions in the map
	uint SkyMapKind;       // SKY_MAP_…
	FAddress AnyHitCounter; // uint: counts alpha tests of rays, if r.RT.Opacity.Count is on
	FAddress StandInHits;   // uint[], by material: rays that hit a stand-in of its shader; 0: not counted
	FAddress ObjectMotions; // FObjectMotion[]; 0: nothing moved
	FAddress LightCells;    // FLightGrid of the view; 0: look-ups find all lights
	FAddress EmissiveClusters; // FEmissiveCluster[]
	FAddress EmissiveRanges;   // FEmissiveRange[]
	FAddress EmissivePowers;   // FEmissivePowerHeader, FEmissivePower[] by cluster
	FAddress EmissiveBounds;   // FEmitterCluster[], relative to the cells of objects
	FAddress ObjectChannels;  // uint[]: channels of each object, exclusive-or CHANNELS_DEFAULT; 0: all have these
	FAddress LightProfiles;   // FLightProfile[], by number - 1
	FAddress ProfileTexels;   // uint[]
	FAddress ToonStyles;      // FToonData[]; 0: no object has a style
	FAddress ObjectToons;     // uint[]: for each object, its style's place + 1; 0: it has none
	FAddress ToonNumbers;     // uint[256]: the same for an engine's numbers; 0: no style has a number
	FAddress SkyData;         // FSkyData (SkyTypes.h); 0: the sky has no program
	uint SunChannels;         // 8 bits, as those of FLightData
	uint Pad;
	FAddress PathRayStatistics; // FPathRayStatistics, for shaders with COUNTS_PATH_RAYS
};
LANTERN_ASSERT_SIZE(FSceneConstants, 312);

// A camera, as passes see it whatever the host's conventions are: FView has them, HostProjection.h makes it of a matrix.
// Positions are relative to the scene's origin.
struct FViewConstants
{
	mat4 RelativeToClip; // clip space from positions relative to the camera, without jitter; depth is reversed and infinite
	vec3 CameraPosition;
	float PixelSize; // height of a pixel at distance 1; orthographic: at any distance, metres
	vec3 CameraRight;
	float Near;
	vec3 CameraUp;
	uint bOrthographic;
	vec3 CameraForward;
	uint FrameIndex; // counts this view's frames, one by one
	// Coordinates along CameraRight and CameraUp at distance 1 (orthographic: metres) of a point of the picture, jitter included:
	// point · scale + offset, the point in pixels.
	vec2 RayScale;
	vec2 RayOffset;
	vec2 ClipJitter; // what a raster adds to xy of clip space, times w
	uint Width;
	uint Height;
	uint Seed;
	float Exposure; // factor, not stops; 0: unknown
	// Error of a distance along the view that its depth texel has: x + y · distance + z · distance², metres.
	vec3 DepthError;
	float NormalError; // sine of the angle by which the host's normals may be off; 0: they are exact
	// The previous frame, for reprojection. A point's position relative to the previous camera is its position relative to this
	// camera plus CameraMotion.
	mat4 PreviousRelativeToClip;
	vec3 CameraMotion; // from the previous camera's position to this one's, metres
	float PreviousNear;
	vec3 PreviousForward; // unit length
	float DeltaSeconds; // since the previous frame
	uint PreviousWidth;
	uint PreviousHeight;
	uint bHistory; // 0: there is no usable previous frame (first frame, cut); the members above are this frame's
	uint bDerivedNormals; // geometric normals come from depth, and each says whether it is sure: see IsSure
};
LANTERN_ASSERT_SIZE(FViewConstants, 296);

// The first push constants of every pass. Those of the pass itself follow.
struct FPassConstants
{
	FAddress Scene; // FSceneConstants
	FAddress View;  // FViewConstants
};
LANTERN_ASSERT_SIZE(FPassConstants, 16);

// Bits of FGBuffer::Classes: what a pixel shows.
#define CLASS_CHARACTER 1u

LANTERN_SHARED_END

#endif
