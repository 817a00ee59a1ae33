// Formats as shaders see them: swapped channels, depth with stencil. VulkanSmokeImportTests.cpp has blocks, which engines alone make.
#include "ContractShaders.h"

#include <cmath>

namespace Lantern
{
namespace
{

class FTextureFormatContract : public FContractShaders
{
protected:
	/// A texture whose two mips have one value each.
	TRTRef<IRTTexture> Fill(ERTFormat Format, const std::vector<uint8_t> (&Values)[2])
	{
		constexpr uint32_t Size = 8;
		const auto Texture = Make.Texture(Size, Size, Format, 2);
		std::vector<uint8_t> Bytes;
		uint64_t Offsets[2] = {};
		for (uint32_t Mip = 0; Mip < 2; ++Mip)
		{
			Offsets[Mip] = Bytes.size();
			for (uint32_t Texel = 0; Texel < (Size >> Mip) * (Size >> Mip); ++Texel)
			{
				Bytes.insert(Bytes.end(), Values[Mip].begin(), Values[Mip].end());
			}
		}
		const auto Source = Upload(Bytes);
		const auto List = Make.List();
		Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
		for (uint32_t Mip = 0; Mip < 2; ++Mip) { List->CopyBufferToTexture(Texture.Get(), Mip, 0, Source.Get(), Offsets[Mip]); }
		Barrier(List.Get(), Texture.Get(), ERTAccess::CopyWrite, ERTAccess::ShaderRead);
		Run(List.Get());
		return Texture;
	}
	/// Red in the middle of a mip.
	float SampleRed(IRTTexture* Texture, uint32_t Mip)
	{
		if (!Pipeline) { Pipeline = MakeComputePipeline(Device(), "SampleLevels.comp"); }
		TRTRef<IRTSampler> Sampler;
		EXPECT_OK(Device().CreateSampler({}, Sampler.ReleaseAndGetAddress()));
		const auto Output = Make.Buffer(8, ERTMemory::Readback);
		FContractPush Push;
		Push.Output = Output->GetDeviceAddress();
		Push.A = Texture->GetSampledIndex();
		Push.B = Sampler->GetIndex();
		Push.C = 2;
		const auto List = Make.List();
		List->SetPipeline(Pipeline.Get());
		List->PushConstants(&Push, sizeof(Push));
		List->Dispatch(1, 1, 1);
		Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
		Run(List.Get());
		return float(static_cast<const uint32_t*>(Output->GetMapped())[Mip]) / 1000.0f;
	}
	void TearDown() override
	{
		Pipeline.Reset();
		FContractShaders::TearDown();
	}
	static float ToLinear(float Srgb) { return Srgb <= 0.04045f ? Srgb / 12.92f : std::pow((Srgb + 0.055f) / 1.055f, 2.4f); }

	TRTRef<IRTPipeline> Pipeline;
};

#define FORMAT_TEST(Name) TEST_P(FTextureFormatContract, Name)

FORMAT_TEST(BlueBeforeRed)
{
	const std::vector<uint8_t> Values[2] = {{10, 20, 200, 255}, {200, 20, 10, 255}};
	const auto Linear = Fill(ERTFormat::BGRA8_UNORM, Values), Srgb = Fill(ERTFormat::BGRA8_SRGB, Values);
	ASSERT_TRUE(Linear && Srgb);
	for (uint32_t Mip = 0; Mip < 2; ++Mip)
	{
		const float Red = float(Values[Mip][2]) / 255.0f;
		EXPECT_NEAR(SampleRed(Linear.Get(), Mip), Red, 0.002f);
		EXPECT_NEAR(SampleRed(Srgb.Get(), Mip), ToLinear(Red), 0.002f);
	}
}

// The stencil beside it does not count: shaders read depth.
FORMAT_TEST(DepthBesideStencilIsSampled)
{
	size_t Found = 0;
	for (const ERTFormat Format : {ERTFormat::D32_FLOAT, ERTFormat::D32_FLOAT_S8_UINT, ERTFormat::D24_UNORM_S8_UINT, ERTFormat::D16_UNORM})
	{
		SCOPED_TRACE(static_cast<int>(Format));
		const FRTTextureDesc Desc{8, 8, 1, 1, Format, ERTTextureUsage::Sampled | ERTTextureUsage::Depth, "Depth"};
		TRTRef<IRTTexture> Texture;
		const FRTStatus Status = Device().CreateTexture(Desc, Texture.ReleaseAndGetAddress());
		if (Status.Code == ERTResult::Unsupported) { continue; }
		ASSERT_TRUE(Status.IsOk()) << Status.Message;
		++Found;
		FRTRasterPassDesc Pass;
		Pass.Depth = Texture.Get();
		Pass.ClearDepth = 0.375f;
		Pass.Width = Pass.Height = 8;
		const auto List = Make.List();
		Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::DepthWrite);
		List->BeginRasterPass(Pass);
		List->EndRasterPass();
		Barrier(List.Get(), Texture.Get(), ERTAccess::DepthWrite, ERTAccess::ShaderRead);
		Run(List.Get());
		EXPECT_NEAR(SampleRed(Texture.Get(), 0), 0.375f, 0.001f);
	}
	EXPECT_GE(Found, 3u) << "each device has D32, D16 and one of both with stencil";
}

INSTANTIATE_TEST_SUITE_P(RHI, FTextureFormatContract, testing::Values(EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
