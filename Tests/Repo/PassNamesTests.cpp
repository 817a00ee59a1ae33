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
    "Source/LanternSignals/Public/LanternSignals/Signals.h",   // the registry
    "Source/LanternRenderer/Private/SignalPasses.cpp",         // its private half
    "Source/LanternRenderer/Private/Frame.cpp",                // the frame
    "Source/LanternRenderer/Private/LocalLights/",             // one pass makes two signals
    "Source/LanternRenderer/Private/DiffuseGI/",               // so do its paths, where other rays leave them room
    "Source/LanternMeasure/Private/Stability/",                // a case of `lantern stability` may be about one signal
    "Source/LanternModule/Public/LanternModule/ModuleFrame.h", // what an engine gets if it asks for nothing else
    "Programs/lantern/Bench/",                                 // a benchmark is about one pass
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

bool IsLetter(char C, char First, char Last) { return C >= First && C <= Last; }

/// Whether a line names a pass: as an identifier or a part of one (AddSunShadowPass), or as the signal's name in quotes.
/// "Reflectionsless" is another word.
bool Names(const std::string& Line, const FSignalInfo& Info)
{
	if (Line.find('"' + std::string(Info.Name) + '"') != std::string::npos) { return true; }
	const std::string Pass = Info.Pass;
	for (size_t At = Line.find(Pass); At != std::string::npos; At = Line.find(Pass, At + 1))
	{
		const size_t End = At + Pass.size();
		if (End == Line.size() || !IsLetter(Line[End], 'a', 'z')) { return true; }
	}
	return false;
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
			if (!Names(WithoutComment(Lines[Line]), Info)) { continue; }
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
		if (!IsUnder(File, "Source") && !IsUnder(File, "Shaders") && !IsUnder(File, "Programs/lantern")) { continue; }
		if (File.Path == "Programs/lantern/CMakeLists.txt") { continue; } // tests of single methods
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
	EXPECT_TRUE(FindForeignNames("Source/LanternHost/Private/New.cpp", {"bool bReflectionsless = false;"}).empty());
	EXPECT_EQ(FindForeignNames("Programs/lantern/Main.cpp", {"return Name == \"sun_shadow\";"}).size(), 1u);
}

} // namespace
} // namespace Lantern::Repo
