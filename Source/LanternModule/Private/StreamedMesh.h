// A mesh whose vertices and indices stay in buffers of the engine's: checked, and described for the scene.
#pragma once

#include <vector>

#include "LanternModule/ModuleMesh.h"
#include "LanternScene/Geometry/Geometry.h"
#include "SceneTypes.h"

namespace Lantern
{

// Of a mesh with FRTModuleMesh::Streams.

/// Ok, or InvalidArgument, which names the member.
FRTStatus CheckStreamedMesh(const FRTModuleMesh& Mesh);
/// Describes the geometry of a checked mesh without the buffer of its streams (PackStreams). It waits for that.
FRTGeometryInfo DescribeStreamedMesh(const FRTModuleMesh& Mesh);
/// Returns what shaders read of a checked mesh, for each section.
std::vector<FVertexStreams> PackStreams(const FRTModuleMesh& Mesh);

} // namespace Lantern
