// Textures: copies, mips, indices and samplers.
#include "ContractFixture.h"

#include <algorithm>

namespace Lantern
{
namespace
{

CONTRACT_TEST(TextureRoundTripIsTightlyPacked)
{
	for (const ERTFormat Format : {ERTFormat::R8_UNORM, ERTFormat::RGBA8_UNORM, ERTFormat::RGBA8_SRGB, ERTFormat::R16_FLOAT,
	         ERTFormat::RGBA16_FLOAT, ERTFormat::R32_UINT, ERTFormat::RGBA32_FLOAT})
	{
		SCOPED_TRACE(static_cast<int>(Format));
		const uint32_t Width = 13, Height = 7;
		std::vector<uint8_t> Bytes(Width * Height * BytesPerTexel(Format));
		for (size_t i = 0; i < Bytes.size(); ++i) { Bytes[i] = static_cast<uint8_t>(i * 37 % 61); }
		const auto Texture = Make.Texture(Width, Height, Format);
		const auto Source = Upload(Bytes);
		const auto List = Make.List();
		Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
		List->CopyBufferToTexture(Texture.Get(), 0, 0, Source.Get(), 0);
		Run(List.Get());
		EXPECT_EQ(Read(Texture.Get(), ERTAccess::CopyWrite), Bytes);
	}
}

CONTRACT_TEST(MipsAndLayersAreApart)
{
	FRTTextureDesc Desc;
	Desc.Width = 8;
	Desc.Height = 4;
	Desc.MipCount = 4;
	Desc.ArraySize = 3;
	Desc.Format = ERTFormat::RGBA8_UNORM;
	Desc.Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest;
	Desc.Name = "Array";
	TRTRef<IRTTexture> Texture;
	ASSERT_OK(Device().CreateTexture(Desc, Texture.ReleaseAndGetAddress()));
	const auto Source = Make.Buffer(12 * 128, ERTMemory::Upload);
	const auto List = Make.List();
	Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	for (uint32_t i = 0; i < 12; ++i)
	{
		std::memset(static_cast<uint8_t*>(Source->GetMapped()) + i * 128, static_cast<int>(i + 1), 128);
		List->CopyBufferToTexture(Texture.Get(), i % 4, i / 4, Source.Get(), i * 128);
	}
	Run(List.Get());
	for (uint32_t i = 0; i < 12; ++i)
	{
		const uint32_t Texels = std::max(1u, 8u >> (i % 4)) * std::max(1u, 4u >> (i % 4));
		const std::vector<uint8_t> Expected(Texels * 4, static_cast<uint8_t>(i + 1));
		EXPECT_EQ(Read(Texture.Get(), ERTAccess::CopyWrite, i % 4, i / 4), Expected) << i;
	}
}

CONTRACT_TEST(ClearsAllMips)
{
	const auto Texture = Make.Texture(5, 3, ERTFormat::RGBA8_UNORM, 2);
	const float Colour[4] = {1.0f, 0.0f, 0.2f, 1.0f};
	const auto List = Make.List();
	Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	List->ClearTexture(Texture.Get(), Colour);
	Run(List.Get());
	for (uint32_t Mip = 0; Mip < 2; ++Mip)
	{
		const std::vector<uint8_t> Texels = Read(Texture.Get(), ERTAccess::CopyWrite, Mip);
		for (size_t i = 0; i < Texels.size(); i += 4)
		{
			ASSERT_EQ(std::vector<uint8_t>(Texels.begin() + i, Texels.begin() + i + 4), (std::vector<uint8_t>{255, 0, 51, 255}));
		}
	}
}

/// Uploads Texels to mip 0, makes the mips and returns the last one.
class FMipContract : public FContract
{
protected:
	std::vector<uint8_t> LastMip(uint32_t Width, uint32_t Height, uint32_t Mips, ERTFormat Format, const std::vector<uint8_t>& Texels)
	{
		const auto Texture = Make.Texture(Width, Height, Format, Mips);
		const auto Source = Upload(Texels);
		const auto List = Make.List();
		Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
		List->CopyBufferToTexture(Texture.Get(), 0, 0, Source.Get(), 0);
		Barrier(List.Get(), Texture.Get(), ERTAccess::CopyWrite, ERTAccess::CopyWrite);
		List->GenerateMips(Texture.Get());
		Run(List.Get());
		return Read(Texture.Get(), ERTAccess::ShaderRead, Mips - 1);
	}
};

TEST_P(FMipContract, MipsAreMeans)
{
	// 4×4, the left half 200, the right half 40.
	std::vector<uint8_t> Texels;
	for (uint32_t i = 0; i < 16; ++i) { Texels.push_back(i % 4 < 2 ? 200 : 40); }
	EXPECT_EQ(LastMip(4, 4, 2, ERTFormat::R8_UNORM, Texels), (std::vector<uint8_t>{200, 40, 200, 40}));
	EXPECT_NEAR(LastMip(4, 4, 3, ERTFormat::R8_UNORM, Texels).at(0), 120, 1);
}

TEST_P(FMipContract, MipsOfSrgbAreMeansOfLight)
{
	// Half black, half white: 188, not 128. Alpha is linear in any case.
	const std::vector<uint8_t> Mean = LastMip(2, 1, 2, ERTFormat::RGBA8_SRGB, {0, 0, 0, 0, 255, 255, 255, 255});
	ASSERT_EQ(Mean.size(), 4u);
	EXPECT_NEAR(Mean[0], 188, 1);
	EXPECT_NEAR(Mean[3], 128, 1);
}

TEST_P(FMipContract, MipsOfOddSizes)
{
	EXPECT_EQ(LastMip(7, 5, 3, ERTFormat::R8_UNORM, std::vector<uint8_t>(35, 77)), std::vector<uint8_t>{77});
	// The mean of a ramp is its middle, whatever the size.
	std::vector<uint8_t> Ramp;
	for (uint32_t i = 0; i < 6; ++i) { Ramp.push_back(static_cast<uint8_t>(50 + i * 20)); }
	EXPECT_NEAR(LastMip(6, 1, 3, ERTFormat::R8_UNORM, Ramp).at(0), 100, 3);
}

INSTANTIATE_TEST_SUITE_P(RHI, FMipContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

CONTRACT_TEST(BindlessIndicesFollowUsage)
{
	const auto Sampled = Make.Texture(1, 1, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::Sampled);
	const auto Storage = Make.Texture(1, 1, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::Storage);
	const auto Both = Make.Texture(1, 1, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::Sampled | ERTTextureUsage::Storage);
	EXPECT_EQ(Sampled->GetStorageIndex(), ~0u);
	EXPECT_EQ(Storage->GetSampledIndex(), ~0u);
	EXPECT_NE(Sampled->GetSampledIndex(), Both->GetSampledIndex());
	EXPECT_NE(Storage->GetStorageIndex(), Both->GetStorageIndex());
	EXPECT_LT(Both->GetSampledIndex(), Caps().MaxBindlessTextures);
}

CONTRACT_TEST(BindlessIndicesAreGivenBack)
{
	uint32_t Highest = 0;
	for (uint32_t i = 0; i < 200; ++i)
	{
		const auto Texture = Make.Texture(1, 1, ERTFormat::R8_UNORM);
		Highest = std::max(Highest, Texture->GetSampledIndex());
		Device().CollectGarbage(); // destroys those before this one
	}
	EXPECT_LT(Highest, 100u);
}

CONTRACT_TEST(SamplersHaveIndices)
{
	FRTSamplerDesc Desc;
	TRTRef<IRTSampler> A, B;
	ASSERT_OK(Device().CreateSampler(Desc, A.ReleaseAndGetAddress()));
	Desc.Mag = Desc.Min = Desc.Mip = ERTFilter::Nearest;
	Desc.U = ERTAddress::Mirror;
	Desc.V = ERTAddress::Clamp;
	Desc.MaxAnisotropy = 64.0f; // more than devices have: clamped
	ASSERT_OK(Device().CreateSampler(Desc, B.ReleaseAndGetAddress()));
	EXPECT_NE(A->GetIndex(), B->GetIndex());
}

CONTRACT_TEST(TooLargeTextureIsAnError)
{
	FRTTextureDesc Desc;
	Desc.Width = 1000000;
	Desc.Height = 4;
	Desc.Format = ERTFormat::RGBA8_UNORM;
	Desc.Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest;
	Desc.Name = "Wide";
	TRTRef<IRTTexture> Texture;
	const FRTStatus Status = Device().CreateTexture(Desc, Texture.ReleaseAndGetAddress());
	EXPECT_FALSE(Status.IsOk());
	EXPECT_FALSE(Texture);
	EXPECT_NE(std::string(Status.Message).find("Wide"), std::string::npos) << Status.Message;
	EXPECT_TRUE(Make.Texture(4, 4, ERTFormat::RGBA8_UNORM)) << "the device goes on";
}

CONTRACT_TEST(RasterPassClearsItsTargets)
{
	const auto Colour =
	    Make.Texture(6, 5, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::RenderTarget | ERTTextureUsage::CopySource, "Colour");
	const auto Depth = Make.Texture(6, 5, ERTFormat::D32_FLOAT, 1, ERTTextureUsage::Depth | ERTTextureUsage::Sampled, "Depth");
	FRTColorTarget Target;
	Target.Texture = Colour.Get();
	Target.Clear[1] = 1.0f;
	FRTRasterPassDesc Pass;
	Pass.Colors = &Target;
	Pass.ColorCount = 1;
	Pass.Depth = Depth.Get();
	Pass.Width = 6;
	Pass.Height = 5;
	const auto List = Make.List();
	Barrier(List.Get(), Colour.Get(), ERTAccess::None, ERTAccess::RenderTarget);
	Barrier(List.Get(), Depth.Get(), ERTAccess::None, ERTAccess::DepthWrite);
	List->BeginRasterPass(Pass);
	List->EndRasterPass();
	Run(List.Get());
	const std::vector<uint8_t> Texels = Read(Colour.Get(), ERTAccess::RenderTarget);
	for (size_t i = 0; i < Texels.size(); i += 4)
	{
		ASSERT_EQ(std::vector<uint8_t>(Texels.begin() + i, Texels.begin() + i + 4), (std::vector<uint8_t>{0, 255, 0, 0}));
	}
}

} // namespace
} // namespace Lantern
