// The Vulkan backend alone: buffers, textures, compute and raster.
#include "VulkanSmokeFixture.h"

#include "VulkanSmokeShaders/Fill_comp.h"
#include "VulkanSmokeShaders/Sample_comp.h"
#include "VulkanSmokeShaders/StoreImage_comp.h"
#include "VulkanSmokeShaders/Triangle_frag.h"
#include "VulkanSmokeShaders/Triangle_vert.h"

namespace Lantern
{

class FVulkanSmokeBasics : public FVulkanSmokeTest
{
protected:
	TRTRef<IRTTexture> MakeColorTarget(uint32_t Size)
	{
		FRTTextureDesc Desc;
		Desc.Width = Desc.Height = Size;
		Desc.Format = ERTFormat::RGBA8_UNORM;
		Desc.Usage = ERTTextureUsage::RenderTarget | ERTTextureUsage::CopySource;
		Desc.Name = "Color";
		TRTRef<IRTTexture> Out;
		const FRTStatus Status = Device->CreateTexture(Desc, Out.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	/// Draws triangles of one colour. DepthFormat Unknown: without depth.
	TRTRef<IRTPipeline> MakeTrianglePipeline(ERTFormat DepthFormat, ERTCull Cull)
	{
		const ERTFormat ColorFormat = ERTFormat::RGBA8_UNORM;
		FRTRasterPipelineDesc Desc;
		Desc.Vertex = MakeCode(Smoke_Triangle_vert, ERTShaderStage::Vertex, "Triangle.vert");
		Desc.Fragment = MakeCode(Smoke_Triangle_frag, ERTShaderStage::Fragment, "Triangle.frag");
		Desc.ColorFormats = &ColorFormat;
		Desc.ColorCount = 1;
		Desc.DepthFormat = DepthFormat;
		Desc.Cull = Cull;
		TRTRef<IRTPipeline> Out;
		const FRTStatus Status = Device->CreateRasterPipeline(Desc, Out.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	/// Draws in one colour from the positions at Address.
	void PushTriangle(uint64_t Address, float Red, float Green)
	{
		const struct
		{
			uint64_t Positions;
			float Color[4];
		} Data = {Address, {Red, Green, 0, 1}};
		List->PushConstants(&Data, sizeof(Data));
	}
};

struct FFillPush
{
	uint64_t Output;
	uint32_t Count, Factor;
};

TEST_F(FVulkanSmokeBasics, ComputeWritesABufferAndTheListIsReused)
{
	constexpr uint32_t Count = 1000;
	TRTRef<IRTPipeline> Pipeline = MakeCompute(Smoke_Fill_comp, "Fill");
	TRTRef<IRTBuffer> Words = MakeBuffer(Count * 4, ERTBufferUsage::Storage | ERTBufferUsage::CopySource, ERTMemory::Device, "Words");
	TRTRef<IRTBuffer> Back = MakeBuffer(Count * 4, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	EXPECT_EQ(Words->GetMapped(), nullptr);
	for (const uint32_t Factor : {3u, 7u})
	{
		ASSERT_OK(List->Begin());
		List->BeginMarker("Fill");
		List->SetPipeline(Pipeline.Get());
		const FFillPush Push = {Words->GetDeviceAddress(), Count, Factor};
		List->PushConstants(&Push, sizeof(Push));
		List->Dispatch((Count + 63) / 64, 1, 1);
		List->EndMarker();
		Barrier(ERTAccess::StorageWrite, ERTAccess::CopyRead);
		List->CopyBuffer(Back.Get(), 0, Words.Get(), 0, Count * 4);
		Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
		ASSERT_NO_FATAL_FAILURE(Run());
		const uint32_t* Result = static_cast<const uint32_t*>(Back->GetMapped());
		for (uint32_t Index = 0; Index < Count; ++Index) { ASSERT_EQ(Result[Index], Index * Factor); }
	}
}

TEST_F(FVulkanSmokeBasics, StorageImageIsReadBack)
{
	constexpr uint32_t Width = 13, Height = 9;
	TRTRef<IRTTexture> Texture;
	ASSERT_OK(Device->CreateTexture(
	    {Width, Height, 1, 1, ERTFormat::RGBA32_FLOAT, ERTTextureUsage::Storage | ERTTextureUsage::CopySource, "Image"},
	    Texture.ReleaseAndGetAddress()));
	EXPECT_EQ(Texture->GetSampledIndex(), ~0u);
	ASSERT_NE(Texture->GetStorageIndex(), ~0u);
	TRTRef<IRTPipeline> Pipeline = MakeCompute(Smoke_StoreImage_comp, "StoreImage");
	TRTRef<IRTBuffer> Back = MakeBuffer(Width * Height * 16, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	ASSERT_OK(List->Begin());
	Barrier(ERTAccess::None, ERTAccess::StorageWrite, Texture.Get());
	List->SetPipeline(Pipeline.Get());
	const uint32_t Push[] = {Texture->GetStorageIndex(), Width, Height};
	List->PushConstants(Push, sizeof(Push));
	List->Dispatch(2, 2, 1);
	Barrier(ERTAccess::StorageWrite, ERTAccess::CopyRead, Texture.Get());
	List->CopyTextureToBuffer(Back.Get(), 0, Texture.Get(), 0, 0);
	Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	const float* Texels = static_cast<const float*>(Back->GetMapped());
	for (uint32_t Y = 0; Y < Height; ++Y)
	{
		for (uint32_t X = 0; X < Width; ++X)
		{
			const float* Texel = Texels + 4 * (Y * Width + X);
			ASSERT_EQ(Texel[0], X);
			ASSERT_EQ(Texel[1], Y);
			ASSERT_EQ(Texel[2], X * Y);
		}
	}
}

TEST_F(FVulkanSmokeBasics, MipsAreAveragesOfTheFirst)
{
	constexpr uint32_t Size = 8, Mips = 4;
	TRTRef<IRTTexture> Texture;
	ASSERT_OK(
	    Device->CreateTexture({Size, Size, Mips, 1, ERTFormat::RGBA16_FLOAT, ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest, "Mips"},
	        Texture.ReleaseAndGetAddress()));
	TRTRef<IRTSampler> Sampler;
	ASSERT_OK(Device->CreateSampler({}, Sampler.ReleaseAndGetAddress()));
	constexpr uint16_t HalfOne = 0x3c00, HalfTwo = 0x4000;
	std::vector<uint16_t> Texels(Size * Size * 4);
	for (uint32_t Index = 0; Index < Size * Size; ++Index)
	{
		Texels[Index * 4] = Index % 2 ? HalfTwo : 0;                   // every 2x2 box has the mean 1
		Texels[Index * 4 + 1] = Index / Size < Size / 2 ? HalfOne : 0; // 0.5 in the last mip alone
	}
	TRTRef<IRTBuffer> Upload = MakeUpload(Texels, ERTBufferUsage::CopySource, "Texels");
	TRTRef<IRTBuffer> Output = MakeBuffer(Mips * 16, ERTBufferUsage::Storage, ERTMemory::Readback, "Output");
	TRTRef<IRTPipeline> Pipeline = MakeCompute(Smoke_Sample_comp, "Sample");
	ASSERT_OK(List->Begin());
	Barrier(ERTAccess::None, ERTAccess::CopyWrite, Texture.Get());
	List->CopyBufferToTexture(Texture.Get(), 0, 0, Upload.Get(), 0);
	List->GenerateMips(Texture.Get());
	List->SetPipeline(Pipeline.Get());
	const struct
	{
		uint64_t Address;
		uint32_t Texture, Sampler;
	} Push = {Output->GetDeviceAddress(), Texture->GetSampledIndex(), Sampler->GetIndex()};
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch(Mips, 1, 1);
	Barrier(ERTAccess::StorageWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	const float* Colors = static_cast<const float*>(Output->GetMapped());
	for (uint32_t Mip = 1; Mip < Mips; ++Mip) { EXPECT_NEAR(Colors[Mip * 4], 1.0f, 0.01f) << Mip; }
	EXPECT_NEAR(Colors[(Mips - 1) * 4 + 1], 0.5f, 0.01f);
}

TEST_F(FVulkanSmokeBasics, RasterTrianglesAreSortedByReversedDepth)
{
	constexpr uint32_t Size = 32;
	const TRTRef<IRTTexture> Color = MakeColorTarget(Size);
	TRTRef<IRTTexture> Depth;
	ASSERT_OK(Device->CreateTexture({Size, Size, 1, 1, ERTFormat::D32_FLOAT, ERTTextureUsage::Depth | ERTTextureUsage::CopySource, "Depth"},
	    Depth.ReleaseAndGetAddress()));
	const TRTRef<IRTPipeline> Pipeline = MakeTrianglePipeline(ERTFormat::D32_FLOAT, ERTCull::None);
	// The left half near (0.75), then the whole target behind it (0.25).
	const std::vector<float> Points = {-1, -3, 0.75f, 0, 0, 0.75f, -1, 3, 0.75f, // covers x < 0 near the centre
	    -1, -1, 0.25f, 3, -1, 0.25f, -1, 3, 0.25f};
	TRTRef<IRTBuffer> Positions = MakeUpload(Points, ERTBufferUsage::Storage, "Positions");
	TRTRef<IRTBuffer> Indices = MakeUpload(std::vector<uint32_t>{3, 4, 5}, ERTBufferUsage::Index, "Indices");
	TRTRef<IRTBuffer> Back = MakeBuffer(Size * Size * 4, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	TRTRef<IRTBuffer> BackDepth = MakeBuffer(Size * Size * 4, ERTBufferUsage::CopyDest, ERTMemory::Readback, "BackDepth");
	ASSERT_OK(List->Begin());
	Barrier(ERTAccess::None, ERTAccess::RenderTarget, Color.Get());
	Barrier(ERTAccess::None, ERTAccess::DepthWrite, Depth.Get());
	const FRTColorTarget Target = {Color.Get(), true, {0, 0, 1, 1}};
	List->BeginRasterPass({&Target, 1, Depth.Get(), true, 0.0f, Size, Size});
	List->SetPipeline(Pipeline.Get());
	PushTriangle(Positions->GetDeviceAddress(), 1, 0);
	List->Draw(3, 1);
	PushTriangle(Positions->GetDeviceAddress(), 0, 1);
	List->SetIndexBuffer(Indices.Get(), 0, ERTIndexType::UInt32);
	List->DrawIndexed(3, 1, 0, 0);
	List->EndRasterPass();
	Barrier(ERTAccess::RenderTarget, ERTAccess::CopyRead, Color.Get());
	Barrier(ERTAccess::DepthWrite, ERTAccess::CopyRead, Depth.Get());
	List->CopyTextureToBuffer(Back.Get(), 0, Color.Get(), 0, 0);
	List->CopyTextureToBuffer(BackDepth.Get(), 0, Depth.Get(), 0, 0);
	Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	const uint32_t* Texels = static_cast<const uint32_t*>(Back->GetMapped());
	const float* Depths = static_cast<const float*>(BackDepth->GetMapped());
	const uint32_t Left = Size / 2 * Size + 4, Right = Size / 2 * Size + Size - 4;
	EXPECT_EQ(Texels[Left], 0xff0000ffu);
	EXPECT_EQ(Depths[Left], 0.75f);
	EXPECT_EQ(Texels[Right], 0xff00ff00u);
	EXPECT_EQ(Depths[Right], 0.25f);
}

TEST_F(FVulkanSmokeBasics, TrianglesClockwiseOnTheTargetAreBackFaces)
{
	constexpr uint32_t Size = 8;
	const TRTRef<IRTTexture> Color = MakeColorTarget(Size);
	const TRTRef<IRTPipeline> Pipeline = MakeTrianglePipeline(ERTFormat::Unknown, ERTCull::Back);
	// Two triangles that cover the target. y is down: the first is clockwise as seen, the second counter-clockwise.
	const std::vector<float> Points = {-1, -1, 0, 3, -1, 0, -1, 3, 0, -1, -1, 0, -1, 3, 0, 3, -1, 0};
	TRTRef<IRTBuffer> Positions = MakeUpload(Points, ERTBufferUsage::Storage, "Positions");
	TRTRef<IRTBuffer> Back = MakeBuffer(Size * Size * 4, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	for (const bool bCounterClockwise : {false, true})
	{
		ASSERT_OK(List->Begin());
		Barrier(ERTAccess::None, ERTAccess::RenderTarget, Color.Get());
		const FRTColorTarget Target = {Color.Get(), true, {0, 0, 1, 1}};
		List->BeginRasterPass({&Target, 1, nullptr, false, 0.0f, Size, Size});
		List->SetPipeline(Pipeline.Get());
		PushTriangle(Positions->GetDeviceAddress() + (bCounterClockwise ? 36 : 0), 1, 0);
		List->Draw(3, 1);
		List->EndRasterPass();
		Barrier(ERTAccess::RenderTarget, ERTAccess::CopyRead, Color.Get());
		List->CopyTextureToBuffer(Back.Get(), 0, Color.Get(), 0, 0);
		Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
		ASSERT_NO_FATAL_FAILURE(Run());
		EXPECT_EQ(static_cast<uint32_t*>(Back->GetMapped())[Size * 4 + 4], bCounterClockwise ? 0xff0000ffu : 0xffff0000u);
	}
}

TEST_F(FVulkanSmokeBasics, ClearsAndFillsReachTheirTargets)
{
	TRTRef<IRTTexture> Texture;
	ASSERT_OK(Device->CreateTexture(
	    {4, 4, 1, 1, ERTFormat::R32_UINT, ERTTextureUsage::Storage | ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest, "Cleared"},
	    Texture.ReleaseAndGetAddress()));
	TRTRef<IRTBuffer> Back = MakeBuffer(128, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	ASSERT_OK(List->Begin());
	Barrier(ERTAccess::None, ERTAccess::CopyWrite, Texture.Get());
	const float Value[4] = {7, 0, 0, 0};
	List->ClearTexture(Texture.Get(), Value);
	Barrier(ERTAccess::CopyWrite, ERTAccess::CopyRead, Texture.Get());
	List->CopyTextureToBuffer(Back.Get(), 0, Texture.Get(), 0, 0);
	List->FillBuffer(Back.Get(), 64, 64, 0xabcd1234u);
	Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	const uint32_t* Words = static_cast<const uint32_t*>(Back->GetMapped());
	EXPECT_EQ(Words[15], 7u);
	EXPECT_EQ(Words[16], 0xabcd1234u);
	EXPECT_EQ(Words[31], 0xabcd1234u);
}

TEST_F(FVulkanSmokeBasics, TimestampsAreOrderedAndUnwrittenOnesSaidToBe)
{
	if (!Device->GetCapabilities().bTimestamps) { GTEST_SKIP() << "the device has no timestamps"; }
	TRTRef<IRTQueryPool> Pool;
	ASSERT_OK(Device->CreateQueryPool(ERTQuery::Timestamp, 4, Pool.ReleaseAndGetAddress()));
	uint64_t Times[4] = {};
	EXPECT_FALSE(Pool->GetResults(0, 4, Times));
	TRTRef<IRTBuffer> Filled = MakeBuffer(1 << 20, ERTBufferUsage::CopyDest, ERTMemory::Device, "Filled");
	ASSERT_OK(List->Begin());
	List->ResetQueries(Pool.Get(), 0, 4);
	List->WriteTimestamp(Pool.Get(), 0);
	List->FillBuffer(Filled.Get(), 0, 1 << 20, 1);
	List->WriteTimestamp(Pool.Get(), 1);
	ASSERT_NO_FATAL_FAILURE(Run());
	ASSERT_TRUE(Pool->GetResults(0, 2, Times));
	EXPECT_LE(Times[0], Times[1]);
	EXPECT_FALSE(Pool->GetResults(0, 4, Times));
}

TEST_F(FVulkanSmokeBasics, AnImportedTextureIsTheSameImageAndSurvivesItsWrapper)
{
	const FRTTextureDesc Desc = {
	    2, 2, 1, 1, ERTFormat::R32_FLOAT, ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest | ERTTextureUsage::Sampled, "Original"};
	TRTRef<IRTTexture> Original, Wrapper;
	ASSERT_OK(Device->CreateTexture(Desc, Original.ReleaseAndGetAddress()));
	ASSERT_OK(Device->ImportTexture(Desc, Original->GetNative(ERTNative::Image), Wrapper.ReleaseAndGetAddress()));
	EXPECT_NE(Wrapper->GetSampledIndex(), Original->GetSampledIndex());
	TRTRef<IRTBuffer> Back = MakeBuffer(16, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	ASSERT_OK(List->Begin());
	Barrier(ERTAccess::None, ERTAccess::CopyWrite, Wrapper.Get());
	const float Value[4] = {0.5f, 0, 0, 0};
	List->ClearTexture(Wrapper.Get(), Value);
	Barrier(ERTAccess::CopyWrite, ERTAccess::CopyRead, Wrapper.Get());
	ASSERT_NO_FATAL_FAILURE(Run());
	Wrapper.Reset();
	ASSERT_OK(Device->WaitIdle());
	ASSERT_OK(List->Begin());
	List->CopyTextureToBuffer(Back.Get(), 0, Original.Get(), 0, 0);
	Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_EQ(static_cast<float*>(Back->GetMapped())[3], 0.5f);
}

TEST_F(FVulkanSmokeBasics, AnImportedBufferIsTheSameMemory)
{
	constexpr ERTBufferUsage Usage = ERTBufferUsage::CopySource | ERTBufferUsage::Storage;
	const FRTBufferDesc Desc{64, Usage, ERTMemory::Device, "Theirs"};
	TRTRef<IRTBuffer> Original = MakeBuffer(64, Usage, ERTMemory::Upload, "Original"), ByHandle, ByAddress;
	FRTNativeBuffer Native;
	Native.Handle = Original->GetNative(ERTNative::Buffer);
	ASSERT_OK(Device->ImportBuffer(Desc, Native, ByHandle.ReleaseAndGetAddress()));
	EXPECT_EQ(ByHandle->GetDeviceAddress(), Original->GetDeviceAddress());
	EXPECT_EQ(ByHandle->GetNative(ERTNative::Buffer), Native.Handle);
	ASSERT_OK(Device->ImportBuffer(Desc, {0, Original->GetDeviceAddress()}, ByAddress.ReleaseAndGetAddress()));
	EXPECT_EQ(ByAddress->GetDeviceAddress(), Original->GetDeviceAddress());
	static_cast<uint32_t*>(Original->GetMapped())[3] = 77;
	TRTRef<IRTBuffer> Back = MakeBuffer(64, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Back");
	ASSERT_OK(List->Begin());
	List->CopyBuffer(Back.Get(), 0, ByHandle.Get(), 0, 64);
	Barrier(ERTAccess::CopyWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_EQ(static_cast<uint32_t*>(Back->GetMapped())[3], 77u);
	const auto ExpectRefused = [&](const FRTBufferDesc& Wrong, const FRTNativeBuffer& From, const char* Part) {
		const FRTStatus Status = Device->ImportBuffer(Wrong, From, ByHandle.ReleaseAndGetAddress());
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		EXPECT_NE(strstr(Status.Message, Part), nullptr) << Status.Message;
	};
	ExpectRefused({1 << 20, Usage, ERTMemory::Device, "Theirs"}, Native, "Size is 1048576 bytes");
	ExpectRefused({0, Usage, ERTMemory::Device, "Theirs"}, Native, "Size is 0");
	ExpectRefused(Desc, {}, "Handle and Address are 0");
	ExpectRefused(Desc, {0, Original->GetDeviceAddress() + 4}, "Address is not a multiple of 16");
}

} // namespace Lantern
