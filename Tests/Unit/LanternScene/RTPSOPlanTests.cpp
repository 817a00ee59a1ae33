// What a link consists of, from the states of units, and how two plans differ.
#include "Pipelines/RTPSOPlan.h"

#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

class FLinkPlanTest : public FPipelineTest
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		Capabilities.bPipelineLibraries = Capabilities.bLibraryOnlyPipelines = true;
		Units = std::make_unique<FRTPSOUnitSet>(Capabilities, *Programs);
	}
	/// Every unit of Wanted is compiled, but those whose names contain Except.
	void CompileAll(bool bStandIns = false, const std::string& Except = "?")
	{
		Units->SetWanted(Wanted, true, bStandIns, 1);
		for (const FUnitStateRef& State : Units->GetWanted().All)
		{
			if (!State->Ready && State->Unit.Name.find(Except) == std::string::npos) { Compile(*State); }
		}
	}
	void Compile(FUnitState& State)
	{
		auto Build = std::make_shared<FPipelineBuild>();
		Build->Id = ++Builds;
		State.Ready = std::move(Build);
		State.ReadyVersion = State.GetVersion();
	}
	FUnitState& Find(const std::string& Name)
	{
		for (const FUnitStateRef& State : Units->GetWanted().All)
		{
			if (State->Unit.Name == Name) { return *State; }
		}
		ADD_FAILURE() << Name << " is not wanted";
		return *Units->GetWanted().All.front();
	}
	FLinkPlan MakePlan(bool bStandardServes = true) const { return MakeLinkPlan(Units->GetWanted(), Units->GetDesc(), bStandardServes); }

	FRTCapabilities Capabilities;
	std::unique_ptr<FRTPSOUnitSet> Units;
	uint64_t Builds = 0;
};

TEST_F(FLinkPlanTest, APlanNeedsEveryMissAndOneRayGeneration)
{
	Wanted.RayGens.push_back(MakeShader("Second"));
	CompileAll(false, "SHADOW.miss");
	EXPECT_FALSE(MakePlan().bComplete);
	Compile(Find("SHADOW.miss"));
	EXPECT_TRUE(MakePlan().bComplete);
	Find("Generate").Ready.reset();
	const FLinkPlan Plan = MakePlan();
	EXPECT_TRUE(Plan.bComplete);
	ASSERT_EQ(Plan.RayGenSources.size(), 1u);
	EXPECT_EQ(Plan.RayGenSources[0], Wanted.RayGens[1]);
	Find("Second").Ready.reset();
	EXPECT_FALSE(MakePlan().bComplete);
}

TEST_F(FLinkPlanTest, AHitProgramIsReadyWhenAllItsRayTypesAre)
{
	AddProgram("Leaves", ERTHitClass::Masked);
	CompileAll(false, "Leaves SHADOW");
	EXPECT_EQ(MakePlan().Hits[1].State, ERTHitState::Missing);
	EXPECT_TRUE(MakePlan().Hits[1].Builds.empty());
	EXPECT_TRUE(MakePlan().bComplete) << "a hit program may be missing";
	CompileAll();
	EXPECT_EQ(MakePlan().Hits[1].State, ERTHitState::Ready);
	EXPECT_EQ(MakePlan().Hits[1].Builds.size(), 2u);
	EXPECT_EQ(MakePlan().Hits[0].Builds[0], nullptr) << "runs nothing";
}

TEST_F(FLinkPlanTest, AStandInIsWaitedForUnlessItDoesNotCompile)
{
	AddProgram("Rust");
	CompileAll(true, "StandIn");
	EXPECT_FALSE(MakePlan().bComplete);
	FUnitState& StandIn = Find("StandIn MATERIAL opaque");
	StandIn.FailedVersion = StandIn.GetVersion();
	EXPECT_TRUE(MakePlan().bComplete);
	EXPECT_TRUE(MakePlan().StandIns.empty());
	Compile(StandIn);
	EXPECT_EQ(MakePlan().StandIns.size(), 1u);
}

TEST_F(FLinkPlanTest, ACallableThatDoesNotCompileIsReplacedByTheEmptyOne)
{
	Wanted.Callables = {MakeShader("Bad"), MakeShader("Good")};
	CompileAll(false, "Bad");
	EXPECT_FALSE(MakePlan().bComplete) << "it may still compile";
	FUnitState& Bad = Find("Bad");
	Bad.FailedVersion = Bad.GetVersion();
	const FLinkPlan Plan = MakePlan();
	EXPECT_TRUE(Plan.bComplete);
	EXPECT_EQ(Plan.Callables[0], Find("EmptyCallable").Ready);
	EXPECT_EQ(Plan.Callables[1], Find("Good").Ready);
}

TEST_F(FLinkPlanTest, KeysAreEqualForEqualPipelinesOnly)
{
	AddProgram("Rust");
	CompileAll(false, "Rust");
	const FLinkPlan First = MakePlan();
	EXPECT_EQ(MakePlan().Key, First.Key);
	EXPECT_NE(MakePlan(false).Key, First.Key);
	CompileAll();
	const FLinkPlan Second = MakePlan();
	EXPECT_NE(Second.Key, First.Key);
	Compile(Find("Rust MATERIAL opaque"));
	EXPECT_NE(MakePlan().Key, Second.Key) << "a newer version";
}

TEST_F(FLinkPlanTest, ProgramsAloneLeaveAFrameCovered)
{
	const uint32_t Rust = AddProgram("Rust");
	CompileAll(true, "Rust");
	const FLinkPlan Before = MakePlan();
	EXPECT_EQ(CountNewPrograms(Before, Before), 0u);
	CompileAll(true);
	FLinkPlan After = MakePlan();
	EXPECT_TRUE(CoversFrame(Before, After));
	EXPECT_EQ(CountNewPrograms(Before, After), 1u);
	EXPECT_EQ(CountNewPrograms(After, Before), 0u) << "one that is missing is not new";
	Compile(Find("Rust MATERIAL opaque"));
	EXPECT_EQ(CountNewPrograms(After, MakePlan()), 1u) << "a newer version is";
	EXPECT_EQ(After.Hits[1].Program, Opaque(Rust));
	EXPECT_FALSE(CoversFrame(Before, MakePlan(false)));
	Compile(Find("StandIn MATERIAL opaque"));
	EXPECT_FALSE(CoversFrame(Before, MakePlan())) << "another stand-in";
}

TEST_F(FLinkPlanTest, ANewRayGenerationIsNotCoveredAndAMissingOneIs)
{
	CompileAll();
	const FLinkPlan One = MakePlan();
	Wanted.RayGens.push_back(MakeShader("Second"));
	CompileAll(false, "Second");
	EXPECT_TRUE(CoversFrame(One, MakePlan()));
	CompileAll();
	const FLinkPlan Two = MakePlan();
	EXPECT_FALSE(CoversFrame(One, Two));
	EXPECT_TRUE(CoversFrame(Two, One));
	Compile(Find("SHADOW.miss"));
	EXPECT_FALSE(CoversFrame(Two, MakePlan()));
}

} // namespace
} // namespace Lantern
