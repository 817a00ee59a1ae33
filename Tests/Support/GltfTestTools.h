// glTF documents made in tests, and what is known of scene files outside the repository.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "LanternHost/SceneLoader.h"
#include "Support/TemporaryFolder.h"
#include "TextCheck.h"

namespace Lantern
{

/// Where scenes by others lie; see LANTERN_SCENES in the README.
inline std::filesystem::path GetScenesFolder()
{
	const char* Folder = std::getenv("LANTERN_SCENES");
	return Folder != nullptr ? std::filesystem::path(Folder) : std::filesystem::path(LANTERN_SOURCE_DIR) / ".." / "shared" / "scenes";
}

#define LANTERN_REQUIRE_SCENE(Path)                                                                                                        \
	if (!std::filesystem::exists(Path))                                                                                                    \
	{                                                                                                                                      \
		GTEST_SKIP() << (Path).string() << " is not there: LANTERN_SCENES names another folder of scenes";                                 \
	}

inline std::string EncodeBase64(const std::vector<uint8_t>& Data)
{
	constexpr const char* Alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string Text;
	for (size_t I = 0; I < Data.size(); I += 3)
	{
		const size_t Count = std::min<size_t>(3, Data.size() - I);
		uint32_t Bits = 0;
		for (size_t B = 0; B < 3; ++B) { Bits = Bits << 8 | (B < Count ? Data[I + B] : 0u); }
		for (size_t C = 0; C < 4; ++C) { Text += C <= Count ? Alphabet[Bits >> (18 - 6 * C) & 63] : '='; }
	}
	return Text;
}

/// Builds a document: buffers grow by what is added, accessors refer to it.
class FGltfMaker
{
public:
	nlohmann::json Json = {{"asset", {{"version", "2.0"}}}};
	std::vector<uint8_t> Data;

	template <class T>
	int AddView(const std::vector<T>& Values)
	{
		Data.resize((Data.size() + 3) / 4 * 4);
		const size_t Offset = Data.size(), Bytes = Values.size() * sizeof(T);
		Data.resize(Offset + Bytes);
		std::memcpy(Data.data() + Offset, Values.data(), Bytes);
		Json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", Offset}, {"byteLength", Bytes}});
		return int(Json["bufferViews"].size()) - 1;
	}
	template <class T>
	int AddAccessor(const std::vector<T>& Values, const char* Type, int ComponentType, size_t Count)
	{
		const int View = AddView(Values);
		Json["accessors"].push_back({{"bufferView", View}, {"type", Type}, {"componentType", ComponentType}, {"count", Count}});
		return int(Json["accessors"].size()) - 1;
	}
	int AddVec3(const std::vector<float>& Values) { return AddAccessor(Values, "VEC3", 5126, Values.size() / 3); }
	int AddIndices(const std::vector<uint16_t>& Values) { return AddAccessor(Values, "SCALAR", 5123, Values.size()); }

	/// A triangle in the xy plane, and a node that shows it. Returns the primitive.
	nlohmann::json& AddTriangle()
	{
		const int Positions = AddVec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
		const int Indices = AddIndices({0, 1, 2});
		Json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", Positions}}}, {"indices", Indices}}}}});
		Json["nodes"].push_back({{"mesh", Json["meshes"].size() - 1}});
		return Json["meshes"].back()["primitives"][0];
	}

	std::string GetText() const
	{
		nlohmann::json Complete = Json;
		if (!Data.empty() && !Complete.contains("buffers"))
		{
			Complete["buffers"] = {{{"byteLength", Data.size()}, {"uri", "data:application/octet-stream;base64," + EncodeBase64(Data)}}};
		}
		return Complete.dump();
	}
	FLoadResult Load(const FLoadOptions& Options = {}) const { return LoadText(GetText(), Options); }
	static FLoadResult LoadText(const std::string& Text, const FLoadOptions& Options = {})
	{
		return LoadSceneFromMemory(Text.data(), Text.size(), "test.gltf", Options);
	}

	/// As a GLB, with the data in the binary chunk.
	std::string GetGlb() const
	{
		nlohmann::json Complete = Json;
		Complete["buffers"] = {{{"byteLength", Data.size()}}};
		std::string Text = Complete.dump();
		Text.resize((Text.size() + 3) / 4 * 4, ' ');
		std::string Binary(Data.begin(), Data.end());
		Binary.resize((Binary.size() + 3) / 4 * 4, '\0');
		std::string Glb;
		const auto Append = [&](uint32_t Value) { Glb.append(reinterpret_cast<const char*>(&Value), 4); };
		Append(0x46546C67);
		Append(2);
		Append(uint32_t(12 + 8 + Text.size() + 8 + Binary.size()));
		Append(uint32_t(Text.size()));
		Append(0x4E4F534A);
		Glb += Text;
		Append(uint32_t(Binary.size()));
		Append(0x004E4942);
		return Glb + Binary;
	}
};

/// The load fails, and its message, one line that can be shown, holds every one of the words.
inline void ExpectError(const FLoadResult& Result, const std::vector<const char*>& Words)
{
	EXPECT_FALSE(Result.Scene.has_value());
	EXPECT_TRUE(IsCleanText(Result.Error)) << testing::PrintToString(Result.Error);
	EXPECT_LT(Result.Error.size(), 1000u);
	for (const char* Word : Words)
	{
		EXPECT_NE(Result.Error.find(Word), std::string::npos) << "'" << Word << "' is not in: " << Result.Error;
	}
}

/// 2 × 1 texels, RGBA: (255, 0, 0, 255) and (0, 0, 255, 128).
inline const std::vector<uint8_t>& GetTinyPng()
{
	static const std::vector<uint8_t> Png = {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52,
	    0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00, 0x00, 0xF4, 0x22, 0x7F, 0x8A, 0x00, 0x00, 0x00, 0x0E, 0x49,
	    0x44, 0x41, 0x54, 0x78, 0x9C, 0x63, 0xF8, 0xCF, 0xC0, 0x00, 0x42, 0x0D, 0x00, 0x0F, 0x7A, 0x03, 0x7E, 0x77, 0xE9, 0x7F, 0x97, 0x00,
	    0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
	return Png;
}

/// Two textures of one image, used as colour and as data.
inline FGltfMaker MakeTextured()
{
	FGltfMaker Maker;
	auto& Primitive = Maker.AddTriangle();
	Primitive["material"] = 0;
	Primitive["attributes"]["NORMAL"] = Maker.AddVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
	Primitive["attributes"]["TEXCOORD_0"] = Maker.AddAccessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2", 5126, 3);
	Maker.Json["images"] = {{{"uri", "data:image/png;base64," + EncodeBase64(GetTinyPng())}}};
	Maker.Json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
	Maker.Json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
	Maker.Json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
	    {"normalTexture", {{"index", 1}, {"scale", 0.5}}}, {"emissiveTexture", {{"index", 0}}}}};
	return Maker;
}

inline bool HasWarning(const FSceneDescription& Scene, const std::string& Word)
{
	return std::any_of(
	    Scene.Warnings.begin(), Scene.Warnings.end(), [&](const std::string& Warning) { return Warning.find(Word) != std::string::npos; });
}

} // namespace Lantern
