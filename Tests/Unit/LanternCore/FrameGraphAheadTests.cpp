// What a frame submits ahead of an engine's list: which passes, in which order, and who waits.
#include <algorithm>
#include <mutex>
#include <random>
#include <utility>

#include <gmock/gmock.h>

#include "FrameGraphTestBase.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

enum class ETouch : uint8_t
{
	Nothing,
	Reads,
	Writes,
};

class FFrameGraphAheadTest : public FFrameGraphTestBase
{
protected:
	void SetUp() override
	{
		FFrameGraphTestBase::SetUp();
		ASSERT_TRUE(Device->CreateCommandList("Engine", Engine.ReleaseAndGetAddress()).IsOk());
	}
	void TearDown() override
	{
		Graph.reset();
		Lists.clear();
		Engine.Reset();
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		FFrameGraphTestBase::TearDown();
	}
	static void SetAsync(const char* Passes)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set("r.RT.Async", Passes, ERTSetBy::Console, "test"));
		FConsoleVariables::Get().BeginFrame();
	}
	void BeginGraph()
	{
		Graph = std::make_unique<FFrameGraph>(*Resources);
		Tokens = {Graph->CreateToken("Tables"), Graph->CreateToken("Structures")};
		Recorded.clear();
	}
	/// A pass that notes the list it is recorded into. Touches: by token.
	void Add(const std::string& Name, bool bAsync, std::pair<ETouch, ETouch> Touches, FGraphTexture Written = {})
	{
		Graph->AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			Builder.RecordOnTask();
			if (bAsync) { Builder.AllowAsync(); }
			if (Written.IsValid()) { Builder.Write(Written, ERTAccess::StorageWrite); }
			const ETouch ByToken[] = {Touches.first, Touches.second};
			for (size_t I = 0; I < Tokens.size(); ++I)
			{
				if (ByToken[I] == ETouch::Writes) { Builder.Write(Tokens[I]); }
				if (ByToken[I] == ETouch::Nothing) { Builder.Without(Tokens[I]); }
			}
			return [this, Name](FPassContext& Pass) {
				const std::lock_guard Lock(Mutex);
				Recorded.emplace_back(Name, &Pass.Commands() == Engine.Get());
			};
		});
	}
	/// Returns the passes that ran ahead, or behind, in their order.
	std::vector<std::string> Get(bool bAhead) const
	{
		std::vector<std::string> Out;
		for (const auto& [Name, bInEngine] : Recorded)
		{
			if (bInEngine != bAhead) { Out.push_back(Name); }
		}
		return Out;
	}
	void Execute()
	{
		Lists.clear();
		ASSERT_TRUE(Engine->Begin().IsOk());
		FGraphRecorder Recorder{[this](ERTQueue Queue, IRTCommandList*& Out) {
			FRTStatus Status = Device->CreateCommandList("Ahead", Lists.emplace_back().ReleaseAndGetAddress(), Queue);
			Out = Lists.back().Get();
			return Status ? Out->Begin() : Status;
		}};
		Recorder.Engine = Engine.Get();
		Recorder.AheadQueue = FindAheadQueue(*Device);
		const FRTStatus Status = Graph->Execute(Recorder);
		ASSERT_TRUE(Status.IsOk()) << Status.Message;
		for (const TRTRef<IRTCommandList>& Item : Lists) { EXPECT_TRUE(Item->End().IsOk()); }
		EXPECT_TRUE(Engine->End().IsOk());
	}
	const std::vector<FGraphSubmission>& GetSubmissions() const { return Graph->GetSubmissions(); }

	TRTRef<IRTCommandList> Engine;
	std::vector<TRTRef<IRTCommandList>> Lists;
	std::unique_ptr<FFrameGraph> Graph;
	std::vector<FGraphToken> Tokens;
	std::mutex Mutex;
	std::vector<std::pair<std::string, bool>> Recorded; ///< name, whether into the engine's list
};

TEST_F(FFrameGraphAheadTest, ScenePassesOvertakeWhatReadsNothingOfTheirs)
{
	SetAsync("");
	BeginGraph();
	Add("Convert", false, {ETouch::Nothing, ETouch::Nothing});
	Add("Tables", true, {ETouch::Writes, ETouch::Nothing});
	Add("Builds", true, {ETouch::Reads, ETouch::Writes});
	Add("Trace", true, {ETouch::Reads, ETouch::Reads}); // behind all writers: it may run ahead as well
	Execute();
	EXPECT_THAT(Get(false), ElementsAre("Convert"));
	EXPECT_THAT(Get(true), testing::UnorderedElementsAre("Tables", "Builds", "Trace"));
	ASSERT_EQ(GetSubmissions().size(), 2u);
	EXPECT_EQ(GetSubmissions()[0].Queue, ERTQueue::Graphics);
	EXPECT_EQ(GetSubmissions()[0].ListCount, 3u) << "each is a task's";
	EXPECT_EQ(GetSubmissions()[1].ListCount, 1u);
	EXPECT_THAT(GetSubmissions()[1].Waits, IsEmpty()) << "one queue runs in order";
}

TEST_F(FFrameGraphAheadTest, PassesStayBehindWhatReadsTheirToken)
{
	BeginGraph();
	Add("EarlyReader", false, {ETouch::Reads, ETouch::Nothing});
	Add("Tables", true, {ETouch::Writes, ETouch::Nothing});
	Add("Builds", true, {ETouch::Nothing, ETouch::Writes});
	Add("Late", true, {ETouch::Reads, ETouch::Nothing}); // reads what Tables, which stays, writes
	Execute();
	EXPECT_THAT(Get(true), ElementsAre("Builds"));
	EXPECT_THAT(Get(false), ElementsAre("EarlyReader", "Tables", "Late"));
}

TEST_F(FFrameGraphAheadTest, PassesWithTexturesStayBehind)
{
	BeginGraph();
	const FGraphTexture Texture = MakeTexture(*Graph, "Shadow");
	Add("Builds", true, {ETouch::Nothing, ETouch::Writes});
	Add("Shadow", true, {ETouch::Reads, ETouch::Reads}, Texture);
	Execute();
	EXPECT_THAT(Get(true), ElementsAre("Builds"));
	EXPECT_THAT(Get(false), ElementsAre("Shadow"));
}

TEST_F(FFrameGraphAheadTest, EngineListEndsTheFrameEvenIfNothingIsInIt)
{
	for (const char* Async : {"", "*"})
	{
		SetAsync(Async);
		BeginGraph();
		Add("Tables", true, {ETouch::Writes, ETouch::Nothing});
		Execute();
		ASSERT_EQ(GetSubmissions().size(), 2u);
		EXPECT_EQ(Lists.size(), 1u);
		BeginGraph();
		Execute();
		ASSERT_EQ(GetSubmissions().size(), 1u) << "without passes";
		EXPECT_TRUE(Lists.empty());
	}
}

TEST_F(FFrameGraphAheadTest, ComputeQueueTakesThePassesThatAreNamed)
{
	SetAsync("Tables, Builds");
	BeginGraph();
	Add("Tables", true, {ETouch::Writes, ETouch::Nothing});
	Add("Records", true, {ETouch::Nothing, ETouch::Nothing});
	Add("Builds", true, {ETouch::Nothing, ETouch::Writes});
	Add("Trace", false, {ETouch::Reads, ETouch::Reads});
	Execute();
	EXPECT_THAT(Get(false), ElementsAre("Records", "Trace"));
	ASSERT_EQ(GetSubmissions().size(), 2u) << "the engine's list is one submission, though only Trace waits";
	EXPECT_EQ(GetSubmissions()[0].Queue, ERTQueue::AsyncCompute);
	EXPECT_TRUE(GetSubmissions()[0].bWaitsForLastGraph);
	EXPECT_EQ(GetSubmissions()[1].Queue, ERTQueue::Graphics);
	EXPECT_THAT(GetSubmissions()[1].Waits, ElementsAre(0u));
}

TEST_F(FFrameGraphAheadTest, PoisonOfHistoriesKeepsNothingBehind)
{
	BeginGraph();
	const FGraphTexture Old = ImportTexture(*Graph, "Old", ERTAccess::ShaderRead, ERTAccess::ShaderRead);
	Graph->MarkHistory(Old);
	Add("Tables", true, {ETouch::Writes, ETouch::Nothing});
	Add("Filter", false, {ETouch::Reads, ETouch::Reads}, Old);
	Resources->PoisonHistory("");
	Execute();
	EXPECT_THAT(Get(true), ElementsAre("Tables"));
}

/// Passes ahead and behind keep the order of every pair that one token orders, and their own.
TEST_F(FFrameGraphAheadTest, RandomGraphsKeepTheOrderOfTheirTokens)
{
	std::mt19937 Random(17);
	const auto Pick = [&] { return static_cast<ETouch>(Random() % 3); };
	uint32_t Ahead = 0, Behind = 0;
	for (int Round = 0; Round < 300; ++Round)
	{
		BeginGraph();
		std::vector<std::pair<ETouch, ETouch>> Touches;
		for (uint32_t I = 0; I < 2 + Random() % 7; ++I)
		{
			Touches.emplace_back(Pick(), Pick());
			Add(std::to_string(I), Random() % 4 != 0, Touches.back());
		}
		Execute();
		std::vector<std::string> Order = Get(true);
		Ahead += static_cast<uint32_t>(Order.size());
		const std::vector<std::string> Rest = Get(false);
		Behind += static_cast<uint32_t>(Rest.size());
		EXPECT_THAT(Rest, ElementsAreArray([&] {
			std::vector<std::string> Sorted(Rest);
			std::sort(Sorted.begin(), Sorted.end());
			return Sorted;
		}()));
		for (const std::string& Late : Order)
		{
			for (const std::string& Early : Rest)
			{
				const auto& A = Touches[std::stoul(Early)];
				const auto& B = Touches[std::stoul(Late)];
				const auto IsHazard = [](ETouch X, ETouch Y) {
					return X != ETouch::Nothing && Y != ETouch::Nothing && (X == ETouch::Writes || Y == ETouch::Writes);
				};
				if (std::stoul(Early) > std::stoul(Late)) { continue; }
				EXPECT_FALSE(IsHazard(A.first, B.first) || IsHazard(A.second, B.second)) << "round " << Round;
			}
		}
	}
	EXPECT_GT(Ahead, 300u);
	EXPECT_GT(Behind, 300u);
}

} // namespace
} // namespace Lantern
