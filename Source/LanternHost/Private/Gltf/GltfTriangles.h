// The triangles of a primitive, whichever way the file lists them.
#pragma once

#include <cstdint>
#include <vector>

#include "Gltf/GltfDocument.h"

namespace Lantern::Gltf
{

/// Gives indices into the primitive's own vertices, three per triangle, each below VertexCount. Returns false, with a warning, for points
/// and lines.
bool ReadTriangles(FDocument& Document, const FJson& Json, uint64_t VertexCount, std::vector<uint32_t>& OutIndices);

} // namespace Lantern::Gltf
