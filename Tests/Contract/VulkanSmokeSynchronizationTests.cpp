// What the layer's synchronization validation finds, and what it only supposes: the smallest reproductions.
#include "Support/SynchronizationMessages.h"
#include "VulkanSmokeFixture.h"
#include "VulkanSmokeShaders/Sample_comp.h"
#include "VulkanSmokeShaders/StoreImage_comp.h"

#include <gmock/gmock.h>

#include <mutex>

namespace Lantern
{

class FVulkanSmokeSynchronization : public FVulkanSmokeTest
{
protected:
	void Change(FRTVulkanDeviceDesc& Desc) override
	{
		if (!Desc.bValidation) { GTEST_SKIP() << "no layers"; }
		bCountsMessages = false;
		Desc.MessageUser = this;
		Desc.MessageCallback = [](void* User, ERTVulkanMessage, const char* Text) {
			auto& Self = *static_cast<FVulkanSmokeSynchronization*>(User);
			const std::lock_guard Lock(Self.Mutex);
			Self.Messages.Add(Text);
		};
	}
	TRTRef<IRTTexture> MakeTexture(ERTTextureUsage Usage, const char* Name)
	{
		TRTRef<IRTTexture> Texture;
		const FRTStatus Status = Device->CreateTexture({8, 8, 1, 1, ERTFormat::RGBA32_FLOAT, Usage, Name}, Texture.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Texture;
	}

	std::mutex Mutex;
	FSynchronizationMessages Messages;
};

// No shader here is ever given an index of Bystander. The old layer supposes that each of them reads or writes it.
TEST_F(FVulkanSmokeSynchronization, OldLayersReportATextureThatNoShaderUses)
{
	const TRTRef<IRTTexture> Read = MakeTexture(ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest, "Read");
	const TRTRef<IRTTexture> Bystander = MakeTexture(
	    ERTTextureUsage::Sampled | ERTTextureUsage::Storage | ERTTextureUsage::CopyDest | ERTTextureUsage::CopySource, "Bystander");
	const TRTRef<IRTBuffer> Output = MakeBuffer(256, ERTBufferUsage::Storage, ERTMemory::Device, "Output");
	TRTRef<IRTSampler> Sampler;
	ASSERT_OK(Device->CreateSampler({}, Sampler.ReleaseAndGetAddress()));
	const TRTRef<IRTPipeline> Store = MakeCompute(Smoke_StoreImage_comp, "StoreImage"), Sample = MakeCompute(Smoke_Sample_comp, "Sample");
	ASSERT_OK(List->Begin());
	Barrier(ERTAccess::None, ERTAccess::CopyWrite, Read.Get());
	Barrier(ERTAccess::CopyWrite, ERTAccess::ShaderRead, Read.Get());
	const auto DispatchSample = [&](uint32_t Slot) {
		const struct
		{
			uint64_t Address;
			uint32_t Texture, Sampler;
		} Push = {Output->GetDeviceAddress() + Slot * 16, Read->GetSampledIndex(), Sampler->GetIndex()};
		List->SetPipeline(Sample.Get());
		List->PushConstants(&Push, sizeof(Push));
		List->Dispatch(1, 1, 1);
	};
	const auto DispatchStore = [&] {
		const uint32_t Push[] = {0, 0, 0}; // 0 × 0 pixels of an image: nothing is written
		List->SetPipeline(Store.Get());
		List->PushConstants(Push, sizeof(Push));
		List->Dispatch(1, 1, 1);
	};
	Barrier(ERTAccess::None, ERTAccess::CopyWrite, Bystander.Get());
	DispatchSample(0);
	Barrier(ERTAccess::CopyWrite, ERTAccess::ShaderRead, Bystander.Get());
	DispatchStore();
	DispatchSample(1);
	DispatchStore();
	Barrier(ERTAccess::ShaderRead, ERTAccess::CopyRead, Bystander.Get());
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_THAT(Messages.Others, testing::IsEmpty());
	using enum ESupposedAccess;
	EXPECT_THAT(
	    Messages.Supposed, testing::AnyOf(testing::IsEmpty(), testing::UnorderedElementsAre(ReadAfterWrite, ReadAfterLayout, WriteAfterRead,
	                                                              WriteAfterLayout, LayoutAfterRead, LayoutAfterWrite)));
}

// All layers see copies: what they are used for here.
TEST_F(FVulkanSmokeSynchronization, ForgottenBarriersAreNoSupposition)
{
	const TRTRef<IRTBuffer> Buffer = MakeBuffer(256, ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest, ERTMemory::Device, "Forgotten");
	const TRTRef<IRTTexture> Texture = MakeTexture(ERTTextureUsage::CopyDest | ERTTextureUsage::CopySource, "Torn");
	const TRTRef<IRTBuffer> Texels = MakeUpload(std::vector<float>(8 * 8 * 4), ERTBufferUsage::CopySource, "Texels");
	ASSERT_OK(List->Begin());
	List->CopyBuffer(Buffer.Get(), 0, Texels.Get(), 0, 128);
	List->CopyBuffer(Buffer.Get(), 128, Buffer.Get(), 0, 128);
	Barrier(ERTAccess::None, ERTAccess::CopyWrite, Texture.Get());
	List->CopyBufferToTexture(Texture.Get(), 0, 0, Texels.Get(), 0);
	Barrier(ERTAccess::CopyRead, ERTAccess::ShaderRead, Texture.Get());
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_THAT(Messages.Supposed, testing::IsEmpty());
	EXPECT_THAT(Messages.Others, testing::Contains(testing::HasSubstr("READ_AFTER_WRITE")));
	EXPECT_THAT(Messages.Others, testing::Contains(testing::HasSubstr("Torn")));
}

} // namespace Lantern
