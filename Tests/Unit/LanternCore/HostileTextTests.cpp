// Ini files, console variables and shaders whose text is broken or means harm: what is said of them can be shown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Config/Config.h"
#include "LanternCore/Config/IniFile.h"
#include "LanternCore/Shaders/ShaderCompiler.h"
#include "Support/CoreTestTools.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TRTConsoleVariable<int32_t> CVarNumber("t.Hostile.Number", 0, "", {0, 100});

/// Broken UTF-8, a C1 control, a direction override: what an ini file may hold within a line.
const std::string Broken = "\xff\xC3(\u0085\u202E";
const std::string BrokenShown = "\\xff\\xc3(\\u{0085}\\u{202e}";
/// And what a name that is no line of a file may hold besides.
const std::string Worse = "\x1b[31m" + Broken + "\nerror: forged";

class HostileText : public testing::Test
{
protected:
	HostileText() { FConsoleVariables::Get().ResetAll(); }
	~HostileText() override { FConsoleVariables::Get().ResetAll(); }

	/// One line each. What is returned has gone past no sink that would have escaped it.
	static void ExpectClean(const std::vector<std::string>& Problems, size_t Count)
	{
		EXPECT_EQ(Problems.size(), Count) << testing::PrintToString(Problems);
		for (const std::string& Problem : Problems)
		{
			EXPECT_TRUE(IsCleanText(Problem)) << testing::PrintToString(Problem);
			EXPECT_LT(Problem.size(), 600u);
		}
	}

	FTemporaryFolder Files;
	FConfigFolder Folder{Files.GetPath()};
	FLogCapture Log;
};

TEST_F(HostileText, IniLines)
{
	const FIniFile File = FIniFile::Parse(Broken + "\n[" + Broken + "\n[S] " + Broken + "\n[S]\n" + Broken + "\nA=\"" + Broken + "\n" +
	                                          "B=\"x\" " + Broken + "\n=" + Broken + "\nC\x1b=1\nD=" + std::string(500, '\xff') + "\x01\n",
	    "T.ini");
	ExpectClean(File.GetProblems(), 9);
	EXPECT_EQ(File.GetProblems()[0], "T.ini:1: '" + BrokenShown + "' stands before any [Section]");
}

TEST_F(HostileText, NamesOfIniFiles)
{
	const FIniFile File = FIniFile::Parse("rubbish\n[S]\nA=1\n", Worse + ".ini");
	ExpectClean(File.GetProblems(), 1);
	EXPECT_TRUE(IsCleanText(File.GetWhere(3)));
	EXPECT_EQ(File.GetName(), Worse + ".ini") << "the name itself stays as it is";
	ExpectClean(FIniFile::Load(Files.GetPath() + "/" + Worse).GetProblems(), 1);
	ExpectClean(FIniFile::Load(std::string(10'000, '\xff')).GetProblems(), 1);
	ExpectClean(LoadFile(Folder, Files.Write("bad\xff.ini", "[SystemSettings]\nrubbish\n")), 1);
}

TEST_F(HostileText, SectionsKeysAndValuesOfTheConfigFolder)
{
	Files.Write("ConsoleVariableAliases.ini", "[" + Broken + "]\n[ConsoleVariableAliases]\n" + Broken + "=" + Broken + "\n");
	ExpectClean(LoadAliases(Folder), 2);
	Files.Write("Scalability.ini", "[" + Broken + "]\n[" + Broken + "@9]\n[" + Broken + "@0]\nt.Hostile.Number=x\n");
	ExpectClean(LoadScalability(Folder, ERTQuality::Low), 3);
	const std::string Game = Files.Write("Game.ini", "[" + Broken + "]\n[SystemSettings]\n" + Broken + "=1\nt.Hostile.Number=" + Broken +
	                                                     "\n[ScalabilityGroups]\nsg." + Broken + "=2\nsg." + Broken + "x=1\n");
	ExpectClean(LoadFile(Folder, Game), 4); // one of the two groups is there
	Files.Write("DeviceProfiles.ini", "[" + Broken + "]\n[Default DeviceProfile]\n" + Broken + "=1\nBaseProfileName=" + Broken +
	                                      "\n+CVars=" + Broken + "\n+CVars=" + Broken + "=1\n+CVars=t.Hostile.Number=" + Broken + "\n");
	ExpectClean(LoadDeviceProfile(Folder, Broken).Problems, 6);
}

TEST_F(HostileText, ConsoleVariables)
{
	FConsoleVariables& Registry = FConsoleVariables::Get();
	Registry.AddAlias("t.Hostile.Alias" + Worse, "t.Hostile.Number");
	for (const auto& [Name, Value] :
	    {std::pair<std::string, std::string>{Worse, "1"}, {"t.Hostile.Alias" + Worse + "!", "1"}, // the nearest is the alias
	        {"t.Hostile.Number", Worse}, {"t.Hostile.Number", std::string(10'000'000, '\xff')}})
	{
		const std::optional<std::string> Problem = Registry.Set(Name, Value, ERTSetBy::CommandLine, "--set");
		ASSERT_TRUE(Problem);
		ExpectClean({*Problem}, 1);
		EXPECT_LT(Problem->size(), 400u);
	}
}

TEST_F(HostileText, Shaders)
{
	FShaderCompilerDesc Desc;
	Desc.SearchFolders = {Files.GetPath(), Files.GetPath() + "/" + Worse};
	FShaderCompiler Compiler(Desc);
	const auto ErrorOf = [&](const FShaderSource& Source) {
		FShaderBinary Out;
		const FRTStatus Status = Compiler.Compile(Source, Out);
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
		EXPECT_TRUE(AreCleanLines(Status.Message)) << testing::PrintToString(Status.Message);
		EXPECT_THAT(Status.Message, Not(HasSubstr("\nerror: forged"))) << "a name has made a line of its own";
		return std::string(Status.Message);
	};
	const std::string Empty = "#version 460\nvoid main() {}\n";
	ErrorOf({"A.comp", ERTShaderStage::Compute, {}, "#version 460\n#error \x1b[31m\xff\n" + Empty});
	ErrorOf({"A.comp", ERTShaderStage::Compute, {}, "#version 460\n#include \"" + Broken + "\"\n"});
	EXPECT_THAT(ErrorOf({"nowhere/" + Broken, ERTShaderStage::Compute, {}, {}}), HasSubstr(BrokenShown));
	EXPECT_THAT(ErrorOf({Broken, ERTShaderStage::Compute, {}, "#version 460\nrubbish\n"}), HasSubstr(BrokenShown + ":2: "));
	ErrorOf({"A.comp", ERTShaderStage::Compute, {{Worse, Worse}}, Empty});
	// The compiler's log would repeat the name before each error.
	EXPECT_THAT(ErrorOf({Worse, ERTShaderStage::Compute, {}, "#version 460\nrubbish\n"}), HasSubstr("one line each"));
	FShaderSource Source{"A.comp", ERTShaderStage::Compute, {}, "#version 460\n#include \"H.glsl\"\nvoid main() {}\n"};
	Source.Headers.push_back({"H.glsl", "rubbish\n", Worse});
	EXPECT_THAT(ErrorOf(Source), HasSubstr("one line each"));
	EXPECT_THAT(Log.GetTexts(), IsEmpty());
}

} // namespace
} // namespace Lantern
