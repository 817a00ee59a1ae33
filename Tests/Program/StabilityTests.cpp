// lantern stability: its table and JSON, what it does about what fails, and its list of known shortfalls. The figures
// themselves are tests of their own, see Programs/lantern/CMakeLists.txt.
#include <set>

#include "LanternImage/ImageIO.h"
#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

class FStabilityTest : public ::testing::Test
{
protected:
	std::string At(const std::string& Name) const { return Folder.GetPath() + "/" + Name; }
	FProgramRun Run(std::vector<std::string> Arguments)
	{
		Arguments.insert(Arguments.begin(), {"stability", "--quick", "--seeds", "1"});
		Arguments.insert(Arguments.end(), {"--json", At("stability.json")});
		FProgramRun Result = RunProgram(Arguments);
		if (Result.Status <= 1) { Rows = ReadJson(At("stability.json"))["cases"]; }
		return Result;
	}
	/// The planes cast no shadow where they face the sun: the case does not hold.
	std::vector<std::string> MakeBroken() const
	{
		return {"--case", "25", "--method", "SunShadowQuery", "--set", "r.RT.Shadow.CasterFaces=2"};
	}

	FTemporaryFolder Folder;
	nlohmann::json Rows;
};

TEST_F(FStabilityTest, AllCasesAreListed)
{
	const FProgramRun List = RunProgram({"stability", "--list"});
	EXPECT_EQ(List.Status, 0);
	for (int Number = 1; Number <= 32; ++Number)
	{
		EXPECT_THAT("\n" + List.Out, HasSubstr("\n" + std::string(Number < 10 ? " " : "") + std::to_string(Number) + " ")) << Number;
	}
}

TEST_F(FStabilityTest, CasesWithoutMethodSaySo)
{
	const FProgramRun Result = Run({"--case", "2", "--case", "15", "--case", "23"});
	EXPECT_EQ(Result.Status, 0) << Result.Out;
	ASSERT_EQ(Rows.size(), 3u);
	for (const nlohmann::json& Row : Rows)
	{
		EXPECT_EQ(Row["status"], "no method yet");
		EXPECT_TRUE(Row["method"].is_null() && Row["figure"].is_null() && Row["holds"].is_null() && Row["fault_fails"].is_null());
	}
}

TEST_F(FStabilityTest, RowsHaveWhatTheContractNames)
{
	const FProgramRun Result = Run({"--case", "25", "--method", "sun shadow, query"});
	EXPECT_EQ(Result.Status, 0) << Result.Out << Result.Err;
	ASSERT_EQ(Rows.size(), 1u);
	for (const char* Key : {"number", "name", "method", "figure", "limit", "holds", "fault_figure", "fault_fails"})
	{
		EXPECT_TRUE(Rows[0].contains(Key)) << Key;
	}
	EXPECT_EQ(Rows[0]["number"], 25);
	EXPECT_EQ(Rows[0]["method"], "sun shadow, query");
	EXPECT_EQ(Rows[0]["holds"], true);
	EXPECT_EQ(Rows[0]["fault_fails"], true);
	EXPECT_GT(Rows[0]["fault_figure"], Rows[0]["limit"]);
	EXPECT_LE(Rows[0]["figure"], Rows[0]["limit"]);
	EXPECT_THAT(Result.Out, HasSubstr("single-sided plane"));
}

TEST_F(FStabilityTest, WhatFailsIsSaidAndShown)
{
	std::vector<std::string> Arguments = MakeBroken();
	Arguments.insert(Arguments.end(), {"-o", At("strips")});
	const FProgramRun Result = Run(Arguments);
	EXPECT_EQ(Result.Status, 1);
	ASSERT_EQ(Rows.size(), 1u);
	EXPECT_EQ(Rows[0]["holds"], false);
	EXPECT_THAT(Result.Out, HasSubstr("does not hold"));
	const std::vector<std::string> Strips = ListFolder(At("strips"));
	ASSERT_EQ(Strips.size(), 1u);
	FImage Strip;
	ASSERT_TRUE(LoadImageFile(At("strips") + "/" + Strips[0], Strip));
	EXPECT_GT(Strip.Height, 2u * 2u * 54u) << "frames, and the references below them";
}

TEST_F(FStabilityTest, NothingIsShownOfWhatHolds)
{
	EXPECT_EQ(Run({"--case", "25", "--method", "SunShadowQuery", "-o", At("strips")}).Status, 0);
	EXPECT_TRUE(ListFolder(At("strips")).empty());
}

TEST_F(FStabilityTest, KnownShortfallsMayFailAndMust)
{
	const std::string Line = "25 | sun shadow, query | pixels on the wrong side | ";
	std::vector<std::string> Arguments = MakeBroken();
	Arguments.insert(Arguments.end(), {"--known", At("known.txt")});
	Folder.Write("known.txt", "# a comment\n" + Line + "0.5 +- 0.5 | culled by hand\n");
	EXPECT_EQ(Run(Arguments).Status, 0);
	EXPECT_EQ(Rows[0]["known"], true);
	EXPECT_EQ(Rows[0]["holds"], false) << "known, not hidden";
	const double Figure = Rows[0]["figure"];
	// A change in either direction is no longer what is known.
	for (const double Known : {Figure + 0.1, Figure - 0.1})
	{
		Folder.Write("known.txt", Line + std::to_string(Known) + " +- 0.05 | culled by hand\n");
		const FProgramRun Other = Run(Arguments);
		EXPECT_EQ(Other.Status, 1) << Known;
		EXPECT_THAT(Other.Out, HasSubstr("is no longer the known"));
	}
	Folder.Write("known.txt", Line + std::to_string(Figure) + " +- 0.05 | culled by hand\n");
	EXPECT_EQ(Run(Arguments).Status, 0);
	const FProgramRun Again = Run({"--case", "25", "--method", "SunShadowQuery", "--known", At("known.txt")});
	EXPECT_EQ(Again.Status, 1);
	EXPECT_THAT(Again.Out, HasSubstr("take it off the list"));
}

TEST_F(FStabilityTest, WrongUseIsNamed)
{
	const FProgramRun Case = RunProgram({"stability", "--case", "1000"});
	EXPECT_EQ(Case.Status, 2);
	EXPECT_THAT(Case.Err, HasSubstr("1000"));
	const FProgramRun Method = RunProgram({"stability", "--method", "magic"});
	EXPECT_EQ(Method.Status, 2);
	EXPECT_THAT(Method.Err, HasSubstr("SunShadowQuery"));
	const FProgramRun Unmeasured = RunProgram({"stability", "--case", "27", "--method", "LocalLightsHalfFiltered"});
	EXPECT_EQ(Unmeasured.Status, 2);
	EXPECT_THAT(Unmeasured.Err, HasSubstr("no case that is run measures it"));
	for (const char* const Wrong :
	    {"25 | sun shadow, query", "25 | sun shadow, query | pixels | chance decides", "25 | sun shadow, query | pixels | 0.5 | no band",
	        "25 | sun shadow, query | pixels | 0.5 +- 0 | no band", "~25 | sun shadow, query | pixels | 0.5 +- 0.1 | may or may not"})
	{
		Folder.Write("known.txt", std::string("\n") + Wrong + "\n");
		const FProgramRun Known = RunProgram({"stability", "--known", At("known.txt")});
		EXPECT_EQ(Known.Status, 4) << Wrong;
		EXPECT_THAT(Known.Err, HasSubstr("known.txt:2"));
	}
	EXPECT_EQ(RunProgram({"stability", "--known", At("nowhere.txt")}).Status, 4);
	EXPECT_EQ(RunProgram({"stability", "--json", At("no/such/folder.json")}).Status, 4);
}

} // namespace
} // namespace Lantern
