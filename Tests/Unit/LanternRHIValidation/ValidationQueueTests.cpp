// Rules of queues: what a list of each takes, and what one queue may still do with a resource that another uses.
#include "Support/ValidationTestTools.h"

namespace Lantern
{
namespace
{

class FValidationQueue : public FValidationFixture
{
protected:
	void SetUp() override
	{
		FValidationFixture::SetUp();
		Source = Make.Buffer(64, ERTMemory::Upload, "Source");
		Middle = Make.Buffer(64, ERTMemory::Device, "Middle");
		Readback = Make.Buffer(64, ERTMemory::Readback, "Readback");
	}
	TRTRef<IRTCommandList> MakeTransferList()
	{
		TRTRef<IRTCommandList> Out;
		EXPECT_OK(Make.Device->CreateCommandList("Transfer", Out.ReleaseAndGetAddress(), ERTQueue::Transfer));
		EXPECT_OK(Out->Begin());
		return Out;
	}
	/// Copies Source to Middle.
	FRTFence Transfer()
	{
		const auto List = MakeTransferList();
		List->CopyBuffer(Middle.Get(), 0, Source.Get(), 0, 64);
		return Make.Submit(List.Get());
	}
	/// A list of the graphics queue that copies Middle to Readback.
	TRTRef<IRTCommandList> MakeReader()
	{
		const auto List = Make.List();
		Barrier(List.Get(), Middle.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::CopyRead);
		return List;
	}

	TRTRef<IRTBuffer> Source, Middle, Readback;
};

TEST_F(FValidationQueue, TransferListsTakeCopiesAlone)
{
	const auto List = MakeTransferList();
	List->FillBuffer(Middle.Get(), 0, 64, 0);
	ExpectMessage({"FillBuffer", "copies between buffers alone"});
	Barrier(List.Get(), Middle.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::ShaderRead);
	ExpectMessage({"Barriers", "copies between buffers alone"});
	List->Dispatch(1, 1, 1);
	ExpectMessage({"Dispatch", "copies between buffers alone"});
	List->CopyBuffer(Middle.Get(), 0, Source.Get(), 0, 64);
	List->KeepAlive(Source.Get());
	Make.Submit(List.Get());
}

TEST_F(FValidationQueue, WhatAnotherQueueWritesMustBeFinished)
{
	Mock->SetManualFences(true);
	const FRTFence Fence = Transfer();
	const auto Early = MakeReader();
	ExpectRefused(Early.Get());
	ExpectMessage({"Barriers", "another queue has not finished with", "'Middle'"});
	Mock->CompleteUpTo(Fence);
	const auto Late = MakeReader();
	Make.Submit(Late.Get());
	Mock->SetManualFences(false);
}

TEST_F(FValidationQueue, BarriersOfMemoryLeaveAloneWhatAnotherQueueWrites)
{
	Mock->SetManualFences(true);
	const FRTFence Fence = Transfer();
	const auto List = Make.List();
	Barrier(List.Get(), nullptr, nullptr, ERTAccess::CopyWrite, ERTAccess::ShaderRead);
	Make.Submit(List.Get());
	Mock->CompleteUpTo(Fence);
	const auto Late = MakeReader(); // it is still in CopyWrite
	Make.Submit(Late.Get());
	Mock->SetManualFences(false);
}

TEST_F(FValidationQueue, ASubmissionIsForOneQueue)
{
	const auto Transfers = MakeTransferList(), Others = Make.List();
	EXPECT_OK(Transfers->End());
	EXPECT_OK(Others->End());
	IRTCommandList* const Lists[] = {Others.Get(), Transfers.Get()};
	EXPECT_EQ(Make.Device->Submit(Lists, 2, nullptr).Code, ERTResult::InvalidArgument);
	ExpectMessage({"Submit", "'Transfer'", "for another queue"});
}

TEST_F(FValidationQueue, FencesAreThoseOfTheirQueue)
{
	const FRTFence Fence = Transfer();
	EXPECT_OK(Make.Device->WaitFor(Fence, 0));
	EXPECT_EQ(Make.Device->WaitFor(MakeFence(ERTQueue::Graphics, 99), 0).Code, ERTResult::InvalidArgument);
	ExpectMessage({"WaitFor", "fence 99"});
	EXPECT_EQ(Make.Device->WaitFor(Fence + 1, 0).Code, ERTResult::InvalidArgument);
	ExpectMessage({"WaitFor"});
}

TEST_F(FValidationQueue, ComputeListsTakeNoRaster)
{
	TRTRef<IRTCommandList> List;
	ASSERT_OK(Make.Device->CreateCommandList("Compute", List.ReleaseAndGetAddress(), ERTQueue::AsyncCompute));
	ASSERT_OK(List->Begin());
	List->BeginRasterPass({});
	ExpectMessage({"BeginRasterPass", "takes no raster"});
	List->FillBuffer(Middle.Get(), 0, 64, 0);
	Make.Submit(List.Get());
}

TEST_F(FValidationQueue, WaitsOnTheDeviceOrderQueues)
{
	Mock->SetManualFences(true);
	TRTRef<IRTCommandList> Compute;
	ASSERT_OK(Make.Device->CreateCommandList("Compute", Compute.ReleaseAndGetAddress(), ERTQueue::AsyncCompute));
	ASSERT_OK(Compute->Begin());
	Compute->CopyBuffer(Middle.Get(), 0, Source.Get(), 0, 64);
	FRTFence Written = Make.Submit(Compute.Get());
	const auto Reader = MakeReader();
	ASSERT_OK(Reader->End());
	IRTCommandList* Raw = Reader.Get();
	EXPECT_FALSE(Make.Device->Submit(&Raw, 1, nullptr));
	ExpectMessage({"another queue has not finished with", "'Middle'"});
	EXPECT_OK(Make.Device->Submit(&Raw, 1, nullptr, &Written, 1));
	const auto Again = Make.List();
	Again->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 64);
	ASSERT_OK(Again->End());
	Raw = Again.Get();
	const FRTFence Unknown = Written + 100;
	EXPECT_FALSE(Make.Device->Submit(&Raw, 1, nullptr, &Unknown, 1));
	ExpectMessage({"wait 0", "no submission has returned"});
	// What the queue has waited for once is finished for all that follows.
	EXPECT_OK(Make.Device->Submit(&Raw, 1, nullptr));
	Mock->SetManualFences(false);
}

} // namespace
} // namespace Lantern
