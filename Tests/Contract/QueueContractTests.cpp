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

} // namespace
} // namespace Lantern
