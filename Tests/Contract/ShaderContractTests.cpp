// Compute and raster shaders: they really run.
#include "ContractShaders.h"

namespace Lantern
{
namespace
{

CONTRACT_SHADER_TEST(ComputeWritesThroughAnAddress)
{
	const auto Pipeline = MakeComputePipeline(Device(), "WriteWords.comp");
	const auto Output = Make.Buffer(100 * 4, ERTMemory::Readback);
	FContractPush Push;
	Push.Output = Output->GetDeviceAddress();
	Push.A = 5;
	Push.B = 3;
	Push.C = 100;
	const auto List = Make.List();
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch(13, 1, 1);
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	for (uint32_t i = 0; i < 100; ++i) { EXPECT_EQ(static_cast<const uint32_t*>(Output->GetMapped())[i], 5 + 3 * i); }
}

/// The number of groups is what an earlier command of the same list wrote.
CONTRACT_SHADER_TEST(IndirectDispatchReadsItsGroupsOnTheDevice)
{
	const auto Pipeline = MakeComputePipeline(Device(), "WriteWords.comp");
	const auto Output = Make.Buffer(64 * 4, ERTMemory::Readback);
	const auto Groups = Upload(std::vector<uint32_t>{99, 3, 1, 1, 0, 1, 1});
	const auto Arguments =
	    Make.Buffer(28, ERTMemory::Device, "Arguments", ERTBufferUsage::Indirect | ERTBufferUsage::CopyDest | ERTBufferUsage::Storage);
	FContractPush Push;
	Push.Output = Output->GetDeviceAddress();
	Push.A = 5;
	Push.B = 3;
	Push.C = 64;
	const auto List = Make.List();
	List->FillBuffer(Output.Get(), 0, 64 * 4, 7);
	Barrier(List.Get(), Output.Get(), ERTAccess::CopyWrite, ERTAccess::StorageWrite);
	List->CopyBuffer(Arguments.Get(), 0, Groups.Get(), 0, 28);
	Barrier(List.Get(), Arguments.Get(), ERTAccess::CopyWrite, ERTAccess::IndirectRead);
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->DispatchIndirect(Arguments.Get(), 4); // 3 groups of 8
	Push.A = 1000;
	List->PushConstants(&Push, sizeof(Push));
	List->DispatchIndirect(Arguments.Get(), 16); // none
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	for (uint32_t i = 0; i < 64; ++i) { EXPECT_EQ(static_cast<const uint32_t*>(Output->GetMapped())[i], i < 24 ? 5 + 3 * i : 7) << i; }
}

CONTRACT_SHADER_TEST(PushConstantsChangeBetweenDispatches)
{
	const auto Pipeline = MakeComputePipeline(Device(), "WriteWords.comp");
	const auto Output = Make.Buffer(64, ERTMemory::Readback);
	const auto List = Make.List();
	List->SetPipeline(Pipeline.Get());
	for (uint32_t Half = 0; Half < 2; ++Half)
	{
		FContractPush Push;
		Push.Output = Output->GetDeviceAddress() + Half * 32;
		Push.A = Half * 100;
		Push.B = 1;
		Push.C = 8;
		List->PushConstants(&Push, sizeof(Push));
		List->Dispatch(1, 1, 1);
	}
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	for (uint32_t i = 0; i < 16; ++i) { EXPECT_EQ(static_cast<const uint32_t*>(Output->GetMapped())[i], i / 8 * 100 + i % 8); }
}

CONTRACT_SHADER_TEST(StorageImageByIndex)
{
	const auto Pipeline = MakeComputePipeline(Device(), "StoreImage.comp");
	const auto Texture = Make.Texture(9, 5, ERTFormat::RGBA32_FLOAT, 1, ERTTextureUsage::Storage | ERTTextureUsage::CopySource);
	FContractPush Push;
	Push.A = Texture->GetStorageIndex();
	Push.C = 9;
	Push.D = 5;
	const auto List = Make.List();
	Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::StorageWrite);
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch(2, 1, 1);
	Run(List.Get());
	const std::vector<uint8_t> Bytes = Read(Texture.Get(), ERTAccess::StorageWrite);
	const auto* Texels = reinterpret_cast<const float*>(Bytes.data());
	for (uint32_t i = 0; i < 45; ++i)
	{
		ASSERT_EQ(Texels[i * 4], static_cast<float>(i % 9)) << i;
		ASSERT_EQ(Texels[i * 4 + 1], static_cast<float>(i / 9)) << i;
		ASSERT_EQ(Texels[i * 4 + 2], 0.25f) << i;
	}
}

CONTRACT_SHADER_TEST(SampledMipsByIndex)
{
	const auto Pipeline = MakeComputePipeline(Device(), "SampleLevels.comp");
	const auto Texture = Make.Texture(4, 4, ERTFormat::R32_FLOAT, 3);
	TRTRef<IRTSampler> Sampler;
	ASSERT_OK(Device().CreateSampler({}, Sampler.ReleaseAndGetAddress()));
	std::vector<float> Levels(16 + 4 + 1, 0.1f);
	std::fill(Levels.begin() + 16, Levels.begin() + 20, 0.2f);
	Levels[20] = 0.3f;
	const auto Source = Upload(Levels);
	const auto Output = Make.Buffer(12, ERTMemory::Readback);
	FContractPush Push;
	Push.Output = Output->GetDeviceAddress();
	Push.A = Texture->GetSampledIndex();
	Push.B = Sampler->GetIndex();
	Push.C = 3;
	const auto List = Make.List();
	Barrier(List.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	List->CopyBufferToTexture(Texture.Get(), 0, 0, Source.Get(), 0);
	List->CopyBufferToTexture(Texture.Get(), 1, 0, Source.Get(), 64);
	List->CopyBufferToTexture(Texture.Get(), 2, 0, Source.Get(), 80);
	Barrier(List.Get(), Texture.Get(), ERTAccess::CopyWrite, ERTAccess::ShaderRead);
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch(1, 1, 1);
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	for (uint32_t i = 0; i < 3; ++i) { EXPECT_EQ(static_cast<const uint32_t*>(Output->GetMapped())[i], 100 + i * 100); }
}

/// Tests with a target of 8×8 texels and triangles over all of it.
class FRasterContract : public FContractShaders
{
protected:
	void SetUp() override
	{
		FContractShaders::SetUp();
		if (HasFatalFailure()) { return; }
		Colour = Make.Texture(8, 8, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::RenderTarget | ERTTextureUsage::CopySource);
		Depth = Make.Texture(8, 8, ERTFormat::D32_FLOAT, 1, ERTTextureUsage::Depth);
	}
	void TearDown() override
	{
		Colour.Reset();
		Depth.Reset();
		Kept.clear();
		FContractShaders::TearDown();
	}
	void BeginPass(IRTCommandList* List)
	{
		FRTColorTarget Target;
		Target.Texture = Colour.Get();
		FRTRasterPassDesc Pass;
		Pass.Colors = &Target;
		Pass.ColorCount = 1;
		Pass.Depth = Depth.Get();
		Pass.Width = Pass.Height = 8;
		Barrier(List, Colour.Get(), ERTAccess::None, ERTAccess::RenderTarget);
		Barrier(List, Depth.Get(), ERTAccess::None, ERTAccess::DepthWrite);
		List->BeginRasterPass(Pass);
	}
	/// A triangle that covers the whole target, counter-clockwise if bFront.
	void Push(IRTCommandList* List, float Z, uint32_t Value, bool bFront = true)
	{
		const float X = bFront ? -3.0f : 3.0f;
		const std::vector<float> Vertices = {-X, -3, Z, 0, X, -3, Z, 0, 0, 6, Z, 0};
		Kept.push_back(Upload(Vertices, "Vertices"));
		FContractPush Item;
		Item.Input = Kept.back()->GetDeviceAddress();
		Item.A = Value;
		List->PushConstants(&Item, sizeof(Item));
	}
	uint8_t GetRed() { return Read(Colour.Get(), ERTAccess::RenderTarget).at((4 * 8 + 4) * 4); }

	TRTRef<IRTTexture> Colour, Depth;
	std::vector<TRTRef<IRTBuffer>> Kept;
};

TEST_P(FRasterContract, DepthIsReversed)
{
	const auto Pipeline = MakeRasterPipeline(Device(), ERTFormat::RGBA8_UNORM, ERTFormat::D32_FLOAT);
	const auto List = Make.List();
	BeginPass(List.Get());
	List->SetPipeline(Pipeline.Get());
	Push(List.Get(), 0.6f, 100);
	List->Draw(3, 1);
	Push(List.Get(), 0.3f, 200); // farther: hidden
	List->Draw(3, 1);
	List->EndRasterPass();
	Run(List.Get());
	EXPECT_EQ(GetRed(), 100);
}

TEST_P(FRasterContract, EqualDepthPassesAndDepthWriteCanBeOff)
{
	const auto Writes = MakeRasterPipeline(Device(), ERTFormat::RGBA8_UNORM, ERTFormat::D32_FLOAT);
	const auto Reads = MakeRasterPipeline(Device(), ERTFormat::RGBA8_UNORM, ERTFormat::D32_FLOAT, ERTCull::None, false);
	const auto List = Make.List();
	BeginPass(List.Get());
	List->SetPipeline(Reads.Get());
	Push(List.Get(), 0.9f, 50);
	List->Draw(3, 1);
	List->SetPipeline(Writes.Get());
	Push(List.Get(), 0.5f, 100);
	List->Draw(3, 1);
	Push(List.Get(), 0.5f, 150);
	List->Draw(3, 1);
	List->EndRasterPass();
	Run(List.Get());
	EXPECT_EQ(GetRed(), 150);
}

TEST_P(FRasterContract, CullModesAreOpposites)
{
	const auto Back = MakeRasterPipeline(Device(), ERTFormat::RGBA8_UNORM, ERTFormat::D32_FLOAT, ERTCull::Back);
	const auto Front = MakeRasterPipeline(Device(), ERTFormat::RGBA8_UNORM, ERTFormat::D32_FLOAT, ERTCull::Front);
	const auto Draw = [&](IRTPipeline* Pipeline, bool bFront) {
		const auto List = Make.List();
		BeginPass(List.Get());
		List->SetPipeline(Pipeline);
		Push(List.Get(), 0.5f, 100, bFront);
		List->Draw(3, 1);
		List->EndRasterPass();
		Run(List.Get());
		return GetRed() == 100;
	};
	EXPECT_TRUE(Draw(Back.Get(), true));
	EXPECT_FALSE(Draw(Back.Get(), false));
	EXPECT_FALSE(Draw(Front.Get(), true));
	EXPECT_TRUE(Draw(Front.Get(), false));
}

TEST_P(FRasterContract, IndexedDraw)
{
	const auto Pipeline = MakeRasterPipeline(Device(), ERTFormat::RGBA8_UNORM, ERTFormat::D32_FLOAT);
	const std::vector<uint16_t> Indices = {9, 9, 0, 1, 2, 0};
	const auto Buffer = Upload(Indices, "Indices");
	const auto List = Make.List();
	BeginPass(List.Get());
	List->SetPipeline(Pipeline.Get());
	Push(List.Get(), 0.5f, 77);
	List->SetIndexBuffer(Buffer.Get(), 2, ERTIndexType::UInt16);
	List->DrawIndexed(3, 1, 1, 0);
	List->EndRasterPass();
	Run(List.Get());
	EXPECT_EQ(GetRed(), 77);
}

INSTANTIATE_TEST_SUITE_P(RHI, FRasterContract, testing::Values(EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
