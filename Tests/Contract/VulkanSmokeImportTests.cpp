// Images of an engine that are not what it says: refused by name as far as Vulkan lets anyone know.
#include "VulkanSmokeEngine.h"

#include <cmath>

#include "VulkanSmokeShaders/Sample_comp.h"

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
		ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, Device->GetCapabilities().DeviceName, Requirements));
		ASSERT_OK(AdoptVulkanDevice(Engine.Describe(Requirements.Get()), Adopted.ReleaseAndGetAddress()));
	}
	void TearDown() override
	{
		// The engine outlives what Lantern holds of it.
		Own.Reset();
		Texture.Reset();
		Pipeline.Reset();
		Output.Reset();
		List.Reset();
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
	uint64_t MakeImage(VkFormat Format, uint32_t Width, uint32_t Height, VkImageUsageFlags Usage, uint32_t Mips = 1)
	{
		VkImageCreateInfo Info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
		Info.imageType = VK_IMAGE_TYPE_2D;
		Info.format = Format;
		Info.extent = {Width, Height, 1};
		Info.mipLevels = Mips;
		Info.arrayLayers = 1;
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

	void RunAdopted()
	{
		ASSERT_OK(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		ASSERT_OK(Adopted->Submit(Lists, 1, &Fence));
		ASSERT_OK(Adopted->WaitFor(Fence, WaitLimitNs));
	}
	/// Red of the first two mips, as Sampler finds it, from 0 to 1.
	void Sample(IRTSampler* Sampler, float (&Out)[2])
	{
		const FRTComputePipelineDesc Desc{MakeCode(Smoke_Sample_comp, ERTShaderStage::Compute, "Sample"), "Sample"};
		ASSERT_OK(Adopted->CreateComputePipeline(Desc, Pipeline.ReleaseAndGetAddress()));
		ASSERT_OK(Adopted->CreateBuffer({32, ERTBufferUsage::Storage, ERTMemory::Readback, "Output"}, Output.ReleaseAndGetAddress()));
		ASSERT_OK(Adopted->CreateCommandList("Sample", List.ReleaseAndGetAddress()));
		ASSERT_OK(List->Begin());
		List->SetPipeline(Pipeline.Get());
		const struct
		{
			uint64_t Address;
			uint32_t Texture, Sampler;
		} Push = {Output->GetDeviceAddress(), Texture->GetSampledIndex(), Sampler->GetIndex()};
		List->PushConstants(&Push, sizeof(Push));
		List->Dispatch(2, 1, 1);
		Barrier(ERTAccess::StorageWrite, ERTAccess::HostRead);
		ASSERT_NO_FATAL_FAILURE(RunAdopted());
		for (uint32_t Mip = 0; Mip < 2; ++Mip) { Out[Mip] = static_cast<const float*>(Output->GetMapped())[Mip * 4]; }
	}

	static constexpr FRTTextureDesc Good{320, 180, 1, 1, ERTFormat::D32_FLOAT, ERTTextureUsage::Sampled, "Depth"};
	FEngine Engine;
	TRTRef<IRTVulkanRequirements> Requirements;
	TRTRef<IRTDevice> Adopted;
	TRTRef<IRTTexture> Texture;
	TRTRef<IRTSampler> Own;
	TRTRef<IRTPipeline> Pipeline;
	TRTRef<IRTBuffer> Output;
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

/// Views and samplers of the engine's, which differ from those that Lantern would make.
class FVulkanSmokeNative : public FVulkanSmokeImport
{
protected:
	void SetUp() override
	{
		FVulkanSmokeImport::SetUp();
		if (IsSkipped() || HasFatalFailure()) { return; }
		Image = (VkImage)MakeImage(VK_FORMAT_R8G8B8A8_UNORM, 2, 2, VK_IMAGE_USAGE_TRANSFER_DST_BIT, 2);
		VkImageViewCreateInfo ViewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
		ViewInfo.image = Image;
		ViewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
		ViewInfo.format = VK_FORMAT_R8G8B8A8_UNORM;
		ViewInfo.components.r = VK_COMPONENT_SWIZZLE_G;
		ViewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 2, 0, 1};
		ASSERT_EQ(Engine.Get<PFN_vkCreateImageView>("vkCreateImageView")(Engine.Device, &ViewInfo, nullptr, &View), VK_SUCCESS);
		VkSamplerCreateInfo SamplerInfo{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
		SamplerInfo.minLod = SamplerInfo.maxLod = 1.0f; // mip 1 alone
		ASSERT_EQ(Engine.Get<PFN_vkCreateSampler>("vkCreateSampler")(Engine.Device, &SamplerInfo, nullptr, &NativeSampler), VK_SUCCESS);
	}
	void TearDown() override
	{
		Native.Reset();
		Texture.Reset();
		if (Adopted) { Adopted->CollectGarbage(); }
		Engine.Get<PFN_vkDestroyImageView>("vkDestroyImageView")(Engine.Device, View, nullptr);
		Engine.Get<PFN_vkDestroySampler>("vkDestroySampler")(Engine.Device, NativeSampler, nullptr);
		FVulkanSmokeImport::TearDown();
	}
	/// Mip 0 is 10, 20 and mip 1 is 30, 40 in red and green.
	void ImportAndFill(uint64_t NativeView)
	{
		FRTTextureDesc Desc{2, 2, 2, 1, ERTFormat::RGBA8_UNORM, ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest, "Texture"};
		Desc.NativeView = NativeView;
		ASSERT_OK(Import(Desc, (uint64_t)Image));
		TRTRef<IRTBuffer> Source;
		ASSERT_OK(Adopted->CreateBuffer({20, ERTBufferUsage::CopySource, ERTMemory::Upload, "Texels"}, Source.ReleaseAndGetAddress()));
		auto* const Bytes = static_cast<uint8_t*>(Source->GetMapped());
		for (uint32_t Texel = 0; Texel < 5; ++Texel)
		{
			const uint8_t Values[4] = {uint8_t(Texel < 4 ? 10 : 30), uint8_t(Texel < 4 ? 20 : 40), 0, 255};
			memcpy(Bytes + Texel * 4, Values, 4);
		}
		ASSERT_OK(Adopted->CreateCommandList("Fill", List.ReleaseAndGetAddress()));
		ASSERT_OK(List->Begin());
		Barrier(ERTAccess::None, ERTAccess::CopyWrite, Texture.Get());
		List->CopyBufferToTexture(Texture.Get(), 0, 0, Source.Get(), 0);
		List->CopyBufferToTexture(Texture.Get(), 1, 0, Source.Get(), 16);
		Barrier(ERTAccess::CopyWrite, ERTAccess::ShaderRead, Texture.Get());
		ASSERT_NO_FATAL_FAILURE(RunAdopted());
	}
	void ExpectSamples(float WithOwn, float WithNative)
	{
		ASSERT_OK(Adopted->CreateSampler({}, Own.ReleaseAndGetAddress()));
		FRTSamplerDesc Desc;
		Desc.NativeSampler = (uint64_t)NativeSampler;
		ASSERT_OK(Adopted->CreateSampler(Desc, Native.ReleaseAndGetAddress()));
		float Found[2] = {};
		ASSERT_NO_FATAL_FAILURE(Sample(Own.Get(), Found));
		EXPECT_NEAR(Found[0] * 255.0f, WithOwn, 0.1f);
		ASSERT_NO_FATAL_FAILURE(Sample(Native.Get(), Found));
		EXPECT_NEAR(Found[0] * 255.0f, WithNative, 0.1f);
	}

	VkImage Image = VK_NULL_HANDLE;
	VkImageView View = VK_NULL_HANDLE;
	VkSampler NativeSampler = VK_NULL_HANDLE;
	TRTRef<IRTSampler> Native;
};

TEST_F(FVulkanSmokeNative, SamplerOfTheEngine)
{
	ASSERT_NO_FATAL_FAILURE(ImportAndFill(0));
	ExpectSamples(10.0f, 30.0f);
}

TEST_F(FVulkanSmokeNative, ViewOfTheEngine)
{
	ASSERT_NO_FATAL_FAILURE(ImportAndFill((uint64_t)View));
	ExpectSamples(20.0f, 40.0f);
}

/// A format, a block of one colour for each of two mips, and their red.
struct FBlocks
{
	ERTFormat Format;
	std::vector<uint8_t> Values[2];
	float Red[2];
};

float ToLinear(float Srgb) { return Srgb <= 0.04045f ? Srgb / 12.92f : std::pow((Srgb + 0.055f) / 1.055f, 2.4f); }

class FVulkanSmokeBlocks : public FVulkanSmokeImport
{
protected:
	void TearDown() override
	{
		for (VkCommandPool Pool : Pools) { Engine.Get<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(Engine.Device, Pool, nullptr); }
		FVulkanSmokeImport::TearDown();
	}
	bool HasFormat(ERTFormat Format)
	{
		VkImageFormatProperties Properties;
		const auto Query = Engine.Get<PFN_vkGetPhysicalDeviceImageFormatProperties>("vkGetPhysicalDeviceImageFormatProperties");
		constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
		return Query(Engine.Physical, GetVulkanFormat(Format), VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, Usage, 0, &Properties) ==
		       VK_SUCCESS;
	}
	void Move(VkCommandBuffer Commands, VkImage Image, VkImageLayout From, VkImageLayout To)
	{
		VkImageMemoryBarrier Barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
		Barrier.srcAccessMask = From == VK_IMAGE_LAYOUT_UNDEFINED ? VkAccessFlags(0) : VkAccessFlags(VK_ACCESS_TRANSFER_WRITE_BIT);
		Barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_READ_BIT;
		Barrier.oldLayout = From;
		Barrier.newLayout = To;
		Barrier.image = Image;
		Barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 2, 0, 1};
		constexpr VkPipelineStageFlags All = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
		Engine.Get<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier")(Commands, All, All, 0, 0, nullptr, 0, nullptr, 1, &Barrier);
	}
	/// The engine makes and fills a texture of 8 × 8 texels with two mips, and Lantern takes it over.
	void ImportBlocks(const FBlocks& Row)
	{
		const uint64_t Native = MakeImage(GetVulkanFormat(Row.Format), 8, 8, VK_IMAGE_USAGE_TRANSFER_DST_BIT, 2);
		std::vector<uint8_t> Bytes;
		VkBufferImageCopy Regions[2] = {};
		for (uint32_t Mip = 0; Mip < 2; ++Mip)
		{
			Regions[Mip].bufferOffset = Bytes.size();
			Regions[Mip].imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, Mip, 0, 1};
			Regions[Mip].imageExtent = {8u >> Mip, 8u >> Mip, 1};
			for (uint32_t Block = 0; Block < 4u >> (Mip * 2); ++Block)
			{
				Bytes.insert(Bytes.end(), Row.Values[Mip].begin(), Row.Values[Mip].end());
			}
		}
		TRTRef<IRTBuffer> Source;
		ASSERT_OK(
		    Adopted->CreateBuffer({Bytes.size(), ERTBufferUsage::CopySource, ERTMemory::Upload, "Blocks"}, Source.ReleaseAndGetAddress()));
		memcpy(Source->GetMapped(), Bytes.data(), Bytes.size());
		const VkCommandBuffer Commands = Engine.BeginCommands();
		Pools.push_back(Engine.Pool);
		Move(Commands, (VkImage)Native, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
		Engine.Get<PFN_vkCmdCopyBufferToImage>("vkCmdCopyBufferToImage")(
		    Commands, (VkBuffer)Source->GetNative(ERTNative::Buffer), (VkImage)Native, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 2, Regions);
		Move(Commands, (VkImage)Native, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
		Engine.Submit(Commands);
		ASSERT_EQ(Engine.Get<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(Engine.Queue), VK_SUCCESS);
		ASSERT_OK(Import({8, 8, 2, 1, Row.Format, ERTTextureUsage::Sampled, "Blocks"}, Native));
		ASSERT_OK(Adopted->CreateSampler({}, Own.ReleaseAndGetAddress()));
	}
	std::vector<VkCommandPool> Pools;
};

// The bytes follow from the formats' definitions: Khronos Data Format Specification 1.3, chapters 18 to 23.
TEST_F(FVulkanSmokeBlocks, BlocksOfOneColour)
{
	const auto MakeBc1 = [](uint8_t High) { return std::vector<uint8_t>{0, High, 0, High, 0, 0, 0, 0}; }; // red is the top 5 of 16 bits
	const auto MakeBc4 = [](uint8_t Red) { return std::vector<uint8_t>{Red, Red, 0, 0, 0, 0, 0, 0}; };
	const auto Join = [](std::vector<uint8_t> A, const std::vector<uint8_t>& B) {
		A.insert(A.end(), B.begin(), B.end());
		return A;
	};
	// Mode 6: 7 bits of each end of red from bit 7 on. The ends are equal, so the indices do not matter.
	const auto MakeBc7 = [](uint32_t Red) {
		const uint32_t Bits = 64u | Red << 7 | Red << 14;
		std::vector<uint8_t> Out(16, 0);
		for (uint32_t Byte = 0; Byte < 3; ++Byte) { Out[Byte] = static_cast<uint8_t>(Bits >> (Byte * 8)); }
		return Out;
	};
	// One subset with 10 bits of each end: red from bit 5 and from bit 35 on.
	const auto MakeBc6 = [](uint64_t Red) {
		const uint64_t Bits = 3u | Red << 5 | Red << 35;
		std::vector<uint8_t> Out(16, 0);
		for (uint32_t Byte = 0; Byte < 8; ++Byte) { Out[Byte] = static_cast<uint8_t>(Bits >> (Byte * 8)); }
		return Out;
	};
	// A void extent: no coordinates, then red, green, blue and alpha in 16 bits each.
	const auto MakeAstc = [](uint8_t Red) {
		std::vector<uint8_t> Out(16, 0xff);
		Out[0] = 0xfc;
		Out[1] = 0xfd;
		Out[8] = Out[9] = Red;
		return Out;
	};
	const float Five = 16.0f / 31.0f, Eight = 200.0f / 255.0f;
	const float Half = 0.77295f; // 480 unquantized and scaled is the half 0x3a2f
	using enum ERTFormat;
	const FBlocks Rows[] = {{BC1_UNORM, {MakeBc1(0xf8), MakeBc1(0x80)}, {1, Five}},
	    {BC1_SRGB, {MakeBc1(0xf8), MakeBc1(0x80)}, {1, ToLinear(Five)}},
	    {BC3_UNORM, {Join(MakeBc4(255), MakeBc1(0xf8)), Join(MakeBc4(255), MakeBc1(0x80))}, {1, Five}},
	    {BC3_SRGB, {Join(MakeBc4(255), MakeBc1(0xf8)), Join(MakeBc4(255), MakeBc1(0x80))}, {1, ToLinear(Five)}},
	    {BC4_UNORM, {MakeBc4(255), MakeBc4(200)}, {1, Eight}},
	    {BC5_UNORM, {Join(MakeBc4(255), MakeBc4(9)), Join(MakeBc4(200), MakeBc4(9))}, {1, Eight}},
	    {BC6H_FLOAT, {MakeBc6(0), MakeBc6(480)}, {0, Half}}, {BC7_UNORM, {MakeBc7(0), MakeBc7(100)}, {0, Eight}},
	    {BC7_SRGB, {MakeBc7(0), MakeBc7(100)}, {0, ToLinear(Eight)}}, {ASTC4x4_UNORM, {MakeAstc(255), MakeAstc(200)}, {1, Eight}},
	    {ASTC4x4_SRGB, {MakeAstc(255), MakeAstc(200)}, {1, ToLinear(Eight)}}};
	size_t Found = 0;
	for (const FBlocks& Row : Rows)
	{
		SCOPED_TRACE(static_cast<int>(Row.Format));
		if (!HasFormat(Row.Format)) { continue; }
		++Found;
		ASSERT_NO_FATAL_FAILURE(ImportBlocks(Row));
		float Red[2] = {};
		ASSERT_NO_FATAL_FAILURE(Sample(Own.Get(), Red));
		for (uint32_t Mip = 0; Mip < 2; ++Mip) { EXPECT_NEAR(Red[Mip], Row.Red[Mip], 0.005f) << Mip; }
	}
	std::printf("[  figure  ] block formats: %zu of %zu\n", Found, std::size(Rows));
	EXPECT_GE(Found, 2u) << "each device has blocks of one kind";
}

} // namespace
} // namespace Lantern
