// Files that are broken or mean harm: each gets one message that names the place, no crash and no hang.
#include <chrono>
#include <cmath>
#include <limits>

#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

FGltfMaker MakeTriangle()
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	return Maker;
}

nlohmann::json& GetPrimitive(FGltfMaker& Maker) { return Maker.Json["meshes"][0]["primitives"][0]; }

TEST(HostileGltf, FilesThatAreNoFiles)
{
	const FTemporaryFolder Folder;
	ExpectError(LoadScene((Folder.Get() / "missing.gltf").string()), {"missing.gltf", "no such file"});
	std::filesystem::create_directory(Folder.Get() / "folder.gltf");
	ExpectError(LoadScene((Folder.Get() / "folder.gltf").string()), {"folder.gltf", "is a directory"});
	ExpectError(LoadScene(Folder.Write("empty.gltf", "")), {"empty.gltf", "JSON"});
	ExpectError(LoadScene(Folder.Write("empty.glb", "")), {"empty.glb", "JSON"});
	ExpectError(LoadScene(Folder.Write("scene.obj", "v 0 0 0")), {"scene.obj", ".gltf", "courtyard"});
	ExpectError(LoadScene(std::string(300, 'a') + ".gltf"), {"no such file"});
}

TEST(HostileGltf, JsonThatIsNone)
{
	ExpectError(FGltfMaker::LoadText("{\"asset\": {\"version\": \"2.0\"},}"), {"test.gltf", "not valid JSON", "column"});
	ExpectError(FGltfMaker::LoadText("[]"), {"expected an object"});
	ExpectError(FGltfMaker::LoadText("{}"), {"asset"});
	ExpectError(FGltfMaker::LoadText("{\"asset\": {\"version\": \"1.0\"}}"), {"asset", "1.0"});
	ExpectError(FGltfMaker::LoadText("{\"asset\": {\"version\": 2}}"), {"asset.version", "string"});
	ExpectError(FGltfMaker::LoadText("\xff\xfe\x00"), {"not valid JSON"});
	ExpectError(FGltfMaker::LoadText("{\"asset\": {\"version\": \"2.0\", \"x\": 1e999}}"), {"not valid JSON"});
	const std::string Text = MakeTriangle().GetText();
	for (size_t Length = 0; Length < Text.size(); Length += 7)
	{
		ExpectError(FGltfMaker::LoadText(Text.substr(0, Length)), {"not valid JSON"});
	}
}

TEST(HostileGltf, DeepNesting)
{
	for (const char* Bracket : {"[", "{\"a\":"})
	{
		std::string Text = "{\"asset\": {\"version\": \"2.0\"}, \"extras\": ";
		for (int I = 0; I < 100000; ++I) { Text += Bracket; }
		ExpectError(FGltfMaker::LoadText(Text), {"nested deeper"});
	}
}

/// A valid triangle with one value put in its place, and what the message must say.
struct FCase
{
	const char* Pointer;
	nlohmann::json Value;
	std::vector<const char*> Words;
};

void ExpectCases(const std::vector<FCase>& Cases)
{
	for (const FCase& Case : Cases)
	{
		FGltfMaker Maker = MakeTriangle();
		if (std::string_view(Case.Pointer).starts_with("/buffers")) { Maker.Json["buffers"] = Case.Value; }
		else { Maker.Json[nlohmann::json::json_pointer(Case.Pointer)] = Case.Value; }
		SCOPED_TRACE(std::string(Case.Pointer) + " = " + Case.Value.dump());
		ExpectError(Maker.Load(), Case.Words);
	}
}

TEST(HostileGltf, WrongMeshesAndNodesAreNamedWithTheirPlace)
{
	ExpectCases({
	    {"/meshes", 7, {"meshes", "array"}},
	    {"/meshes/0", nullptr, {"meshes[0]", "object"}},
	    {"/meshes/0/primitives", "x", {"meshes[0].primitives", "array"}},
	    {"/meshes/0/primitives/0/attributes", 3, {"meshes[0].primitives[0].attributes", "object"}},
	    {"/meshes/0/primitives/0/attributes/POSITION", "0", {"attributes.POSITION", "integer"}},
	    {"/meshes/0/primitives/0/attributes/POSITION", 99, {"attributes.POSITION", "no accessor 99"}},
	    {"/meshes/0/primitives/0/attributes/POSITION", -1, {"attributes.POSITION", "-1"}},
	    {"/meshes/0/primitives/0/attributes/POSITION", 4294967296ull, {"no accessor 4294967296"}},
	    {"/meshes/0/primitives/0/attributes/POSITION", 1, {"1 components", "expected 3"}},
	    {"/meshes/0/primitives/0/indices", 0, {"indices", "unsigned scalars"}},
	    {"/meshes/0/primitives/0/indices", 0.5, {"indices", "0.5"}},
	    {"/meshes/0/primitives/0/material", 0, {"material", "there are 0"}},
	    {"/meshes/0/primitives/0/mode", 7, {"mode", "7"}},
	    {"/nodes/0/mesh", true, {"nodes[0].mesh", "boolean"}},
	    {"/nodes/0/mesh", 1, {"nodes[0].mesh", "no mesh 1"}},
	    {"/nodes/0/matrix", {1, 2, 3}, {"nodes[0].matrix", "16", "3"}},
	    {"/nodes/0/translation", {1e300, 0, 0}, {"nodes[0].translation[0]", "float"}},
	    {"/nodes/0/rotation", {0, 0, 0, 0}, {"nodes[0]", "rotation"}},
	    {"/nodes/0/scale", {1e30, 1, 1}, {"node 0", "place or size"}},
	    {"/nodes/0/children", {5}, {"nodes[0].children[0]", "no node 5"}},
	    {"/nodes/0/children", {0}, {"cycle"}},
	    {"/nodes/0/skin", 0, {"skin"}},
	    {"/nodes/0/camera", 0, {"camera"}},
	    {"/scene", 3, {"scene"}},
	    {"/scenes", {{{"nodes", {8}}}}, {"scenes[0].nodes[0]", "no node 8"}},
	});
}

TEST(HostileGltf, WrongBuffersAreNamedWithTheirPlace)
{
	ExpectCases({
	    {"/accessors/0/count", -5, {"accessors[0].count", "-5"}},
	    {"/accessors/0/count", 4, {"accessors[0]", "4 elements of 12 bytes", "do not fit"}},
	    {"/accessors/0/count", 1ull << 62, {"accessors[0].count"}},
	    {"/accessors/0/count", UINT64_MAX, {"accessors[0].count"}},
	    {"/accessors/0/count", 1e300, {"accessors[0].count"}},
	    {"/accessors/0/byteOffset", UINT64_MAX - 3, {"accessors[0]", "do not fit"}},
	    {"/accessors/0/byteOffset", 4, {"accessors[0]", "do not fit"}},
	    {"/accessors/0/componentType", 5124, {"accessors[0].componentType", "5124"}},
	    {"/accessors/0/type", "VEC5", {"accessors[0].type", "VEC5"}},
	    {"/accessors/0/bufferView", 40, {"accessors[0].bufferView", "40"}},
	    {"/accessors/0/sparse", {{"count", 1}}, {"accessors[0].sparse", "missing"}},
	    {"/bufferViews/0/buffer", 2, {"bufferViews[0].buffer"}},
	    {"/bufferViews/0/byteLength", 1000, {"bufferViews[0]", "do not fit buffer 0"}},
	    {"/bufferViews/0/byteOffset", UINT64_MAX, {"bufferViews[0]", "do not fit buffer 0"}},
	    {"/bufferViews/0/byteStride", 8, {"accessors[0]", "stride 8"}},
	    {"/bufferViews/0/byteStride", 4096, {"bufferViews[0].byteStride"}},
	    {"/buffers", {{{"byteLength", 1000}, {"uri", "data:x;base64,AAAA"}}}, {"buffers[0]", "ends early", "1000"}},
	    {"/buffers", {{{"byteLength", UINT64_MAX}, {"uri", "data:x;base64,AAAA"}}}, {"buffers[0]", "ends early"}},
	    {"/buffers", {{{"byteLength", 3}, {"uri", "data:x;base64,AA*A"}}}, {"buffers[0].uri", "character 2"}},
	    {"/buffers", {{{"byteLength", 3}, {"uri", "data:x,AAAA"}}}, {"buffers[0].uri", "base64"}},
	    {"/buffers", {{{"byteLength", 3}}}, {"buffers[0]", "uri"}},
	    {"/buffers", {{{"byteLength", 3}, {"uri", "file.bin"}}}, {"file.bin", "in memory"}},
	});
}

TEST(HostileGltf, WrongMaterialsAndExtensionsAreNamedWithTheirPlace)
{
	ExpectCases({
	    {"/extensionsRequired", {"KHR_draco_mesh_compression"}, {"KHR_draco_mesh_compression", "required"}},
	    {"/materials", {{{"alphaMode", "FOG"}}}, {"materials[0]", "FOG"}},
	    {"/materials", {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}}, {"baseColorTexture.index", "no texture 0"}},
	    {"/materials", {{{"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}}}, {"ior"}},
	    {"/cameras", {{{"perspective", {{"yfov", 0}, {"znear", 1}}}}}, {"cameras[0].perspective", "yfov"}},
	    {"/extensions/KHR_lights_punctual/lights", {{{"type", "sun"}}}, {"lights[0]", "sun"}},
	});
}

TEST(HostileGltf, ExistingExtrasOfAnyShapeAreIgnored)
{
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["extras"] = {{"count", "seven"}, {"meshes", {1, nullptr, "x"}}};
	Maker.Json["nodes"][0]["extras"] = nullptr;
	EXPECT_TRUE(Maker.Load().Scene);
}

TEST(HostileGltf, IndicesOutOfRange)
{
	FGltfMaker Maker = MakeTriangle();
	GetPrimitive(Maker)["indices"] = Maker.AddIndices({0, 1, 3});
	ExpectError(Maker.Load(), {"meshes[0].primitives[0]", "index 2 is 3", "3 vertices"});
}

TEST(HostileGltf, PositionsThatAreNoNumbers)
{
	for (const float Bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
	{
		FGltfMaker Maker = MakeTriangle();
		GetPrimitive(Maker)["attributes"]["POSITION"] = Maker.AddVec3({0, 0, 0, 1, Bad, 0, 0, 1, 0});
		ExpectError(Maker.Load(), {"meshes[0].primitives[0]", "vertex 1", "finite"});
	}
}

TEST(HostileGltf, OtherAttributesThatAreNoNumbersAreReplaced)
{
	const float Bad = std::numeric_limits<float>::quiet_NaN(), Huge = 3e38f;
	FGltfMaker Maker = MakeTriangle();
	auto& Attributes = GetPrimitive(Maker)["attributes"];
	Attributes["NORMAL"] = Maker.AddVec3({Bad, 0, 0, 0, 0, 0, Huge, Huge, Huge});
	Attributes["TEXCOORD_0"] = Maker.AddAccessor(std::vector<float>{Bad, 0, Huge, -Huge, 0, 0}, "VEC2", 5126, 3);
	Attributes["COLOR_0"] = Maker.AddAccessor(std::vector<float>(12, Bad), "VEC4", 5126, 3);
	Attributes["TANGENT"] = Maker.AddAccessor(std::vector<float>(12, Bad), "VEC4", 5126, 3);
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Warnings.size(), 3u);
	EXPECT_EQ(Result.Scene->Meshes[0].Attributes[0].UV0, glm::vec2(0));
}

TEST(HostileGltf, AttributesOfAnotherLength)
{
	FGltfMaker Maker = MakeTriangle();
	GetPrimitive(Maker)["attributes"]["NORMAL"] = Maker.AddVec3({0, 0, 1});
	ExpectError(Maker.Load(), {"attributes.NORMAL", "1 elements", "3"});
}

TEST(HostileGltf, NothingToDrawIsNoError)
{
	FGltfMaker Maker;
	EXPECT_TRUE(Maker.Load().Scene);
	Maker.Json["scenes"] = nlohmann::json::array();
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_TRUE(Result.Scene->Meshes.empty());
	EXPECT_EQ(Result.Scene->Materials.size(), 1u);
}

TEST(HostileGltf, SparseIndicesOutOfRange)
{
	FGltfMaker Maker = MakeTriangle();
	const int Indices = Maker.AddView(std::vector<uint8_t>{0, 200}), Values = Maker.AddView(std::vector<float>(6, 1.0f));
	auto& Sparse = Maker.Json["accessors"][0]["sparse"];
	Sparse = {{"count", 2}, {"indices", {{"bufferView", Indices}, {"componentType", 5121}}}, {"values", {{"bufferView", Values}}}};
	ExpectError(Maker.Load(), {"accessors[0]", "sparse index 1 is 200"});
	Sparse["indices"]["componentType"] = 5126;
	ExpectError(Maker.Load(), {"accessors[0].sparse.indices", "unsigned"});
	Sparse["indices"]["componentType"] = 5125;
	ExpectError(Maker.Load(), {"accessors[0].sparse.indices", "do not fit"});
}

TEST(HostileGltf, SmallFilesThatUnfoldToALot)
{
	FLoadOptions Options;
	Options.MaxGeometryBytes = 1 << 20;
	FGltfMaker Zeros = MakeTriangle();
	Zeros.Json["accessors"].push_back({{"type", "VEC3"}, {"componentType", 5126}, {"count", 200000}});
	GetPrimitive(Zeros) = {{"attributes", {{"POSITION", 2}}}};
	ExpectError(Zeros.Load(Options), {"meshes[0]", "limit"});
	FGltfMaker Repeated = MakeTriangle();
	for (int I = 0; I < 20000; ++I) { Repeated.Json["meshes"].push_back(Repeated.Json["meshes"][0]); }
	ExpectError(Repeated.Load(Options), {"limit"});
	Options = {};
	Options.MaxNodes = 100;
	FGltfMaker Nodes = MakeTriangle();
	for (int I = 0; I < 101; ++I) { Nodes.Json["nodes"].push_back(nlohmann::json::object()); }
	ExpectError(Nodes.Load(Options), {"nodes", "100"});
}

TEST(HostileGltf, CyclesAndSecondParents)
{
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}};
	ExpectError(Maker.Load(), {"nodes[2].children[0]", "node 1 is already a child of node 0"});
	Maker.Json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
	ExpectError(Maker.Load(), {"nodes[1]", "cycle"});
	Maker.Json["nodes"] = {{{"children", {1}}}, nlohmann::json::object()};
	Maker.Json["scenes"] = {{{"nodes", {0, 1}}}};
	ExpectError(Maker.Load(), {"scenes[0].nodes[1]", "no root"});
}

TEST(HostileGltf, ScalesThatMultiplyBeyondAllNumbers)
{
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["nodes"] = nlohmann::json::array();
	for (int I = 0; I < 400; ++I) { Maker.Json["nodes"].push_back({{"scale", {10, 10, 10}}, {"children", {I + 1}}}); }
	Maker.Json["nodes"].push_back({{"mesh", 0}});
	ExpectError(Maker.Load(), {"node 14", "place or size"});
}

void SetImage(FGltfMaker& Maker, const nlohmann::json& Image)
{
	Maker.Json["images"] = nlohmann::json::array({Image});
	Maker.Json["textures"] = {{{"source", 0}}};
	Maker.Json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
}

std::string MakeUri(const std::vector<uint8_t>& Data) { return "data:image/png;base64," + EncodeBase64(Data); }

TEST(HostileGltf, ImagesThatAreNone)
{
	FGltfMaker Maker = MakeTriangle();
	SetImage(Maker, {{"uri", MakeUri({'h', 'e', 'l', 'l', 'o'})}});
	ExpectError(Maker.Load(), {"images[0]", "materials[0].normalTexture", "not a PNG or JPEG"});
	SetImage(Maker, {{"uri", "data:image/png;base64,"}});
	ExpectError(Maker.Load(), {"images[0]", "not a PNG or JPEG"});
	SetImage(Maker, {{"name", "both"}});
	ExpectError(Maker.Load(), {"images[0]", "'both'", "either"});
	SetImage(Maker, {{"bufferView", 77}});
	ExpectError(Maker.Load(), {"images[0]", "no buffer view 77"});
	std::vector<uint8_t> Cut = GetTinyPng();
	Cut.resize(45);
	SetImage(Maker, {{"uri", MakeUri(Cut)}});
	ExpectError(Maker.Load(), {"images[0]", "cannot be decoded"});
	std::vector<uint8_t> Huge = GetTinyPng();
	Huge[18] = 0x4E; // a width of 20,000
	Huge[19] = 0x20;
	SetImage(Maker, {{"uri", MakeUri(Huge)}});
	ExpectError(Maker.Load(), {"images[0]", "20000", "limit"});
	FLoadOptions Options;
	Options.MaxImageBytes = 7;
	SetImage(Maker, {{"uri", MakeUri(GetTinyPng())}});
	ExpectError(Maker.Load(Options), {"images[0]", "limit of 7 bytes"});
	Maker.Json["textures"] = nlohmann::json::array({nlohmann::json::object()});
	ExpectError(Maker.Load(), {"textures[0]", "source"});
}

TEST(HostileGltf, PathsOutsideTheFolderAreRefused)
{
	const FTemporaryFolder Folder;
	const auto& Png = GetTinyPng();
	std::filesystem::create_directory(Folder.Get() / "inner");
	Folder.Write("secret.png", std::string(Png.begin(), Png.end()));
	for (const std::string Uri : {"../secret.png", "%2e%2e/secret.png", "a/../../secret.png", "/etc/passwd", "file:///etc/passwd",
	         "http://example.com/x.png", "..\\secret.png", "c:\\x.png", "..", ""})
	{
		FGltfMaker Maker = MakeTriangle();
		SetImage(Maker, {{"uri", Uri}});
		SCOPED_TRACE(Uri);
		ExpectError(LoadScene(Folder.Write("inner/scene.gltf", Maker.GetText())), {"images[0]", "URI"});
	}
	FGltfMaker Maker = MakeTriangle();
	SetImage(Maker, {{"uri", "missing.png"}});
	ExpectError(LoadScene(Folder.Write("inner/scene.gltf", Maker.GetText())),
	    {"images[0]", "missing.png", "no such file", "materials[0].normalTexture"});
	SetImage(Maker, {{"uri", "."}});
	ExpectError(LoadScene(Folder.Write("inner/scene.gltf", Maker.GetText())), {"images[0]", "directory"});
}

TEST(HostileGltf, MessagesAreOneBearableLine)
{
	FGltfMaker Maker = MakeTriangle();
	SetImage(Maker, {{"uri", MakeUri({'x'})}, {"name", std::string(100000, 'n') + "\n\x1b[31m"}});
	ExpectError(Maker.Load(), {"images[0]"});
	Maker = MakeTriangle();
	for (int I = 0; I < 1000; ++I) { Maker.Json["meshes"][0]["primitives"].push_back({{"attributes", nlohmann::json::object()}}); }
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Warnings.size(), 51u);
}

TEST(HostileGltf, ManySkinnedNodesOfOneLargeMesh)
{
	FGltfMaker Maker = MakeTriangle();
	auto& Attributes = GetPrimitive(Maker)["attributes"];
	Attributes["JOINTS_0"] = Maker.AddAccessor(std::vector<uint8_t>(12, 0), "VEC4", 5121, 3);
	Attributes["WEIGHTS_0"] = Maker.AddAccessor(std::vector<float>(12, 1.0f), "VEC4", 5126, 3);
	Maker.Json["skins"] = {{{"joints", std::vector<int>(1000, 0)}}};
	Maker.Json["nodes"] = std::vector<nlohmann::json>(1000, {{"mesh", 0}, {"skin", 0}});
	FLoadOptions Options;
	Options.MaxGeometryBytes = 1 << 20;
	ExpectError(Maker.Load(Options), {"nodes", "limit"});
}

TEST(HostileGltf, ABufferFileThatEndsEarly)
{
	const FTemporaryFolder Folder;
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["buffers"] = {{{"byteLength", Maker.Data.size()}, {"uri", "data.bin"}}};
	Folder.Write("data.bin", std::string(Maker.Data.begin(), Maker.Data.end() - 1));
	ExpectError(LoadScene(Folder.Write("scene.gltf", Maker.Json.dump())), {"scene.gltf", "buffers[0]", "ends early"});
}

TEST(HostileGltf, GlbHeadersThatLie)
{
	const std::string Glb = MakeTriangle().GetGlb();
	const auto LoadGlb = [](const std::string& Data) { return LoadSceneFromMemory(Data.data(), Data.size(), "test.glb"); };
	ASSERT_TRUE(LoadGlb(Glb).Scene);
	for (size_t Length = 0; Length < Glb.size(); ++Length) { EXPECT_FALSE(LoadGlb(Glb.substr(0, Length)).Scene) << Length; }
	const auto Patch = [&](size_t Offset, uint32_t Value) {
		std::string Patched = Glb;
		std::memcpy(Patched.data() + Offset, &Value, 4);
		return LoadGlb(Patched);
	};
	ExpectError(Patch(4, 1), {"version 1"});
	ExpectError(Patch(8, uint32_t(Glb.size()) + 1), {"truncated"});
	ExpectError(Patch(8, UINT32_MAX), {"truncated"});
	ExpectError(Patch(12, UINT32_MAX), {"chunk 0"});
	ExpectError(Patch(12, 0), {"GLB"});
	ExpectError(Patch(16, 0x004E4942), {"first chunk"});
	uint32_t JsonLength = 0;
	std::memcpy(&JsonLength, Glb.data() + 12, 4);
	ExpectError(Patch(20 + JsonLength, UINT32_MAX - 3), {"chunk 1"});
	ExpectError(Patch(20 + JsonLength, 0), {"buffers[0]"});
	ExpectError(Patch(24 + JsonLength, 0x58585858), {"buffers[0]"});
	ExpectError(LoadGlb("glTF"), {"shorter than its header"});
}

TEST(HostileGltf, AnimationsThatCannotBePlayed)
{
	const auto Load = [](const std::vector<float>& Times, const std::vector<float>& Values, const char* Interpolation) {
		FGltfMaker Maker = MakeTriangle();
		const int Input = Maker.AddAccessor(Times, "SCALAR", 5126, Times.size());
		const int Output = Maker.AddVec3(Values);
		Maker.Json["animations"] = {{{"samplers", {{{"input", Input}, {"output", Output}, {"interpolation", Interpolation}}}},
		    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
		return Maker.Load();
	};
	EXPECT_TRUE(Load({0, 1}, {1, 1, 1, 2, 2, 2}, "LINEAR").Scene);
	ExpectError(Load({1, 0}, {1, 1, 1, 2, 2, 2}, "LINEAR"), {"animations[0].samplers[0]", "time 1"});
	ExpectError(Load({0, NAN}, {1, 1, 1, 2, 2, 2}, "LINEAR"), {"time 1"});
	ExpectError(Load({0, 1}, {1, 1, 1, 2, 2, NAN}, "LINEAR"), {"value 1"});
	ExpectError(Load({0, 1}, {1, 1, 1}, "LINEAR"), {"output"});
	ExpectError(Load({0, 1}, {1, 1, 1, 2, 2, 2}, "CUBICSPLINE"), {"output"});
	ExpectError(Load({0, 1}, {1, 1, 1, 2, 2, 2}, "SPLINE"), {"SPLINE"});
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
	Maker.Json["animations"] = {
	    {{"samplers", {{{"input", 0}, {"output", 0}}}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}};
	ExpectError(Maker.Load(), {"node 0", "matrix"});
}

/// What the fuzzer starts from, and files made to break the loader; none may do worse than fail.
TEST(HostileGltf, TheFuzzersCorpus)
{
	size_t Count = 0;
	for (const auto& Entry : std::filesystem::directory_iterator(std::filesystem::path(LANTERN_SOURCE_DIR) / "Tests/Data/GltfCorpus"))
	{
		std::ifstream Stream(Entry.path(), std::ios::binary);
		const std::string Data((std::istreambuf_iterator<char>(Stream)), std::istreambuf_iterator<char>());
		FLoadOptions Options;
		Options.MaxGeometryBytes = Options.MaxImageBytes = 64 << 20;
		const FLoadResult Result = LoadSceneFromMemory(Data.data(), Data.size(), Entry.path().filename().string(), Options);
		EXPECT_NE(Result.Scene.has_value(), !Result.Error.empty()) << Entry.path();
		if (Result.Scene)
		{
			EXPECT_EQ(ValidateScene(*Result.Scene), "");
			EvaluatePose(*Result.Scene, 0.7);
		}
		++Count;
	}
	EXPECT_GT(Count, 0u);
}

} // namespace
} // namespace Lantern
