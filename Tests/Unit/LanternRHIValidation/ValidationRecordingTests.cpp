// Rules a command list can judge by itself.
#include "Support/ValidationTestTools.h"

namespace Lantern
{
namespace
{

class FValidationRecording : public FValidationFixture
{
protected:
	FRTRasterPassDesc Pass(IRTTexture* Target)
	{
		Color.Texture = Target;
		FRTRasterPassDesc Desc;
		Desc.Colors = &Color;
		Desc.ColorCount = 1;
		Desc.Width = Desc.Height = 4;
		return Desc;
	}
	TRTRef<IRTPipeline> Raster(ERTFormat Format)
	{
		FRTRasterPipelineDesc Desc;
		Desc.Vertex = {DummyWords, std::size(DummyWords), ERTShaderStage::Vertex, "V"};
		Desc.Fragment = {DummyWords, std::size(DummyWords), ERTShaderStage::Fragment, "F"};
		Desc.ColorFormats = &Format;
		Desc.ColorCount = 1;
		Desc.Name = "Raster";
		TRTRef<IRTPipeline> Out;
		EXPECT_OK(Make.Device->CreateRasterPipeline(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}
	FRTColorTarget Color;
};

TEST_F(FValidationRecording, BeginAndEnd)
{
	const auto List = Make.List("L");
	EXPECT_EQ(List->Begin().Code, ERTResult::InvalidArgument);
	ExpectMessage({"list 'L'", "Begin", "recording already"});
	EXPECT_OK(List->End());
	EXPECT_FALSE(List->End());
	ExpectMessage({"list 'L'", "End", "not recording"});
	List->BeginMarker("M");
	ExpectMessage({"BeginMarker", "not recording"});
	EXPECT_OK(List->Begin());
	List->EndMarker();
	ExpectMessage({"EndMarker", "no marker"});
	List->BeginMarker("M");
	EXPECT_OK(List->End());
	ExpectMessage({"1 markers are still open"});
}

TEST_F(FValidationRecording, Submission)
{
	const auto List = Make.List("L");
	IRTCommandList* Raw = List.Get();
	EXPECT_FALSE(Make.Device->Submit(&Raw, 1, nullptr));
	ExpectMessage({"Submit", "'L'", "not been ended"});
	EXPECT_OK(List->End());
	IRTCommandList* Twice[] = {Raw, Raw};
	EXPECT_FALSE(Make.Device->Submit(Twice, 2, nullptr));
	ExpectMessage({"'L'", "twice"});
	Mock->SetManualFences(true);
	FRTFence Fence = 0;
	EXPECT_OK(Make.Device->Submit(&Raw, 1, &Fence));
	EXPECT_FALSE(Make.Device->Submit(&Raw, 1, nullptr));
	ExpectMessage({"'L'", "submitted already"});
	EXPECT_FALSE(List->Begin());
	ExpectMessage({"'L'", "Begin", "has not finished"});
	Mock->CompleteUpTo(Fence);
	EXPECT_OK(List->Begin());
	EXPECT_FALSE(Make.Device->WaitFor(Fence + 1, 0));
	ExpectMessage({"WaitFor", "no submission has returned fence"});
}

TEST_F(FValidationRecording, ImportedLists)
{
	TRTRef<IRTCommandList> List;
	ASSERT_OK(Make.Device->ImportCommandList(7, List.ReleaseAndGetAddress()));
	EXPECT_FALSE(List->Begin());
	ExpectMessage({"Begin", "imported"});
	EXPECT_FALSE(List->End());
	ExpectMessage({"End", "imported"});
	IRTCommandList* Raw = List.Get();
	EXPECT_FALSE(Make.Device->Submit(&Raw, 1, nullptr));
	ExpectMessage({"Submit", "is imported"});
	const auto Buffer = Make.Buffer(4);
	List->FillBuffer(Buffer.Get(), 0, 4, 1);
	FRTFence Fence = 0;
	EXPECT_OK(Make.Device->NotifyExternalSubmit(&Raw, 1, &Fence));
	EXPECT_OK(Make.Device->WaitFor(Fence, 0));
	EXPECT_EQ(Mock->GetBytes(Unwrap(Buffer.Get()))[0], 1);
}

// The error is the device's, not a wrong use. The list has run, so the fence of its work must be there.
TEST_F(FValidationRecording, ErrorsOnImportedListsComeWithAFence)
{
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 8, 16);
	TRTRef<IRTCommandList> List;
	ASSERT_OK(Make.Device->ImportCommandList(7, List.ReleaseAndGetAddress()));
	for (uint32_t Update = 0; Update <= Table->GetDesc().Copies; ++Update) // one more than there are host copies
	{
		Table->SetRecord(ERTRecordKind::Hit, 7, 2, &Update, 4);
		if (Update == Table->GetDesc().Copies) { Mock->FailAllocation(1); }
		List->UpdateShaderTable(Table.Get());
	}
	EXPECT_EQ(List->GetStatus().Code, ERTResult::OutOfDeviceMemory);
	IRTCommandList* Raw = List.Get();
	FRTFence Fence = 0;
	EXPECT_EQ(Make.Device->NotifyExternalSubmit(&Raw, 1, &Fence).Code, ERTResult::OutOfDeviceMemory);
	EXPECT_GT(Fence, 0u);
	EXPECT_OK(Make.Device->WaitFor(Fence, 0));
	EXPECT_FALSE(Make.Device->NotifyExternalSubmit(&Raw, 1, nullptr));
	ExpectMessage({"has been submitted already"});
}

TEST_F(FValidationRecording, IndirectArguments)
{
	const auto Pipeline = Make.Compute();
	const auto Plain = Make.Buffer(16, ERTMemory::Device, "Plain");
	const auto Arguments = Make.Buffer(16, ERTMemory::Device, "Arguments", ERTBufferUsage::Indirect | ERTBufferUsage::CopyDest);
	const auto List = Make.List();
	List->DispatchIndirect(Arguments.Get(), 0);
	ExpectMessage({"DispatchIndirect"}); // no pipeline
	List->SetPipeline(Pipeline.Get());
	List->DispatchIndirect(Plain.Get(), 0);
	ExpectMessage({"DispatchIndirect", "buffer 'Plain'", "without the usage Indirect"});
	List->DispatchIndirect(Arguments.Get(), 8);
	ExpectMessage({"DispatchIndirect", "buffer 'Arguments'", "12 bytes at 8 of 16"});
	List->DispatchIndirect(Arguments.Get(), 2);
	ExpectMessage({"DispatchIndirect", "no multiple of 4"});
	List->FillBuffer(Arguments.Get(), 0, 16, 1);
	List->DispatchIndirect(Arguments.Get(), 4);
	EXPECT_OK(List->End());
	IRTCommandList* Raw = List.Get();
	EXPECT_FALSE(Make.Device->Submit(&Raw, 1, nullptr));
	ExpectMessage({"DispatchIndirect", "buffer 'Arguments'", "the call needs"});
}

TEST_F(FValidationRecording, CopiesInRange)
{
	const auto A = Make.Buffer(16, ERTMemory::Device, "A"), B = Make.Buffer(16, ERTMemory::Device, "B");
	const auto Plain = Make.Buffer(16, ERTMemory::Device, "Plain", ERTBufferUsage::Storage);
	const auto List = Make.List();
	List->CopyBuffer(A.Get(), 8, B.Get(), 0, 9);
	ExpectMessage({"CopyBuffer", "buffer 'A'", "9 bytes at 8 of 16"});
	List->CopyBuffer(A.Get(), 0, B.Get(), ~0ull, 4);
	ExpectMessage({"buffer 'B'"});
	List->CopyBuffer(A.Get(), 0, B.Get(), 0, 0);
	ExpectMessage({"0 bytes"});
	List->CopyBuffer(Plain.Get(), 0, B.Get(), 0, 4);
	ExpectMessage({"buffer 'Plain'", "without the usage CopyDest"});
	List->CopyBuffer(A.Get(), 0, A.Get(), 8, 4);
	ExpectMessage({"both source and destination"});
	List->FillBuffer(A.Get(), 2, 4, 0);
	ExpectMessage({"FillBuffer", "multiples of 4"});
	EXPECT_EQ(Reached(ERTMockCall::CopyBuffer) + Reached(ERTMockCall::FillBuffer), 0u);
}

TEST_F(FValidationRecording, TextureCopies)
{
	const auto Texture = Make.Texture(4, 4, ERTFormat::RGBA16_FLOAT, 2);
	const auto Buffer = Make.Buffer(128, ERTMemory::Upload, "B");
	const auto List = Make.List();
	List->CopyBufferToTexture(Texture.Get(), 2, 0, Buffer.Get(), 0);
	ExpectMessage({"texture 'Texture'", "mip 2 of 2"});
	List->CopyBufferToTexture(Texture.Get(), 0, 1, Buffer.Get(), 0);
	ExpectMessage({"layer 1 of 1"});
	List->CopyBufferToTexture(Texture.Get(), 0, 0, Buffer.Get(), 8);
	ExpectMessage({"buffer 'B'", "128 bytes at 8 of 128"});
	List->CopyBufferToTexture(Texture.Get(), 1, 0, Buffer.Get(), 4);
	ExpectMessage({"offset 4 is not a multiple of 8"});
	const auto Integers = Make.Texture(4, 4, ERTFormat::R32_UINT, 2);
	List->GenerateMips(Integers.Get());
	ExpectMessage({"GenerateMips", "cannot be filtered"});
	EXPECT_EQ(Reached(ERTMockCall::CopyBufferToTexture), 0u);
}

TEST_F(FValidationRecording, DispatchesAndConstants)
{
	const auto Pipeline = Make.Compute("C");
	const auto List = Make.List();
	const uint8_t Bytes[256] = {};
	List->PushConstants(Bytes, 4);
	ExpectMessage({"PushConstants", "no pipeline"});
	List->Dispatch(1, 1, 1);
	ExpectMessage({"Dispatch", "no compute pipeline"});
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(Bytes, 132);
	ExpectMessage({"132 bytes", "at most 128"});
	List->PushConstants(Bytes, 6);
	ExpectMessage({"6 bytes", "multiple of 4"});
	List->Dispatch(1, 0, 1);
	ExpectMessage({"1 x 0 x 1", "'C'"});
	EXPECT_EQ(Reached(ERTMockCall::Dispatch) + Reached(ERTMockCall::PushConstants), 0u);
	List->PushConstants(Bytes, 128);
	List->Dispatch(1, 1, 1);
	EXPECT_EQ(Reached(ERTMockCall::Dispatch), 1u);
}

TEST_F(FValidationRecording, RasterPasses)
{
	const auto Target = Make.Texture(4, 4, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::RenderTarget);
	const auto Sampled = Make.Texture(4, 4, ERTFormat::RGBA8_UNORM);
	const auto Small = Make.Texture(2, 2, ERTFormat::RGBA8_UNORM, 1, ERTTextureUsage::RenderTarget, "Small");
	const auto Fits = Raster(ERTFormat::RGBA8_UNORM), Other = Raster(ERTFormat::R8_UNORM);
	const auto Compute = Make.Compute();
	const auto Indices = Make.Buffer(12);
	const auto List = Make.List();
	Barrier(List.Get(), nullptr, Target.Get(), ERTAccess::None, ERTAccess::RenderTarget);
	List->Draw(3, 1);
	ExpectMessage({"Draw", "outside a raster pass"});
	List->EndRasterPass();
	ExpectMessage({"EndRasterPass", "no raster pass"});
	List->BeginRasterPass(Pass(Sampled.Get()));
	ExpectMessage({"without the usage RenderTarget"});
	List->BeginRasterPass(Pass(Small.Get()));
	ExpectMessage({"'Small'", "2 x 2 texels, the pass 4 x 4"});
	List->BeginRasterPass(Pass(Target.Get()));
	List->SetPipeline(Compute.Get());
	List->Draw(3, 1);
	ExpectMessage({"Draw", "no raster pipeline has been set, but pipeline 'Compute'"});
	List->Dispatch(1, 1, 1);
	ExpectMessage({"Dispatch", "within a raster pass"});
	List->FillBuffer(Indices.Get(), 0, 4, 0);
	ExpectMessage({"FillBuffer", "within a raster pass"});
	EXPECT_FALSE(List->End());
	ExpectMessage({"End", "within a raster pass"});
	List->SetPipeline(Other.Get());
	List->Draw(3, 1);
	ExpectMessage({"formats are not those of the raster pass"});
	List->SetPipeline(Fits.Get());
	List->DrawIndexed(3, 1, 0, 0);
	ExpectMessage({"DrawIndexed", "no index buffer"});
	List->SetIndexBuffer(Indices.Get(), 4, ERTIndexType::UInt32);
	List->DrawIndexed(3, 1, 0, 0);
	ExpectMessage({"indices 0 + 3, the buffer holds 2"});
	EXPECT_EQ(Reached(ERTMockCall::Draw) + Reached(ERTMockCall::DrawIndexed), 0u);
	List->Draw(3, 1);
	List->DrawIndexed(2, 1, 0, 0);
	List->EndRasterPass();
	Make.Submit(List.Get());
}

TEST_F(FValidationRecording, Queries)
{
	TRTRef<IRTQueryPool> Pool;
	EXPECT_FALSE(Make.Device->CreateQueryPool(ERTQuery::Timestamp, 0, Pool.ReleaseAndGetAddress()));
	ExpectMessage({"CreateQueryPool"});
	ASSERT_OK(Make.Device->CreateQueryPool(ERTQuery::Timestamp, 2, Pool.ReleaseAndGetAddress()));
	const auto List = Make.List();
	List->WriteTimestamp(Pool.Get(), 2);
	ExpectMessage({"WriteTimestamp", "query 2 of 2"});
	List->ResetQueries(Pool.Get(), 1, 2);
	ExpectMessage({"ResetQueries", "1 + 2 of 2"});
	uint64_t Time = 0;
	EXPECT_FALSE(Pool->GetResults(2, 1, &Time));
	ExpectMessage({"GetResults"});
}

TEST_F(FValidationRecording, BarriersAreWellFormed)
{
	const auto Buffer = Make.Buffer(4);
	const auto Texture = Make.Texture(1, 1, ERTFormat::R8_UNORM);
	const auto List = Make.List();
	Barrier(List.Get(), Buffer.Get(), Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	ExpectMessage({"Barriers", "both a buffer and a texture"});
	Barrier(List.Get(), Buffer.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::None);
	ExpectMessage({"After is None"});
	EXPECT_EQ(Reached(ERTMockCall::Barrier), 0u);
}

TEST_F(FValidationRecording, RaysNeedTheTablesPipelineAndAReadyRayGen)
{
	const auto Pipeline = Make.RayTracing("A");
	FRTShaderCode Shader = {DummyWords, std::size(DummyWords), ERTShaderStage::RayGen, "G"};
	FRTShaderGroup Group;
	Group.General = 0;
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = &Shader;
	Desc.Groups = &Group;
	Desc.ShaderCount = Desc.GroupCount = 1;
	Desc.Name = "B";
	TRTRef<IRTPipeline> Other;
	ASSERT_OK(Make.Device->CreateRayTracingPipeline(Desc, Other.ReleaseAndGetAddress()));
	const auto Table = Make.Table(Pipeline.Get(), 1);
	const auto List = Make.List();
	List->SetPipeline(Other.Get());
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	ExpectMessage({"TraceRays", "'Table' is of pipeline 'A'", "'B' is set"});
	List->SetPipeline(Pipeline.Get());
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	ExpectMessage({"ray generation record 0 was never set"});
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	ExpectMessage({"set after the last UpdateShaderTable"});
	List->UpdateShaderTable(Table.Get());
	List->TraceRays(Table.Get(), 1, 1, 1, 1);
	ExpectMessage({"ray generation record 1 of 1"});
	List->TraceRays(Table.Get(), 0, 1, 0, 1);
	ExpectMessage({"1 x 0 x 1 rays"});
	EXPECT_EQ(Reached(ERTMockCall::TraceRays), 0u);
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	EXPECT_EQ(Reached(ERTMockCall::TraceRays), 1u);
	Make.Submit(List.Get());
}

} // namespace
} // namespace Lantern
