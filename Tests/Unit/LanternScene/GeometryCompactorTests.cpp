// FGeometryCompactor: sizes, copies and their take-over, frame by frame.
#include "GeometryContextTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryCompactorTest : public FGeometryContextTest
{
protected:
	/// What a frame begins with.
	void Begin()
	{
		Compactor->TakeCopies();
		Compactor->TakeSizes();
		const FRTStatus Status = Compactor->Choose();
		EXPECT_TRUE(Status) << Status.Message;
	}
	void RunFrame(bool bSubmit = true)
	{
		NextFrame();
		Begin();
		EXPECT_TRUE(RunCommands(bSubmit));
	}
	/// Builds the geometry in one frame and asks for its size in the next.
	FRTGeometryRef AddAsked(const std::string& Name, uint32_t Triangles)
	{
		const FRTGeometryRef Geometry = AddBuilt(Name, Triangles);
		EXPECT_EQ(GetState(Geometry), EGeometryCompaction::Wanted);
		NextFrame();
		EXPECT_TRUE(RunCommands());
		EXPECT_EQ(GetState(Geometry), EGeometryCompaction::Queried);
		return Geometry;
	}
	EGeometryCompaction GetState(const FRTGeometryRef& Geometry) { return Entry(Geometry).Compaction; }
	uint32_t CountCopies() { return Mock().CountCalls(ERTMockCall::CompactGeometry); }
};

TEST_F(FGeometryCompactorTest, CopyIsTakenOverInTheFrameAfterIt)
{
	const FRTGeometryRef Rock = AddAsked("Rock", 1000);
	const uint64_t Before = AddressOf(Rock), Bytes = Entry(Rock).Sizes.StructureBytes;
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Queried);
	EXPECT_TRUE(Compactor->IsBusy());
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Copied);
	EXPECT_EQ(Context->Stats.Compacted, 1u);
	EXPECT_EQ(AddressOf(Rock), Before);
	EXPECT_FALSE(Context->Memory.IsReleasing());
	EXPECT_TRUE(Compactor->NeedsUpdate());
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::None);
	EXPECT_NE(AddressOf(Rock), Before);
	EXPECT_EQ(AddressOf(Rock), Rock->GetStructure()->GetDeviceAddress());
	EXPECT_LT(Entry(Rock).Sizes.StructureBytes, Bytes);
	EXPECT_EQ(Context->Stats.CompactionSavedBytes, Bytes - Entry(Rock).Sizes.StructureBytes);
	EXPECT_TRUE(Context->Memory.IsReleasing());
	EXPECT_FALSE(Compactor->NeedsUpdate());
	EXPECT_FALSE(Compactor->IsBusy());
	EXPECT_EQ(Mock().GetGeometry(Rock->GetStructure()).CompactedFrom, "Rock");
}

TEST_F(FGeometryCompactorTest, SizesAreReadOnceTheGpuIsDone)
{
	Mock().SetManualFences(true);
	const FRTGeometryRef Rock = AddAsked("Rock", 1000);
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Queried);
	EXPECT_FALSE(Compactor->NeedsUpdate()) << "there is nothing to do until then";
	EXPECT_TRUE(Compactor->IsBusy());
	Mock().CompleteUpTo(1);
	EXPECT_FALSE(Compactor->NeedsUpdate()) << "that was the build";
	Mock().CompleteUpTo(2);
	EXPECT_TRUE(Compactor->NeedsUpdate());
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Copied);
	EXPECT_EQ(Mock().GetBlockingWaits(), 0u);
	Mock().SetManualFences(false);
}

TEST_F(FGeometryCompactorTest, SavingOfLessThanATenthIsNotWorthACopy)
{
	const FRTGeometryRef Rock = AddAsked("Rock", 1000);
	const uint64_t Compacted = Mock().GetGeometry(Rock->GetStructure()).CompactedSize;
	Entry(Rock).Sizes.StructureBytes = Compacted * 100 / 91;
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::None);
	EXPECT_EQ(CountCopies(), 0u);
	EXPECT_FALSE(Compactor->NeedsUpdate());
}

TEST_F(FGeometryCompactorTest, ExpectedShareFollowsWhatIsSeen)
{
	EXPECT_FLOAT_EQ(Compactor->GetExpectedShare(), 0.7f);
	const FRTGeometryRef Rock = AddAsked("Rock", 1000);
	Entry(Rock).Sizes.StructureBytes = 2 * Mock().GetGeometry(Rock->GetStructure()).CompactedSize;
	Compactor->TakeSizes();
	EXPECT_FLOAT_EQ(Compactor->GetExpectedShare(), 0.7f + 0.1f * (0.5f - 0.7f));
	const FRTGeometryRef Stone = AddAsked("Stone", 1000);
	Entry(Stone).Sizes.StructureBytes = 1; // as if it were larger than before
	const float Before = Compactor->GetExpectedShare();
	Compactor->TakeSizes();
	EXPECT_FLOAT_EQ(Compactor->GetExpectedShare(), Before + 0.1f * (1.0f - Before));
}

TEST_F(FGeometryCompactorTest, SmallCopiesComeFirst)
{
	std::vector<FRTGeometryRef> Rocks;
	for (const uint32_t Triangles : {300u, 100u, 200u})
	{
		Rocks.push_back(Add("Rock" + std::to_string(Triangles), Triangles));
		ASSERT_TRUE(Builder->AddBuild(Entry(Rocks.back())));
	}
	ASSERT_TRUE(RunCommands());
	RunFrame();
	EXPECT_EQ(CountCopies(), 0u) << "the sizes are asked for in this frame";
	RunFrame();
	std::vector<std::string> Names;
	for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CompactGeometry)) { Names.push_back(Call.Name); }
	EXPECT_EQ(Names, std::vector<std::string>({"Rock100", "Rock200", "Rock300"}));
}

TEST_F(FGeometryCompactorTest, CopiesOfAFrameKeepToALimitOfBytes)
{
	std::vector<FRTGeometryRef> Mountains;
	for (int I = 0; I < 3; ++I) { Mountains.push_back(AddBuilt("Mountain", 700000)); } // 42 MB each, compacted
	for (int I = 0; I < 3; ++I)
	{
		RunFrame();
		EXPECT_EQ(Context->Stats.Compacted, 1u) << "64 MiB hold one, not two";
	}
	RunFrame();
	EXPECT_EQ(CountCopies(), 3u);
	for (const FRTGeometryRef& Mountain : Mountains) { EXPECT_EQ(GetState(Mountain), EGeometryCompaction::None); }
}

TEST_F(FGeometryCompactorTest, BudgetHoldsCopiesBack)
{
	const FRTGeometryRef Rock = AddAsked("Rock", 10000);
	const uint64_t Bytes = Mock().GetGeometry(Rock->GetStructure()).CompactedSize;
	FillBudget(8, Bytes - 1);
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Sized);
	EXPECT_FALSE(Compactor->NeedsUpdate()) << "until there is room";
	EmptyBudget();
	FillBudget(8, Bytes);
	EXPECT_TRUE(Compactor->NeedsUpdate());
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Copied);
	EXPECT_EQ(Context->Memory.GetRoom(), 0u);
}

TEST_F(FGeometryCompactorTest, LostCopyIsRecordedAgainIntoTheSameStructure)
{
	const FRTGeometryRef Rock = AddAsked("Rock", 1000);
	RunFrame(false);
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Sized);
	EXPECT_FALSE(Compactor->HasCopies());
	FillBudget(8, 0); // its memory is there already
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Copied);
	EXPECT_EQ(CountCopies(), 2u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateGeometry, "Rock"), 2u);
	RunFrame();
	EXPECT_TRUE(Mock().GetGeometry(Rock->GetStructure()).IsUsable());
}

TEST_F(FGeometryCompactorTest, LostBuildsAreNotQueried)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	ASSERT_TRUE(Builder->AddBuild(Entry(Rock)));
	EXPECT_FALSE(Compactor->HasCommands()) << "a query may follow only a build that was submitted";
	ASSERT_TRUE(RunCommands(false));
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::None);
	EXPECT_FALSE(Compactor->HasCommands() || Compactor->IsBusy());
	RunFrame();
	EXPECT_EQ(CountCopies(), 0u);
}

TEST_F(FGeometryCompactorTest, LostQueriesOfBuiltGeometryAreRecordedAgain)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	ASSERT_TRUE(Builder->AddBuild(Entry(Rock)));
	TRTRef<IRTCommandList> List;
	ASSERT_TRUE(Device->CreateCommandList("Builds", List.ReleaseAndGetAddress()));
	ASSERT_TRUE(List->Begin());
	ASSERT_EQ(Builder->Plan(1), 1u);
	Builder->RecordPart(*List, 0);
	ASSERT_TRUE(List->End());
	IRTCommandList* const Lists[] = {List.Get()};
	FRTFence Fence = 0;
	ASSERT_TRUE(Device->Submit(Lists, 1, &Fence));
	List.Reset();
	Builder->Submitted();
	Compactor->Submitted();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Wanted);
	RunFrame(false);
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Wanted) << "the query never ran";
	EXPECT_TRUE(Compactor->NeedsUpdate());
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Queried);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::WriteCompactedSize, "Rock"), 2u);
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Copied);
}

TEST_F(FGeometryCompactorTest, ForgottenSizesDoNotCount)
{
	const FRTGeometryRef Rock = AddAsked("Rock", 1000), Stone = AddAsked("Stone", 1000);
	Compactor->Forget(Entry(Rock));
	// A new structure asks for its own size: the old answer must not be taken for it.
	Entry(Rock).Compaction = EGeometryCompaction::Queried;
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Queried);
	EXPECT_EQ(GetState(Stone), EGeometryCompaction::Copied);
}

TEST_F(FGeometryCompactorTest, ReleasedGeometryIsPassedOver)
{
	FRTGeometryRef Rock = AddBuilt("Rock", 1000);
	Rock.reset();
	RunFrame();
	EXPECT_EQ(CountCopies(), 0u);
	EXPECT_FALSE(Compactor->NeedsUpdate() || Compactor->IsBusy());
}

TEST_F(FGeometryCompactorTest, OutOfMemoryMakesCopiesWait)
{
	const FRTGeometryRef Rock = AddAsked("Rock", 1000);
	Mock().FailAllocation(1);
	RunFrame();
	EXPECT_EQ(Context->Stats.Compacted, 0u);
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Sized);
	RunFrame();
	EXPECT_EQ(GetState(Rock), EGeometryCompaction::Copied);
}

TEST_F(FGeometryCompactorTest, DynamicGeometryIsNotCompacted)
{
	const FRTGeometryRef Body = AddBuilt("Body", 1000, true);
	EXPECT_EQ(GetState(Body), EGeometryCompaction::None);
	EXPECT_FALSE(Compactor->IsBusy());
}

} // namespace
} // namespace Lantern
