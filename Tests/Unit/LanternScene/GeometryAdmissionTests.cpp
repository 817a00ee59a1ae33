// FGeometryAdmission: a build starts, waits, is made coarser or is refused.
#include "GeometryMisfitTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryAdmissionTest : public FGeometryMisfitTest
{
protected:
	void SetUp() override
	{
		FGeometryMisfitTest::SetUp();
		Set("r.RT.Build.Compaction", "0"); // a build then needs its own bytes only
	}
	/// Admits a queued geometry. Returns whether the round is to stop.
	bool Admit(const FRTGeometryRef& Geometry, bool bBuildAll = false, uint64_t Share = FGeometryMemoryBudget::Unlimited)
	{
		if (Entry(Geometry).State == EGeometryState::Free) { Context->Queue.Add(Entry(Geometry)); }
		bool bStop = false;
		Status = Admission->Admit(Entry(Geometry), bBuildAll, Share, bStop);
		return bStop;
	}
	EGeometryState GetState(const FRTGeometryRef& Geometry) { return Entry(Geometry).State; }

	FRTStatus Status;
};

constexpr uint32_t Patience = FGeometryAdmission::PatienceFrames;

TEST_F(FGeometryAdmissionTest, WithoutABudgetEverythingIsBuilt)
{
	const FRTGeometryRef Rock = Add("Rock", 100000);
	EXPECT_FALSE(Admit(Rock));
	EXPECT_TRUE(Status);
	EXPECT_EQ(GetState(Rock), EGeometryState::Building);
	EXPECT_EQ(Context->Stats.WaitingForMemory, 0u);
	ASSERT_TRUE(RunCommands());
}

TEST_F(FGeometryAdmissionTest, WhatFitsToTheByteIsBuilt)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	const uint64_t Bytes = GetBuildBytes(Rock);
	FillBudget(4, Bytes - 1);
	EXPECT_FALSE(Admit(Rock));
	EXPECT_EQ(GetState(Rock), EGeometryState::Pending);
	EXPECT_EQ(Entry(Rock).Misfits, 1u);
	EXPECT_EQ(Context->Stats.WaitingForMemory, 1u);
	EmptyBudget();
	FillBudget(4, Bytes);
	EXPECT_FALSE(Admit(Rock));
	EXPECT_EQ(GetState(Rock), EGeometryState::Building);
	EXPECT_EQ(Entry(Rock).Misfits, 0u);
	EXPECT_EQ(Context->Memory.GetRoom(), 0u);
	ASSERT_TRUE(RunCommands());
}

TEST_F(FGeometryAdmissionTest, CopyOfCompactionNeedsRoomToo)
{
	Set("r.RT.Build.Compaction", "1");
	const FRTGeometryRef Rock = Add("Rock", 1000);
	const uint64_t Bytes = GetBuildBytes(Rock);
	FillBudget(4, Bytes);
	for (uint32_t I = 1; I <= Patience; ++I)
	{
		EXPECT_FALSE(Admit(Rock));
		EXPECT_EQ(GetState(Rock), EGeometryState::Pending);
		EXPECT_EQ(Entry(Rock).Misfits, I);
	}
	EXPECT_FALSE(Admit(Rock));
	EXPECT_EQ(GetState(Rock), EGeometryState::Building) << "rather without a copy than never";
	ASSERT_TRUE(RunCommands());
}

TEST_F(FGeometryAdmissionTest, WhatTheNextReleaseMayHelpHoldsOthersBackForAWhile)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	FillBudget(4, 1000);
	for (uint32_t I = 0; I < FGeometryAdmission::MostWaitFrames; ++I)
	{
		NextFrame();
		Context->Memory.NoteRelease();
		EXPECT_TRUE(Admit(Rock)) << I;
		EXPECT_EQ(Entry(Rock).Misfits, 0u);
	}
	EXPECT_FALSE(Admit(Rock));
	EXPECT_EQ(Entry(Rock).Misfits, 1u);
	EXPECT_EQ(GetState(Rock), EGeometryState::Pending);
}

TEST_F(FGeometryAdmissionTest, WhatExceedsTheBudgetHoldsNobodyBack)
{
	Set("r.RT.Build.MemoryMB", "1");
	const FRTGeometryRef Mountain = Add("Mountain", 20000); // 2 MB
	Context->Memory.NoteRelease();
	EXPECT_FALSE(Admit(Mountain));
	EXPECT_EQ(Entry(Mountain).Misfits, 1u);
}

TEST_F(FGeometryAdmissionTest, AfterPatienceItIsRefusedOrMadeCoarser)
{
	const FRTGeometryRef Rock = Add("Rock", 3200), Terrain = AddTerrain("Terrain");
	FillBudget(4, GetBuildBytes(Rock) / 2);
	for (uint32_t I = 0; I < Patience; ++I)
	{
		Admit(Rock);
		Admit(Terrain);
	}
	EXPECT_EQ(GetState(Rock), EGeometryState::Pending);
	EXPECT_EQ(GetState(Terrain), EGeometryState::Pending);
	Admit(Rock);
	Admit(Terrain);
	EXPECT_EQ(GetState(Rock), EGeometryState::Refused);
	EXPECT_EQ(Entry(Rock).RefusedRoom, GetBuildBytes(Rock) / 2);
	EXPECT_EQ(GetState(Terrain), EGeometryState::Coarsening);
	EXPECT_EQ(Refusals->GetCount(), 1u);
	EXPECT_EQ(Coarsener->GetCount(), 1u);
}

TEST_F(FGeometryAdmissionTest, BuildAllMakesItCoarserAtOnce)
{
	const FRTGeometryRef Rock = Add("Rock", 3200), Terrain = AddTerrain("Terrain");
	FillBudget(4, GetBuildBytes(Terrain) / 2);
	Context->Memory.NoteRelease();
	EXPECT_FALSE(Admit(Rock, true)) << "nothing waits";
	EXPECT_EQ(GetState(Rock), EGeometryState::Refused);
	EXPECT_FALSE(Admit(Terrain, true));
	EXPECT_TRUE(Status);
	EXPECT_EQ(GetState(Terrain), EGeometryState::Building);
	EXPECT_TRUE(Terrain->IsCoarse());
	EXPECT_EQ(Coarsener->GetCount(), 0u);
	EXPECT_LE(GetUsed(), 4u << 20);
	ASSERT_TRUE(RunCommands());
	EXPECT_TRUE(Mock().GetGeometry(Terrain->GetStructure()).IsUsable());
}

TEST_F(FGeometryAdmissionTest, CoarserGeometryLeavesTheQueueWhenItIsBuilt)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	FillBudget(4, GetBuildBytes(Terrain) / 2);
	Context->Queue.Add(Entry(Terrain));
	const FRTStatus Run = Context->Queue.Run({FrameNumber, true, true}, [&](FGeometryEntry& Item, size_t, bool& bOutStop) {
		return Admission->Admit(Item, true, FGeometryMemoryBudget::Unlimited, bOutStop);
	});
	EXPECT_TRUE(Run);
	EXPECT_EQ(GetState(Terrain), EGeometryState::Building);
	EXPECT_TRUE(Context->Queue.IsEmpty());
	ASSERT_TRUE(RunCommands());
}

TEST_F(FGeometryAdmissionTest, ShareIsALimitOfItsOwn)
{
	Set("r.RT.Build.MemoryMB", "4");
	const FRTGeometryRef A = Add("A", 1000), B = Add("B", 1000);
	const uint64_t Bytes = GetBuildBytes(A);
	Admit(A, true, Bytes - 1);
	EXPECT_EQ(GetState(A), EGeometryState::Refused);
	EXPECT_EQ(Entry(A).RefusedRoom, Bytes - 1);
	Admit(B, true, Bytes);
	EXPECT_EQ(GetState(B), EGeometryState::Building);
	ASSERT_TRUE(RunCommands());
}

TEST_F(FGeometryAdmissionTest, OutOfDeviceMemoryIsAMisfitExceptWithBuildAll)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	Mock().FailAllocation(1);
	EXPECT_FALSE(Admit(Rock));
	EXPECT_TRUE(Status);
	EXPECT_EQ(GetState(Rock), EGeometryState::Pending);
	EXPECT_EQ(Entry(Rock).Misfits, 1u);
	EXPECT_EQ(Context->Stats.WaitingForMemory, 1u);
	Mock().FailAllocation(1);
	Admit(Rock, true);
	EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(GetState(Rock), EGeometryState::Pending);
	EXPECT_EQ(Entry(Rock).Misfits, 1u);
	Admit(Rock, true);
	EXPECT_TRUE(Status);
	EXPECT_EQ(GetState(Rock), EGeometryState::Building);
	ASSERT_TRUE(RunCommands());
}

} // namespace
} // namespace Lantern
