#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Config/IniFile.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::vector<std::string> Resolve(const FIniFile& File, std::string_view Section)
{
	FIniResolver Resolver;
	if (const FIniSection* Found = File.FindSection(Section)) Resolver.Apply(File, *Found);
	std::vector<std::string> Result;
	for (const FIniValue& Value : Resolver.GetValues()) Result.push_back(Value.Key + "=" + Value.Value);
	return Result;
}

std::vector<std::string> ResolveText(std::string_view Text)
{
	const FIniFile File = FIniFile::Parse(Text, "T.ini");
	EXPECT_THAT(File.GetProblems(), IsEmpty());
	return Resolve(File, "S");
}

TEST(IniFile, KeysAndValuesAreTrimmedAndKeepTheirPlace)
{
	const FIniFile File = FIniFile::Parse("\n; note\n[ S ]\n  Key = some value \t\nOther=\n", "T.ini");
	ASSERT_THAT(File.GetProblems(), IsEmpty());
	const FIniSection* Section = File.FindSection("s");
	ASSERT_NE(Section, nullptr);
	EXPECT_EQ(Section->Name, "S");
	EXPECT_EQ(Section->Line, 3u);
	ASSERT_EQ(Section->Entries.size(), 2u);
	EXPECT_EQ(Section->Entries[0].Key, "Key");
	EXPECT_EQ(Section->Entries[0].Value, "some value");
	EXPECT_EQ(Section->Entries[0].Line, 4u);
	EXPECT_EQ(Section->Entries[1].Value, "");
	EXPECT_EQ(File.GetWhere(4), "T.ini:4");
}

TEST(IniFile, OperationsFollowUE)
{
	EXPECT_THAT(ResolveText("[S]\nA=1\na=2\n"), ElementsAre("a=2"));
	EXPECT_THAT(ResolveText("[S]\n+A=1\n+A=2\n+A=1\n"), ElementsAre("A=1", "A=2"));
	EXPECT_THAT(ResolveText("[S]\n.A=1\n.A=1\n"), ElementsAre("A=1", "A=1"));
	EXPECT_THAT(ResolveText("[S]\n+A=1\n+A=2\n-A=1\n"), ElementsAre("A=2"));
	EXPECT_THAT(ResolveText("[S]\n.A=1\n.A=1\n-a=1\n"), IsEmpty());
	EXPECT_THAT(ResolveText("[S]\n+A=1\n-A=9\n"), ElementsAre("A=1"));
	EXPECT_THAT(ResolveText("[S]\n+A=1\n+A=2\n!A\n+A=3\n"), ElementsAre("A=3"));
	EXPECT_THAT(ResolveText("[S]\n+A=1\n!A=ClearArray\n"), IsEmpty());
	EXPECT_THAT(ResolveText("[S]\n+A=1\n+B=2\n-A\n"), ElementsAre("B=2"));
	EXPECT_THAT(ResolveText("[S]\n+A=1\n+A=2\nA=3\n"), ElementsAre("A=3"));
	EXPECT_THAT(ResolveText("[S]\n+A=1\n-A=1\n+A=1\n"), ElementsAre("A=1")) << "removed, so it may be added again";
	EXPECT_THAT(ResolveText("[S]\n+A=x\n+A=X\n"), ElementsAre("A=x", "A=X")) << "values keep their case";
}

TEST(IniFile, SectionsMayBeContinued) { EXPECT_THAT(ResolveText("[S]\nA=1\n[Other]\nA=5\n[s]\nB=2\n"), ElementsAre("A=1", "B=2")); }

TEST(IniFile, ADerivedSectionWorksOnItsBase)
{
	const FIniFile File = FIniFile::Parse("[Base]\n+V=a\n+V=b\nK=1\n[Derived]\n-V=a\n+V=c\nK=2\n", "T.ini");
	FIniResolver Resolver;
	Resolver.Apply(File, *File.FindSection("Base"));
	Resolver.Apply(File, *File.FindSection("Derived"));
	std::vector<std::string> Values;
	for (const FIniValue& Value : Resolver.GetValues()) Values.push_back(Value.Value + "@" + Value.Where);
	EXPECT_THAT(Values, ElementsAre("b@T.ini:3", "c@T.ini:7", "2@T.ini:8"));
}

TEST(IniFile, CommentsAndQuotes)
{
	EXPECT_THAT(ResolveText("[S] ; the section\nA=4 ; four\nB=x;y\nC=;empty\n ;C=3\n"), ElementsAre("A=4", "B=x;y", "C="));
	EXPECT_THAT(ResolveText("[S]\nA=\" a ; b \" ; note\nB=\"\"\nC=\"say \\\"x\\\" \\\\ \\n\"\nD=\"C:\\dir\"\nE=a\"b\"\n"),
	    ElementsAre("A= a ; b ", "B=", "C=say \"x\" \\ \n", "D=C:\\dir", "E=a\"b\""));
	EXPECT_THAT(ResolveText("[S]\n+CVars=r.X=1\n"), ElementsAre("CVars=r.X=1")) << "the first '=' divides";
}

TEST(IniFile, LineEndsAndByteOrderMark)
{
	EXPECT_THAT(ResolveText("\xEF\xBB\xBF[S]\r\nA=1\r\nB=2\r\n"), ElementsAre("A=1", "B=2"));
	EXPECT_THAT(ResolveText("[S]\rA=1\rB=2"), ElementsAre("A=1", "B=2"));
	EXPECT_THAT(ResolveText("[S]\nA=1"), ElementsAre("A=1"));
	const FIniFile Crlf = FIniFile::Parse("[S]\r\n\r\noops\r\n", "T.ini");
	EXPECT_THAT(Crlf.GetProblems(), ElementsAre(StartsWith("T.ini:3: ")));
	EXPECT_THAT(FIniFile::Parse("", "T.ini").GetProblems(), IsEmpty());
}

TEST(IniFile, Utf16IsNamed)
{
	const FIniFile File = FIniFile::Parse(std::string_view("\xFF\xFE[\0S\0]\0", 8), "T.ini");
	EXPECT_THAT(File.GetProblems(), ElementsAre("T.ini: UTF-16; save it as UTF-8"));
	EXPECT_THAT(File.GetSections(), IsEmpty());
}

struct FBadLine
{
	const char *Line, *Reason;
};

TEST(IniFile, EachBadLineIsNamedAndTheRestApplies)
{
	const FBadLine Cases[] = {
	    {"no assignment", "is neither Key=Value nor [Section]"},
	    {"+Key", "is neither Key=Value nor [Section]"},
	    {"=value", "no key"},
	    {"+=value", "no key"},
	    {"-", "no key"},
	    {"!", "no key"},
	    {"K=\"open", "no closing quotation mark"},
	    {"K=\"a\" b", "text after the closing quotation mark"},
	    {"K=\"a\\\"", "no closing quotation mark"},
	    {"K=\x01", "control character"},
	    {"# not UE", "is neither Key=Value nor [Section]"},
	};
	for (const FBadLine& Case : Cases)
	{
		const FIniFile File = FIniFile::Parse(std::string("[S]\nA=1\n") + Case.Line + "\nB=2\n", "T.ini");
		ASSERT_EQ(File.GetProblems().size(), 1u) << Case.Line;
		EXPECT_THAT(File.GetProblems()[0], StartsWith("T.ini:3: "));
		EXPECT_THAT(File.GetProblems()[0], HasSubstr(Case.Reason));
		EXPECT_THAT(Resolve(File, "S"), ElementsAre("A=1", "B=2")) << Case.Line;
	}
}

TEST(IniFile, WhatFollowsABrokenHeaderLandsNowhere)
{
	for (const char* Header : {"[Broken", "[]", "[ ]", "[T] tail"})
	{
		const FIniFile File = FIniFile::Parse(std::string("[S]\nA=1\n") + Header + "\nB=2\nrubbish\n[S]\nC=3\n", "T.ini");
		ASSERT_EQ(File.GetProblems().size(), 1u) << Header;
		EXPECT_THAT(File.GetProblems()[0], StartsWith("T.ini:3: "));
		EXPECT_THAT(Resolve(File, "S"), ElementsAre("A=1", "C=3"));
		EXPECT_EQ(File.GetSections().size(), 1u);
	}
}

TEST(IniFile, EntriesBeforeAnySectionAreProblems)
{
	const FIniFile File = FIniFile::Parse("A=1\n[S]\nB=2\n", "T.ini");
	EXPECT_THAT(File.GetProblems(), ElementsAre("T.ini:1: 'A=1' stands before any [Section]"));
	EXPECT_THAT(Resolve(File, "S"), ElementsAre("B=2"));
}

TEST(IniFile, NulBytesSpoilTheirLineOnly)
{
	const FIniFile File = FIniFile::Parse(std::string_view("[S]\nA=1\0x\nB\0=2\nC=3\n", 19), "T.ini");
	EXPECT_THAT(File.GetProblems(), ElementsAre("T.ini:2: control character in 'A=1\\x00x'", "T.ini:3: control character in 'B\\x00=2'"));
	EXPECT_THAT(Resolve(File, "S"), ElementsAre("C=3"));
}

TEST(IniFile, ALineOfTenMegabytesIsOneShortProblem)
{
	const FIniFile File = FIniFile::Parse("[S]\nA=" + std::string(10'000'000, 'x') + "\nB=2\n", "T.ini");
	ASSERT_EQ(File.GetProblems().size(), 1u);
	EXPECT_THAT(File.GetProblems()[0], StartsWith("T.ini:2: a line of 10000002 bytes"));
	EXPECT_LT(File.GetProblems()[0].size(), 200u);
	EXPECT_THAT(Resolve(File, "S"), ElementsAre("B=2"));
}

TEST(IniFile, AFloodOfProblemsIsCounted)
{
	std::string Text = "[S]\n";
	for (int I = 0; I < 5000; ++I) Text += "bad\n";
	const FIniFile File = FIniFile::Parse(Text + "A=1\n", "T.ini");
	ASSERT_EQ(File.GetProblems().size(), 101u);
	EXPECT_EQ(File.GetProblems().back(), "T.ini: 4900 more problems are not listed");
	EXPECT_THAT(Resolve(File, "S"), ElementsAre("A=1"));
}

TEST(IniFile, CostStaysBoundedForAHostileFile)
{
	// Unique adds to one key are quadratic if done naively: what bounds them is the number of entries.
	std::string Text = "[S]\n";
	for (int I = 0; I < 200'000; ++I) Text += "+A=" + std::to_string(I) + "\n";
	const FIniFile File = FIniFile::Parse(Text, "T.ini");
	EXPECT_EQ(Resolve(File, "S").size(), 9'999u); // the header counts as one
	EXPECT_THAT(File.GetProblems(), ElementsAre("T.ini:10001: more than 10000 entries; the rest is ignored"));
	EXPECT_THAT(FIniFile::Parse(std::string(17 << 20, '\n'), "T.ini").GetProblems(), ElementsAre("T.ini: larger than 16 MiB"));
}

TEST(IniFile, FilesThatAreNone)
{
	const FTemporaryFolder Folder;
	EXPECT_THAT(FIniFile::Load(Folder.GetPath() + "/none.ini").GetProblems(), ElementsAre(Folder.GetPath() + "/none.ini: no such file"));
	EXPECT_THAT(FIniFile::Load(Folder.GetPath()).GetProblems(), ElementsAre(HasSubstr("is a folder, not a file")));
	EXPECT_THAT(FIniFile::Load("/dev/zero").GetProblems(), ElementsAre("/dev/zero: is not a regular file"));
	EXPECT_THAT(FIniFile::Load("").GetProblems(), ElementsAre(HasSubstr("no such file")));
	EXPECT_THAT(FIniFile::Load(std::string(10'000, 'x')).GetProblems(), testing::SizeIs(1));
	const std::string Path = Folder.Write("good.ini", "[S]\nA=1");
	EXPECT_THAT(Resolve(FIniFile::Load(Path), "S"), ElementsAre("A=1"));
	EXPECT_THAT(FIniFile::Load(Folder.Write("empty.ini", "")).GetProblems(), IsEmpty());
	EXPECT_THAT(
	    FIniFile::Load(Folder.Write("big.ini", std::string(17 << 20, ' '))).GetProblems(), ElementsAre(HasSubstr("larger than 16 MiB")));
}

} // namespace
} // namespace Lantern
