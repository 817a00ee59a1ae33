// glTF files with text that is broken or means harm, where messages quote it: errors and warnings can be shown.
#include "Support/GltfTestTools.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

/// As JSON can say it: escapes of a terminal, C1 controls, a direction override, a line that claims to be ours.
const std::string Worse = "\x1b[31m\u0085\u202E\u2028\nerror: forged \u00E4";
constexpr const char* WorseShown = "\\x1b[31m\\u{0085}\\u{202e}\\u{2028}\\nerror: forged \u00E4";

FGltfMaker MakeTriangle()
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	return Maker;
}

void ExpectClean(const FLoadResult& Result)
{
	EXPECT_TRUE(IsCleanText(Result.Error)) << testing::PrintToString(Result.Error);
	EXPECT_LT(Result.Error.size(), 1000u);
	for (size_t I = 0; Result.Scene && I < Result.Scene->Warnings.size(); ++I)
	{
		EXPECT_TRUE(IsCleanText(Result.Scene->Warnings[I])) << testing::PrintToString(Result.Scene->Warnings[I]);
	}
}

TEST(HostileGltfText, JsonOfBrokenBytes)
{
	for (const std::string Bytes :
	    {"\xff", "\x1b[31m", "\xC3", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC0\x80", "\u0085", "\u202E", "\x7f", "\r\n\x01"})
	{
		for (const std::string Before : {"", "{\"a\": ", "{\"a\": \"text", "{\"", "{\"a\": \"\\u12", "[1, tr", "{\"a\": \"text\"} "})
		{
			const FLoadResult Result = FGltfMaker::LoadText(Before + Bytes);
			ExpectError(Result, {"test.gltf: not valid JSON"});
			ExpectClean(Result);
		}
	}
	// The parser repeats the word that it could not read, all of it.
	const FLoadResult Result = FGltfMaker::LoadText("{\"a\": \"" + std::string(10'000'000, 'x') + "\xff\"}");
	ExpectError(Result, {"test.gltf: not valid JSON"});
	ExpectClean(Result);
}

TEST(HostileGltfText, AnyByteInAnyPlace)
{
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["nodes"][0]["name"] = "node";
	Maker.Json["extensionsUsed"] = {"EXT_unknown"};
	const std::string Text = Maker.GetText();
	for (const char Byte : {'\xff', '\x80', '\x1b', '\n', '\x7f', '"'})
	{
		for (size_t Place = 0; Place < Text.size(); ++Place)
		{
			std::string Changed = Text;
			Changed[Place] = Byte;
			ExpectClean(FGltfMaker::LoadText(Changed));
		}
	}
}

/// A valid triangle with the hostile text in one place; the error must show it as escapes.
TEST(HostileGltfText, NamesAndWords)
{
	const std::vector<std::pair<const char*, nlohmann::json>> Cases = {
	    {"/asset/version", Worse},
	    {"/extensionsRequired", {Worse}},
	    {"/materials", {{{"alphaMode", Worse}}}},
	    {"/accessors/0/type", Worse},
	    {"/extensions/KHR_lights_punctual/lights", {{{"type", Worse}}}},
	    {"/nodes/0", {{"mesh", 0}, {"name", Worse}, {"scale", {1e30, 1, 1}}}},
	    {"/images", {{{"name", Worse}}}},
	    {"/animations", {{{"samplers", {{{"input", 2}, {"output", 0}, {"interpolation", Worse}}}},
	                        {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}}}}},
	    {"/animations", {{{"samplers", {{{"input", 2}, {"output", 0}}}},
	                        {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", Worse}}}}}}}}},
	};
	for (const auto& [Pointer, Value] : Cases)
	{
		FGltfMaker Maker = MakeTriangle();
		Maker.AddAccessor(std::vector<float>{0, 1, 2}, "SCALAR", 5126, 3);
		Maker.Json["textures"] = {{{"source", 0}}};
		Maker.Json["images"] = {{{"name", "fine"}, {"uri", "data:image/png;base64," + EncodeBase64(GetTinyPng())}}};
		Maker.Json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
		Maker.Json[nlohmann::json::json_pointer(Pointer)] = Value;
		SCOPED_TRACE(Pointer);
		const FLoadResult Result = Maker.Load();
		ExpectError(Result, {WorseShown});
		ExpectClean(Result);
	}
}

TEST(HostileGltfText, NamesThatAreLong)
{
	for (const char* Piece : {"n", "\u00E4", "\u20AC", "\U0001F600", "\x01", "\u202E"})
	{
		FGltfMaker Maker = MakeTriangle();
		std::string Name;
		while (Name.size() < 5000) { Name += Piece; }
		Maker.Json["nodes"][0]["name"] = Name;
		Maker.Json["nodes"][0]["scale"] = {1e30, 1, 1};
		const FLoadResult Result = Maker.Load();
		ExpectError(Result, {"node 0 '", "\u2026", "place or size"});
		ExpectClean(Result);
	}
}

TEST(HostileGltfText, Warnings)
{
	FGltfMaker Maker = MakeTriangle();
	Maker.Json["extensionsUsed"] = {"EXT_a", Worse, std::string(10'000, 'x') + "\u202E"};
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	ASSERT_EQ(Result.Scene->Warnings.size(), 1u);
	EXPECT_NE(Result.Scene->Warnings[0].find(WorseShown), std::string::npos) << Result.Scene->Warnings[0];
	ExpectClean(Result);
}

TEST(HostileGltfText, UrisAndPaths)
{
	const FTemporaryFolder Folder;
	for (const std::string Uri : {"%ff%1b%0a.bin", "%2e%2e/%ff%1b%0a", "/%ff%c2%85%e2%80%ae", "a:%ff", "%ff%0aerror:forged.bin"})
	{
		FGltfMaker Maker = MakeTriangle();
		Maker.Json["buffers"] = {{{"byteLength", 1}, {"uri", Uri}}};
		SCOPED_TRACE(Uri);
		for (const FLoadResult& Result : {LoadScene(Folder.Write("scene.gltf", Maker.Json.dump())), Maker.Load()})
		{
			ExpectError(Result, {"buffers[0]", "\\xff"});
			ExpectClean(Result);
		}
		Maker = MakeTriangle();
		Maker.Json["images"] = {{{"uri", Uri}}};
		Maker.Json["textures"] = {{{"source", 0}}};
		Maker.Json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
		ExpectClean(LoadScene(Folder.Write("scene.gltf", Maker.GetText())));
	}
	for (const std::string Name : {"\xff\x1b\nerror: forged.gltf", "\xff\u202E", "courtyard:\x1b[31m\xff", "furnace:\n"})
	{
		const FLoadResult Result = LoadScene(Name);
		EXPECT_FALSE(Result.Scene);
		ExpectClean(Result);
	}
	ExpectClean(LoadScene(Folder.Write("bad\xff\n.gltf", "{")));
	ExpectClean(LoadSceneFromMemory("{", 1, "\xff\n\x1b"));
}

} // namespace
} // namespace Lantern
