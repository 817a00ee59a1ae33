// What the GPU leaves for the CPU arrives after a fixed number of frames, each once, and nothing of frames that never ran.
#include "Feedback/ReadbackRing.h"
#include "LanternRHIMock/MockDevice.h"
#include <gtest/gtest.h>
#include <vector>

namespace Lantern
{
namespace
{

class FReadbackRingTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		ASSERT_TRUE(CreateMockDevice({}, Device.ReleaseAndGetAddress()));
		Ring = std::make_unique<FRing>(*Device, "Test", ERTBufferUsage::CopyDest);
	}
	/// A frame that writes Value; returns what arrived at its start.
	std::vector<int> Frame(int Value, bool bWrites = true, bool bSubmitted = true)
	{
		std::vector<int> Arrived;
		Ring->BeginFrame(Index++, [&](const FRing::FEntry& Entry) { Arrived.push_back(Entry.Notes); });
		if (bWrites)
		{
			FRTStatus Status;
			FRing::FEntry* const Entry = Ring->Write(64, Status);
			EXPECT_TRUE(Entry && Status);
			if (Entry) { Entry->Notes = Value; }
		}
		Ring->EndFrame(bSubmitted);
		return Arrived;
	}

	using FRing = TReadbackRing<int>;
	TRTRef<IRTDevice> Device;
	std::unique_ptr<FRing> Ring;
	uint32_t Index = 0;
};

using FInts = std::vector<int>;

TEST_F(FReadbackRingTest, ArrivesAfterAFixedNumberOfFrames)
{
	for (int I = 0; I < static_cast<int>(FRing::FramesInFlight); ++I) { EXPECT_EQ(Frame(I), FInts{}); }
	for (int I = static_cast<int>(FRing::FramesInFlight); I < 10; ++I)
	{
		EXPECT_EQ(Frame(I), FInts{I - static_cast<int>(FRing::FramesInFlight)});
	}
}

TEST_F(FReadbackRingTest, FramesThatWriteNothingLeaveNothing)
{
	Frame(1);
	Frame(2, false);
	EXPECT_EQ(Frame(3), FInts{1});
	EXPECT_EQ(Frame(4), FInts{});
	EXPECT_EQ(Frame(5), FInts{3});
}

TEST_F(FReadbackRingTest, FramesThatNeverRanLeaveNothing)
{
	Frame(1, true, false);
	Frame(2);
	EXPECT_EQ(Frame(3), FInts{});
	EXPECT_EQ(Frame(4), FInts{2});
}

TEST_F(FReadbackRingTest, TakeAllGivesTheRestOldestFirstAndOnce)
{
	Frame(1);
	Frame(2);
	FInts Rest;
	const auto Take = [&](const FRing::FEntry& Entry) { Rest.push_back(Entry.Notes); };
	Ring->TakeAll(Take);
	EXPECT_EQ(Rest, (FInts{1, 2}));
	Ring->TakeAll(Take);
	EXPECT_EQ(Rest, (FInts{1, 2}));
	EXPECT_EQ(Frame(3), FInts{});
}

TEST_F(FReadbackRingTest, BuffersGrowAndAreKept)
{
	Frame(1);
	Ring->BeginFrame(0, [](const FRing::FEntry&) {});
	FRTStatus Status;
	IRTBuffer* const Small = Ring->Write(64, Status)->Buffer.Get();
	EXPECT_EQ(Ring->Write(32, Status)->Buffer.Get(), Small);
	EXPECT_GE(Ring->Write(4096, Status)->Buffer->GetDesc().Size, 4096u);
	EXPECT_TRUE(Status);
}

} // namespace
} // namespace Lantern
