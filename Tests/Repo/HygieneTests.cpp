// Sizes, and words that must not be published.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

constexpr size_t MaxFileLines = 500;
constexpr size_t LongFunctionLines = 60; ///< reported
constexpr size_t MaxFunctionLines = 100; ///< refused

bool IsCode(const FTextFile& File) { return IsCpp(File) || (IsUnder(File, "Shaders") && File.Path.find(".md") == std::string::npos); }

bool OpensFunction(std::string_view LineBefore)
{
	for (const char* Word : {"namespace", "struct", "class", "enum", "union", "extern", "template"})
	{
		if (LineBefore.starts_with(Word) && LineBefore.find('(') == std::string_view::npos) { return false; }
	}
	return !LineBefore.empty() && LineBefore.find('=') == std::string_view::npos;
}

struct FFunction
{
	std::string Place;
	size_t LineCount = 0;
};

/// Bodies whose braces stand in the first column, as .clang-format puts those of functions outside classes.
std::vector<FFunction> FindFunctions(const FTextFile& File)
{
	std::vector<FFunction> Functions;
	size_t Begin = 0;
	bool bInside = false;
	for (size_t Line = 1; Line < File.Lines.size(); ++Line)
	{
		if (File.Lines[Line] == "{" && OpensFunction(File.Lines[Line - 1]))
		{
			Begin = Line;
			bInside = true;
		}
		else if (bInside && File.Lines[Line].starts_with("}"))
		{
			Functions.push_back({At(File, Begin), Line - Begin - 1});
			bInside = false;
		}
	}
	return Functions;
}

TEST(Hygiene, FilesStayShort)
{
	for (const FTextFile& File : GetFiles())
	{
		if (IsCode(File)) { EXPECT_LE(File.Lines.size(), MaxFileLines) << File.Path << ": one idea per file; split it"; }
	}
}

TEST(Hygiene, SourceFilesOpenWithWhatLivesThere)
{
	size_t Seen = 0;
	for (const FTextFile& File : GetFiles())
	{
		const bool bChecked = HasExtension(File, {".cpp"}) && (IsUnder(File, "Source") || IsUnder(File, "Programs"));
		if (!bChecked) { continue; }
		++Seen;
		// One word would only repeat the file's name.
		const std::string_view First = File.Lines.empty() ? std::string_view() : File.Lines[0];
		const bool bComment = First.starts_with("// ") && First.find(' ', 3) != std::string_view::npos;
		EXPECT_TRUE(bComment) << File.Path << ": the first line must be a comment that says what lives in the file";
	}
	EXPECT_GT(Seen, 100u) << "found no files to check";
}

/// Tests include each other's headers in any order, and one name must then be one check.
TEST(Hygiene, AMacroOfTestHeadersIsDefinedOnce)
{
	std::map<std::string_view, std::string> Places;
	for (const FTextFile& File : GetFiles())
	{
		if (!IsUnder(File, "Tests") || !HasExtension(File, {".h"})) { continue; }
		for (size_t Line = 0; Line < File.Lines.size(); ++Line)
		{
			constexpr std::string_view Define = "#define ";
			if (!File.Lines[Line].starts_with(Define)) { continue; }
			const std::string_view Rest = File.Lines[Line].substr(Define.size());
			const auto [Known, bNew] = Places.emplace(Rest.substr(0, Rest.find_first_of(" (")), At(File, Line));
			EXPECT_TRUE(bNew) << At(File, Line) << ": " << Known->first << " is defined at " << Known->second;
		}
	}
	EXPECT_GT(Places.size(), 3u) << "found no macros to check";
}

TEST(Hygiene, FunctionsStayShort)
{
	size_t Seen = 0;
	for (const FTextFile& File : GetFiles())
	{
		for (const FFunction& Function : IsCode(File) ? FindFunctions(File) : std::vector<FFunction>())
		{
			++Seen;
			EXPECT_LE(Function.LineCount, MaxFunctionLines) << Function.Place;
			if (Function.LineCount > LongFunctionLines)
			{
				std::printf("long: %s, %zu lines\n", Function.Place.c_str(), Function.LineCount);
			}
		}
	}
	EXPECT_GT(Seen, 50u) << "the search for functions no longer finds them";
}

TEST(Hygiene, NoPathsOrHostsOfOneMachine)
{
	// Written in two parts so that this file does not find itself.
	const std::vector<std::string> Forbidden = {std::string("/wo") + "rk/", std::string("/ro") + "ot/", std::string("/ho") + "me/",
	    std::string("/var/") + "tmp", std::string("debian") + ".org", std::string("ubuntu") + ".com", std::string("snapshot.") + "deb"};
	for (const FTextFile& File : GetFiles())
	{
		for (const std::string& Word : Forbidden)
		{
			for (size_t Line = 0; File.Text.find(Word) != std::string::npos && Line < File.Lines.size(); ++Line)
			{
				EXPECT_EQ(File.Lines[Line].find(Word), std::string_view::npos) << At(File, Line) << ": " << Word;
			}
		}
	}
}

// A test that was renamed would run in time again, and its old name would stay.
TEST(Hygiene, LongTestsExist)
{
	const auto List = std::ranges::find(GetFiles(), "Tests/LongTests.txt", &FTextFile::Path);
	ASSERT_NE(List, GetFiles().end());
	for (size_t I = 0; I < List->Lines.size(); ++I)
	{
		const std::string_view Name = List->Lines[I];
		const size_t Dot = Name.find('.');
		if (Name.starts_with('#') || Dot == std::string_view::npos) { continue; }
		const std::string Definition = "(" + std::string(Name.substr(0, Dot)) + ", " + std::string(Name.substr(Dot + 1)) + ")";
		const bool bFound = std::ranges::any_of(GetFiles(), [&](const FTextFile& File) {
			return IsUnder(File, "Tests") && File.Text.find("\nTEST") != std::string::npos &&
			       File.Text.find(Definition) != std::string::npos;
		});
		EXPECT_TRUE(bFound) << At(*List, I);
	}
}

TEST(Hygiene, TextFilesEndWithOneNewlineAndNoCarriageReturns)
{
	for (const FTextFile& File : GetFiles())
	{
		if (!IsCode(File) || File.Text.empty()) { continue; }
		EXPECT_EQ(File.Text.back(), '\n') << File.Path;
		EXPECT_EQ(File.Text.find('\r'), std::string::npos) << File.Path;
	}
}

} // namespace
} // namespace Lantern::Repo
