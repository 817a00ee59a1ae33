// A parsed glTF document: its JSON, buffers, buffer views and accessors, and the state of an import.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "Gltf/GltfFile.h"
#include "Gltf/GltfJson.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern::Gltf
{

enum class EComponent : uint32_t
{
	I8 = 5120,
	U8 = 5121,
	I16 = 5122,
	U16 = 5123,
	U32 = 5125,
	F32 = 5126
};

/// Elements of an accessor. The bytes have been checked to hold all of them.
struct FElements
{
	const uint8_t* Data = nullptr; ///< null: all zeros
	size_t Stride = 0;
	EComponent Type = EComponent::F32;
};

struct FAccessor
{
	uint32_t Components = 1; ///< 1–4, 16 for MAT4 (other matrices: see Type in the file; not read by us)
	uint64_t Count = 0;
	bool bNormalized = false;
	FElements Elements;
	uint64_t SparseCount = 0; ///< replaced elements
	FElements SparseIndices, SparseValues;
};

struct FDocument
{
	FDocument(const FLoadOptions& InOptions, FSceneDescription& OutScene) : Options(InOptions), Scene(OutScene) {}
	FDocument(const FDocument&) = delete;
	FDocument& operator=(const FDocument&) = delete;

	const FLoadOptions& Options;
	FSceneDescription& Scene;
	std::filesystem::path Folder; ///< empty: in memory
	nlohmann::json Json;
	FJson Root;
	FBytes GlbBinary;
	std::vector<FBlob> Buffers;
	std::vector<FBytes> BufferViews;
	std::vector<uint32_t> BufferViewStrides;
	std::vector<FAccessor> Accessors;

	/// Where the bytes of Scene.Images come from; ReadMaterials fills it.
	struct FImageSource
	{
		size_t GltfImage = 0;
		std::string UsedBy; ///< "materials[3].normalTexture"
	};
	std::vector<FImageSource> ImageSources;
	/// Profiles of lights that were read, by path or data: index in Scene.Profiles.
	std::map<std::string, size_t> ProfileIndices;
	/// New index by index in the file; −1 for a mesh of which nothing is left.
	std::vector<int32_t> MeshRemap, NodeRemap;

	/// Adds a warning once per text, and no more warnings than anyone reads.
	void Warn(const std::string& Text)
	{
		constexpr size_t MaxWarnings = 50;
		if (Warned.size() <= MaxWarnings && Warned.insert(Text).second)
		{
			Scene.Warnings.push_back(Warned.size() <= MaxWarnings ? Text : "further warnings are left out");
		}
	}
	void ReportProgress(std::string_view Stage, float Fraction) const
	{
		if (Options.Progress) { Options.Progress(Stage, Fraction); }
	}
	/// Counts the bytes that the file unfolds to. Throws past the limit.
	void ChargeGeometry(const FJson& Place, uint64_t Count, uint64_t BytesEach);

private:
	std::set<std::string> Warned;
	uint64_t GeometryBytes = 0;
};

void ReadBuffers(FDocument& Document);
void ReadAccessors(FDocument& Document);

/// Reads an accessor as floats. Normalised integers become −1 to 1 or 0 to 1; other integers stay as they are. Components that the accessor
/// lacks are left as they were in Fill.
std::vector<glm::vec4> ReadVec4(const FAccessor& Accessor, const glm::vec4& Fill);
std::vector<glm::vec3> ReadVec3(const FAccessor& Accessor);
std::vector<glm::vec2> ReadVec2(const FAccessor& Accessor);
std::vector<float> ReadScalars(const FAccessor& Accessor);
std::vector<glm::mat4> ReadMat4(const FAccessor& Accessor);
std::vector<glm::uvec4> ReadUVec4(const FAccessor& Accessor);
std::vector<uint32_t> ReadIndices(const FAccessor& Accessor);

// The parts of an import, in the order in which they are called.
void ReadMaterials(FDocument& Document); ///< and which textures and images they use, and how
void ReadImages(FDocument& Document);
void ReadMeshes(FDocument& Document);
void ReadNodes(FDocument& Document);
void ReadSkins(FDocument& Document);
void ReadAnimations(FDocument& Document);

} // namespace Lantern::Gltf
