// Converts mesh data of an engine to the vertex and index formats of shaders.
#include "MeshData.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{

FRTStatus Refuse(const FRTModuleMesh& Mesh, const char* Reason)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "mesh \"%s\": %s", FRTShown(Mesh.Name).Text, Reason);
}

bool IsSectionSound(const FRTModuleSection& Section, uint32_t IndexCount)
{
	return Section.IndexCount > 0 && Section.IndexCount % 3 == 0 && Section.FirstIndex <= IndexCount &&
	       Section.IndexCount <= IndexCount - Section.FirstIndex;
}

/// Before anything is read: counts that can be, and arrays for them.
FRTStatus CheckCounts(const FRTModuleMesh& Mesh)
{
	if (Mesh.Name == nullptr) { return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleMesh::Name is null"); }
	if (Mesh.VertexCount == 0 || Mesh.VertexCount > MaxMeshVertices) { return Refuse(Mesh, "VertexCount is 0, or above MaxMeshVertices"); }
	if (Mesh.IndexCount == 0 || Mesh.IndexCount > MaxMeshIndices || Mesh.IndexCount % 3 != 0)
	{
		return Refuse(Mesh, "IndexCount is 0, above MaxMeshIndices, or no multiple of 3");
	}
	if (Mesh.SectionCount > Mesh.IndexCount / 3) { return Refuse(Mesh, "has more sections than triangles"); }
	return Mesh.Indices != nullptr ? FRTStatus::Success() : Refuse(Mesh, "Indices is null");
}

/// Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014.
uint32_t PackOctahedral(glm::vec3 N)
{
	const float Sum = std::abs(N.x) + std::abs(N.y) + std::abs(N.z);
	glm::vec2 P = Sum > 0.0f ? glm::vec2(N) / Sum : glm::vec2(0);
	if (N.z < 0.0f)
	{
		const glm::vec2 Sign(P.x >= 0.0f ? 1.0f : -1.0f, P.y >= 0.0f ? 1.0f : -1.0f);
		P = (1.0f - glm::abs(glm::vec2(P.y, P.x))) * Sign;
	}
	return glm::packSnorm2x16(P);
}

glm::vec3 ReadVector(const float* Data, uint32_t Index) { return {Data[Index * 3], Data[Index * 3 + 1], Data[Index * 3 + 2]}; }

/// Sum of the normals of the triangles around each vertex, weighted by area.
std::vector<glm::vec3> MakeNormals(const FRTModuleMesh& Mesh)
{
	std::vector<glm::vec3> Normals(Mesh.VertexCount, glm::vec3(0));
	for (uint32_t First = 0; First + 2 < Mesh.IndexCount; First += 3)
	{
		const uint32_t* Corner = Mesh.Indices + First;
		const glm::vec3 A = ReadVector(Mesh.Positions, Corner[0]);
		const glm::vec3 B = ReadVector(Mesh.Positions, Corner[1]);
		const glm::vec3 C = ReadVector(Mesh.Positions, Corner[2]);
		const glm::vec3 Area = cross(B - A, C - A);
		for (uint32_t I = 0; I < 3; ++I) { Normals[Corner[I]] += Area; }
	}
	return Normals;
}

} // namespace

FRTStatus CheckMesh(const FRTModuleMesh& Mesh)
{
	if (const FRTStatus Status = CheckCounts(Mesh); !Status) { return Status; }
	if (const FRTStatus Status = CheckVertices(Mesh); !Status) { return Status; }
	if (*std::max_element(Mesh.Indices, Mesh.Indices + Mesh.IndexCount) >= Mesh.VertexCount)
	{
		return Refuse(Mesh, "an index is out of range");
	}
	if (Mesh.Sections != nullptr && Mesh.SectionCount == 0) { return Refuse(Mesh, "has no section"); }
	for (uint32_t Section = 0; Mesh.Sections != nullptr && Section < Mesh.SectionCount; ++Section)
	{
		if (!IsSectionSound(Mesh.Sections[Section], Mesh.IndexCount))
		{
			return Refuse(Mesh, "a section is empty or reaches past the indices");
		}
	}
	return FRTStatus::Success();
}

FRTStatus CheckVertices(const FRTModuleMesh& Mesh)
{
	if (Mesh.Positions == nullptr) { return Refuse(Mesh, "Positions is null"); }
	const auto IsFinite = [&](const float* Values, size_t Components) {
		return Values == nullptr ||
		       std::all_of(Values, Values + Mesh.VertexCount * Components, [](float Value) { return std::isfinite(Value); });
	};
	if (!IsFinite(Mesh.Positions, 3)) { return Refuse(Mesh, "a position is not finite"); }
	if (!IsFinite(Mesh.Normals, 3)) { return Refuse(Mesh, "a normal is not finite"); }
	return IsFinite(Mesh.UVs, 2) ? FRTStatus::Success() : Refuse(Mesh, "a texture coordinate is not finite");
}

void PackNormals(const FRTModuleMesh& Mesh, std::vector<FVertexAttributes>& Attributes)
{
	const std::vector<glm::vec3> Made = Mesh.Normals == nullptr ? MakeNormals(Mesh) : std::vector<glm::vec3>();
	for (uint32_t Vertex = 0; Vertex < Mesh.VertexCount; ++Vertex)
	{
		Attributes[Vertex].Normal = PackOctahedral(Mesh.Normals != nullptr ? ReadVector(Mesh.Normals, Vertex) : Made[Vertex]);
	}
}

std::vector<FVertexAttributes> PackAttributes(const FRTModuleMesh& Mesh)
{
	std::vector<FVertexAttributes> Attributes(Mesh.VertexCount);
	for (uint32_t Vertex = 0; Vertex < Mesh.VertexCount; ++Vertex)
	{
		FVertexAttributes& Out = Attributes[Vertex];
		Out = {};
		Out.Color = ~0u;
		if (Mesh.UVs != nullptr) { Out.UV0 = {Mesh.UVs[Vertex * 2], Mesh.UVs[Vertex * 2 + 1]}; }
	}
	PackNormals(Mesh, Attributes);
	return Attributes;
}

std::vector<FRTSectionInfo> MakeSections(const FRTModuleMesh& Mesh)
{
	if (Mesh.Sections == nullptr)
	{
		// Alpha-testable: instances without a masked material are forced opaque, so it is free.
		return {FRTSectionInfo{0, Mesh.IndexCount, false}};
	}
	std::vector<FRTSectionInfo> Sections;
	for (uint32_t Section = 0; Section < Mesh.SectionCount; ++Section)
	{
		const FRTModuleSection& From = Mesh.Sections[Section];
		Sections.push_back({From.FirstIndex, From.IndexCount, !From.bMayBeMasked});
	}
	return Sections;
}

FMaterialData PackMaterial(const FRTModuleMaterial& Material)
{
	FMaterialData Data = {};
	Data.BaseColor = {Material.BaseColor[0], Material.BaseColor[1], Material.BaseColor[2], Material.BaseColor[3]};
	Data.Emissive = ReadVector(Material.Emissive, 0);
	Data.Metallic = Material.Metallic;
	Data.Roughness = Material.Roughness;
	Data.NormalScale = 1.0f;
	Data.OcclusionStrength = 1.0f;
	Data.AlphaCutoff = Material.AlphaCutoff;
	Data.Ior = 1.5f;
	Data.Specular = 1.0f;
	Data.Flags = (Material.bMasked ? MATERIAL_MASKED : 0u) | (Material.bDoubleSided ? MATERIAL_DOUBLE_SIDED : 0u);
	std::fill(std::begin(Data.Textures), std::end(Data.Textures), NO_TEXTURE);
	std::fill(std::begin(Data.UVTransform), std::end(Data.UVTransform), glm::vec4(1, 0, 0, 1));
	// Light sampling and its density must agree: the weight is what half precision makes of it.
	const float Luminance = dot(Data.Emissive, glm::vec3(0.2126f, 0.7152f, 0.0722f));
	Data.EmissiveWeight = glm::unpackHalf1x16(glm::packHalf1x16(std::min(Luminance, 65504.0f)));
	return Data;
}

} // namespace Lantern
