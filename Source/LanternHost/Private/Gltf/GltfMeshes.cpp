// Meshes: a glTF mesh becomes one vertex and one index array, and each of its primitives a section.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "Gltf/GltfTriangles.h"
#include "LanternHost/VertexPacking.h"
#include "TangentSpace.h"

namespace Lantern::Gltf
{

namespace
{

/// One primitive's vertices, unpacked. Empty arrays: not there.
struct FPrimitive
{
	std::vector<glm::vec3> Positions, Normals;
	std::vector<glm::vec4> Tangents, Colors;
	std::vector<glm::vec2> UV[2];
	std::vector<FSkinWeights> Skin;
	std::vector<uint32_t> Indices;
	int32_t Material = -1;
};

/// Vertices already in the mesh, by the accessors they came from: primitives often share them.
using FVertexRanges = std::map<std::string, uint32_t>;

class FMeshReader
{
public:
	FMeshReader(FDocument& InDocument, FHostMesh& OutMesh) : Document(InDocument), Mesh(OutMesh) {}
	void ReadPrimitive(const FJson& Json);

private:
	const FAccessor* FindAttribute(const FJson& Attributes, const char* Name, size_t VertexCount) const;
	void ReadVertices(const FJson& Json, const FJson& Attributes, FPrimitive& Out);
	void ReadSkin(const FJson& Attributes, FPrimitive& Out);
	void MakeFlat(const FJson& Json, FPrimitive& Primitive) const;
	void FixNormals(FPrimitive& Primitive);
	void AddTangents(FPrimitive& Primitive) const;
	void Append(const FJson& Json, const FPrimitive& Primitive);
	void AppendSection(uint32_t BaseVertex, const FPrimitive& Primitive);

	FDocument& Document;
	FHostMesh& Mesh;
	FVertexRanges Ranges;
};

void CheckComponents(const FJson& Json, const FAccessor& Accessor, uint32_t Min, uint32_t Max)
{
	if (Accessor.Components < Min || Accessor.Components > Max)
	{
		Json.Fail(fmt::format("accessor has {} components, expected {}", Accessor.Components,
		    Min == Max ? std::to_string(Min) : fmt::format("{} or {}", Min, Max)));
	}
}

const FAccessor* FMeshReader::FindAttribute(const FJson& Attributes, const char* Name, size_t VertexCount) const
{
	const int32_t Index = Attributes.GetIndex(Name, Document.Accessors.size(), "accessor");
	if (Index < 0) { return nullptr; }
	const FAccessor& Accessor = Document.Accessors[size_t(Index)];
	const FJson Place = Attributes.Member(Name);
	if (Accessor.Count != VertexCount) { Place.Fail(fmt::format("{} elements, but POSITION has {}", Accessor.Count, VertexCount)); }
	const std::string_view Text(Name);
	const bool bUV = Text.starts_with("TEXCOORD"), bNormal = Text == "NORMAL";
	const uint32_t Min = bUV ? 2 : bNormal || Text == "COLOR_0" ? 3 : 4;
	CheckComponents(Place, Accessor, Min, bUV ? 2 : bNormal ? 3 : 4);
	Document.ChargeGeometry(Place, Accessor.Count, 16);
	return &Accessor;
}

bool IsFinite(const glm::vec3& V) { return std::isfinite(V.x) && std::isfinite(V.y) && std::isfinite(V.z); }

/// Texture coordinates, colours: harmless where they are not numbers, so zero will do, and a word about it.
template <class TVector>
void ReplaceNonFinite(FDocument& Document, std::vector<TVector>& Values, const char* What)
{
	for (TVector& Value : Values)
	{
		for (int I = 0; I < TVector::length(); ++I)
		{
			if (!std::isfinite(Value[I]))
			{
				Value[I] = 0.0f;
				Document.Warn(fmt::format("{} that are no numbers were set to 0", What));
			}
		}
	}
}

void FMeshReader::ReadVertices(const FJson& Json, const FJson& Attributes, FPrimitive& Out)
{
	const int32_t PositionIndex = Attributes.GetIndex("POSITION", Document.Accessors.size(), "accessor");
	const FAccessor& Position = Document.Accessors[size_t(PositionIndex)];
	const FJson PositionPlace = Attributes.Member("POSITION");
	CheckComponents(PositionPlace, Position, 3, 3);
	Document.ChargeGeometry(PositionPlace, Position.Count, sizeof(FVertexAttributes) + 12);
	Out.Positions = ReadVec3(Position);
	for (size_t I = 0; I < Out.Positions.size(); ++I)
	{
		if (!IsFinite(Out.Positions[I])) { Json.Fail(fmt::format("the position of vertex {} is not finite", I)); }
	}
	const size_t Count = Out.Positions.size();
	if (const FAccessor* Normal = FindAttribute(Attributes, "NORMAL", Count))
	{
		Out.Normals = ReadVec3(*Normal);
		if (const FAccessor* Tangent = FindAttribute(Attributes, "TANGENT", Count))
		{
			Out.Tangents = ReadVec4(*Tangent, glm::vec4(0, 0, 0, 1));
		}
	}
	const char* const Names[2] = {"TEXCOORD_0", "TEXCOORD_1"};
	for (int Set = 0; Set < 2; ++Set)
	{
		if (const FAccessor* UV = FindAttribute(Attributes, Names[Set], Count))
		{
			Out.UV[Set] = ReadVec2(*UV);
			ReplaceNonFinite(Document, Out.UV[Set], "texture coordinates");
		}
	}
	if (const FAccessor* Color = FindAttribute(Attributes, "COLOR_0", Count))
	{
		Out.Colors = ReadVec4(*Color, glm::vec4(1));
		ReplaceNonFinite(Document, Out.Colors, "vertex colours");
	}
	ReadSkin(Attributes, Out);
}

/// The four strongest of up to eight influences, renormalised.
FSkinWeights KeepStrongest(std::array<std::pair<float, uint16_t>, 8>& Influences)
{
	std::stable_sort(Influences.begin(), Influences.end(), [](const auto& A, const auto& B) { return A.first > B.first; });
	FSkinWeights Result;
	float Sum = 0.0f;
	for (size_t I = 0; I < 4; ++I) { Sum += Influences[I].first; }
	for (size_t I = 0; I < 4; ++I)
	{
		// A joint without weight is no reference: files leave any number there.
		const bool bUsed = Sum > 0 && Influences[I].first > 0;
		Result.Joints[I] = bUsed ? Influences[I].second : uint16_t(0);
		Result.Weights[I] = bUsed ? Influences[I].first / Sum : 0.0f;
	}
	if (!(Sum > 0)) { Result.Weights[0] = 1.0f; }
	return Result;
}

void FMeshReader::ReadSkin(const FJson& Attributes, FPrimitive& Out)
{
	const size_t Count = Out.Positions.size();
	std::vector<std::array<std::pair<float, uint16_t>, 8>> Influences;
	for (int Set = 0; Set < 2; ++Set)
	{
		const char* const JointNames[2] = {"JOINTS_0", "JOINTS_1"};
		const char* const WeightNames[2] = {"WEIGHTS_0", "WEIGHTS_1"};
		const FAccessor* Joints = FindAttribute(Attributes, JointNames[Set], Count);
		const FAccessor* Weights = FindAttribute(Attributes, WeightNames[Set], Count);
		if (Joints == nullptr || Weights == nullptr) { continue; }
		if (Joints->Elements.Type != EComponent::U8 && Joints->Elements.Type != EComponent::U16)
		{
			const FJson Place = Attributes.Member(JointNames[Set]);
			Place.Fail("joints must be unsigned bytes or shorts");
		}
		const std::vector<glm::uvec4> JointValues = ReadUVec4(*Joints);
		const std::vector<glm::vec4> WeightValues = ReadVec4(*Weights, glm::vec4(0));
		Document.ChargeGeometry(Attributes, Count, 64);
		Influences.resize(Count);
		for (size_t I = 0; I < Count; ++I)
		{
			for (int C = 0; C < 4; ++C)
			{
				const float Weight = WeightValues[I][C];
				const bool bUsable = std::isfinite(Weight) && Weight > 0 && Weight < 1e30f;
				Influences[I][size_t(Set * 4 + C)] = {bUsable ? Weight : 0.0f, uint16_t(JointValues[I][C])};
			}
		}
	}
	for (auto& Influence : Influences) { Out.Skin.push_back(KeepStrongest(Influence)); }
}

template <class T>
void Gather(std::vector<T>& Values, const std::vector<uint32_t>& Indices)
{
	if (!Values.empty())
	{
		std::vector<T> Gathered;
		Gathered.reserve(Indices.size());
		for (const uint32_t Index : Indices) { Gathered.push_back(Values[Index]); }
		Values = std::move(Gathered);
	}
}

/// Without normals the specification wants flat shading: each triangle gets vertices of its own.
void FMeshReader::MakeFlat(const FJson& Json, FPrimitive& Primitive) const
{
	Document.ChargeGeometry(Json, Primitive.Indices.size(), 128);
	Gather(Primitive.Positions, Primitive.Indices);
	Gather(Primitive.Colors, Primitive.Indices);
	Gather(Primitive.UV[0], Primitive.Indices);
	Gather(Primitive.UV[1], Primitive.Indices);
	Gather(Primitive.Skin, Primitive.Indices);
	for (size_t I = 0; I < Primitive.Indices.size(); ++I) { Primitive.Indices[I] = uint32_t(I); }
	Primitive.Normals = ComputeSmoothNormals(Primitive.Positions, Primitive.Indices);
}

/// Normalises; a normal that is zero or no number is taken from the triangles around.
void FMeshReader::FixNormals(FPrimitive& Primitive)
{
	std::vector<glm::vec3> Computed;
	for (size_t I = 0; I < Primitive.Normals.size(); ++I)
	{
		glm::vec3& Normal = Primitive.Normals[I];
		const double Length = IsFinite(Normal) ? glm::length(glm::dvec3(Normal)) : 0.0;
		if (Length > 1e-20)
		{
			Normal = glm::vec3(glm::dvec3(Normal) / Length);
			continue;
		}
		if (Computed.empty())
		{
			Document.Warn("normals that are zero or no numbers were computed from the triangles");
			Computed = ComputeSmoothNormals(Primitive.Positions, Primitive.Indices);
		}
		Normal = Computed[I];
	}
}

void FMeshReader::AddTangents(FPrimitive& Primitive) const
{
	const FHostMaterial& Material = Document.Scene.Materials[size_t(Primitive.Material)];
	const FHostTextureSlot& Slot = Material.Slots[TEXTURE_NORMAL];
	if (Slot.Texture < 0 || !Primitive.Tangents.empty() || Primitive.UV[Slot.UVSet].empty()) { return; }
	Primitive.Tangents = ComputeTangents(Primitive.Positions, Primitive.Normals, Primitive.UV[Slot.UVSet], Primitive.Indices);
}

/// Where a tangent is unusable, any direction along the surface.
uint32_t PackTangentAt(const FPrimitive& Primitive, size_t I)
{
	const glm::vec3& Normal = Primitive.Normals[I];
	glm::vec4 Tangent(0);
	if (!Primitive.Tangents.empty()) { Tangent = Primitive.Tangents[I]; }
	const double Length = IsFinite(glm::vec3(Tangent)) ? glm::length(glm::dvec3(Tangent)) : 0.0;
	const glm::vec3 Unit = Length > 1e-20 ? glm::vec3(glm::dvec3(Tangent) / Length) : GetPerpendicular(Normal);
	return PackTangent(glm::vec4(Unit, Tangent.w < 0 ? -1.0f : 1.0f));
}

void FMeshReader::AppendSection(uint32_t BaseVertex, const FPrimitive& Primitive)
{
	FHostSection Section;
	Section.FirstIndex = uint32_t(Mesh.Indices.size());
	Section.IndexCount = uint32_t(Primitive.Indices.size());
	Section.Material = Primitive.Material;
	for (const uint32_t Index : Primitive.Indices) { Mesh.Indices.push_back(BaseVertex + Index); }
	Mesh.Sections.push_back(Section);
}

void FMeshReader::Append(const FJson& Json, const FPrimitive& Primitive)
{
	const size_t Base = Mesh.Positions.size();
	const size_t Count = Primitive.Positions.size();
	if (Base + Count > UINT32_MAX || Mesh.Indices.size() + Primitive.Indices.size() > UINT32_MAX)
	{
		Json.Fail("the mesh has more vertices or indices than 32 bits count");
	}
	Mesh.Positions.insert(Mesh.Positions.end(), Primitive.Positions.begin(), Primitive.Positions.end());
	for (size_t I = 0; I < Count; ++I)
	{
		FVertexAttributes Attributes{};
		Attributes.Normal = PackUnitVector(Primitive.Normals[I]);
		Attributes.Tangent = PackTangentAt(Primitive, I);
		Attributes.UV0 = Primitive.UV[0].empty() ? glm::vec2(0) : Primitive.UV[0][I];
		Attributes.UV1 = Primitive.UV[1].empty() ? glm::vec2(0) : Primitive.UV[1][I];
		Attributes.Color = Primitive.Colors.empty() ? 0xffffffffu : PackColor(Primitive.Colors[I]);
		Mesh.Attributes.push_back(Attributes);
	}
	if (!Primitive.Skin.empty() || !Mesh.Skin.empty())
	{
		// A primitive without weights in a skinned mesh follows the first joint.
		FSkinWeights First;
		First.Weights[0] = 1.0f;
		Mesh.Skin.resize(Base, First);
		Mesh.Skin.insert(Mesh.Skin.end(), Primitive.Skin.begin(), Primitive.Skin.end());
		Mesh.Skin.resize(Base + Count, First);
	}
	Mesh.bHasTangents = Mesh.bHasTangents || !Primitive.Tangents.empty();
	AppendSection(uint32_t(Base), Primitive);
}

void FMeshReader::ReadPrimitive(const FJson& Json)
{
	const FJson Attributes = Json.Member("attributes");
	if (!Attributes.Exists()) { Json.Fail("'attributes' is missing"); }
	FPrimitive Primitive;
	Primitive.Material = Json.GetIndex("material", Document.Scene.Materials.size(), "material");
	if (Primitive.Material < 0)
	{
		Primitive.Material = int32_t(Document.Scene.Materials.size()); // the default one, appended by ReadMeshes
	}
	if (Json.Member("targets").Exists()) { Document.Warn("morph targets are not read"); }
	const int32_t Position = Attributes.GetIndex("POSITION", Document.Accessors.size(), "accessor");
	if (Position < 0)
	{
		Document.Warn(fmt::format("{}: left out, it has no POSITION", Json.GetPath()));
		return;
	}
	if (!ReadTriangles(Document, Json, Document.Accessors[size_t(Position)].Count, Primitive.Indices)) { return; }
	if (Primitive.Indices.empty())
	{
		Document.Warn(fmt::format("{}: left out, it has no triangles", Json.GetPath()));
		return;
	}
	const bool bDefaultMaterial = size_t(Primitive.Material) == Document.Scene.Materials.size();
	const bool bNeedsTangents =
	    !bDefaultMaterial && Document.Scene.Materials[size_t(Primitive.Material)].Slots[TEXTURE_NORMAL].Texture >= 0;
	const bool bShareable = Attributes.Member("NORMAL").Exists() && (!bNeedsTangents || Attributes.Member("TANGENT").Exists());
	const std::string Key = Attributes.Dump();
	if (const auto Found = Ranges.find(Key); bShareable && Found != Ranges.end())
	{
		AppendSection(Found->second, Primitive);
		return;
	}
	ReadVertices(Json, Attributes, Primitive);
	if (Primitive.Normals.empty()) { MakeFlat(Json, Primitive); }
	FixNormals(Primitive);
	if (bNeedsTangents) { AddTangents(Primitive); }
	if (bShareable) { Ranges[Key] = uint32_t(Mesh.Positions.size()); }
	Append(Json, Primitive);
}

void ComputeBounds(FHostMesh& Mesh)
{
	Mesh.BoundsMin = Mesh.BoundsMax = Mesh.Positions[0];
	for (const glm::vec3& Position : Mesh.Positions)
	{
		Mesh.BoundsMin = glm::min(Mesh.BoundsMin, Position);
		Mesh.BoundsMax = glm::max(Mesh.BoundsMax, Position);
	}
}

} // namespace

void ReadMeshes(FDocument& Document)
{
	const FJson Meshes = Document.Root.Member("meshes");
	const size_t DefaultMaterial = Document.Scene.Materials.size();
	bool bDefaultMaterialUsed = DefaultMaterial == 0;
	for (size_t I = 0; I < Meshes.Count(); ++I)
	{
		const FJson Json = Meshes.Element(I);
		FHostMesh Mesh;
		Mesh.Name = Json.GetString("name", "");
		FMeshReader Reader(Document, Mesh);
		const FJson Primitives = Json.Member("primitives");
		for (size_t P = 0; P < Primitives.Count(); ++P)
		{
			const FJson Primitive = Primitives.Element(P);
			Reader.ReadPrimitive(Primitive);
		}
		Document.ReportProgress("meshes", float(I + 1) / float(Meshes.Count()));
		if (Mesh.Sections.empty())
		{
			Document.MeshRemap.push_back(-1);
			continue;
		}
		for (const FHostSection& Section : Mesh.Sections) { bDefaultMaterialUsed |= size_t(Section.Material) == DefaultMaterial; }
		ComputeBounds(Mesh);
		Document.MeshRemap.push_back(int32_t(Document.Scene.Meshes.size()));
		Document.Scene.Meshes.push_back(std::move(Mesh));
	}
	if (bDefaultMaterialUsed)
	{
		FHostMaterial Default;
		Default.Name = "default";
		Document.Scene.Materials.push_back(Default);
	}
}

} // namespace Lantern::Gltf
