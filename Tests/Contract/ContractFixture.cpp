// Devices of the corpus, and what must be true when a test ends.
#include "ContractFixture.h"

#include "LanternRHIMock/MockDevice.h"
#include "LanternRHIValidation/ValidationDevice.h"
#include "LanternRHIVulkan/VulkanDevice.h"

#include <algorithm>
#include <cstdlib>

namespace Lantern
{

std::string GetName(EContractRHI Which)
{
	static constexpr const char* Names[] = {"Mock", "MockValidated", "Vulkan", "VulkanValidated"};
	return Names[static_cast<size_t>(Which)];
}

void FContractFixture::AddMessage(const char* Message)
{
	std::lock_guard Lock(Mutex);
	Messages.push_back(Message);
}

void FContractFixture::SetUp()
{
	if (IsVulkan())
	{
		FRTVulkanDeviceDesc Desc;
		// Some machines have a driver and no layers.
		Desc.bValidation = std::getenv("LANTERN_TEST_WITHOUT_LAYERS") == nullptr;
		Desc.MessageUser = this;
		Desc.MessageCallback = [](void* User, ERTVulkanMessage Severity, const char* Text) {
			if (Severity != ERTVulkanMessage::Info) { static_cast<FContractFixture*>(User)->AddMessage(Text); }
		};
		ASSERT_OK(CreateVulkanDevice(Desc, Inner.ReleaseAndGetAddress()));
	}
	else { ASSERT_OK(CreateMockDevice({.bTransferQueue = true}, Inner.ReleaseAndGetAddress())); }
	const bool bWrap = GetParam() == EContractRHI::MockValidated || GetParam() == EContractRHI::VulkanValidated;
	const auto Callback = [](void* User, const char* Text) { static_cast<FContractFixture*>(User)->AddMessage(Text); };
	if (bWrap) { ASSERT_OK(WrapWithValidation(Inner.Get(), Callback, this, Make.Device.ReleaseAndGetAddress())); }
	else { Make.Device = Inner; }
}

void FContractFixture::TearDown()
{
	if (!Inner) { return; }
	EXPECT_OK(Inner->WaitIdle());
	Inner->CollectGarbage();
	EXPECT_EQ(Inner->GetValidationMessageCount(), 0u);
	EXPECT_EQ(Inner->GetMemoryStats().Total, 0u) << "the test released everything, the device did not";
	if (!IsVulkan())
	{
		EXPECT_EQ(GetMock(Inner.Get()).GetLiveObjects(), std::vector<std::string>());
		EXPECT_EQ(GetMock(Inner.Get()).GetErrors(), std::vector<std::string>());
	}
	Make.Device.Reset();
	Inner.Reset();
	// Destroying the device may have brought messages too, about leaks.
	for (const std::string& Message : Messages) { ADD_FAILURE() << Message; }
}

std::vector<uint8_t> FContractFixture::Read(IRTTexture* Texture, ERTAccess Access, uint32_t Mip, uint32_t Layer)
{
	const FRTTextureDesc& Desc = Texture->GetDesc();
	const uint64_t Bytes =
	    static_cast<uint64_t>(std::max(1u, Desc.Width >> Mip)) * std::max(1u, Desc.Height >> Mip) * BytesPerTexel(Desc.Format);
	const auto Readback = Make.Buffer(Bytes, ERTMemory::Readback, "Readback");
	const auto List = Make.List("Read");
	if (Access != ERTAccess::CopyRead) { Barrier(List.Get(), Texture, Access, ERTAccess::CopyRead); }
	List->CopyTextureToBuffer(Readback.Get(), 0, Texture, Mip, Layer);
	if (Access != ERTAccess::CopyRead) { Barrier(List.Get(), Texture, ERTAccess::CopyRead, Access); }
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Run(List.Get());
	const auto* Begin = static_cast<const uint8_t*>(Readback->GetMapped());
	return {Begin, Begin + Bytes};
}

namespace
{

std::string GetParamName(const testing::TestParamInfo<EContractRHI>& Info) { return GetName(Info.param); }

INSTANTIATE_TEST_SUITE_P(RHI, FContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated), GetParamName);
INSTANTIATE_TEST_SUITE_P(RHI, FContractShaders, testing::Values(EContractRHI::Vulkan, EContractRHI::VulkanValidated), GetParamName);

} // namespace
} // namespace Lantern
