// lantern reference: the same seed gives the same picture, and one that was interrupted goes on as if it had not been.
#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class FReferenceProgramTest : public ::testing::Test
{
protected:
	std::string At(const std::string& Name) const { return Folder.GetPath() + "/" + Name; }
	std::vector<std::string> MakeArguments(const std::string& Output, uint32_t Samples, std::vector<std::string> More = {}) const
	{
		More.insert(More.begin(), {"reference", "furnace:0.7", "--size", "64x48", "--spp", std::to_string(Samples), "-o", At(Output)});
		return More;
	}
	void Run(const std::string& Output, uint32_t Samples, const std::vector<std::string>& More = {})
	{
		const FProgramRun Result = RunProgram(MakeArguments(Output, Samples, More));
		ASSERT_EQ(Result.Status, 0) << Result.Err;
	}
	/// Kills a run as soon as it has saved something new. False: its picture was there before.
	bool IsKilledInTheMiddle(const std::vector<std::string>& Arguments)
	{
		const std::string State = ReadFile(At("cut.pfm.state"));
		FProgramProcess Process(Arguments);
		const auto HasSaved = [&] { return !Process.IsRunning() || ReadFile(At("cut.pfm.state")) != State; };
		EXPECT_TRUE(WaitUntil("a new state of the picture", HasSaved));
		const bool bRan = Process.IsRunning();
		Process.Kill();
		const bool bWhole = std::filesystem::exists(At("cut.pfm"));
		EXPECT_TRUE(!bWhole || ReadFile(At("cut.pfm")) == ReadFile(At("whole.pfm"))) << "half-written";
		EXPECT_TRUE(bWhole || bRan) << "ended without a picture";
		return !bWhole;
	}
	/// Renders whole.pfm, and leaves the state of a cut.pfm that was killed three times. False: it was whole too soon.
	bool IsKilledThreeTimes(uint32_t Samples)
	{
		Run("whole.pfm", Samples);
		for (const char* Name : {"cut.pfm", "cut.pfm.state"}) { std::filesystem::remove(At(Name)); }
		const std::vector<std::string> Arguments = MakeArguments("cut.pfm", Samples, CutOptions);
		for (int Kill = 0; Kill < 3; ++Kill)
		{
			if (HasFailure() || !IsKilledInTheMiddle(Arguments)) { return false; }
		}
		return true;
	}
	const std::vector<std::string> CutOptions = {"--resume", "--save-every", "0"};
	FTemporaryFolder Folder;
};

TEST_F(FReferenceProgramTest, SameSeedSameBytes)
{
	Run("a.pfm", 4, {"--seed", "3", "--json", At("a.json"), "--validate"});
	Run("b.pfm", 4, {"--seed", "3"});
	Run("c.pfm", 4, {"--seed", "4"});
	EXPECT_EQ(ReadFile(At("a.pfm")), ReadFile(At("b.pfm")));
	EXPECT_NE(ReadFile(At("a.pfm")), ReadFile(At("c.pfm")));
	const nlohmann::json Json = ReadJson(At("a.json"));
	for (const char* Key : {"device", "driver", "width", "height", "spp", "bounces", "seconds", "paths"})
	{
		EXPECT_TRUE(Json.contains(Key)) << Key;
	}
	EXPECT_EQ(Json["paths"], 64 * 48 * 4);
}

TEST_F(FReferenceProgramTest, KilledInTheMiddleItGoesOnToTheSameBytes)
{
	// More samples where they are all there before this program, which may have to wait for a core, sees the first.
	uint32_t Samples = 150;
	while (!IsKilledThreeTimes(Samples))
	{
		ASSERT_FALSE(HasFailure());
		Samples *= 4;
		ASSERT_LT(Samples, 10'000u) << "it was always too fast to be killed";
	}
	std::vector<std::string> Last = MakeArguments("cut.pfm", Samples, CutOptions);
	Last.insert(Last.end(), {"--json", At("cut.json"), "--validate"});
	const FProgramRun Result = RunProgram(Last);
	ASSERT_EQ(Result.Status, 0) << Result.Err;
	EXPECT_GT(ReadJson(At("cut.json"))["resumed_spp"].get<uint32_t>(), 0u);
	EXPECT_LT(ReadJson(At("cut.json"))["resumed_spp"].get<uint32_t>(), Samples);
	EXPECT_EQ(ReadFile(At("cut.pfm")), ReadFile(At("whole.pfm")));
}

TEST_F(FReferenceProgramTest, MoreSamplesGoOnFromAFinishedPicture)
{
	Run("whole.pfm", 6);
	Run("grown.pfm", 2, {"--resume"});
	Run("grown.pfm", 6, {"--resume", "--json", At("a.json")});
	EXPECT_EQ(ReadJson(At("a.json"))["resumed_spp"], 2);
	EXPECT_EQ(ReadFile(At("grown.pfm")), ReadFile(At("whole.pfm")));
}

TEST_F(FReferenceProgramTest, StateOfAnotherPictureIsRefusedAndKept)
{
	Run("a.pfm", 2, {"--resume"});
	const std::string State = ReadFile(At("a.pfm.state")), Picture = ReadFile(At("a.pfm"));
	for (const std::vector<std::string>& Other : {std::vector<std::string>{"--seed", "1"}, {"--bounces", "2"}, {"--sky", "1,1,1"},
	         {"--sun", "1,0,-1,0,1"}, {"--camera", "0,0,0,1,0,0,50"}, {"--set", "r.RT.Material.Override=2"}, {"--no-scene-lights"}})
	{
		std::vector<std::string> Arguments = MakeArguments("a.pfm", 2, {"--resume"});
		Arguments.insert(Arguments.end(), Other.begin(), Other.end());
		const FProgramRun Result = RunProgram(Arguments);
		EXPECT_EQ(Result.Status, 4) << Other[0];
		ASSERT_EQ(Result.GetMessages().size(), 1u) << Result.Err;
		EXPECT_THAT(Result.GetMessages()[0], HasSubstr("a.pfm.state"));
	}
	EXPECT_EQ(ReadFile(At("a.pfm.state")), State);
	EXPECT_EQ(ReadFile(At("a.pfm")), Picture);
}

TEST_F(FReferenceProgramTest, DamagedStateIsRefused)
{
	Run("a.pfm", 2, {"--resume"});
	const std::string State = ReadFile(At("a.pfm.state"));
	for (const std::string& Damaged :
	    {std::string(), State.substr(0, 10), State.substr(0, State.size() - 1), std::string(State.size(), 'x')})
	{
		Folder.Write("a.pfm.state", Damaged);
		const FProgramRun Result = RunProgram(MakeArguments("a.pfm", 4, {"--resume"}));
		EXPECT_EQ(Result.Status, 4) << Result.Err;
		ASSERT_EQ(Result.GetMessages().size(), 1u) << Result.Err;
		EXPECT_THAT(Result.GetMessages()[0], HasSubstr("a.pfm.state"));
	}
}

} // namespace
} // namespace Lantern
