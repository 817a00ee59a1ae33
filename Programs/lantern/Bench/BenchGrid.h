// A square of triangles, for benchmarks of the module.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternModule/Module.h"

namespace Lantern
{

class FBenchGrid
{
public:
	explicit FBenchGrid(uint32_t Triangles); ///< about so many
	FRTModuleMesh Describe() const;          ///< valid while this lives
	size_t GetIndexCount() const { return Indices.size(); }

private:
	std::vector<float> Positions;
	std::vector<uint32_t> Indices;
};

/// Adds a mesh of its own and an object of it, in rows of 100 before the camera.
FRTStatus AddBenchGrid(IRTModuleRenderer& Renderer, const FBenchGrid& Grid, ERTMaterialHandle Material, uint32_t Number);

} // namespace Lantern
