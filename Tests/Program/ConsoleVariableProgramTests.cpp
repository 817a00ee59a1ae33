// lantern cvars, and what files and options make of console variables.
#include <map>
#include <set>

#include "LanternCore/Config/Config.h"
#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> RenderSmall(std::vector<std::string> More)
{
	More.insert(More.begin(), {"render", "furnace", "--size", "8x8"});
	return More;
}

/// Name → variable, from lantern cvars --json.
std::map<std::string, nlohmann::json> ReadVariables()
{
	const FTemporaryFolder Folder;
	const FProgramRun Run = RunProgram({"cvars", "--json", Folder.GetPath() + "/cvars.json"});
	EXPECT_EQ(Run.Status, 0) << Run.Err;
	std::map<std::string, nlohmann::json> Variables;
	const nlohmann::json Json = ReadJson(Folder.GetPath() + "/cvars.json");
	for (const nlohmann::json& Variable : Json.at("variables")) { Variables[Variable.at("name")] = Variable; }
	return Variables;
}

TEST(ConsoleVariableProgramTest, DocumentIsWhatTheProgramPrints)
{
	const FProgramRun Run = RunProgram({"cvars", "--markdown"});
	EXPECT_EQ(Run.Status, 0);
	EXPECT_EQ(Run.Err, "");
	EXPECT_EQ(ReadFile(LANTERN_SOURCE_DIR "/Docs/ConsoleVariables.md"), Run.Out)
	    << "run: lantern cvars --markdown > Docs/ConsoleVariables.md";
}

TEST(ConsoleVariableProgramTest, JsonDescribesEveryVariable)
{
	const auto Variables = ReadVariables();
	EXPECT_GT(Variables.size(), 10u);
	ASSERT_TRUE(Variables.count("r.RT.Shadow.Samples"));
	const std::string Page = RunProgram({"cvars"}).Out;
	for (const auto& [Name, Variable] : Variables)
	{
		for (const char* Key : {"name", "type", "default", "value", "set_by", "help", "aliases"})
		{
			EXPECT_TRUE(Variable.contains(Key)) << Name << " has no " << Key;
		}
		EXPECT_THAT(Variable["set_by"], ::testing::AnyOf("code", "ini")) << Name << ": no device, no options";
		EXPECT_NE(Variable["help"], "") << Name;
		EXPECT_THAT(Page, HasSubstr(Name));
	}
}

TEST(ConsoleVariableProgramTest, EveryVariableThatAnIniFileNamesExists)
{
	std::set<std::string> Known;
	for (const auto& [Name, Variable] : ReadVariables())
	{
		Known.insert(Name);
		for (const std::string Alias : Variable["aliases"]) { Known.insert(Alias); }
	}
	const std::vector<FConfigReference> References = ListConsoleVariables({LANTERN_SOURCE_DIR "/Config"});
	EXPECT_GT(References.size(), 10u);
	for (const FConfigReference& Reference : References)
	{
		EXPECT_TRUE(Known.count(Reference.Name)) << Reference.Where << ": " << Reference.Name;
	}
}

TEST(ConsoleVariableProgramTest, WrongNameIsOneWarningWithTheNearest)
{
	const FProgramRun Run = RunProgram(RenderSmall({"--set", "r.RT.Shadw.Samples=2", "--validate"}));
	EXPECT_EQ(Run.Status, 0) << Run.Err;
	EXPECT_THAT(Run.GetMessages(),
	    ElementsAre(AllOf(HasSubstr("warning"), HasSubstr("--set"), HasSubstr("r.RT.Shadw.Samples"), HasSubstr("'r.RT.Shadow.Samples'"))));
}

TEST(ConsoleVariableProgramTest, WrongValueIsOneWarningWithTheRange)
{
	for (const char* Value : {"abc", "100"})
	{
		const FProgramRun Run = RunProgram(RenderSmall({"--set", std::string("r.RT.Shadow.Samples=") + Value}));
		EXPECT_EQ(Run.Status, 0) << Run.Err;
		EXPECT_THAT(Run.GetMessages(),
		    ElementsAre(AllOf(HasSubstr("warning"), HasSubstr("r.RT.Shadow.Samples"), HasSubstr(Value), HasSubstr("1 to 64"))));
	}
}

TEST(ConsoleVariableProgramTest, WrongIniIsNamedWithItsLineAndTheRestApplies)
{
	const FTemporaryFolder Folder;
	const std::string Ini = Folder.Write("wrong.ini", "[SystemSettings]\n"
	                                                  "nonsense\n"
	                                                  "r.RT.Shadow.Samples=abc\n"
	                                                  "r.RT.Shadow=0\n");
	const std::string Json = Folder.GetPath() + "/a.json";
	const FProgramRun Run = RunProgram({"render", "planes", "--size", "8x8", "--config", Ini, "--json", Json, "--validate"});
	EXPECT_EQ(Run.Status, 0) << Run.Err;
	EXPECT_THAT(Run.GetMessages(), ElementsAre(AllOf(HasSubstr("warning"), HasSubstr("wrong.ini:2"), HasSubstr("nonsense")),
	                                   AllOf(HasSubstr("warning"), HasSubstr("wrong.ini:3"), HasSubstr("abc"))));
	const nlohmann::json Figures = ReadJson(Json);
	for (const nlohmann::json& Pass : Figures["passes"]) { EXPECT_NE(Pass["name"], "SunShadow") << "line 4 was not applied"; }
}

TEST(ConsoleVariableProgramTest, BinaryRubbishAsIniIsNoDisaster)
{
	const FTemporaryFolder Folder;
	std::string Rubbish(5000, '\0');
	for (size_t I = 0; I < Rubbish.size(); ++I) { Rubbish[I] = static_cast<char>(I * 2654435761u >> 13); }
	const FProgramRun Run = RunProgram(RenderSmall({"--config", Folder.Write("rubbish.ini", Rubbish)}));
	EXPECT_LT(Run.Status, 128) << Run.Err.substr(0, 1000);
}

TEST(ConsoleVariableProgramTest, CommandLineOutranksQualityAndFiles)
{
	const FTemporaryFolder Folder;
	const std::string Ini = Folder.Write("project.ini", "[SystemSettings]\nr.RT.Shadow.Samples=8\n");
	const auto CountRays = [&](std::vector<std::string> More) {
		const std::string Json = Folder.GetPath() + "/rays.json";
		More.insert(More.begin(), {"render", "planes", "--size", "10x10", "--sun", "1,0,-1,0,2", "--set", "r.RT.AO=0", "--set", "r.RT.GI=0",
		                              "--set", "r.RT.Reflections=0", "--json", Json});
		const FProgramRun Run = RunProgram(More);
		EXPECT_EQ(Run.Status, 0) << Run.Err;
		return ReadJson(Json)["rays"].get<uint64_t>() / 100;
	};
	EXPECT_EQ(CountRays({}), 1u);
	EXPECT_EQ(CountRays({"--config", Ini}), 8u);
	EXPECT_EQ(CountRays({"--config", Ini, "--quality", "epic"}), 2u);
	EXPECT_EQ(CountRays({"--config", Ini, "--quality", "cinematic", "--set", "r.RayTracing.Shadows.SamplesPerPixel=3"}), 3u)
	    << "by its name in UE";
}

} // namespace
} // namespace Lantern
