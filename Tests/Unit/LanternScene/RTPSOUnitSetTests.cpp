// The units of descriptions and their states, without a device and without threads.
#include "Pipelines/RTPSOUnitSet.h"

#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;

class FRTPSOUnitSetTest : public FPipelineTest
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		Capabilities.bPipelineLibraries = Capabilities.bLibraryOnlyPipelines = true;
		Units = std::make_unique<FRTPSOUnitSet>(Capabilities, *Programs);
	}
	bool Want(std::optional<bool> StandIns = std::nullopt, uint64_t Frame = 1) { return Units->SetWanted(Wanted, true, StandIns, Frame); }
	static std::vector<std::string> NamesOf(const std::vector<FUnitStateRef>& States)
	{
		std::vector<std::string> Names;
		for (const FUnitStateRef& State : States) { Names.push_back(State->Unit.Name); }
		return Names;
	}
	std::vector<std::string> GetMissing(uint64_t Frame = 1) const { return NamesOf(Units->FindMissing(Frame)); }
	FUnitState& Find(const std::string& Name)
	{
		for (const FUnitStateRef& State : Units->GetWanted().All)
		{
			if (State->Unit.Name == Name) { return *State; }
		}
		ADD_FAILURE() << Name << " is not wanted";
		return *Units->GetWanted().All.front();
	}
	static void Compile(FUnitState& State)
	{
		State.Ready = std::make_shared<FPipelineBuild>();
		State.ReadyVersion = State.GetVersion();
		State.Error = FRTStatus::Success();
	}
	static void Fail(FUnitState& State)
	{
		State.FailedVersion = State.GetVersion();
		State.Error = FRTStatus::Error(ERTResult::CompileFailed, "wrong");
	}
	void CompileAll()
	{
		for (const FUnitStateRef& State : Units->GetWanted().All) { Compile(*State); }
	}
	FRTPSOCompilerStats Count() const
	{
		FRTPSOCompilerStats Stats;
		Units->Count(Stats);
		return Stats;
	}

	FRTCapabilities Capabilities;
	std::unique_ptr<FRTPSOUnitSet> Units;
};

TEST_F(FRTPSOUnitSetTest, ADescriptionHasAUnitForEachShaderGroupThatRunsSomething)
{
	AddProgram("Rust");
	AddProgram("Leaves", ERTHitClass::Masked);
	ASSERT_TRUE(Want());
	EXPECT_THAT(NamesOf(Units->GetWanted().All), ElementsAre("Generate", "SHADOW.miss", "MATERIAL.miss", "Standard MATERIAL opaque",
	                                                 "Rust MATERIAL opaque", "Leaves SHADOW masked", "Leaves MATERIAL masked"));
	ASSERT_EQ(Units->GetWanted().Hits.size(), 3u);
	EXPECT_EQ(Units->GetWanted().Hits[1].Types[0], nullptr) << "a shadow ray on an opaque surface runs nothing";
	ASSERT_TRUE(Want(true));
	EXPECT_EQ(Units->GetWanted().StandIns.size(), 2u) << "one for each class that is there";
	EXPECT_EQ(Units->GetWanted().All.size(), 10u);
}

TEST_F(FRTPSOUnitSetTest, UnitsKeepTheirStateWhereTheyAreWantedAgain)
{
	ASSERT_TRUE(Want());
	EXPECT_FALSE(Want()) << "nothing is new";
	EXPECT_TRUE(Want(true));
	EXPECT_FALSE(Want()) << "stand-ins stay";
	CompileAll();
	const uint32_t Rust = AddProgram("Rust");
	EXPECT_TRUE(Want(true));
	EXPECT_THAT(GetMissing(), ElementsAre("Rust MATERIAL opaque"));
	Compile(Find("Rust MATERIAL opaque"));
	Programs->Edit(Rust, {.Name = "Rust", .Text = MakeText(77)});
	EXPECT_TRUE(Want(true));
	EXPECT_THAT(GetMissing(), ElementsAre("Rust MATERIAL opaque"));
	EXPECT_TRUE(Units->AreHitsReady()) << "the older version serves";
	EXPECT_TRUE(Units->SetWanted(Wanted, false, true, 1));
	EXPECT_EQ(GetMissing().size(), Units->GetWanted().All.size()) << "SPIR-V in place of libraries";
}

TEST_F(FRTPSOUnitSetTest, EssentialUnitsComeFirstThenThoseOfHighPriority)
{
	for (const char* Name : {"Far", "Near", "Seen", "MoreSeen"}) { AddProgram(Name); }
	Units->SetPriorities({{}, {0, 50.0f}, {0, 2.0f}, {10, 90.0f}, {500, 100.0f}});
	ASSERT_TRUE(Want(true));
	EXPECT_THAT(GetMissing(), ElementsAre("Generate", "SHADOW.miss", "MATERIAL.miss", "Standard MATERIAL opaque", "StandIn MATERIAL opaque",
	                              "MoreSeen MATERIAL opaque", "Seen MATERIAL opaque", "Near MATERIAL opaque", "Far MATERIAL opaque"));
}

TEST_F(FRTPSOUnitSetTest, UnitsOnTheirWayAreNotMissing)
{
	ASSERT_TRUE(Want());
	CompileAll();
	EXPECT_FALSE(Units->IsAnyToCome(1));
	AddProgram("Rust");
	ASSERT_TRUE(Want());
	FUnitState& Rust = Find("Rust MATERIAL opaque");
	for (const EUnitWork Work : {EUnitWork::Queued, EUnitWork::Compiling})
	{
		Rust.Work = Work;
		EXPECT_THAT(GetMissing(), ElementsAre());
		EXPECT_TRUE(Units->IsAnyToCome(1));
	}
	Rust.Work = EUnitWork::Idle;
	EXPECT_EQ(Units->CountSettled(), 4u);
	Fail(Rust);
	EXPECT_EQ(Units->CountSettled(), 5u);
	EXPECT_FALSE(Units->IsAnyToCome(1));
	EXPECT_FALSE(Units->AreHitsReady());
}

TEST_F(FRTPSOUnitSetTest, AShortageOfMemoryWaitsForItsFrame)
{
	AddProgram("Rust");
	ASSERT_TRUE(Want());
	CompileAll();
	FUnitState& Rust = Find("Rust MATERIAL opaque");
	Rust.Ready.reset();
	Rust.ReadyVersion = 0;
	Rust.Error = FRTStatus::Error(ERTResult::OutOfDeviceMemory, "full");
	Rust.RetryAt = 61;
	EXPECT_THAT(GetMissing(60), ElementsAre());
	EXPECT_THAT(GetMissing(61), ElementsAre("Rust MATERIAL opaque"));
	EXPECT_EQ(Units->FindFatalError().Code, ERTResult::OutOfDeviceMemory);
	Units->ForgetShortages();
	EXPECT_THAT(GetMissing(1), ElementsAre("Rust MATERIAL opaque"));
	EXPECT_TRUE(Units->FindFatalError());
}

TEST_F(FRTPSOUnitSetTest, OnlyEssentialUnitsWithoutAnOlderVersionAreFatal)
{
	AddProgram("Rust");
	ASSERT_TRUE(Want());
	Fail(Find("Rust MATERIAL opaque"));
	EXPECT_TRUE(Units->FindFatalError());
	Compile(Find("SHADOW.miss"));
	Find("SHADOW.miss").Reloads++;
	Fail(Find("SHADOW.miss"));
	EXPECT_TRUE(Units->FindFatalError()) << "its older version serves";
	Fail(Find("MATERIAL.miss"));
	EXPECT_EQ(Units->FindFatalError().Code, ERTResult::CompileFailed);
	EXPECT_EQ(Count().Failed, 2u);
}

TEST_F(FRTPSOUnitSetTest, UnitsThatNothingWantsAreDroppedInTime)
{
	const FRTPSODesc Few = Wanted;
	for (const char* Name : {"Rust", "Moss"}) { AddProgram(Name); }
	ASSERT_TRUE(Want({}, 1));
	CompileAll();
	const FUnitStateRef Moss = Units->GetWanted().All.back();
	const std::weak_ptr<const FPipelineBuild> Rust = Find("Rust MATERIAL opaque").Ready;
	Wanted = Few;
	ASSERT_TRUE(Want({}, 2));
	Moss->Work = EUnitWork::Compiling;
	FTrash Trash;
	Units->DropOld(11, 10, Trash);
	EXPECT_EQ(Count().Kept, 6u) << "wanted ten frames ago";
	Units->DropOld(12, 10, Trash);
	EXPECT_EQ(Count().Kept, 5u) << "a compile thread has the other one";
	EXPECT_FALSE(Rust.expired()) << "destroyed by the caller";
	Trash.Take();
	EXPECT_TRUE(Rust.expired());
	Moss->Work = EUnitWork::Idle;
	Units->DropOld(100, 10, Trash);
	EXPECT_EQ(Count().Kept, 4u) << "those that are wanted stay";
}

TEST_F(FRTPSOUnitSetTest, AnEditMakesANewVersionUnlessOneHasCome)
{
	const uint32_t Rust = AddProgram("Rust");
	ASSERT_TRUE(Want());
	EXPECT_TRUE(Units->ListSettled().empty());
	CompileAll();
	const std::vector<FUnitLook> Looks = Units->ListSettled();
	EXPECT_EQ(Looks.size(), 5u);
	Programs->Edit(Rust, {.Name = "Rust", .Text = MakeText(77)});
	ASSERT_TRUE(Want());
	EXPECT_TRUE(Units->Reload(Looks));
	EXPECT_EQ(Find("Rust MATERIAL opaque").Reloads, 0u);
	EXPECT_EQ(GetMissing().size(), 5u);
	EXPECT_FALSE(Units->Reload(Looks)) << "all of them have newer versions";
}

} // namespace
} // namespace Lantern
