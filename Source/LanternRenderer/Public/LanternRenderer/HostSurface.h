// A host's G-buffer in its own conventions, and the pass that turns it into what passes read. What is native already costs nothing.
#pragma once

#include "LanternRenderer/Frame.h"
#include "LanternRenderer/HostProjection.h"

namespace Lantern
{

/// A G-buffer as a host has it. Defaults: as FGBuffer, which is called native.
struct FHostSurface
{
	FGraphTexture Depth, Normals;
	FGraphTexture GeometricNormals;    ///< coded as Normals; invalid: see bGeometricInZw
	FGraphTexture Motion;              ///< may be invalid
	FGraphTexture BaseColor, Material; ///< may be invalid, both
	FGraphTexture BackAlbedo;          ///< may be invalid: see bBackAlbedo
	FHostDepth DepthMeaning;
	bool bOctahedral = true; ///< normals: else xyz
	bool bUnsigned = false;  ///< normals: from 0 to 1; else from −1 to 1
	/// Channels z and w of octahedral normals hold the geometric normal. If not, and without GeometricNormals, it is derived from
	/// depth, and rays leave to both sides of it.
	bool bGeometricInZw = true;
	glm::mat3 NormalAxes{1.0f}; ///< columns: axes of the normals' space, in the world, orthonormal
	/// Whether Motion is as FGBuffer has it. Else motion = texel.xy · MotionScale + MotionOffset, by all of what follows.
	bool bNativeMotion = true;
	bool bMotionInUV = false;     ///< in parts of the picture; else in pixels
	bool bMotionDistance = false; ///< z and w are as in FGBuffer; else z is taken to be that of a surface that stands still
	bool bMotionPartial = false;  ///< texels of 0 were not written: the camera's motion
	glm::vec2 MotionScale{1}, MotionOffset{0};
	bool bUnrealMaterial = false; ///< Material: metallic, specular, roughness; alpha of BaseColor: occlusion
	bool bBackAlbedo = false;     ///< there is BackAlbedo. Normals then say where, as those of FGBuffer do
	glm::uvec2 Offset{0};         ///< of the view in all textures, pixels, below 65,536
};

/// Returns whether AddHostSurfacePass has textures to convert. Which textures are there does not count.
bool NeedsHostSurfacePass(const FHostSurface& Host);
FShaderSource MakeHostSurfaceSource();

/// Returns the G-buffer as passes read it, and sets the errors of Context.View. Adds a pass over the pixels for those textures that
/// are not native. r.RT.DepthBias scales the error of depth.
FGBuffer AddHostSurfacePass(FFrameContext& Context, const FHostSurface& Host);

} // namespace Lantern
