// lantern reference: the same seed gives the same picture, and one that was interrupted goes on as if it had not been.
#include <chrono>
#include <thread>

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
	std::vector<std::string> MakeArguments(const std::string& Output, uint32_t Samples,
	                                       std::vector<std::string> More = {}) const
	{
		More.insert(More.begin(), {"reference", "furnace:0.7", "--size", "64x48", "--spp", std::to_string(Samples),
		                           "-o", At(Output)});
		return More;
	}
	void Run(const std::string& Output, uint32_t Samples, const std::vector<std::string>& More = {})
	{
		const FProgramRun Result = RunProgram(MakeArguments(Output, Samples, More));
		ASSERT_EQ(Result.Status, 0) << Result.Err;
	}
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
	Run("whole.pfm", 150);
	const auto Start = std::chrono::steady_clock::now();
	const std::vector<std::string> Arguments = MakeArguments("cut.pfm", 150, {"--resume", "--save-every", "0"});
	uint32_t Kills = 0;
	// Killed as soon as it has saved something new, again and again.
	for (std::string State; Kills < 3; ++Kills)
	{
		FProgramProcess Process(Arguments);
		while (Process.IsRunning() &&
		       (!std::filesystem::exists(At("cut.pfm.state")) || ReadFile(At("cut.pfm.state")) == State))
		{
			std::this_thread::sleep_for(std::chrono::milliseconds(5));
		}
		ASSERT_TRUE(Process.IsRunning()) << "it was too fast to be killed; " << Kills << " times it was not";
		Process.Kill();
		State = ReadFile(At("cut.pfm.state"));
		EXPECT_FALSE(std::filesystem::exists(At("cut.pfm"))) << "nothing half-written";
		ASSERT_LT(std::chrono::steady_clock::now() - Start, std::chrono::seconds(100));
	}
	std::vector<std::string> Last = Arguments;
	Last.insert(Last.end(), {"--json", At("cut.json"), "--validate"});
	const FProgramRun Result = RunProgram(Last);
	ASSERT_EQ(Result.Status, 0) << Result.Err;
	EXPECT_GT(ReadJson(At("cut.json"))["resumed_spp"].get<uint32_t>(), 0u);
	EXPECT_LT(ReadJson(At("cut.json"))["resumed_spp"].get<uint32_t>(), 150u);
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
	for (const std::vector<std::string>& Other : {std::vector<std::string>{"--seed", "1"},
	                                              {"--bounces", "2"},
	                                              {"--sky", "1,1,1"},
	                                              {"--sun", "1,0,-1,0,1"},
	                                              {"--camera", "0,0,0,1,0,0,50"},
	                                              {"--set", "r.RT.Material.Override=2"},
	                                              {"--no-scene-lights"}})
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
