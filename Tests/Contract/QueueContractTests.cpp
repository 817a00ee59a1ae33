// Queues: what each takes, and that their fences are apart.
#include "ContractFixture.h"

namespace Lantern
{
namespace
{

CONTRACT_TEST(TransferQueueCopiesBesideTheFrame)
{
	TRTRef<IRTCommandList> Transfer;
	const FRTStatus Created = Device().CreateCommandList("Transfer", Transfer.ReleaseAndGetAddress(), ERTQueue::Transfer);
	if (!Caps().bTransferQueue)
	{
		EXPECT_EQ(Created.Code, ERTResult::Unsupported);
		EXPECT_FALSE(Transfer);
		return;
	}
	ASSERT_OK(Created);
	std::vector<uint32_t> Values(256);
	for (uint32_t i = 0; i < 256; ++i) { Values[i] = i * i; }
	const auto Source = Upload(Values);
	const auto Middle = Make.Buffer(1024), Readback = Make.Buffer(1024, ERTMemory::Readback);
	ASSERT_OK(Transfer->Begin());
	Transfer->CopyBuffer(Middle.Get(), 0, Source.Get(), 0, 512);
	const FRTBufferRegion Region{512, 512, 512};
	Transfer->CopyBufferRegions(Middle.Get(), Source.Get(), &Region, 1);
	const FRTFence Copied = Make.Submit(Transfer.Get());
	EXPECT_EQ(GetFenceQueue(Copied), ERTQueue::Transfer);
	Wait(Copied);
	EXPECT_GE(Device().GetCompletedFence(ERTQueue::Transfer), Copied);

	const auto List = Make.List();
	Barrier(List.Get(), Middle.Get(), ERTAccess::CopyWrite, ERTAccess::CopyRead);
	List->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 1024);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Run(List.Get());
	EXPECT_EQ(std::memcmp(Readback->GetMapped(), Values.data(), 1024), 0);
	ASSERT_OK(Transfer->Begin()); // once more: its submission has finished
	ASSERT_OK(Transfer->End());
}

CONTRACT_TEST(FencesOfQueuesAreApart)
{
	const FRTFence First = Make.Submit(Make.List().Get());
	EXPECT_EQ(GetFenceQueue(First), ERTQueue::Graphics);
	if (!Caps().bTransferQueue) { return; }
	std::vector<FRTFence> Fences;
	for (int Round = 0; Round < 8; ++Round)
	{
		TRTRef<IRTCommandList> List;
		ASSERT_OK(Device().CreateCommandList("Transfer", List.ReleaseAndGetAddress(), ERTQueue::Transfer));
		ASSERT_OK(List->Begin());
		const auto From = Upload(std::vector<uint32_t>(64, Round)), To = Make.Buffer(256);
		List->CopyBuffer(To.Get(), 0, From.Get(), 0, 256);
		Fences.push_back(Make.Submit(List.Get()));
		if (Round % 2 == 0) { Make.Submit(Make.List().Get()); }
	} // what the lists use is released before they have run
	for (size_t I = 1; I < Fences.size(); ++I) { EXPECT_GT(Fences[I], Fences[I - 1]); }
	Wait(Fences.front());
	Wait(Fences.back());
	EXPECT_OK(Device().WaitIdle());
}

/// There and back: each queue reads what the other has written, ordered by waits alone.
CONTRACT_TEST(QueuesWaitForEachOtherOnTheDevice)
{
	TRTRef<IRTCommandList> Compute;
	const FRTStatus Created = Device().CreateCommandList("Compute", Compute.ReleaseAndGetAddress(), ERTQueue::AsyncCompute);
	if (!Caps().bAsyncComputeQueue)
	{
		EXPECT_EQ(Created.Code, ERTResult::Unsupported);
		return;
	}
	ASSERT_OK(Created);
	const std::vector<uint32_t> Values = {3, 1, 4, 1, 5, 9, 2, 6};
	const auto Source = Upload(Values);
	const auto A = Make.Buffer(32), B = Make.Buffer(32), Readback = Make.Buffer(32, ERTMemory::Readback);
	const auto First = Make.List();
	First->CopyBuffer(A.Get(), 0, Source.Get(), 0, 32);
	const FRTFence Written = Make.Submit(First.Get());

	ASSERT_OK(Compute->Begin());
	const FRTBarrier Taken{A.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::CopyRead, true};
	Compute->Barriers(&Taken, 1);
	Compute->CopyBuffer(B.Get(), 0, A.Get(), 0, 32);
	ASSERT_OK(Compute->End());
	IRTCommandList* Raw = Compute.Get();
	FRTFence Copied = 0;
	ASSERT_OK(Device().Submit(&Raw, 1, &Copied, &Written, 1));
	EXPECT_EQ(GetFenceQueue(Copied), ERTQueue::AsyncCompute);

	const auto Last = Make.List();
	const FRTBarrier Back{B.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::CopyRead, true};
	Last->Barriers(&Back, 1);
	Last->CopyBuffer(Readback.Get(), 0, B.Get(), 0, 32);
	Barrier(Last.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_OK(Last->End());
	Raw = Last.Get();
	FRTFence Done = 0;
	ASSERT_OK(Device().Submit(&Raw, 1, &Done, &Copied, 1));
	Wait(Done);
	EXPECT_EQ(std::memcmp(Readback->GetMapped(), Values.data(), 32), 0);
	EXPECT_GE(Device().GetCompletedFence(ERTQueue::AsyncCompute), Copied) << "the last list waited for it";
}

/// A texture that one queue stores to and the other reads back.
CONTRACT_TEST(TexturesChangeQueues)
{
	if (!Caps().bAsyncComputeQueue) { return; }
	const auto Texture = Make.Texture(4, 4, ERTFormat::R32_FLOAT, 1, ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest);
	TRTRef<IRTCommandList> Compute;
	ASSERT_OK(Device().CreateCommandList("Compute", Compute.ReleaseAndGetAddress(), ERTQueue::AsyncCompute));
	ASSERT_OK(Compute->Begin());
	const std::vector<float> Values(16, 2.5f);
	const auto Source = Upload(Values);
	Barrier(Compute.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	Compute->CopyBufferToTexture(Texture.Get(), 0, 0, Source.Get(), 0);
	const FRTFence Written = Make.Submit(Compute.Get());
	const auto Readback = Make.Buffer(64, ERTMemory::Readback);
	const auto List = Make.List();
	const FRTBarrier Taken{nullptr, Texture.Get(), ERTAccess::CopyWrite, ERTAccess::CopyRead, true};
	List->Barriers(&Taken, 1);
	List->CopyTextureToBuffer(Readback.Get(), 0, Texture.Get(), 0, 0);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_OK(List->End());
	IRTCommandList* Raw = List.Get();
	FRTFence Done = 0;
	ASSERT_OK(Device().Submit(&Raw, 1, &Done, &Written, 1));
	Wait(Done);
	EXPECT_EQ(std::memcmp(Readback->GetMapped(), Values.data(), 64), 0);
}

} // namespace
} // namespace Lantern
