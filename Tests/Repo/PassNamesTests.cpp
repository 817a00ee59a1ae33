// A pass is named in its own rooms, in the registry of signals and in Frame.cpp, and nowhere else in the plugin's sources and
// shaders: whoever adds one need not look for lists to put it into.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "LanternSignals/Signals.h"
#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

/// Places that name a signal because they are about that one, not because they list all.
constexpr const char* Exempt[] = {
    "Source/LanternSignals/Public/LanternSignals/Signals.h", // the registry
    "Source/LanternRenderer/Private/SignalPasses.cpp",       // its private half
    "Source/LanternRenderer/Private/Frame.cpp",              // the frame
    "Source/LanternMeasure/Private/Stability/",              // a case of `lantern stability` may be about one signal
    "Source/LanternModule/Public/LanternModule/Module.h",    // what an engine gets if it asks for nothing else
};

bool IsExempt(const std::string& Path)
{
	for (const char* Place : Exempt)
	{
		if (Path.rfind(Place, 0) == 0) { return true; }
	}
	return false;
}

/// A pass's own rooms: folders of its name, and the header that its shaders share with C++.
bool IsOwnRoom(const std::string& Path, const std::string& Pass)
{
	return Path.find("/" + Pass + "/") != std::string::npos || Path == "Shaders/Shared/" + Pass + "Types.h";
}

std::string WithoutComment(std::string_view Line) { return std::string(Line.substr(0, Line.find("//"))); }

/// Lines of a file that name a pass which has its rooms elsewhere.
std::vector<std::string> FindForeignNames(const std::string& Path, const std::vector<std::string_view>& Lines)
{
	std::vector<std::string> Found;
	for (const FSignalInfo& Info : SignalInfos)
	{
		const std::string Pass = Info.Pass;
		if (Pass.empty() || IsExempt(Path) || IsOwnRoom(Path, Pass)) { continue; }
		for (size_t Line = 0; Line < Lines.size(); ++Line)
		{
			if (WithoutComment(Lines[Line]).find(Pass) == std::string::npos) { continue; }
			Found.push_back(Path + ":" + std::to_string(Line + 1) + ": names " + Pass);
		}
	}
	return Found;
}

TEST(PassNames, StandInTheRegistryAndTheirOwnRoomsOnly)
{
	size_t Seen = 0;
	for (const FTextFile& File : GetFiles())
	{
		if (!IsUnder(File, "Source") && !IsUnder(File, "Shaders")) { continue; }
		++Seen;
		for (const std::string& Place : FindForeignNames(File.Path, File.Lines)) { ADD_FAILURE() << Place; }
	}
	EXPECT_GT(Seen, 100u) << "the search for sources no longer finds them";
}

// The check itself.
TEST(PassNames, TheCheckTellsRoomsFromLists)
{
	const std::vector<std::string_view> Names = {"if (bSunShadow) {", "// SunShadow in a comment"};
	EXPECT_EQ(FindForeignNames("Source/LanternHost/Private/New.cpp", Names).size(), 1u);
	EXPECT_EQ(FindForeignNames("Shaders/Lighting/New.glsl", {"#include \"../SunShadow/SunShadow.glsl\""}).size(), 1u);
	EXPECT_EQ(FindForeignNames("Source/LanternRenderer/Private/AmbientOcclusion/AmbientOcclusion.cpp", Names).size(), 1u);
	EXPECT_TRUE(FindForeignNames("Source/LanternRenderer/Private/SunShadow/SunShadow.cpp", Names).empty());
	EXPECT_TRUE(FindForeignNames("Source/LanternRenderer/Private/Frame.cpp", Names).empty());
	EXPECT_TRUE(FindForeignNames("Source/LanternHost/Private/New.cpp", {"int Reflected = 0; // Reflections"}).empty());
}

} // namespace
} // namespace Lantern::Repo
