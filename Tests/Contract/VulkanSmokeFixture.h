// What the Vulkan smoke tests share: a device with validation on, and short ways to fill and read its resources.
#pragma once

#include "LanternRHIVulkan/VulkanDevice.h"
#include "Support/StatusChecks.h"
#include "Support/WaitTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <dlfcn.h>

namespace Lantern
{

template <size_t Count>
FRTShaderCode MakeCode(const uint32_t (&Words)[Count], ERTShaderStage Stage, const char* Name)
{
	return {Words, Count, Stage, Name};
}

class FVulkanSmokeTest : public ::testing::Test
{
protected:
	static void SetUpTestSuite()
	{
		// Its synchronization validation keeps memory until the process ends. Unloaded with the instance, nobody could tell
		// whose memory that is, and the leak checker would blame us.
		dlopen("libVkLayer_khronos_validation.so", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
	}

	void SetUp() override
	{
		FRTVulkanDeviceDesc Desc;
		// A machine with a driver alone, without the layers, can still run the tests.
		Desc.bValidation = !getenv("LANTERN_TEST_WITHOUT_LAYERS");
		Desc.bSynchronizationValidation = Desc.bValidation;
		Change(Desc);
		const FRTStatus Status = CreateVulkanDevice(Desc, Device.ReleaseAndGetAddress());
		if (!Status && getenv("LANTERN_ALLOW_NO_DRIVER")) { GTEST_SKIP() << Status.Message; }
		ASSERT_TRUE(Status.IsOk()) << Status.Message << "\n(set LANTERN_ALLOW_NO_DRIVER to skip)";
		ASSERT_OK(Device->CreateCommandList("Smoke", List.ReleaseAndGetAddress()));
	}

	void TearDown() override
	{
		if (Device)
		{
			EXPECT_TRUE(Device->WaitIdle().IsOk());
			if (bCountsMessages) { EXPECT_EQ(Device->GetValidationMessageCount(), 0u); }
		}
	}

	virtual void Change(FRTVulkanDeviceDesc&) {}

	TRTRef<IRTBuffer> MakeBuffer(uint64_t Size, ERTBufferUsage Usage, ERTMemory Memory, const char* Name)
	{
		TRTRef<IRTBuffer> Buffer;
		const FRTStatus Status = Device->CreateBuffer({Size, Usage, Memory, Name}, Buffer.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Buffer;
	}

	template <class T>
	TRTRef<IRTBuffer> MakeUpload(const std::vector<T>& Items, ERTBufferUsage Usage, const char* Name)
	{
		TRTRef<IRTBuffer> Buffer = MakeBuffer(Items.size() * sizeof(T), Usage, ERTMemory::Upload, Name);
		memcpy(Buffer->GetMapped(), Items.data(), Items.size() * sizeof(T));
		return Buffer;
	}

	template <size_t Count>
	TRTRef<IRTPipeline> MakeCompute(const uint32_t (&Words)[Count], const char* Name)
	{
		TRTRef<IRTPipeline> Pipeline;
		const FRTStatus Status =
		    Device->CreateComputePipeline({MakeCode(Words, ERTShaderStage::Compute, Name), Name}, Pipeline.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Pipeline;
	}

	void Barrier(ERTAccess Before, ERTAccess After, IRTTexture* Texture = nullptr)
	{
		FRTBarrier Item;
		Item.Texture = Texture;
		Item.Before = Before;
		Item.After = After;
		List->Barriers(&Item, 1);
	}

	/// Ends the list, runs it and waits.
	void Run()
	{
		ASSERT_OK(List->End());
		IRTCommandList* Lists[] = {List.Get()};
		FRTFence Fence = 0;
		ASSERT_OK(Device->Submit(Lists, 1, &Fence));
		ASSERT_OK(Device->WaitFor(Fence, WaitLimitNs));
	}

	TRTRef<IRTDevice> Device;
	TRTRef<IRTCommandList> List;
	bool bCountsMessages = true; ///< any message fails the test
};

} // namespace Lantern
