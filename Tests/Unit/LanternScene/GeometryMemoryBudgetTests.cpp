// FGeometryMemoryBudget: the limit, what is left of it, releases, the peak.
#include "GeometryContextTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryMemoryBudgetTest : public FGeometryContextTest
{
protected:
	FGeometryMemoryBudget& Memory() { return Context->Memory; }
};

TEST_F(FGeometryMemoryBudgetTest, WithoutALimitThereIsUnlimitedRoom)
{
	EXPECT_EQ(Memory().GetLimit(), 0u);
	EXPECT_EQ(Memory().GetRoom(), FGeometryMemoryBudget::Unlimited);
	const FRTGeometryRef Rock = AddBuilt("Rock", 100);
	EXPECT_EQ(Memory().GetRoom(), FGeometryMemoryBudget::Unlimited);
	EXPECT_EQ(Memory().GetUsed(), GetUsed());
	EXPECT_GT(Memory().GetUsed(), 0u);
}

TEST_F(FGeometryMemoryBudgetTest, RoomIsWhatIsLeftAndNeverNegative)
{
	Set("r.RT.Build.MemoryMB", "2");
	EXPECT_EQ(Memory().GetLimit(), 2u << 20);
	EXPECT_EQ(Memory().GetRoom(), 2u << 20);
	const FRTGeometryRef Rock = AddBuilt("Rock", 10000); // 1 MB, and 0.64 MB of scratch
	EXPECT_EQ(Memory().GetRoom(), (2u << 20) - GetUsed());
	Set("r.RT.Build.MemoryMB", "1");
	EXPECT_GT(GetUsed(), 1u << 20);
	EXPECT_EQ(Memory().GetRoom(), 0u);
}

TEST_F(FGeometryMemoryBudgetTest, ReleasesComeBackWithinEightFrames)
{
	EXPECT_FALSE(Memory().IsReleasing());
	Memory().NoteRelease();
	for (int I = 0; I < 8; ++I)
	{
		EXPECT_TRUE(Memory().IsReleasing()) << I;
		NextFrame();
	}
	EXPECT_FALSE(Memory().IsReleasing());
}

TEST_F(FGeometryMemoryBudgetTest, ReleasesBeforeTheFirstFrameDoNotCount)
{
	FGeometryStoreStats Stats;
	FGeometryMemoryBudget Young(*Device, Stats);
	Young.NoteRelease();
	EXPECT_FALSE(Young.IsReleasing());
	Young.BeginFrame(1);
	EXPECT_FALSE(Young.IsReleasing());
}

TEST_F(FGeometryMemoryBudgetTest, PeakStaysWhenMemoryGoes)
{
	FRTGeometryRef Rock = AddBuilt("Rock", 1000);
	const uint64_t Peak = GetUsed();
	Memory().UpdateStats();
	EXPECT_EQ(Context->Stats.LiveBytes, Device->GetMemoryStats().Geometry);
	EXPECT_EQ(Context->Stats.ScratchBytes, Device->GetMemoryStats().Scratch);
	EXPECT_EQ(Context->Stats.PeakBytes, Peak);
	Rock.reset();
	uint32_t Coarse = 0;
	Slots().FreeReleased(Coarse);
	Memory().UpdateStats();
	EXPECT_EQ(Context->Stats.LiveBytes, 0u);
	EXPECT_EQ(Context->Stats.PeakBytes, Peak);
	EXPECT_LT(GetUsed(), Peak);
}

} // namespace
} // namespace Lantern
