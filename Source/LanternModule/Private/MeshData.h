// An engine's mesh checked and packed for the scene.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "LanternModule/Module.h"
#include "LanternScene/Geometry/Geometry.h"
#include "SceneTypes.h"

namespace Lantern
{

/// Ok, or InvalidArgument saying what of the mesh cannot be.
FRTStatus CheckMesh(const FRTModuleMesh& Mesh);
/// Name, counts, sections and bounds alone.
FRTStatus CheckShape(const FRTModuleMesh& Mesh);
/// InvalidArgument with the mesh's name.
FRTStatus RefuseMesh(const FRTModuleMesh& Mesh, const char* Reason);
/// Returns the sections of a mesh that has some, else all indices as one.
std::vector<FRTModuleSection> GetSections(const FRTModuleMesh& Mesh);
/// Positions and normals alone. Mesh: its name. Normals may be null.
FRTStatus CheckVertices(const char* Mesh, const float* Positions, const float* Normals, uint32_t VertexCount);

/// A mesh's positions and indices on the CPU.
struct FMeshShape
{
	std::vector<glm::vec3> Positions;
	std::vector<uint32_t> Indices;
};

/// A mesh as its one buffer on the GPU has it: positions, attributes, indices.
struct FMeshData
{
	std::shared_ptr<const FMeshShape> Shape;
	std::vector<FVertexAttributes> Attributes;
	std::vector<uint16_t> Indices16; ///< take the place of the shape's on the GPU, if there are any

	uint64_t GetAttributesOffset() const { return Shape->Positions.size() * sizeof(glm::vec3); }
	uint64_t GetIndicesOffset() const { return GetAttributesOffset() + Attributes.size() * sizeof(FVertexAttributes); }
	uint64_t GetBytes() const { return GetIndicesOffset() + (Indices16.empty() ? Shape->Indices.size() * 4 : Indices16.size() * 2); }
	/// Copies Size bytes from Offset on to Out.
	void Copy(uint64_t Offset, uint64_t Size, uint8_t* Out) const;
};

// Of a checked mesh.
std::shared_ptr<FMeshData> PackMesh(const FRTModuleMesh& Mesh);
/// Writes the normals alone. Normals: null for those of the triangles between Positions.
void PackNormals(const FMeshShape& Shape, const glm::vec3* Positions, const float* Normals, std::vector<FVertexAttributes>& Attributes);
/// Describes the mesh without its buffers. It waits for its data.
FRTGeometryInfo DescribeGeometry(const FRTModuleMesh& Mesh, const FMeshData& Data);

/// What shaders know of the material. It must have been checked.
FMaterialData PackMaterial(const FRTModuleMaterial& Material);

} // namespace Lantern
