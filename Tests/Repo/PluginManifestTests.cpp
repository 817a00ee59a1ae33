// Plugin.json tells an engine what to load; it must agree with the code.
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "LanternRHI/RTTypes.h"
#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

nlohmann::json ReadManifest()
{
	std::ifstream Stream(GetRoot() / "Plugin.json");
	return nlohmann::json::parse(Stream, nullptr, false);
}

std::string ReadProjectVersion()
{
	std::ifstream Stream(GetRoot() / "CMakeLists.txt");
	const std::string Text(std::istreambuf_iterator<char>(Stream), {});
	std::smatch Match;
	return std::regex_search(Text, Match, std::regex("project\\(Lantern VERSION ([0-9.]+)")) ? Match[1].str() : "";
}

TEST(PluginManifest, AgreesWithTheCode)
{
	const nlohmann::json Manifest = ReadManifest();
	ASSERT_TRUE(Manifest.is_object());
	EXPECT_EQ(Manifest.value("version", ""), ReadProjectVersion());
	EXPECT_EQ(Manifest.value("rhiVersion", 0u), RHIVersion);
	EXPECT_EQ(Manifest.value("entryPoint", ""), "LanternCreateModule");
	EXPECT_FALSE(Manifest.value("library", "").empty());
}

TEST(PluginManifest, FoldersExist)
{
	const nlohmann::json Manifest = ReadManifest();
	for (const char* Key : {"configFolder", "shaderFolder"})
	{
		EXPECT_TRUE(std::filesystem::is_directory(GetRoot() / Manifest.value(Key, "missing"))) << Key;
	}
}

} // namespace
} // namespace Lantern::Repo
