// The README's example is code that is compiled and run: the marked lines of Programs/Minimal/Main.cpp.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

using FLines = std::vector<std::string_view>;

constexpr const char* Example = "Programs/Minimal/Main.cpp";

std::string_view TrimLeft(std::string_view Line) { return Line.substr(std::min(Line.find_first_not_of(" \t"), Line.size())); }

/// The lines between the first line that is Begin and the next that is End, without indentation. Empty if either is missing.
FLines GetLinesBetween(const FLines& Lines, std::string_view Begin, std::string_view End)
{
	const auto IsLine = [](std::string_view Mark) { return [Mark](std::string_view Line) { return TrimLeft(Line) == Mark; }; };
	const auto First = std::find_if(Lines.begin(), Lines.end(), IsLine(Begin));
	if (First == Lines.end()) { return {}; }
	const auto Last = std::find_if(First + 1, Lines.end(), IsLine(End));
	if (Last == Lines.end()) { return {}; }
	FLines Between;
	std::transform(First + 1, Last, std::back_inserter(Between), TrimLeft);
	return Between;
}

FLines GetLinesOf(std::string_view Path)
{
	const auto File = std::find_if(GetFiles().begin(), GetFiles().end(), [&](const FTextFile& Other) { return Other.Path == Path; });
	return File == GetFiles().end() ? FLines() : File->Lines;
}

TEST(Readme, QuotesTheMinimalProgram)
{
	const FLines Code = GetLinesBetween(GetLinesOf(Example), "// README begin", "// README end");
	const FLines Quote = GetLinesBetween(GetLinesOf("README.md"), "```cpp", "```");
	EXPECT_FALSE(Code.empty()) << Example << " has no lines between // README begin and // README end";
	EXPECT_EQ(Quote, Code) << "copy the marked lines of " << Example << " to the README's block of C++";
}

TEST(Readme, FindsLinesBetweenMarks)
{
	EXPECT_THAT(GetLinesBetween({"a", "\tbegin", "  b", "", "\t\tc", "end", "d", "end"}, "begin", "end"), ElementsAre("b", "", "c"));
	EXPECT_THAT(GetLinesBetween({"begin", "a"}, "begin", "end"), IsEmpty());
	EXPECT_THAT(GetLinesBetween({"a", "end"}, "begin", "end"), IsEmpty());
	EXPECT_THAT(GetLinesBetween({"begin here", "a", "end"}, "begin", "end"), IsEmpty()) << "a mark is a whole line";
}

} // namespace
} // namespace Lantern::Repo
