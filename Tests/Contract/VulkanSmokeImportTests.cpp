// Images of an engine that are not what it says: refused by name as far as Vulkan lets anyone know.
#include "VulkanSmokeEngine.h"

namespace Lantern
{
namespace
{

class FVulkanSmokeImport : public FVulkanSmokeTest
{
protected:
	void SetUp() override
	{
		FVulkanSmokeTest::SetUp();
		if (IsSkipped() || HasFatalFailure()) { return; }
		ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, Device->GetCapabilities().DeviceName));
		ASSERT_OK(GetVulkanRequirements(Engine.DescribeRequirements(), Requirements.ReleaseAndGetAddress()));
		ASSERT_TRUE(Engine.CreateDevice(Requirements->MergeFeatures(), Requirements->GetExtensionCount(), Requirements->GetExtensions()));
		ASSERT_OK(AdoptVulkanDevice(Engine.Describe(Requirements.Get()), Adopted.ReleaseAndGetAddress()));
	}
	void TearDown() override
	{
		Adopted.Reset();
		for (const auto& [Image, Memory] : Images)
		{
			Engine.Get<PFN_vkDestroyImage>("vkDestroyImage")(Engine.Device, Image, nullptr);
			Engine.Get<PFN_vkFreeMemory>("vkFreeMemory")(Engine.Device, Memory, nullptr);
		}
		EXPECT_EQ(Engine.Messages, "");
		FVulkanSmokeTest::TearDown();
	}
	/// An image of the engine's, with memory of the first type that it allows.
	uint64_t MakeImage(VkFormat Format, uint32_t Width, uint32_t Height, VkImageUsageFlags Usage)
	{
		VkImageCreateInfo Info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
		Info.imageType = VK_IMAGE_TYPE_2D;
		Info.format = Format;
		Info.extent = {Width, Height, 1};
		Info.mipLevels = Info.arrayLayers = 1;
		Info.samples = VK_SAMPLE_COUNT_1_BIT;
		Info.usage = Usage | VK_IMAGE_USAGE_SAMPLED_BIT;
		auto& [Image, Memory] = Images.emplace_back();
		EXPECT_EQ(Engine.Get<PFN_vkCreateImage>("vkCreateImage")(Engine.Device, &Info, nullptr, &Image), VK_SUCCESS);
		VkMemoryRequirements Needs;
		Engine.Get<PFN_vkGetImageMemoryRequirements>("vkGetImageMemoryRequirements")(Engine.Device, Image, &Needs);
		uint32_t Type = 0;
		while ((Needs.memoryTypeBits >> Type & 1) == 0) { ++Type; }
		const VkMemoryAllocateInfo Allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, Needs.size, Type};
		EXPECT_EQ(Engine.Get<PFN_vkAllocateMemory>("vkAllocateMemory")(Engine.Device, &Allocation, nullptr, &Memory), VK_SUCCESS);
		Engine.Get<PFN_vkBindImageMemory>("vkBindImageMemory")(Engine.Device, Image, Memory, 0);
		return (uint64_t)Image;
	}
	FRTStatus Import(const FRTTextureDesc& Desc, uint64_t Image)
	{
		return Adopted->ImportTexture(Desc, Image, Texture.ReleaseAndGetAddress());
	}
	void ExpectRefused(const FRTTextureDesc& Desc, uint64_t Image, std::initializer_list<const char*> Parts)
	{
		const FRTStatus Status = Import(Desc, Image);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		for (const char* Part : Parts) { EXPECT_NE(strstr(Status.Message, Part), nullptr) << Status.Message; }
		EXPECT_FALSE(Texture);
	}

	static constexpr FRTTextureDesc Good{320, 180, 1, 1, ERTFormat::D32_FLOAT, ERTTextureUsage::Sampled, "Depth"};
	FEngine Engine;
	TRTRef<IRTVulkanRequirements> Requirements;
	TRTRef<IRTDevice> Adopted;
	TRTRef<IRTTexture> Texture;
	std::vector<std::pair<VkImage, VkDeviceMemory>> Images;
};

TEST_F(FVulkanSmokeImport, DepthWithStencilIsNotTakenForDepthAlone)
{
	const VkImageUsageFlags Usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
	const uint64_t Stencil = MakeImage(VK_FORMAT_D32_SFLOAT_S8_UINT, 320, 180, Usage);
	ExpectRefused(Good, Stencil, {"'Depth'", "FRTTextureDesc::Format is D32_SFLOAT", "D32_SFLOAT_S8_UINT"});
	// Depth alone is taken, however an engine uses it.
	for (const VkImageUsageFlags More : {VkImageUsageFlags(0), VkImageUsageFlags(VK_IMAGE_USAGE_TRANSFER_SRC_BIT),
	         VkImageUsageFlags(VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT)})
	{
		ASSERT_OK(Import(Good, MakeImage(VK_FORMAT_D32_SFLOAT, 320, 180, Usage | More)));
		Texture.Reset();
		Adopted->CollectGarbage();
	}
}

TEST_F(FVulkanSmokeImport, AnImageThatIsTooSmallIsRefused)
{
	const uint64_t Small = MakeImage(VK_FORMAT_D32_SFLOAT, 160, 90, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
	ExpectRefused(Good, Small, {"FRTTextureDesc says 320 x 180", "230400 bytes"});
	FRTTextureDesc Wide = Good;
	Wide.Format = ERTFormat::RGBA16_SNORM;
	ExpectRefused(Wide, MakeImage(VK_FORMAT_R8G8B8A8_SNORM, 320, 180, 0), {"460800 bytes"});
}

TEST_F(FVulkanSmokeImport, ImpossibleDescriptionsAreRefusedByField)
{
	const uint64_t Image = MakeImage(VK_FORMAT_D32_SFLOAT, 320, 180, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
	ExpectRefused(Good, 0, {"NativeImage is null"});
	const auto Refuse = [&](auto Member, auto Value, const char* Name) {
		FRTTextureDesc Desc = Good;
		Desc.*Member = Value;
		ExpectRefused(Desc, Image, {Name});
	};
	for (const uint32_t Count : {0u, ~0u})
	{
		Refuse(&FRTTextureDesc::Width, Count, "FRTTextureDesc::Width");
		Refuse(&FRTTextureDesc::Height, Count, "FRTTextureDesc::Height");
		Refuse(&FRTTextureDesc::MipCount, Count, "FRTTextureDesc::MipCount");
		Refuse(&FRTTextureDesc::ArraySize, Count, "FRTTextureDesc::ArraySize");
	}
	Refuse(&FRTTextureDesc::Format, ERTFormat::Unknown, "FRTTextureDesc::Format");
	TRTRef<IRTCommandList> None;
	const FRTStatus Status = Adopted->ImportCommandList(0, None.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_NE(strstr(Status.Message, "NativeCommandBuffer"), nullptr);
	ASSERT_OK(Import(Good, Image));
	Texture.Reset();
	Adopted->CollectGarbage();
}

} // namespace
} // namespace Lantern
