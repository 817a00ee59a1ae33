// Files, arguments and settings that are broken or mean harm: whatever they hold, a terminal gets lines that can be
// shown, and as many of them as the program wrote.
#include "ProgramTools.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Steers a terminal, is no UTF-8, turns the direction of writing, and claims to be a line of the program.
const std::string Worse = "\x1b[31m\xff\u202E\u0085\nerror: forged";
constexpr const char* WorseShown = "\\x1b[31m\\xff\\u{202e}\\u{0085}\\nerror: forged";

/// Runs it; what it says can be shown, and nothing that it quotes has become a line.
FProgramRun RunClean(const std::vector<std::string>& Arguments, const FProgramOptions& Options = {})
{
	FProgramRun Run = RunProgram(Arguments, Options);
	EXPECT_TRUE(AreCleanLines(Run.Err)) << ::testing::PrintToString(Run.Err);
	EXPECT_TRUE(AreCleanLines(Run.Out)) << ::testing::PrintToString(Run.Out);
	EXPECT_EQ(("\n" + Run.Err).find("\nerror: forged"), std::string::npos) << ::testing::PrintToString(Run.Err);
	EXPECT_LT(Run.Status, 128);
	return Run;
}

TEST(MessageTest, FilesOfBrokenBytes)
{
	const FTemporaryFolder Folder;
	FProgramOptions Options;
	Options.Folder = Folder.GetPath();
	for (const std::string Name : {"plain.gltf", "bad\xff\x1b\n\u202E.gltf"})
	{
		for (const std::string Text :
		    {"{\"asset\": \"\xff\x1b[31m", "\xff\xfe\x1b", "{\"asset\": {\"version\": \"\\u001b[31m\\u0085\\n\"}}",
		        "{\"asset\": {\"version\": \"2.0\"}, \"extensionsRequired\": [\"\\u001b[2J\\u202e\\n\"]}"})
		{
			Folder.Write(Name, Text);
			const FProgramRun Run = RunClean({"render", Name, "-o", "a.pfm"}, Options);
			EXPECT_EQ(Run.Status, 4);
			ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
			EXPECT_LT(Run.GetMessages()[0].size(), 600u);
			std::filesystem::remove(Folder.GetPath() + "/" + Name);
		}
	}
	Folder.Write("bad\xff.png", "\x1b\xff");
	for (const std::vector<std::string>& Arguments :
	    {std::vector<std::string>{"compare", "bad\xff.png", Worse + ".png"}, {"chart", "-o", "a.html", "--merge", Worse}})
	{
		const FProgramRun Run = RunClean(Arguments, Options);
		EXPECT_EQ(Run.Status, 4);
		EXPECT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
	}
}

TEST(MessageTest, BrokenArguments)
{
	const std::vector<std::vector<std::string>> Usages = {
	    {Worse},
	    {"render", "--" + Worse},
	    {"render", "furnace", "furnace", Worse},
	    {"render", "--size", Worse},
	    {"render", "--size", "0x0" + Worse},
	    {"render", "--camera", Worse},
	    {"render", "--time", Worse},
	    {"render", "--frames", Worse},
	    {"render", "--seed", Worse},
	    {"render", "--quality", Worse},
	    {"render", "--set", Worse},
	    {"render", "--device", Worse},
	    {"render", "--explain", Worse},
	    {"reference", "--signal", Worse},
	    {"compare", "a", "b", "--heatmap", Worse},
	    {"chart", "-o", Worse},
	    {"chart", "-o", "a.html", "--shard", Worse},
	    {"chart", "-o", "a.html", "--signals", Worse},
	    {"chart", "-o", "a.html", "--methods", Worse},
	    {"chart", "-o", "a.html", "--paths", Worse},
	};
	const FTemporaryFolder Folder;
	FProgramOptions Options;
	Options.Folder = Folder.GetPath();
	for (const std::vector<std::string>& Arguments : Usages)
	{
		const FProgramRun Run = RunClean(Arguments, Options);
		SCOPED_TRACE(::testing::PrintToString(Arguments));
		EXPECT_EQ(Run.Status, 2);
		EXPECT_EQ(Run.Out, "");
		ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
		EXPECT_THAT(Run.GetMessages()[0], HasSubstr(WorseShown));
	}
	const FProgramRun Long = RunClean({"render", "--size", std::string(100'000, '\xff')});
	EXPECT_LT(Long.Err.size(), 1000u);
}

TEST(MessageTest, BrokenNamesOfFilesAndScenes)
{
	const std::vector<std::vector<std::string>> Inputs = {
	    {"render", Worse},
	    {"render", "furnace:" + Worse},
	    {"render", Worse + ".gltf"},
	    {"render", "furnace", "-o", Worse},
	    {"render", "furnace", "-o", Worse + "/a.pfm"},
	    {"render", "furnace", "--json", Worse + "/a.json"},
	    {"render", "furnace", "--config", Worse},
	    {"cvars", "--json", Worse + "/a.json"},
	    {"chart", "-o", "a.html", "--methods-file", Worse},
	};
	const FTemporaryFolder Folder;
	FProgramOptions Options;
	Options.Folder = Folder.GetPath();
	for (const std::vector<std::string>& Arguments : Inputs)
	{
		const FProgramRun Run = RunClean(Arguments, Options);
		SCOPED_TRACE(::testing::PrintToString(Arguments));
		EXPECT_EQ(Run.Status, 4);
		ASSERT_EQ(Run.GetMessages().size(), 1u) << Run.Err;
		EXPECT_THAT(Run.GetMessages()[0], HasSubstr(WorseShown));
	}
}

TEST(MessageTest, BrokenSettings)
{
	const FTemporaryFolder Folder;
	const std::string Ini = Folder.Write("bad\xff.ini", "[\xff\u202E]\n[SystemSettings]\n\xff\u0085=1\nr.RT.Shadow.Samples=\xff\n\xff\n");
	const FProgramRun FromFile = RunClean({"cvars", "--config", Ini});
	EXPECT_EQ(FromFile.Status, 0);
	EXPECT_EQ(FromFile.GetMessages().size(), 4u) << FromFile.Err;
	const FProgramRun FromLine =
	    RunClean({"cvars", "--set", Worse + "=1", "--set", "r.RT.Shadow.Samples=" + Worse, "--set", "r.RT.Trace.File=" + Worse});
	EXPECT_EQ(FromLine.Status, 0);
	EXPECT_THAT(FromLine.GetMessages(), ElementsAre(HasSubstr(WorseShown), HasSubstr(WorseShown)));
	EXPECT_THAT(FromLine.Out, HasSubstr(WorseShown)) << "the value of a variable is in the table";
}

TEST(MessageTest, BrokenEnvironment)
{
	FProgramOptions Options;
	Options.Environment = {{"LANTERN_ROOT", "/nowhere" + Worse}, {"LANTERN_CACHE", "/proc/" + Worse}};
	EXPECT_NE(RunClean({"render", "furnace", "--size", "8x8"}, Options).Status, 0);
	EXPECT_THAT(RunClean({"cvars"}, Options).GetMessages(), ::testing::Not(IsEmpty()));
}

} // namespace
} // namespace Lantern
