// FBuildScratch: growth, reserve and shrinking of the scratch buffer.
#include "GeometryContextTestTools.h"

namespace Lantern
{
namespace
{

constexpr uint64_t Step = FBuildScratch::Step;

class FBuildScratchTest : public FGeometryContextTest
{
protected:
	FGeometryMemoryBudget& Memory() { return Context->Memory; }
	FBuildScratch& Scratch() { return Context->Scratch; }
	uint64_t GetScratchSize() { return Scratch().Get() ? Scratch().Get()->GetDesc().Size : 0; }
};

TEST_F(FBuildScratchTest, GrowthIsTheWholeNewSizeInSteps)
{
	EXPECT_EQ(Scratch().Get(), nullptr);
	EXPECT_EQ(Scratch().GetGrowth(0), Step) << "a build names a buffer even if it needs no scratch";
	EXPECT_EQ(Scratch().GetGrowth(1), Step);
	EXPECT_EQ(Scratch().GetGrowth(Step), Step);
	EXPECT_EQ(Scratch().GetGrowth(Step + 1), 2 * Step);
	ASSERT_TRUE(Scratch().Grow(Step + 1));
	EXPECT_EQ(GetScratchSize(), 2 * Step);
	EXPECT_EQ(Device->GetMemoryStats().Scratch, 2 * Step);
	EXPECT_EQ(Scratch().GetGrowth(2 * Step), 0u);
	EXPECT_EQ(Scratch().GetGrowth(2 * Step + 1), 3 * Step);
	FRTBuildSizes Sizes;
	Sizes.StructureBytes = 1000;
	Sizes.BuildScratchBytes = 2 * Step;
	EXPECT_EQ(Scratch().GetBuildBytes(Sizes), 1000u);
	++Sizes.BuildScratchBytes;
	EXPECT_EQ(Scratch().GetBuildBytes(Sizes), 1000u + 3 * Step);
}

TEST_F(FBuildScratchTest, ReplacedBufferIsARelease)
{
	ASSERT_TRUE(Scratch().Grow(1));
	EXPECT_FALSE(Memory().IsReleasing()) << "there was none before";
	ASSERT_TRUE(Scratch().Grow(Step + 1));
	EXPECT_TRUE(Memory().IsReleasing());
	EXPECT_EQ(Context->Stats.PeakBytes, 3 * Step) << "both live for a moment";
}

TEST_F(FBuildScratchTest, FailedGrowthKeepsTheBuffer)
{
	ASSERT_TRUE(Scratch().Grow(1));
	IRTBuffer* const Before = Scratch().Get();
	Mock().FailAllocation(1);
	EXPECT_EQ(Scratch().Grow(Step + 1).Code, ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(Scratch().Get(), Before);
	EXPECT_FALSE(Memory().IsReleasing());
	ASSERT_TRUE(Scratch().Grow(Step + 1));
	EXPECT_EQ(GetScratchSize(), 2 * Step);
}

TEST_F(FBuildScratchTest, ReserveCountsForLaterGrowth)
{
	IRTBuffer* Out = nullptr;
	ASSERT_TRUE(Scratch().Reserve(5 * Step, Out));
	EXPECT_EQ(Out, Scratch().Get());
	EXPECT_EQ(GetScratchSize(), 5 * Step);
	for (uint32_t Frame = 0; Frame <= FBuildScratch::ShrinkAfterFrames; ++Frame) { Scratch().EndFrame(); }
	EXPECT_EQ(Scratch().Get(), nullptr);
	EXPECT_EQ(Scratch().GetGrowth(1), 5 * Step);
	ASSERT_TRUE(Scratch().Reserve(2 * Step, Out));
	EXPECT_EQ(GetScratchSize(), 2 * Step) << "the last reserve counts";
}

TEST_F(FBuildScratchTest, ReserveOfRefitsCountsWhileThereIsDynamicGeometry)
{
	Scratch().SetRefitReserve(4 * Step);
	EXPECT_EQ(Scratch().GetGrowth(1), Step);
	FRTGeometryRef Body = Add("Body", 10, true);
	EXPECT_EQ(Scratch().GetGrowth(1), 4 * Step);
	EXPECT_EQ(Scratch().GetGrowth(6 * Step), 6 * Step);
	Body.reset();
	uint32_t Coarse = 0;
	Slots().FreeReleased(Coarse);
	EXPECT_EQ(Scratch().GetGrowth(1), Step);
}

TEST_F(FBuildScratchTest, ShrinksAfterFramesThatNeedLessThanHalf)
{
	ASSERT_TRUE(Scratch().Grow(8 * Step));
	Scratch().EndFrame();
	for (uint32_t Frame = 1; Frame < FBuildScratch::ShrinkAfterFrames; ++Frame)
	{
		ASSERT_TRUE(Scratch().Grow(3 * Step));
		Scratch().EndFrame();
	}
	EXPECT_EQ(GetScratchSize(), 8 * Step);
	ASSERT_TRUE(Scratch().Grow(4 * Step)); // half: the count starts anew
	Scratch().EndFrame();
	for (uint32_t Frame = 1; Frame < FBuildScratch::ShrinkAfterFrames; ++Frame)
	{
		Scratch().EndFrame();
		EXPECT_TRUE(Scratch().IsTooLarge());
	}
	EXPECT_EQ(GetScratchSize(), 8 * Step);
	NextFrame();
	Scratch().EndFrame();
	EXPECT_EQ(Scratch().Get(), nullptr);
	EXPECT_FALSE(Scratch().IsTooLarge());
	EXPECT_TRUE(Memory().IsReleasing());
	EXPECT_EQ(Device->GetMemoryStats().Scratch, 0u);
}

TEST_F(FBuildScratchTest, SmallBufferStays)
{
	ASSERT_TRUE(Scratch().Grow(4 * Step)); // 256 KiB
	for (uint32_t Frame = 0; Frame < 3 * FBuildScratch::ShrinkAfterFrames; ++Frame) { Scratch().EndFrame(); }
	EXPECT_FALSE(Scratch().IsTooLarge());
	EXPECT_EQ(GetScratchSize(), 4 * Step);
}

} // namespace
} // namespace Lantern
