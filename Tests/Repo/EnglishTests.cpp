// Sentences in public headers, help texts and documents keep the rules of CONTRIBUTING.md; and tests of the checker itself.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "English.h"
#include "Prose.h"
#include "Repository.h"

namespace Lantern::Repo
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

bool IsPublicHeader(const FTextFile& File)
{
	return IsUnder(File, "Source") && HasExtension(File, {".h"}) && File.Path.find("/Public/") != std::string::npos;
}

/// Number of sentences.
size_t CheckProse(const FTextFile& File, const FProse& Prose)
{
	const std::vector<std::string> Sentences = SplitSentences(Prose.Text);
	for (const std::string& Sentence : Sentences)
	{
		const std::string Fault = FindFault(Sentence);
		EXPECT_TRUE(Fault.empty()) << At(File, Prose.Line) << ": " << Fault << ": " << Sentence;
	}
	return Sentences.size();
}

std::vector<std::string_view> SplitLines(std::string_view Text)
{
	std::vector<std::string_view> Lines;
	for (size_t End = Text.find('\n'); End != std::string_view::npos; End = Text.find('\n'))
	{
		Lines.push_back(Text.substr(0, End));
		Text.remove_prefix(End + 1);
	}
	Lines.push_back(Text);
	return Lines;
}

std::vector<std::string> GetTexts(const std::vector<FProse>& Found)
{
	std::vector<std::string> Texts;
	for (const FProse& Prose : Found) { Texts.push_back(Prose.Text); }
	return Texts;
}

std::vector<std::string> GetComments(std::string_view Text) { return GetTexts(FindComments(SplitLines(Text))); }
std::vector<std::string> GetParagraphs(std::string_view Text) { return GetTexts(FindParagraphs(SplitLines(Text))); }

TEST(English, PublicHeaders)
{
	size_t Sentences = 0;
	for (const FTextFile& File : GetFiles())
	{
		for (const FProse& Comment : IsPublicHeader(File) ? FindComments(File.Lines) : std::vector<FProse>())
		{
			Sentences += CheckProse(File, Comment);
		}
	}
	EXPECT_GT(Sentences, 500u) << "the search for comments no longer finds them";
}

TEST(English, Documents)
{
	size_t Sentences = 0;
	for (const FTextFile& File : GetFiles())
	{
		// The generated list of settings is among them: its cells are the help texts of the console variables.
		for (const FProse& Prose : IsDocument(File) ? FindParagraphs(File.Lines) : std::vector<FProse>())
		{
			Sentences += CheckProse(File, Prose);
		}
	}
	EXPECT_GT(Sentences, 300u) << "the search for sentences no longer finds them";
}

// ---- the checker itself

TEST(EnglishChecker, RefusesOpenings)
{
	for (const char* Wrong : {"Of the last frame.", "The same, in metres.", "Both are counted.", "What must be freed first.", "Of",
	         "**Of a sphere** around it.", "(The same for rays.)", "\"Both\" is refused, too."})
	{
		EXPECT_NE(FindFault(Wrong), "") << Wrong;
	}
	for (const char* Right : {"Offset from the start.", "Often zero.", "The samesize flag.", "Bothnia is a gulf.", "What musters a test.",
	         "Counters of the last frame.", "Returns both.", "the same", "", "It is the same."})
	{
		EXPECT_EQ(FindFault(Right), "") << Right;
	}
}

TEST(EnglishChecker, RefusesMoreThan25Words)
{
	std::string Sentence = "It";
	for (size_t Word = 1; Word < MaxSentenceWords; ++Word) { Sentence += " is"; }
	EXPECT_EQ(CountWords(Sentence), 25u);
	EXPECT_EQ(FindFault(Sentence), "");
	EXPECT_EQ(FindFault(Sentence + " – ≤ × …"), "") << "no words";
	EXPECT_EQ(FindFault(Sentence + " long"), "26 words");
}

TEST(EnglishChecker, CountsWords)
{
	EXPECT_EQ(CountWords(""), 0u);
	EXPECT_EQ(CountWords("– · → ≤ × ÷"), 0u);
	EXPECT_EQ(CountWords("one"), 1u);
	EXPECT_EQ(CountWords("  3 × 4 rows,\trow-major "), 4u);
	EXPECT_EQ(CountWords("temporal σ is small"), 4u) << "a Greek letter is a word";
}

TEST(EnglishChecker, SplitsSentences)
{
	EXPECT_THAT(SplitSentences(""), IsEmpty());
	EXPECT_THAT(SplitSentences("One. Two! Three? 4 ends"), ElementsAre("One.", "Two!", "Three?", "4 ends"));
	EXPECT_THAT(SplitSentences("A half is 0.5 of it. (Also here.) \"And here.\" Last."),
	    ElementsAre("A half is 0.5 of it.", "(Also here.)", "\"And here.\"", "Last."));
	EXPECT_THAT(SplitSentences("It ends here. r.RT.Shadow begins one."), ElementsAre("It ends here.", "r.RT.Shadow begins one."));
	EXPECT_THAT(SplitSentences("Sizes, e.g. Width, by Schied et al. 2017, i.e. Height."),
	    ElementsAre("Sizes, e.g. Width, by Schied et al. 2017, i.e. Height."));
	EXPECT_THAT(SplitSentences("The file a.b is small. so is this"), ElementsAre("The file a.b is small. so is this"));
}

TEST(EnglishChecker, TakesInlineCodeAsOneWordAndLinksAsTheirText)
{
	EXPECT_THAT(SplitSentences("Call `Run(A, B. C)` first. `Other` follows."), ElementsAre("Call CODE first.", "CODE follows."));
	EXPECT_THAT(SplitSentences("See [the guide](Docs/Some Guide.md) first."), ElementsAre("See [the guide] first."));
	EXPECT_EQ(CountWords(SplitSentences("`one two three`")[0]), 1u);
	EXPECT_THAT(SplitSentences("A lone ` stays"), ElementsAre("A lone ` stays"));
}

TEST(EnglishChecker, FindsComments)
{
	EXPECT_THAT(GetComments("int A;\n\nvoid F();"), IsEmpty());
	EXPECT_THAT(GetComments("// One\n// block.\n\n/// Another.\nint A;"), ElementsAre("One block.", "Another."));
	EXPECT_THAT(GetComments("// One.\n//\n// Two."), ElementsAre("One.", "Two.")) << "a blank line divides";
	EXPECT_THAT(GetComments("int A; ///< first\n       ///< of two\nint B; ///< second"), ElementsAre("first of two", "second"));
	EXPECT_THAT(GetComments("int A; // its own\n// Of the next."), ElementsAre("its own", "Of the next."));
	EXPECT_THAT(GetComments("// List:\n// - one\n//   goes on\n// - two\n// End."), ElementsAre("List:", "one goes on", "two", "End."));
	EXPECT_THAT(GetComments("// Use:\n//   F(1);\n//   F(2);\n// End."), ElementsAre("Use:", "F(1);", "F(2);", "End."));
}

TEST(EnglishChecker, FindsNoCommentsInLiterals)
{
	EXPECT_THAT(GetComments("auto A = \"no // comment\";"), IsEmpty());
	EXPECT_THAT(GetComments("auto A = \"\\\"// no\"; // yes"), ElementsAre("yes"));
	EXPECT_THAT(GetComments("char A = '\"'; // yes"), ElementsAre("yes"));
	EXPECT_THAT(GetComments("int A = 1'000; // yes"), ElementsAre("yes"));
}

TEST(EnglishChecker, FindsParagraphs)
{
	EXPECT_THAT(GetParagraphs("# Title\nOne\nparagraph.\n\nAnother."), ElementsAre("Title", "One paragraph.", "Another."));
	EXPECT_THAT(GetParagraphs("- one\n  goes on\n- two\n\n12. three"), ElementsAre("one goes on", "two", "three"));
	EXPECT_THAT(GetParagraphs("> quoted\n> text"), ElementsAre("quoted text"));
	EXPECT_THAT(GetParagraphs("Before\n```cpp\nOf code;\n```\nafter"), ElementsAre("Before", "after"));
	EXPECT_THAT(GetParagraphs("| a | `b|c` d |\n|---|---|\n| e\\|f | |"), ElementsAre("a", "`b|c` d", "---", "---", "e\\|f"));
	EXPECT_TRUE(FindParagraphs(SplitLines("| a |"))[0].bTableCell);
	EXPECT_EQ(FindParagraphs(SplitLines("One.\n\nTwo."))[1].Line, 2u);
}

} // namespace
} // namespace Lantern::Repo
