// An engine's mesh checked and packed for the scene.
#pragma once

#include <vector>

#include "LanternModule/Module.h"
#include "LanternScene/Geometry/Geometry.h"
#include "SceneTypes.h"

namespace Lantern
{

/// Ok, or InvalidArgument saying what of the mesh cannot be.
FRTStatus CheckMesh(const FRTModuleMesh& Mesh);
/// Positions, normals and texture coordinates alone; VertexCount must be right.
FRTStatus CheckVertices(const FRTModuleMesh& Mesh);

/// Of a checked mesh: normals and texture coordinates as vertices carry them.
std::vector<FVertexAttributes> PackAttributes(const FRTModuleMesh& Mesh);
/// The normals alone, into attributes as PackAttributes made them.
void PackNormals(const FRTModuleMesh& Mesh, std::vector<FVertexAttributes>& Attributes);

std::vector<FRTSectionInfo> MakeSections(const FRTModuleMesh& Mesh);

/// Without textures: what shaders know of the material.
FMaterialData PackMaterial(const FRTModuleMaterial& Material);

} // namespace Lantern
