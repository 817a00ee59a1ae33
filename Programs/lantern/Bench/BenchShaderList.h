// Lists the pipelines that frames of a scene may need. It renders frames on the mock device, with every method of Config/Methods.ini and
// every signal of the reference. Other settings stay as they are.
#pragma once

#include <string>
#include <vector>

#include "LanternHost/SampleEngine.h"

namespace Lantern
{

struct FPipelineShaders
{
	std::string Name; ///< paths, with defines
	/// One compute shader, all shaders of a ray-tracing pipeline, or those of all raster pipelines that draw RasterScene.
	std::vector<FShaderSource> Shaders;
	FRTPSODesc Rays;            ///< empty unless it is a ray-tracing pipeline
	FMaterialPrograms Programs; ///< the programs that Rays names
	std::string RasterScene;
	bool IsRays() const { return !Rays.RayGens.empty(); }
	bool IsRaster() const { return !RasterScene.empty(); }
};

/// Adds pipelines that Out lacks. Engine must be on a mock device, with the scene of that name loaded. Console variables are restored.
FRTStatus ListPipelines(
    FSampleEngine& Engine, const std::string& Scene, const std::string& MethodsFile, std::vector<FPipelineShaders>& Out);

} // namespace Lantern
