// Rules for the creation, import and release of objects.
#include "Support/TextCheck.h"
#include "Support/ValidationTestTools.h"

namespace Lantern
{
namespace
{

class FValidationCreation : public FValidationFixture
{
protected:
	IRTDevice& Device() { return *Make.Device; }
};

TEST_F(FValidationCreation, Buffers)
{
	TRTRef<IRTBuffer> Out;
	EXPECT_EQ(
	    Device().CreateBuffer({0, AnyUsage, ERTMemory::Device, "Empty"}, Out.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument);
	ExpectMessage({"CreateBuffer", "'Empty'", "size is 0"});
	EXPECT_FALSE(Device().CreateBuffer({4, ERTBufferUsage::None, ERTMemory::Device, "Useless"}, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'Useless'", "no usage"});
	EXPECT_EQ(Reached(ERTMockCall::CreateBuffer), 0u);
	EXPECT_FALSE(Out);
}

TEST_F(FValidationCreation, NamesAreShownAsEscapes)
{
	TRTRef<IRTBuffer> Out;
	for (const std::string& Name : {std::string("\x1b[31m\xff\u202E\nerror: forged"), std::string(10'000, '\n')})
	{
		const FRTStatus Status = Device().CreateBuffer({0, AnyUsage, ERTMemory::Device, Name.c_str()}, Out.ReleaseAndGetAddress());
		EXPECT_TRUE(IsCleanText(Status.Message)) << testing::PrintToString(Status.Message);
		ASSERT_EQ(Messages.size(), 1u);
		EXPECT_TRUE(IsCleanText(Messages[0])) << testing::PrintToString(Messages[0]);
		ExpectMessage({"CreateBuffer", Name[0] == '\n' ? "\\n\\n…'" : "'\\x1b[31m\\xff\\u{202e}\\nerror: forged'", "size is 0"});
	}
}

TEST_F(FValidationCreation, Textures)
{
	FRTTextureDesc Good;
	Good.Width = 8;
	Good.Height = 4;
	Good.Format = ERTFormat::RGBA8_SRGB;
	Good.Usage = ERTTextureUsage::Sampled;
	Good.Name = "T";
	TRTRef<IRTTexture> Out;
	const auto Refuses = [&](FRTTextureDesc Desc, const char* Rule) {
		EXPECT_EQ(Device().CreateTexture(Desc, Out.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument) << Rule;
		ExpectMessage({"CreateTexture", "'T'", Rule});
	};
	FRTTextureDesc Desc = Good;
	Desc.Height = 0;
	Refuses(Desc, "8 x 0");
	Desc = Good;
	Desc.MipCount = 5;
	Refuses(Desc, "5 mips, at most 4");
	Desc = Good;
	Desc.Format = ERTFormat::Unknown;
	Refuses(Desc, "Unknown");
	Desc = Good;
	Desc.Usage = ERTTextureUsage::Depth;
	Refuses(Desc, "not a depth format");
	Desc = Good;
	Desc.Usage = ERTTextureUsage::Storage;
	Refuses(Desc, "sRGB");
	Desc = Good;
	Desc.Format = ERTFormat::D32_FLOAT;
	Desc.Usage = ERTTextureUsage::RenderTarget;
	Refuses(Desc, "depth format");
	EXPECT_EQ(Reached(ERTMockCall::CreateTexture), 0u);
	EXPECT_OK(Device().CreateTexture(Good, Out.ReleaseAndGetAddress()));
	EXPECT_EQ(Device().ImportTexture(Good, 0, Out.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument);
	ExpectMessage({"ImportTexture", "NativeImage is 0"});
}

TEST_F(FValidationCreation, ImportedBuffersMustBeThere)
{
	TRTRef<IRTBuffer> Out;
	const FRTBufferDesc Good{256, ERTBufferUsage::Storage, ERTMemory::Device, "Theirs"};
	const auto Refuses = [&](const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, const char* Part) {
		EXPECT_EQ(Device().ImportBuffer(Desc, Native, Out.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument);
		ExpectMessage({"ImportBuffer", Part});
	};
	Refuses({0, ERTBufferUsage::Storage, ERTMemory::Device, "Theirs"}, {1, 0}, "size is 0");
	Refuses({256, ERTBufferUsage::None, ERTMemory::Device, "Theirs"}, {1, 0}, "no usage");
	Refuses(Good, {}, "Handle and Address are 0");
	Refuses(Good, {1, 8}, "multiple of 16");
	EXPECT_EQ(Reached(ERTMockCall::ImportBuffer), 0u);
	EXPECT_OK(Device().ImportBuffer(Good, {1, 0}, Out.ReleaseAndGetAddress()));
	FRTTextureDesc Cube{8, 8, 1, 4, ERTFormat::RGBA8_UNORM, ERTTextureUsage::Sampled, "Cube"};
	Cube.bCube = true;
	TRTRef<IRTTexture> Texture;
	EXPECT_EQ(Device().CreateTexture(Cube, Texture.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument);
	ExpectMessage({"CreateTexture", "six layers"});
}

TEST_F(FValidationCreation, EnvironmentErrorsPassWithoutMessage)
{
	FRTTextureDesc Desc;
	Desc.Width = Desc.Height = 100000;
	Desc.Format = ERTFormat::R8_UNORM;
	Desc.Usage = ERTTextureUsage::Sampled;
	TRTRef<IRTTexture> Out;
	EXPECT_EQ(Device().CreateTexture(Desc, Out.ReleaseAndGetAddress()).Code, ERTResult::Unsupported);
	Mock->FailAllocation(1);
	TRTRef<IRTBuffer> Buffer;
	EXPECT_EQ(
	    Device().CreateBuffer({4, AnyUsage, ERTMemory::Device, "B"}, Buffer.ReleaseAndGetAddress()).Code, ERTResult::OutOfDeviceMemory);
}

TEST_F(FValidationCreation, Geometries)
{
	const auto Vertices = Make.Buffer(360);
	const FRTGeometrySection Good = Make.Section(Vertices.Get());
	TRTRef<IRTGeometry> Out;
	const auto Refuses = [&](std::vector<FRTGeometrySection> Sections, const char* Rule) {
		FRTGeometryDesc Desc;
		Desc.Sections = Sections.data();
		Desc.SectionCount = static_cast<uint32_t>(Sections.size());
		Desc.Name = "G";
		EXPECT_EQ(Device().CreateGeometry(Desc, Out.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument) << Rule;
		ExpectMessage({"CreateGeometry", "'G'", Rule});
	};
	Refuses({}, "no sections");
	FRTGeometrySection Section = Good;
	Section.TriangleCount = 0;
	Refuses({Good, Section}, "section 1 has no triangles");
	Section = Good;
	Section.VertexStride = 10;
	Refuses({Section}, "stride of 10");
	Section = Good;
	Section.TriangleCount = 2;
	Refuses({Section}, "2 triangles of 3 vertices");
	Section = Good;
	Section.bProcedural = true;
	Section.VertexStride = 24;
	Refuses({Good, Section}, "mixes triangles with AABBs");
	Section.VertexCount = 0;
	Refuses({Section}, "no AABBs");
	EXPECT_EQ(Reached(ERTMockCall::CreateGeometry), 0u);
}

TEST_F(FValidationCreation, Pipelines)
{
	TRTRef<IRTPipeline> Out;
	FRTComputePipelineDesc Compute;
	Compute.Name = "C";
	EXPECT_FALSE(Device().CreateComputePipeline(Compute, Out.ReleaseAndGetAddress()));
	ExpectMessage({"CreateComputePipeline", "'C'", "no code"});
	Compute.Shader = {DummyWords, std::size(DummyWords), ERTShaderStage::Vertex, "V"};
	EXPECT_FALSE(Device().CreateComputePipeline(Compute, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'V'", "vertex shader, not a compute shader"});

	FRTRasterPipelineDesc Raster;
	Raster.Name = "R";
	Raster.Vertex = Compute.Shader;
	EXPECT_FALSE(Device().CreateRasterPipeline(Raster, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'R'", "neither colour nor depth"});
	const ERTFormat Wrong = ERTFormat::D32_FLOAT;
	Raster.Fragment = {DummyWords, std::size(DummyWords), ERTShaderStage::Fragment, "F"};
	Raster.ColorFormats = &Wrong;
	Raster.ColorCount = 1;
	EXPECT_FALSE(Device().CreateRasterPipeline(Raster, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'R'", "colour target 0"});
}

TEST_F(FValidationCreation, ShaderGroups)
{
	const FRTShaderCode Shaders[] = {
	    {DummyWords, std::size(DummyWords), ERTShaderStage::RayGen, "Gen"},
	    {DummyWords, std::size(DummyWords), ERTShaderStage::ClosestHit, "Hit"},
	    {DummyWords, std::size(DummyWords), ERTShaderStage::Intersection, "Box"},
	};
	TRTRef<IRTPipeline> Out;
	const auto Refuses = [&](std::vector<FRTShaderGroup> Groups, const char* Rule) {
		FRTRayTracingPipelineDesc Desc;
		Desc.Shaders = Shaders;
		Desc.ShaderCount = 3;
		Desc.Groups = Groups.data();
		Desc.GroupCount = static_cast<uint32_t>(Groups.size());
		Desc.Name = "P";
		EXPECT_FALSE(Device().CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress())) << Rule;
		ExpectMessage({"CreateRayTracingPipeline", "'P'", Rule});
	};
	const FRTShaderGroup Gen = {ERTGroupKind::General, 0};
	Refuses({}, "no shaders or no groups");
	Refuses({Gen, {ERTGroupKind::General, 1}}, "group 1 is general, but has a closest-hit shader");
	Refuses({Gen, {ERTGroupKind::General, 7}}, "group 1 has shader 7 of 3");
	Refuses({Gen, {ERTGroupKind::Triangles, NoShader, 1, NoShader, 2}}, "group 1 may have no intersection shader");
	Refuses({Gen, {ERTGroupKind::Procedural, NoShader, 1}}, "group 1 has no intersection shader");
	Refuses({Gen, {ERTGroupKind::Triangles, NoShader, 2}}, "closest-hit shader one of another stage");
	Refuses({Gen, {ERTGroupKind::Triangles, 0, 1}}, "hit group with a general shader");
	Refuses({{ERTGroupKind::Triangles, NoShader, 1}}, "no group has a ray generation shader");
	EXPECT_EQ(Reached(ERTMockCall::CreateRayTracingPipeline), 0u);
}

TEST_F(FValidationCreation, ShaderTables)
{
	const auto Compute = Make.Compute("Blur");
	const auto Pipeline = Make.RayTracing();
	TRTRef<IRTShaderTable> Out;
	FRTShaderTableDesc Desc;
	Desc.Name = "T";
	EXPECT_FALSE(Device().CreateShaderTable(Desc, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'T'", "Pipeline is null"});
	Desc.Pipeline = Compute.Get();
	EXPECT_FALSE(Device().CreateShaderTable(Desc, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'T'", "'Blur'", "not for ray tracing"});
	Desc.Pipeline = Pipeline.Get();
	Desc.RecordDataBytes = MaxRecordDataBytes + 1;
	EXPECT_FALSE(Device().CreateShaderTable(Desc, Out.ReleaseAndGetAddress()));
	ExpectMessage({"33 bytes of record data"});
	EXPECT_EQ(Reached(ERTMockCall::CreateShaderTable), 0u);
	const auto Table = Make.Table(Pipeline.Get(), 1);
	EXPECT_EQ(Table->GetDesc().Pipeline, Pipeline.Get()) << "the wrapped pipeline, not the hidden one";
}

TEST_F(FValidationCreation, Records)
{
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 2, 8);
	const uint8_t Data[16] = {};
	Table->SetRecord(ERTRecordKind::Hit, 2, 2, nullptr, 0);
	ExpectMessage({"'Table'", "hit record 2 is out of range", "has 2"});
	Table->SetRecord(ERTRecordKind::Hit, 0, 6, nullptr, 0);
	ExpectMessage({"hit record 0", "group 6", "has 6"});
	Table->SetRecord(ERTRecordKind::Hit, 0, 1, nullptr, 0);
	ExpectMessage({"group 1", "not a hit group"});
	Table->SetRecord(ERTRecordKind::Miss, 0, 2, nullptr, 0);
	ExpectMessage({"miss record 0", "is a hit group"});
	Table->SetRecord(ERTRecordKind::Miss, 0, 4, nullptr, 0);
	ExpectMessage({"miss record 0", "another stage"});
	Table->SetRecord(ERTRecordKind::Hit, 0, 2, Data, 12);
	ExpectMessage({"12 bytes of data, at most 8"});
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, Data, 4);
	ExpectMessage({"4 bytes of data, at most 0"});
	Table->SetRecord(ERTRecordKind::Hit, 0, 2, Data, 8);
	Table->SetRecord(ERTRecordKind::Hit, 1, 5, Data, 8);
	Table->SetRecord(ERTRecordKind::Callable, 0, 4, nullptr, 0);
}

TEST_F(FValidationCreation, LeaksAreNamed)
{
	auto Buffer = Make.Buffer(4, ERTMemory::Device, "Forgotten");
	auto Texture = Make.Texture(1, 1, ERTFormat::R8_UNORM);
	Texture.Reset();
	Make.Device.Reset();
	ExpectMessage({"buffer 'Forgotten'", "leaked"});
	// The device must live until then: releasing late is wrong, not fatal.
	Buffer.Reset();
}

TEST_F(FValidationCreation, ReleasedAndForeignObjectsAreTold)
{
	auto List = Make.List();
	auto Buffer = Make.Buffer(4);
	IRTBuffer* Stale = Buffer.Get();
	Buffer.Reset();
	List->FillBuffer(Stale, 0, 4, 0);
	ExpectMessage({"'List'", "FillBuffer", "Dest", "already been released"});
	TRTRef<IRTBuffer> Foreign;
	ASSERT_OK(Inner->CreateBuffer({4, AnyUsage, ERTMemory::Device, "F"}, Foreign.ReleaseAndGetAddress()));
	List->FillBuffer(Foreign.Get(), 0, 4, 0);
	ExpectMessage({"Dest", "not an object of this device"});
	List->FillBuffer(nullptr, 0, 4, 0);
	ExpectMessage({"Dest is null"});
	EXPECT_EQ(Reached(ERTMockCall::FillBuffer), 0u);
}

TEST_F(FValidationCreation, UnwrapReachesTheInnerObject)
{
	const auto Buffer = Make.Buffer(4, ERTMemory::Device, "B");
	EXPECT_NE(Unwrap(Buffer.Get()), Buffer.Get());
	EXPECT_NE(Mock->GetBytes(Unwrap(Buffer.Get())), nullptr);
	EXPECT_EQ(Unwrap(Make.Device.Get()), Inner.Get());
	EXPECT_EQ(Unwrap(Inner.Get()), Inner.Get());
}

} // namespace
} // namespace Lantern
