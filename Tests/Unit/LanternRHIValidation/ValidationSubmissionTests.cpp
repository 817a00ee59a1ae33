// Rules that depend on what was submitted before: resource states, builds, tables.
#include "Support/ValidationTestTools.h"

namespace Lantern
{
namespace
{

class FValidationSubmission : public FValidationFixture
{
protected:
	void SetUp() override
	{
		FValidationFixture::SetUp();
		Vertices = Make.Buffer(36, ERTMemory::Upload, "Vertices");
		Scratch = Make.Scratch();
		Instances = Make.Buffer(4 * sizeof(FRTInstance), ERTMemory::Upload, "Instances");
		Section = Make.Section(Vertices.Get());
	}
	FRTInstance* Items() { return static_cast<FRTInstance*>(Instances->GetMapped()); }
	TRTRef<IRTGeometry> Built(const char* Name)
	{
		auto Geometry = Make.Geometry(Section, Name);
		const auto List = Make.List();
		Make.Build(List.Get(), Geometry.Get(), Section, Scratch.Get());
		Make.BuildBarrier(List.Get());
		Make.Submit(List.Get());
		return Geometry;
	}

	TRTRef<IRTBuffer> Vertices, Scratch, Instances;
	FRTGeometrySection Section;
};

TEST_F(FValidationSubmission, TextureStates)
{
	const auto Texture = Make.Texture(1, 1, ERTFormat::RGBA8_UNORM);
	const auto Readback = Make.Buffer(4, ERTMemory::Readback, "Readback");
	const float Black[4] = {};
	auto List = Make.List();
	List->ClearTexture(Texture.Get(), Black);
	ExpectRefused(List.Get());
	ExpectMessage({"ClearTexture", "texture 'Texture' is in None", "needs CopyWrite"});

	List = Make.List();
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	List->ClearTexture(Texture.Get(), Black);
	Make.Submit(List.Get());

	List = Make.List();
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::ShaderRead, ERTAccess::CopyRead);
	ExpectRefused(List.Get());
	ExpectMessage({"Barriers", "'Texture' is in CopyWrite", "says ShaderRead"});

	// The refused submission left the state alone.
	List = Make.List();
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::CopyWrite, ERTAccess::CopyRead);
	List->CopyTextureToBuffer(Readback.Get(), 0, Texture.Get(), 0, 0);
	Make.Submit(List.Get());
}

TEST_F(FValidationSubmission, ImportedTexturesTakeTheirFirstState)
{
	FRTTextureDesc Desc;
	Desc.Width = Desc.Height = 1;
	Desc.Format = ERTFormat::RGBA8_UNORM;
	Desc.Usage = ERTTextureUsage::Sampled;
	Desc.Name = "Engine";
	TRTRef<IRTTexture> Texture;
	ASSERT_OK(Make.Device->ImportTexture(Desc, 99, Texture.ReleaseAndGetAddress()));
	auto List = Make.List();
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::RenderTarget, ERTAccess::ShaderRead);
	Make.Submit(List.Get());
	List = Make.List();
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::RenderTarget, ERTAccess::ShaderRead);
	ExpectRefused(List.Get());
	ExpectMessage({"'Engine' is in ShaderRead", "says RenderTarget"});
}

TEST_F(FValidationSubmission, BufferStates)
{
	const auto Upload = Make.Buffer(16, ERTMemory::Upload, "Upload");
	const auto Middle = Make.Buffer(16, ERTMemory::Device, "Middle");
	const auto Readback = Make.Buffer(16, ERTMemory::Readback, "Readback");
	auto List = Make.List();
	List->CopyBuffer(Middle.Get(), 0, Upload.Get(), 0, 16);
	List->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 16);
	ExpectRefused(List.Get());
	ExpectMessage({"CopyBuffer", "'Middle' is in CopyWrite", "needs CopyRead"});

	List = Make.List();
	List->CopyBuffer(Middle.Get(), 0, Upload.Get(), 0, 16);
	Barrier(List.Get(), Middle.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::CopyRead);
	List->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 16);
	Barrier(List.Get(), Readback.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead);
	Make.Submit(List.Get());

	// The next frame: the read-back buffer is free again, a memory barrier does for the rest.
	List = Make.List();
	List->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 16);
	Barrier(List.Get(), nullptr, nullptr, ERTAccess::CopyRead, ERTAccess::CopyWrite);
	List->FillBuffer(Middle.Get(), 0, 16, 0);
	Make.Submit(List.Get());
}

TEST_F(FValidationSubmission, GenerateMipsLeavesShaderRead)
{
	const auto Texture = Make.Texture(4, 4, ERTFormat::RGBA8_UNORM, 3);
	const auto List = Make.List();
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::None, ERTAccess::CopyWrite);
	List->GenerateMips(Texture.Get());
	Barrier(List.Get(), nullptr, Texture.Get(), ERTAccess::ShaderRead, ERTAccess::CopyRead);
	Make.Submit(List.Get());
}

TEST_F(FValidationSubmission, BuildDescriptions)
{
	const auto Geometry = Make.Geometry(Section, "G");
	const auto List = Make.List();
	FRTGeometrySection Two[2] = {Section, Section};
	FRTGeometryBuild Build;
	Build.Geometry = Geometry.Get();
	Build.Sections = Two;
	Build.SectionCount = 2;
	Build.Scratch = Scratch.Get();
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"BuildGeometries", "'G'", "2 sections, it was created with 1"});
	Build.SectionCount = 1;
	Two[0].TriangleCount = 2;
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"'G', section 0", "not those of its creation"});
	Two[0] = Section;
	Two[0].VertexOffset = 4;
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"'Vertices'", "36 bytes at 4 of 36"});
	Two[0] = Section;
	Build.bUpdate = true;
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"'G'", "without bAllowUpdate"});
	Build.bUpdate = false;
	Build.ScratchOffset = 4;
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"'G'", "scratch offset 4 is not a multiple of 128"});
	const auto Tiny = Make.Scratch(128);
	Build.ScratchOffset = 0;
	Build.Scratch = Tiny.Get();
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"'G'", "bytes of scratch", "'Scratch' has 128"});
	Build.Scratch = Vertices.Get();
	List->BuildGeometries(&Build, 1);
	ExpectMessage({"'Vertices'", "without the usage Scratch"});
	EXPECT_EQ(Reached(ERTMockCall::BuildGeometry), 0u);
}

TEST_F(FValidationSubmission, ScratchMustNotOverlap)
{
	const auto A = Make.Geometry(Section, "A"), B = Make.Geometry(Section, "B");
	const auto List = Make.List();
	FRTGeometryBuild Builds[2];
	Builds[0] = {A.Get(), &Section, 1, false, Scratch.Get(), 0};
	Builds[1] = {B.Get(), &Section, 1, false, Scratch.Get(), 128};
	List->BuildGeometries(Builds, 2);
	ExpectMessage({"'B'", "overlaps that of another build"});
	EXPECT_EQ(Reached(ERTMockCall::BuildGeometry), 1u) << "the good one goes through";
	Make.BuildBarrier(List.Get());
	List->BuildGeometries(&Builds[1], 1);
	EXPECT_EQ(Reached(ERTMockCall::BuildGeometry), 2u);
	Make.BuildBarrier(List.Get());
	Builds[1] = Builds[0];
	Builds[1].ScratchOffset = 4096;
	List->BuildGeometries(Builds, 2);
	ExpectMessage({"build 1 is of the same geometry"});
}

TEST_F(FValidationSubmission, UpdateNeedsABuild)
{
	const auto Geometry = Make.Geometry(Section, "Skin", true);
	auto List = Make.List();
	Make.Build(List.Get(), Geometry.Get(), Section, Scratch.Get(), true);
	ExpectRefused(List.Get());
	ExpectMessage({"update of geometry 'Skin' before any build"});
	List = Make.List();
	Make.Build(List.Get(), Geometry.Get(), Section, Scratch.Get());
	Make.BuildBarrier(List.Get());
	Make.Build(List.Get(), Geometry.Get(), Section, Scratch.Get(), true);
	Make.Submit(List.Get());
	EXPECT_EQ(Mock->GetGeometry(Unwrap(Geometry.Get())).UpdateCount, 1u);
}

TEST_F(FValidationSubmission, IndicesInRange)
{
	const auto Indices = Make.Buffer(12, ERTMemory::Upload, "Indices");
	const FRTGeometrySection Indexed = Make.Section(Vertices.Get(), Indices.Get());
	const auto Geometry = Make.Geometry(Indexed, "G");
	const uint32_t Wrong[3] = {0, 1, 3};
	std::memcpy(Indices->GetMapped(), Wrong, sizeof(Wrong));
	const auto List = Make.List();
	Make.Build(List.Get(), Geometry.Get(), Indexed, Scratch.Get());
	ExpectRefused(List.Get());
	ExpectMessage({"'G', section 0", "index 3 (number 2), but there are 3 vertices"});
}

TEST_F(FValidationSubmission, Instances)
{
	const auto Rock = Built("Rock"), Raw = Make.Geometry(Section, "Raw");
	const auto Scene = Make.Scene(3);
	auto List = Make.List();
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 4, Scratch.Get(), 0);
	ExpectMessage({"BuildScene", "'Scene'", "4 instances, it was created for 3"});
	List->BuildScene(Scene.Get(), Instances.Get(), 8, 1, Scratch.Get(), 0);
	ExpectMessage({"'Instances'", "offset 8 is not a multiple of 16"});
	List->BuildScene(Scene.Get(), Instances.Get(), 208, 1, Scratch.Get(), 0);
	ExpectMessage({"'Instances'", "64 bytes at 208 of 256"});
	EXPECT_EQ(Reached(ERTMockCall::BuildScene), 0u);
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 3, Scratch.Get(), 0);
	// The instances may be written until the submission.
	Items()[0] = Make.Instance(Rock->GetDeviceAddress());
	Items()[1] = Make.Instance(0x42);
	Items()[2] = Make.Instance(0);
	ExpectRefused(List.Get());
	ExpectMessage({"'Scene'", "instance 1 points at 0x42"});
	List = Make.List();
	Items()[1] = Make.Instance(0);
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 3, Scratch.Get(), 0);
	Items()[1] = Make.Instance(Raw->GetDeviceAddress());
	ExpectRefused(List.Get());
	ExpectMessage({"instance 1 points at geometry 'Raw', which was never built"});
}

TEST_F(FValidationSubmission, BuildsOfAnEarlierListCount)
{
	const auto Raw = Make.Geometry(Section, "Raw");
	const auto Scene = Make.Scene();
	const auto Builds = Make.List("Builds"), List = Make.List();
	Make.Build(Builds.Get(), Raw.Get(), Section, Scratch.Get());
	Make.BuildBarrier(Builds.Get());
	Items()[0] = Make.Instance(Raw->GetDeviceAddress());
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	ExpectRefused(List.Get());
	ExpectMessage({"instance 0 points at geometry 'Raw', which was never built"});
	Make.Submit(Builds.Get());
}

/// Threads record lists that are submitted in another order.
TEST_F(FValidationSubmission, BuildsMayBeRecordedBehindWhatNeedsThem)
{
	const auto Raw = Make.Geometry(Section, "Raw");
	const auto Scene = Make.Scene();
	const auto Builds = Make.List("Builds"), List = Make.List();
	Items()[0] = Make.Instance(Raw->GetDeviceAddress());
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	Make.Build(Builds.Get(), Raw.Get(), Section, Scratch.Get());
	Make.BuildBarrier(Builds.Get());
	Make.Submit(Builds.Get());
	Make.Submit(List.Get());
}

TEST_F(FValidationSubmission, ReleasedGeometriesMustBeKept)
{
	auto Tree = Built("Tree");
	const auto Scene = Make.Scene();
	Items()[0] = Make.Instance(Tree->GetDeviceAddress());
	auto Kept = Make.List();
	Kept->KeepAlive(Tree.Get());
	Kept->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	Tree.Reset();
	Make.Submit(Kept.Get());
	const auto List = Make.List();
	Make.BuildBarrier(List.Get());
	const uint32_t Before = Reached(ERTMockCall::BuildScene);
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	ExpectMessage({"BuildScene", "'Scene'", "instance 0 points at the released geometry 'Tree'"});
	EXPECT_EQ(Reached(ERTMockCall::BuildScene), Before) << "the driver never saw it";
	Make.Submit(List.Get());
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
}

TEST_F(FValidationSubmission, BuildsNeedABarrierBehindThem)
{
	const auto Geometry = Make.Geometry(Section, "G");
	const auto Scene = Make.Scene();
	const auto List = Make.List();
	Items()[0] = Make.Instance(Geometry->GetDeviceAddress());
	Make.Build(List.Get(), Geometry.Get(), Section, Scratch.Get());
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 4096);
	ExpectMessage({"'Scene'", "no memory barrier from BuildWrite"});
	Make.BuildBarrier(List.Get());
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 4096);
	EXPECT_EQ(Reached(ERTMockCall::BuildScene), 1u);
	Make.Submit(List.Get());
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
}

TEST_F(FValidationSubmission, HitRecordsBeyondTheTable)
{
	const auto Geometry = Built("G");
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 2);
	const auto Scene = Make.Scene();
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Hit, 0, 2, nullptr, 0);
	const auto Trace = [&](uint32_t TableOffset) {
		Items()[0] = Make.Instance(Geometry->GetDeviceAddress(), TableOffset);
		auto List = Make.List();
		Make.BuildBarrier(List.Get());
		List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
		Make.BuildBarrier(List.Get());
		List->UpdateShaderTable(Table.Get());
		List->SetPipeline(Pipeline.Get());
		List->TraceRays(Table.Get(), 0, 1, 1, 1);
		return List;
	};
	ExpectRefused(Trace(2).Get());
	ExpectMessage({"instance 0 of scene 'Scene' reaches hit record 2, but shader table 'Table' has 2"});
	Make.Submit(Trace(0).Get());
	Make.Submit(Trace(1).Get()); // never set: rays that reach it run no shader
}

TEST_F(FValidationSubmission, TableUpdateMustBeSubmitted)
{
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 1);
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	const auto Forgotten = Make.List("Forgotten"), List = Make.List();
	Forgotten->UpdateShaderTable(Table.Get());
	List->SetPipeline(Pipeline.Get());
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	ExpectRefused(List.Get());
	ExpectMessage({"TraceRays", "'Table' has never been updated"});
}

} // namespace
} // namespace Lantern
