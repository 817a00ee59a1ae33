// Engines and ports that were compiled with the public headers go on working until a version says otherwise. The folder Recorded
// has what the compiler makes of the headers of the version that each file names. LANTERN_RECORD_ABI=1 writes them anew.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternModule/Module.h"
#include "Layouts.h"

namespace Lantern::Abi
{
namespace
{

using testing::HasSubstr;

std::string ReadFile(const std::string& File)
{
	std::ifstream Stream(File);
	return {std::istreambuf_iterator<char>(Stream), {}};
}

std::string Join(const std::vector<std::string>& Blocks)
{
	std::string Text;
	for (const std::string& Block : Blocks) { Text += Block; }
	return Text;
}

/// The lines of the changelog's section of what is not released yet.
std::string GetUnreleased()
{
	const std::string Text = ReadFile(LANTERN_SOURCE_DIR "/CHANGELOG.md");
	const size_t Begin = Text.find("## [Unreleased]");
	return Begin == std::string::npos ? std::string() : Text.substr(Begin, Text.find("\n## [", Begin + 1) - Begin);
}

/// Versions have a number, and headers that they speak for.
struct FVersioned
{
	const char* Name;
	uint32_t Number;
	const char* Object;
	const char* Known; ///< part of its description, to see that there is one
};

class FAbiTest : public testing::TestWithParam<FVersioned>
{};

TEST_P(FAbiTest, ChangesOnlyWithTheVersion)
{
	const FVersioned& Version = GetParam();
	const std::string Title = std::string(Version.Name) + " version " + std::to_string(Version.Number);
	const std::string File = std::string(LANTERN_SOURCE_DIR "/Tests/Abi/Recorded/") + Version.Name + ".txt";
	const std::string Now = Title + "\n" + Join(DescribeObject(Version.Object, "Lantern"));
	ASSERT_THAT(Now, HasSubstr(Version.Known)) << "readelf or the debug information is missing";
	if (std::getenv("LANTERN_RECORD_ABI") != nullptr) { std::ofstream(File) << Now; }
	const std::string Recorded = ReadFile(File);
	ASSERT_EQ(Recorded.rfind(std::string(Version.Name) + " version ", 0), 0u) << File;
	if (Recorded.rfind(Title + "\n", 0) == 0)
	{
		EXPECT_EQ(Now, Recorded) << "what engines were compiled with has changed: raise the version";
	}
	else
	{
		// A raised version may change until its release.
		EXPECT_THAT(GetUnreleased(), HasSubstr(Title)) << "the changelog must name it, or its layout be recorded: LANTERN_RECORD_ABI=1";
	}
}

INSTANTIATE_TEST_SUITE_P(Headers, FAbiTest,
    testing::Values(FVersioned{"Module", ModuleVersion, LANTERN_ABI_MODULE, "::RenderFrame(Lantern::FRTModuleFrame const&, "},
        FVersioned{"RHI", RHIVersion, LANTERN_ABI_RHI, "struct FRTTextureDesc"}),
    [](const auto& Info) { return Info.param.Name; });

TEST(Abi, EveryPlantedChangeIsSeen)
{
	const auto Describe = [](const char* Namespace) {
		std::string Text = Join(DescribeObject(LANTERN_ABI_PLANTED, Namespace));
		for (size_t At = 0; (At = Text.find(Namespace)) != std::string::npos;) { Text.erase(At, std::string(Namespace).size()); }
		return Text;
	};
	const std::string Original = Describe("Original");
	EXPECT_EQ(Original, "enum EKind, 1 bytes\n  One = 0\n  Two = 1\n"
	                    "struct FDesc, 8 bytes\n  0: float32 Width\n  4: unsigned32 Count\n"
	                    "struct IThing, 8 bytes\n  virtual 0: ::IThing::Add(::FDesc const&) -> signed32\n"
	                    "  virtual 1: ::IThing::Remove(::EKind) -> void\n");
	EXPECT_EQ(Describe("Equal"), Original);
	for (const char* Changed : {"MemberAdded", "MembersSwapped", "MemberRetyped", "ArrayLonger", "CallAdded", "CallsSwapped",
	         "ParameterRetyped", "ResultRetyped", "ValuesSwapped", "EnumWider"})
	{
		EXPECT_NE(Describe(Changed), Original) << Changed;
		EXPECT_NE(Describe(Changed), "") << Changed;
	}
}

} // namespace
} // namespace Lantern::Abi
