// Names that the documents quote in backticks must exist: documents rot first where nobody compiles them.
//
// Checked are paths (`Source/…`), files (`Frame.cpp`), console variables (`r.RT.…`), C++ names (`FRTStatus`,
// `IRTDevice::Submit()`), options (`--size`), CMake options (`LANTERN_…`) and subcommands (`lantern render`).
// `<…>` and `*` stand for anything. Fenced blocks are examples and not checked.
#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <unordered_set>

#include <gtest/gtest.h>

#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

struct FQuote
{
	std::string Place, Text;
};

bool IsSearched(const FTextFile& File) { return !HasExtension(File, {".md"}) && !IsUnder(File, "Tests/Repo"); }

void CollectQuotes(const FTextFile& File, std::vector<FQuote>& Quotes)
{
	bool bFenced = false;
	for (size_t Line = 0; Line < File.Lines.size(); ++Line)
	{
		std::string_view Rest = File.Lines[Line];
		if (Rest.substr(0, 3) == "```")
		{
			bFenced = !bFenced;
			continue;
		}
		for (size_t Open = Rest.find('`'); !bFenced && Open != std::string_view::npos; Open = Rest.find('`'))
		{
			const size_t Close = Rest.find('`', Open + 1);
			if (Close == std::string_view::npos) { break; }
			Quotes.push_back({At(File, Line), std::string(Rest.substr(Open + 1, Close - Open - 1))});
			Rest.remove_prefix(Close + 1);
		}
	}
}

std::vector<FQuote> GetQuotes()
{
	std::vector<FQuote> Quotes;
	for (const FTextFile& File : GetFiles())
	{
		if (IsDocument(File)) { CollectQuotes(File, Quotes); }
	}
	return Quotes;
}

/// All words of code: runs of letters, digits and underscores.
const std::unordered_set<std::string>& GetWords()
{
	static const std::unordered_set<std::string> Words = [] {
		std::unordered_set<std::string> Found;
		for (const FTextFile& File : GetFiles())
		{
			const auto IsWord = [](char C) { return std::isalnum(static_cast<unsigned char>(C)) || C == '_'; };
			for (auto It = File.Text.begin(); IsSearched(File) && It != File.Text.end();)
			{
				const auto Begin = std::find_if(It, File.Text.end(), IsWord);
				It = std::find_if_not(Begin, File.Text.end(), IsWord);
				Found.emplace(Begin, It);
			}
		}
		return Found;
	}();
	return Words;
}

bool OccursInCode(const std::string& Text)
{
	return std::any_of(GetFiles().begin(), GetFiles().end(),
	    [&](const FTextFile& File) { return IsSearched(File) && File.Text.find(Text) != std::string::npos; });
}

/// `<Pass>` and `*` become "anything".
std::regex ToPattern(std::string_view Text)
{
	std::string Pattern;
	for (size_t Index = 0; Index < Text.size(); ++Index)
	{
		if (Text[Index] == '<' || Text[Index] == '*')
		{
			Index = Text[Index] == '*' ? Index : std::min(Text.find('>', Index), Text.size());
			Pattern += "[^/]*";
			continue;
		}
		if (std::string_view(".+()[]{}^$|?\\").find(Text[Index]) != std::string_view::npos) { Pattern += '\\'; }
		Pattern += Text[Index];
	}
	return std::regex(Pattern);
}

bool PathExists(std::string Text)
{
	while (!Text.empty() && Text.back() == '/') { Text.pop_back(); }
	if (Text.find_first_of("<*") == std::string::npos) { return std::filesystem::exists(GetRoot() / Text); }
	const std::regex Pattern = ToPattern(Text);
	return std::any_of(GetFiles().begin(), GetFiles().end(),
	    [&](const FTextFile& File) { return std::regex_search(File.Path, Pattern, std::regex_constants::match_continuous); });
}

bool FileNameExists(const std::string& Name)
{
	const std::regex Pattern = ToPattern(Name);
	return std::any_of(GetFiles().begin(), GetFiles().end(),
	    [&](const FTextFile& File) { return std::regex_match(std::filesystem::path(File.Path).filename().string(), Pattern); });
}

std::string_view GetText(std::string_view Path)
{
	const auto File = std::find_if(GetFiles().begin(), GetFiles().end(), [&](const FTextFile& Other) { return Other.Path == Path; });
	return File == GetFiles().end() ? std::string_view() : File->Text;
}

bool ConsoleVariableExists(const std::string& Name)
{
	// The generated list has those whose names are made at start-up, too.
	static const std::string_view List = GetText("Docs/ConsoleVariables.md");
	return Name.find_first_of("<*") != std::string::npos || List.find("| `" + Name + "` |") != std::string_view::npos ||
	       OccursInCode(Name + "="); // an alias
}

bool AllWordsExist(const std::string& Text)
{
	static const std::regex Word("[A-Za-z_][A-Za-z0-9_]*");
	for (std::sregex_iterator It(Text.begin(), Text.end(), Word), End; It != End; ++It)
	{
		if (GetWords().count(It->str()) == 0) { return false; }
	}
	return true;
}

bool OptionExists(const std::string& Option) { return OccursInCode(Option); }

/// `lantern render --size 640x360`: the subcommand and each option.
bool CommandExists(const std::string& Command)
{
	static const std::regex Part("^lantern ([a-z]+)|(--[a-z][a-z-]+)");
	for (std::sregex_iterator It(Command.begin(), Command.end(), Part), End; It != End; ++It)
	{
		const std::string Sub = (*It)[1].str();
		if (!Sub.empty() ? !OccursInCode('"' + Sub + '"') : !OptionExists((*It)[2].str())) { return false; }
	}
	return true;
}

/// What a quote claims to be decides how it is looked up; what looks like no name at all is not checked.
bool IsTrue(const std::string& Text)
{
	static const std::regex Path("(Config|Shaders|Source|Tests|Docs|Scripts|Programs|\\.ci)/[^ ]*");
	static const std::regex FileName("[A-Za-z<*][A-Za-z0-9_<>*]*\\.(h|cpp|ini|json|md|txt|glsl|rgen|rchit|rahit|rmiss|comp|vert|frag)");
	static const std::regex Variable("r\\.[A-Za-z<*][A-Za-z0-9.<>*]*");
	static const std::regex OurType("[FIET]RT[A-Z<][A-Za-z0-9_:<>]*(\\(\\))?");
	static const std::regex Name("[A-Z][a-z0-9]+([A-Z][A-Za-z0-9]*)+(::[A-Za-z0-9]+)*(\\(\\))?|F[A-Z][a-z][A-Za-z0-9:]*(\\(\\))?");
	static const std::regex Option("--[a-z][a-z-]+( [A-Za-z,.0-9|]+)?");
	static const std::regex CMakeName("LANTERN_[A-Z0-9_]+(=[A-Z]+)?");
	static const std::regex Command("lantern [a-z]+.*");
	static const std::regex Vulkan("V[Kk].*");

	if (std::regex_match(Text, Vulkan)) { return true; }
	if (std::regex_match(Text, Path)) { return PathExists(Text); }
	if (std::regex_match(Text, FileName))
	{
		return FileNameExists(Text) || OccursInCode('"' + Text + '"'); // or one that the program writes
	}
	if (std::regex_match(Text, Variable)) { return ConsoleVariableExists(Text); }
	if (std::regex_match(Text, Option)) { return OptionExists(Text.substr(0, Text.find(' '))); }
	if (std::regex_match(Text, CMakeName)) { return AllWordsExist(Text.substr(0, Text.find('='))); }
	if (std::regex_match(Text, Command)) { return CommandExists(Text); }
	if (std::regex_match(Text, OurType) && Text.find('<') != std::string::npos) { return true; }
	if (std::regex_match(Text, OurType) || std::regex_match(Text, Name)) { return AllWordsExist(Text); }
	return true;
}

TEST(Documents, QuotedNamesExist)
{
	const std::vector<FQuote> Quotes = GetQuotes();
	EXPECT_GT(Quotes.size(), 20u) << "the search for quotes no longer finds them";
	for (const FQuote& Quote : Quotes)
	{
		EXPECT_TRUE(IsTrue(Quote.Text)) << Quote.Place << ": nothing in the tree is called `" << Quote.Text << "`";
	}
}

// The check itself: each kind of name, once there and once not.
TEST(Documents, TheCheckTellsTrueFromFalse)
{
	for (const char* There : {"Scripts/Setup", "Source/LanternRHI/", "Source/<Module>/CMakeLists.txt", "RTTypes.h", "IRTDevice::Submit()",
	         "FRTStatus", "GetDeviceAddress()", "LANTERN_WITH_OIIO=OFF", "VkDevice", "r.RT.<Pass>.<Knob>", "two words"})
	{
		EXPECT_TRUE(IsTrue(There)) << There;
	}
	for (const char* Missing :
	    {"Scripts/Nothing", "Source/<Module>/Nothing.h", "NoSuchFile.cpp", "IRTDevice::NoSuchCall()", "FRTNoSuchThing", "GetNoSuchThing()",
	        "LANTERN_NO_SUCH_OPTION", "r.RT.No.SuchKnob", "--no-such-option", "lantern nosuchcommand"})
	{
		EXPECT_FALSE(IsTrue(Missing)) << Missing;
	}
}

// A link to a file of the repository leads somewhere.
TEST(Documents, LinksLeadSomewhere)
{
	static const std::regex Link("\\]\\(([^)#:]+)(#[^)]*)?\\)");
	for (const FTextFile& File : GetFiles())
	{
		const auto Folder = (GetRoot() / File.Path).parent_path();
		for (std::sregex_iterator It(File.Text.begin(), File.Text.end(), Link), End; IsDocument(File) && It != End; ++It)
		{
			EXPECT_TRUE(std::filesystem::exists(Folder / (*It)[1].str())) << File.Path << ": " << (*It)[1];
		}
	}
}

} // namespace
} // namespace Lantern::Repo
