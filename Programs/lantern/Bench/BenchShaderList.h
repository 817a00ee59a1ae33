// Which pipelines frames of a scene may need: found by rendering them on the mock device, with every method of
// Config/Methods.ini, every signal of the reference, and the settings as they are.
#pragma once

#include <string>
#include <vector>

#include "LanternHost/SampleEngine.h"

namespace Lantern
{

struct FPipelineShaders
{
	std::string Name; ///< paths, with defines
	/// One compute shader, all of a ray-tracing pipeline, or those of all raster pipelines that frames of RasterScene draw with.
	std::vector<FShaderSource> Shaders;
	FRTPSODesc Rays;            ///< of a ray-tracing pipeline
	FMaterialPrograms Programs; ///< that Rays names
	std::string RasterScene;
	bool IsRays() const { return !Rays.RayGens.empty(); }
	bool IsRaster() const { return !RasterScene.empty(); }
};

/// Engine: on a mock device, with the scene of that name loaded. Console variables are as before afterwards. Adds to Out what
/// is not there yet.
FRTStatus ListPipelines(
    FSampleEngine& Engine, const std::string& Scene, const std::string& MethodsFile, std::vector<FPipelineShaders>& Out);

} // namespace Lantern
