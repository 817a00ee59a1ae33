// A wall of quads with a material each, and rays that show what the material program of each quad says. Measurements and tests of
// material programs stand on it.
#pragma once

#include <string>

#include "LanternHost/SceneDescription.h"
#include "LanternRenderer/Renderer.h"

namespace Lantern
{

struct FMaterialWall
{
	uint32_t Count = 0, Columns = 0; ///< of quads; rows go up from Origin
	double QuadSize = 1.0;           ///< metres
	double Step = 1.0;               ///< metres from one quad to the next, in both directions
	glm::dvec3 Origin{0};            ///< lower left corner; the quads face +z
};

/// Makes the scene. Quad i has material i, which is a default one, and texture coordinates from 0 to 1.
FSceneDescription MakeMaterialWall(const FMaterialWall& Wall);

struct FMaterialTraceDesc
{
	std::string Path; ///< names the shader
	/// Rays per metre of a wall at the origin: parallel rays along −z from z = 5 m. 0: rays of the frame's camera.
	double RaysPerMetre = 0.0;
	/// Passes the colour, a vec3 at location 1, through callable shader 0 in the left half of the picture and 1 in the right.
	bool bCallables = false;
};

/// Makes the ray generation shader for AddMaterialTrace. It stores base colour and distance of what each ray hits, or (0, 0, 0, −1).
FShaderSource MakeMaterialTrace(const FMaterialTraceDesc& Desc);

/// Adds the pass "Trace", which traces one ray per texel into Target. RayGen: index of such a shader in Context.RayPipeline. Context
/// must live until the frame ends.
void AddMaterialTrace(FFrameContext& Context, uint32_t RayGen, FGraphTexture Target);

/// Traces Width × Height rays, and copies the texels to Readback: four floats each, rows from the top.
void AddMaterialTraceReadback(FFrameContext& Context, uint32_t RayGen, uint32_t Width, uint32_t Height, IRTBuffer* Readback);

} // namespace Lantern
