// One corpus for every RHI. CONTRACT_TEST runs a test on the mock and on Vulkan, each alone and behind the validation wrapper.
// CONTRACT_SHADER_TEST is for tests that need shaders to run, on Vulkan only. Whatever a test does, at its end no validation may
// have said anything, and nothing may be left over.
#pragma once

#include "Support/RHIMaker.h"
#include "Support/WaitTools.h"

#include <mutex>
#include <string>
#include <vector>

namespace Lantern
{

enum class EContractRHI : uint8_t
{
	Mock,
	MockValidated,
	Vulkan,
	VulkanValidated,
};

std::string GetName(EContractRHI Which);

class FContractFixture : public testing::TestWithParam<EContractRHI>
{
protected:
	void SetUp() override;
	void TearDown() override;

	IRTDevice& Device() { return *Make.Device; }
	const FRTCapabilities& Caps() { return Make.Device->GetCapabilities(); }
	/// Says whether this is the mock without the wrapper, whose memory and tables can be looked into.
	bool IsMock() const { return GetParam() == EContractRHI::Mock; }
	bool IsVulkan() const { return GetParam() >= EContractRHI::Vulkan; }
	void Wait(FRTFence Fence) { EXPECT_OK(Device().WaitFor(Fence, WaitLimitNs)); }
	/// Ends the list, submits it and waits.
	void Run(IRTCommandList* List) { Wait(Make.Submit(List)); }
	static void Barrier(IRTCommandList* List, IRTBuffer* Buffer, ERTAccess Before, ERTAccess After)
	{
		const FRTBarrier Item = {Buffer, nullptr, Before, After};
		List->Barriers(&Item, 1);
	}
	static void Barrier(IRTCommandList* List, IRTTexture* Texture, ERTAccess Before, ERTAccess After)
	{
		const FRTBarrier Item = {nullptr, Texture, Before, After};
		List->Barriers(&Item, 1);
	}
	/// Makes an Upload buffer with these bytes.
	TRTRef<IRTBuffer> Upload(const void* Bytes, uint64_t Size, const char* Name = "Upload")
	{
		auto Buffer = Make.Buffer(Size, ERTMemory::Upload, Name);
		std::memcpy(Buffer->GetMapped(), Bytes, Size);
		return Buffer;
	}
	template <class T>
	TRTRef<IRTBuffer> Upload(const std::vector<T>& Items, const char* Name = "Upload")
	{
		return Upload(Items.data(), Items.size() * sizeof(T), Name);
	}
	/// Reads the bytes of one mip and layer. The texture is in Access and stays there.
	std::vector<uint8_t> Read(IRTTexture* Texture, ERTAccess Access, uint32_t Mip = 0, uint32_t Layer = 0);

	FRHIMaker Make;

private:
	void AddMessage(const char* Message);

	std::mutex Mutex;
	std::vector<std::string> Messages;
	TRTRef<IRTDevice> Inner;
};

class FContract : public FContractFixture
{};

/// Devices on which shaders run.
class FContractShaders : public FContractFixture
{};

#define CONTRACT_TEST(Name) TEST_P(FContract, Name)
#define CONTRACT_SHADER_TEST(Name) TEST_P(FContractShaders, Name)

} // namespace Lantern
