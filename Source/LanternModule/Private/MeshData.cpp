// Converts mesh data of an engine to the vertex and index formats of shaders.
#include "MeshData.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"
#include "LanternScene/Geometry/Octahedral.h"
#include "LanternScene/Scene/TextureSlot.h"

namespace Lantern
{

namespace
{

bool IsSectionSound(const FRTModuleSection& Section, uint32_t IndexCount)
{
	return Section.IndexCount > 0 && Section.IndexCount % 3 == 0 && Section.FirstIndex <= IndexCount &&
	       Section.IndexCount <= IndexCount - Section.FirstIndex;
}

/// Null is finite.
bool AreFinite(const float* Values, size_t Count)
{
	return Values == nullptr || std::all_of(Values, Values + Count, [](float Value) { return std::isfinite(Value); });
}

/// Before anything is read: counts that can be.
FRTStatus CheckCounts(const FRTModuleMesh& Mesh)
{
	if (Mesh.Name == nullptr) { return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleMesh::Name is null"); }
	if (Mesh.VertexCount == 0 || Mesh.VertexCount > MaxMeshVertices)
	{
		return RefuseMesh(Mesh, "VertexCount is 0, or above MaxMeshVertices");
	}
	if (Mesh.IndexCount == 0 || Mesh.IndexCount > MaxMeshIndices || Mesh.IndexCount % 3 != 0)
	{
		return RefuseMesh(Mesh, "IndexCount is 0, above MaxMeshIndices, or no multiple of 3");
	}
	return Mesh.SectionCount > Mesh.IndexCount / 3 ? RefuseMesh(Mesh, "has more sections than triangles") : FRTStatus::Success();
}

FRTStatus CheckBounds(const FRTModuleMesh& Mesh)
{
	const bool bCenter = std::all_of(Mesh.BoundsCenter, Mesh.BoundsCenter + 3, [](float Value) { return std::isfinite(Value); });
	return bCenter && std::isfinite(Mesh.BoundsRadius) ? FRTStatus::Success()
	                                                   : RefuseMesh(Mesh, "BoundsCenter or BoundsRadius is not finite");
}

glm::vec3 ReadVector(const float* Data, uint32_t Index) { return {Data[Index * 3], Data[Index * 3 + 1], Data[Index * 3 + 2]}; }

/// Sum of the normals of the triangles around each vertex, weighted by area.
std::vector<glm::vec3> MakeNormals(const FMeshShape& Shape, const glm::vec3* Positions)
{
	std::vector<glm::vec3> Normals(Shape.Positions.size(), glm::vec3(0));
	for (size_t First = 0; First + 2 < Shape.Indices.size(); First += 3)
	{
		const uint32_t* const Corner = &Shape.Indices[First];
		const glm::vec3 A = Positions[Corner[0]];
		const glm::vec3 Area = cross(Positions[Corner[1]] - A, Positions[Corner[2]] - A);
		for (uint32_t I = 0; I < 3; ++I) { Normals[Corner[I]] += Area; }
	}
	return Normals;
}

uint32_t GetIndex(const FRTModuleMesh& Mesh, uint32_t At) { return Mesh.Indices16 != nullptr ? Mesh.Indices16[At] : Mesh.Indices[At]; }

bool HasIndexBase(const FRTModuleMesh& Mesh)
{
	const auto HasBase = [](const FRTModuleSection& Section) { return Section.FirstVertex > 0; };
	return Mesh.Sections != nullptr && std::any_of(Mesh.Sections, Mesh.Sections + Mesh.SectionCount, HasBase);
}

bool AreIndicesSound(const FRTModuleMesh& Mesh)
{
	const auto IsSound = [&](uint32_t First, uint32_t Count, uint64_t Base) {
		uint32_t Largest = 0;
		for (uint32_t I = 0; I < Count; ++I) { Largest = std::max(Largest, GetIndex(Mesh, First + I)); }
		return Base + Largest < Mesh.VertexCount;
	};
	if (!HasIndexBase(Mesh)) { return IsSound(0, Mesh.IndexCount, 0); }
	return std::all_of(Mesh.Sections, Mesh.Sections + Mesh.SectionCount,
	    [&](const FRTModuleSection& Section) { return IsSound(Section.FirstIndex, Section.IndexCount, Section.FirstVertex); });
}

/// Indices into all vertices. With an index base they are those of the sections, one behind the other.
std::vector<uint32_t> MakeIndices(const FRTModuleMesh& Mesh)
{
	std::vector<uint32_t> Out;
	const auto Append = [&](uint32_t First, uint32_t Count, uint32_t Base) {
		for (uint32_t I = 0; I < Count; ++I) { Out.push_back(Base + GetIndex(Mesh, First + I)); }
	};
	if (!HasIndexBase(Mesh)) { Append(0, Mesh.IndexCount, 0); }
	else
	{
		for (const FRTModuleSection& Section : GetSections(Mesh)) { Append(Section.FirstIndex, Section.IndexCount, Section.FirstVertex); }
	}
	return Out;
}

uint32_t PackTangent(const float* Tangent)
{
	constexpr uint32_t SignBit = 1u << 16;
	const uint32_t Packed = PackOctahedral({Tangent[0], Tangent[1], Tangent[2]}) & ~SignBit;
	return Tangent[3] < 0.0f ? Packed | SignBit : Packed;
}

std::vector<FVertexAttributes> PackAttributes(const FRTModuleMesh& Mesh)
{
	std::vector<FVertexAttributes> Attributes(Mesh.VertexCount);
	for (uint32_t Vertex = 0; Vertex < Mesh.VertexCount; ++Vertex)
	{
		FVertexAttributes& Out = Attributes[Vertex];
		Out = {};
		Out.Color = ~0u;
		if (Mesh.Tangents != nullptr) { Out.Tangent = PackTangent(Mesh.Tangents + size_t(Vertex) * 4); }
		if (Mesh.UVs != nullptr) { Out.UV0 = {Mesh.UVs[size_t(Vertex) * 2], Mesh.UVs[size_t(Vertex) * 2 + 1]}; }
		if (Mesh.UVs1 != nullptr) { Out.UV1 = {Mesh.UVs1[size_t(Vertex) * 2], Mesh.UVs1[size_t(Vertex) * 2 + 1]}; }
		if (Mesh.Colors != nullptr) { std::memcpy(&Out.Color, Mesh.Colors + size_t(Vertex) * 4, sizeof(Out.Color)); }
	}
	return Attributes;
}

bool HasOpaqueVertices(const FRTModuleMesh& Mesh)
{
	for (uint32_t Vertex = 0; Mesh.Colors != nullptr && Vertex < Mesh.VertexCount; ++Vertex)
	{
		if (Mesh.Colors[size_t(Vertex) * 4 + 3] != 255) { return false; }
	}
	return true;
}

std::vector<FRTSectionInfo> MakeSections(const FRTModuleMesh& Mesh)
{
	std::vector<FRTSectionInfo> Sections;
	const bool bBase = HasIndexBase(Mesh);
	uint32_t First = 0;
	for (const FRTModuleSection& From : GetSections(Mesh))
	{
		Sections.push_back({bBase ? First : From.FirstIndex, From.IndexCount, !From.bMayBeMasked});
		First += From.IndexCount;
	}
	return Sections;
}

FRTStatus CheckSections(const FRTModuleMesh& Mesh)
{
	if (Mesh.Sections == nullptr) { return FRTStatus::Success(); }
	if (Mesh.SectionCount == 0) { return RefuseMesh(Mesh, "has no section"); }
	uint64_t Indices = 0;
	for (uint32_t Section = 0; Section < Mesh.SectionCount; ++Section)
	{
		if (!IsSectionSound(Mesh.Sections[Section], Mesh.IndexCount))
		{
			return RefuseMesh(Mesh, "a section is empty or reaches past the indices");
		}
		Indices += Mesh.Sections[Section].IndexCount;
	}
	return Indices <= ~0u ? FRTStatus::Success() : RefuseMesh(Mesh, "the sections have more indices than 32 bits can count");
}

} // namespace

FRTStatus RefuseMesh(const FRTModuleMesh& Mesh, const char* Reason)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "mesh \"%s\": %s", FRTShown(Mesh.Name).Text, Reason);
}

std::vector<FRTModuleSection> GetSections(const FRTModuleMesh& Mesh)
{
	if (Mesh.Sections != nullptr) { return {Mesh.Sections, Mesh.Sections + Mesh.SectionCount}; }
	FRTModuleSection Whole;
	Whole.IndexCount = Mesh.IndexCount;
	Whole.bMayBeMasked = true; // free: instances without a masked material are forced opaque
	return {Whole};
}

FRTStatus CheckShape(const FRTModuleMesh& Mesh)
{
	FRTStatus Status = CheckCounts(Mesh);
	Status = Status ? CheckSections(Mesh) : Status;
	return Status ? CheckBounds(Mesh) : Status;
}

FRTStatus CheckMesh(const FRTModuleMesh& Mesh)
{
	if (const FRTStatus Status = CheckShape(Mesh); !Status) { return Status; }
	const bool bIndices = (Mesh.Indices != nullptr) != (Mesh.Indices16 != nullptr);
	if (!bIndices) { return RefuseMesh(Mesh, "Indices is null, or Indices16 is there beside it"); }
	FRTStatus Status = CheckVertices(Mesh.Name, Mesh.Positions, Mesh.Normals, Mesh.VertexCount);
	const auto Check = [&](const float* Values, size_t Components, const char* Reason) {
		if (Status && !AreFinite(Values, Mesh.VertexCount * Components)) { Status = RefuseMesh(Mesh, Reason); }
	};
	Check(Mesh.Tangents, 4, "a tangent is not finite");
	Check(Mesh.UVs, 2, "a texture coordinate is not finite");
	Check(Mesh.UVs1, 2, "a texture coordinate is not finite");
	if (!Status) { return Status; }
	return AreIndicesSound(Mesh) ? FRTStatus::Success() : RefuseMesh(Mesh, "an index is out of range");
}

FRTStatus CheckVertices(const char* Mesh, const float* Positions, const float* Normals, uint32_t VertexCount)
{
	const auto Fail = [&](const char* Reason) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "mesh \"%s\": %s", FRTShown(Mesh).Text, Reason);
	};
	if (Positions == nullptr) { return Fail("Positions is null"); }
	if (!AreFinite(Positions, size_t(VertexCount) * 3)) { return Fail("a position is not finite"); }
	return AreFinite(Normals, size_t(VertexCount) * 3) ? FRTStatus::Success() : Fail("a normal is not finite");
}

void PackNormals(const FMeshShape& Shape, const glm::vec3* Positions, const float* Normals, std::vector<FVertexAttributes>& Attributes)
{
	const std::vector<glm::vec3> Made = Normals == nullptr ? MakeNormals(Shape, Positions) : std::vector<glm::vec3>();
	for (uint32_t Vertex = 0; Vertex < Attributes.size(); ++Vertex)
	{
		Attributes[Vertex].Normal = PackOctahedral(Normals != nullptr ? ReadVector(Normals, Vertex) : Made[Vertex]);
	}
}

void FMeshData::Copy(uint64_t Offset, uint64_t Size, uint8_t* Out) const
{
	const struct
	{
		uint64_t Begin, End;
		const void* Data;
	} Parts[] = {{0, GetAttributesOffset(), Shape->Positions.data()}, {GetAttributesOffset(), GetIndicesOffset(), Attributes.data()},
	    {GetIndicesOffset(), GetBytes(), Indices16.empty() ? static_cast<const void*>(Shape->Indices.data()) : Indices16.data()}};
	for (const auto& Part : Parts)
	{
		const uint64_t Begin = std::max(Offset, Part.Begin), End = std::min(Offset + Size, Part.End);
		if (Begin >= End) { continue; }
		std::memcpy(Out + (Begin - Offset), static_cast<const uint8_t*>(Part.Data) + (Begin - Part.Begin), End - Begin);
	}
}

std::shared_ptr<FMeshData> PackMesh(const FRTModuleMesh& Mesh)
{
	static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
	const auto Shape = std::make_shared<FMeshShape>();
	Shape->Positions.resize(Mesh.VertexCount);
	std::memcpy(Shape->Positions.data(), Mesh.Positions, size_t(Mesh.VertexCount) * sizeof(glm::vec3));
	Shape->Indices = MakeIndices(Mesh);
	const auto Data = std::make_shared<FMeshData>();
	Data->Attributes = PackAttributes(Mesh);
	PackNormals(*Shape, Shape->Positions.data(), Mesh.Normals, Data->Attributes);
	if (Mesh.Indices16 != nullptr && Mesh.VertexCount <= 1u << 16) { Data->Indices16.assign(Shape->Indices.begin(), Shape->Indices.end()); }
	if (Data->Indices16.size() % 2 != 0) { Data->Indices16.push_back(0); } // shaders read whole words
	Data->Shape = Shape;
	return Data;
}

FRTGeometryInfo DescribeGeometry(const FRTModuleMesh& Mesh, const FMeshData& Data)
{
	FRTGeometryInfo Out;
	Out.Name = Mesh.Name;
	Out.VertexCount = Mesh.VertexCount;
	Out.Sections = MakeSections(Mesh);
	Out.IndexType = Data.Indices16.empty() ? ERTIndexType::UInt32 : ERTIndexType::UInt16;
	Out.bHasTangents = Mesh.Tangents != nullptr;
	Out.bOpaqueVertices = HasOpaqueVertices(Mesh);
	Out.bDynamic = Mesh.bDeformable;
	Out.bWaitsForData = true;
	const FBoundingSphere Given{ReadVector(Mesh.BoundsCenter, 0), Mesh.BoundsRadius};
	const FBoundingSphere Bounds =
	    Given.Radius < 0.0f ? FindBoundingSphere(Data.Shape->Positions.data(), Data.Shape->Positions.size()) : Given;
	Out.BoundsCenter = Bounds.Center;
	Out.BoundsRadius = Bounds.Radius;
	if (!Mesh.bKeepOnCpu || Mesh.bDeformable) { return Out; }
	Out.CpuPositions = Data.Shape->Positions.data();
	Out.CpuIndices = Data.Shape->Indices.data();
	Out.CpuOwner = Data.Shape;
	return Out;
}

namespace
{

/// Rounds to fp16, as payloads do: light sampling and its density must agree wherever they are computed.
float MakeEmissiveWeight(glm::vec3 Emission)
{
	constexpr float Scale = 1.0f / 64.0f; // so that bright lights stay in the range of fp16
	constexpr float Least = 6.2e-5f, Most = 65504.0f;
	const float Luminance = dot(Emission, glm::vec3(0.2126f, 0.7152f, 0.0722f)) * Scale;
	return Luminance > 0.0f ? glm::unpackHalf1x16(glm::packHalf1x16(glm::clamp(Luminance, Least, Most))) : 0.0f;
}

} // namespace

FMaterialData PackMaterial(const FRTModuleMaterial& Material)
{
	FMaterialData Data = {};
	Data.BaseColor = {Material.BaseColor[0], Material.BaseColor[1], Material.BaseColor[2], Material.BaseColor[3]};
	Data.Emissive = ReadVector(Material.Emissive, 0);
	Data.LightEmissive = Material.bLightEmissive ? ReadVector(Material.LightEmissive, 0) : Data.Emissive;
	Data.Metallic = Material.Metallic;
	Data.Roughness = Material.Roughness;
	Data.NormalScale = Material.NormalScale;
	Data.OcclusionStrength = Material.OcclusionStrength;
	Data.AlphaCutoff = Material.AlphaCutoff;
	Data.Ior = Material.Ior;
	Data.Specular = Material.Specular;
	Data.Transmission = Material.Transmission;
	Data.Extinction = glm::min(-glm::log(ReadVector(Material.AttenuationColor, 0)) / Material.AttenuationDistance, glm::vec3(1.0e6f));
	Data.ScatterAlbedo = ReadVector(Material.ScatterAlbedo, 0);
	Data.ScatterAnisotropy = Material.ScatterAnisotropy;
	Data.DiffuseTransmission = Material.DiffuseTransmission;
	Data.DiffuseTransmissionColor = ReadVector(Material.DiffuseTransmissionColor, 0);
	const bool bBlended = Material.bBlended && Material.Transmission <= 0.0f;
	Data.Flags = (Material.bMasked || bBlended ? MATERIAL_MASKED : 0u) | (Material.bDoubleSided ? MATERIAL_DOUBLE_SIDED : 0u) |
	             (Material.bSolid ? MATERIAL_SOLID : 0u) | (bBlended ? MATERIAL_BLENDED : 0u);
	const std::array<const FRTModuleMap*, MaterialMapCount> Maps = GetMaps(Material);
	static_assert(MaterialMapCount == TEXTURE_SLOTS);
	for (uint32_t Slot = 0; Slot < TEXTURE_SLOTS; ++Slot)
	{
		const FRTModuleMap& Map = *Maps[Slot];
		Data.UVTransform[Slot] = {Map.UVMatrix[0], Map.UVMatrix[1], Map.UVMatrix[2], Map.UVMatrix[3]};
		Data.UVOffset[Slot] = {Map.UVOffset[0], Map.UVOffset[1]};
		Data.UVSets |= Map.UVSet << Slot;
		Data.Textures[Slot] = NO_TEXTURE;
		if (Map.Texture == nullptr) { continue; }
		[[maybe_unused]] const bool bFits = MakeTextureSlot(Map.Texture->GetSampledIndex(), Map.Sampler->GetIndex(), Data.Textures[Slot]);
		assert(bFits && "CheckMaterial has seen to it");
	}
	const glm::vec3 Mean = Material.EmissiveMap.Texture != nullptr ? ReadVector(Material.EmissiveMapMean, 0) : glm::vec3(1);
	Data.EmissiveWeight = bBlended ? 0.0f : MakeEmissiveWeight(Data.LightEmissive * Mean);
	return Data;
}

} // namespace Lantern
