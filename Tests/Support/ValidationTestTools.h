// A mock behind the validation wrapper, and what the wrapper said.
#pragma once

#include "LanternRHIValidation/ValidationDevice.h"
#include "MockTestTools.h"

#include <gmock/gmock.h>

namespace Lantern
{

class FValidationFixture : public testing::Test
{
protected:
	void SetUp() override
	{
		FRTMockDesc Desc;
		Desc.MaxPushConstantBytes = 128;
		Desc.bTransferQueue = true;
		ASSERT_OK(CreateMockDevice(Desc, Inner.ReleaseAndGetAddress()));
		const auto Callback = [](void* User, const char* Message) { static_cast<FValidationFixture*>(User)->Messages.push_back(Message); };
		ASSERT_OK(WrapWithValidation(Inner.Get(), Callback, this, Make.Device.ReleaseAndGetAddress()));
		Mock = &GetMock(Inner.Get());
	}
	void TearDown() override { EXPECT_THAT(Messages, testing::IsEmpty()) << "messages that the test did not expect"; }

	/// Exactly one message so far, containing all parts; forgets it.
	void ExpectMessage(std::initializer_list<const char*> Parts)
	{
		ASSERT_EQ(Messages.size(), 1u) << testing::PrintToString(Messages) << ", expected one with " << *Parts.begin();
		for (const char* Part : Parts) { EXPECT_THAT(Messages[0], testing::HasSubstr(Part)); }
		Messages.clear();
	}
	/// Calls of this kind that reached the wrapped device.
	uint32_t Reached(ERTMockCall Kind) const { return Mock->CountCalls(Kind); }
	/// Ends and submits; the submission must be refused.
	void ExpectRefused(IRTCommandList* List)
	{
		const uint32_t Before = Reached(ERTMockCall::Submit);
		EXPECT_OK(List->End());
		EXPECT_EQ(Make.Device->Submit(&List, 1, nullptr).Code, ERTResult::InvalidArgument);
		EXPECT_EQ(Reached(ERTMockCall::Submit), Before);
	}
	static void Barrier(IRTCommandList* List, IRTBuffer* Buffer, IRTTexture* Texture, ERTAccess Before, ERTAccess After)
	{
		const FRTBarrier Item = {Buffer, Texture, Before, After};
		List->Barriers(&Item, 1);
	}

	std::vector<std::string> Messages;
	TRTRef<IRTDevice> Inner;
	FMockMaker Make;
	FRTMock* Mock = nullptr;
};

} // namespace Lantern
