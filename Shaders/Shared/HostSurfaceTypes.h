// Constants of the pass that reads a host's G-buffer, shared by C++ and GLSL.
#ifndef LANTERN_HOST_SURFACE_TYPES_H
#define LANTERN_HOST_SURFACE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define HOST_SURFACE_GROUP_SIZE 8 // threads in x and y

// FHostSurfaceConstants::Flags
#define HOST_DEPTH_ORTHOGRAPHIC 1u    // depth 0 and 1 stand for distances; else for 1 / distance
#define HOST_DEPTH_REVERSED 2u        // depth is sky at 0; else at 1
#define HOST_DEPTH_LINEAR 4u          // texels are distances
#define HOST_NORMALS_OCTAHEDRAL 8u    // else xyz
#define HOST_NORMALS_UNSIGNED 16u     // from 0 to 1; else from −1 to 1
#define HOST_GEOMETRIC_IN_ZW 32u      // Normals has the geometric normal as well; octahedral only
#define HOST_MOTION_IN_UV 64u         // else in pixels
#define HOST_MOTION_DISTANCE 128u     // z and w are as in FGBuffer::Motion; else z is that of a surface that stands still
#define HOST_MOTION_PARTIAL 256u      // texels of 0 were not written: the camera's motion stands in
#define HOST_MATERIAL_UNREAL 512u     // metallic, specular, roughness
#define HOST_NORMALS_MIRRORED 1024u   // the third axis of the normals' space is −X × Y; else X × Y

// All textures: sampled indices, or NO_TEXTURE. Outputs: storage indices; NO_TEXTURE: the host's own texture is read as it is.
struct FHostSurfaceConstants
{
	FPassConstants Pass;
	uint Depth, Normals, GeometricNormals, Motion, BaseColor, Material, BackAlbedo;
	uint OutDepth, OutNormals, OutMotion, OutBaseColor, OutMaterial, OutBackAlbedo;
	uint Offset; // of the view in the textures, pixels: x | y << 16
	uint Flags;
	float DepthAtZero, DepthAtOne; // see FHostDepth
	vec2 MotionScale, MotionOffset;
	vec3 NormalX, NormalY; // axes of the normals' space, in the world, unit length and orthogonal
	uint Pad;
};
LANTERN_ASSERT_SIZE(FHostSurfaceConstants, 128);

LANTERN_SHARED_END

#endif
