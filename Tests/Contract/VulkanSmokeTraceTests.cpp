// The Vulkan backend alone: acceleration structures, ray-tracing pipelines, shader tables, ray queries.
#include "VulkanSmokeFixture.h"

#include "VulkanSmokeShaders/Query_comp.h"
#include "VulkanSmokeShaders/Trace_rahit.h"
#include "VulkanSmokeShaders/Trace_rchit.h"
#include "VulkanSmokeShaders/Trace_rgen.h"
#include "VulkanSmokeShaders/Trace_rmiss.h"

namespace Lantern
{

struct FHit
{
	uint32_t Value, Kind, Custom;
	float Distance;
};

struct FTracePush
{
	uint64_t Output;
	uint32_t Scene, Mask, MissValue, Add;
	float Step;
	uint32_t Padding = 0;
};

struct FRecord
{
	uint32_t Value, bIgnore;
};

constexpr uint32_t HitFrontFacing = 0xFE, HitBackFacing = 0xFF;

/// A geometry of two triangles that stand in z = 0 over x in [0, 1) and [1, 2): the first opaque, the second not.
/// Four rays look at x = 0.25, 1.25, 2.25, …
class FVulkanSmokeTrace : public FVulkanSmokeTest
{
protected:
	static constexpr uint32_t RayCount = 8;

	void SetUp() override
	{
		FVulkanSmokeTest::SetUp();
		if (IsSkipped() || HasFatalFailure()) { return; }
		const std::vector<float> Points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0};
		Vertices = MakeUpload(Points, ERTBufferUsage::GeometryInput, "Vertices");
		Indices = MakeUpload(std::vector<uint32_t>{0, 1, 2, 3, 4, 5}, ERTBufferUsage::GeometryInput, "Indices");
		Output = MakeBuffer(RayCount * sizeof(FHit), ERTBufferUsage::Storage, ERTMemory::Readback, "Hits");
		for (uint32_t Section = 0; Section < 2; ++Section)
		{
			Sections[Section].Vertices = Vertices.Get();
			Sections[Section].VertexCount = 6;
			Sections[Section].Indices = Indices.Get();
			Sections[Section].IndexOffset = Section * 12;
			Sections[Section].TriangleCount = 1;
			Sections[Section].bOpaque = Section == 0;
		}
		FRTGeometryDesc Desc;
		Desc.Sections = Sections;
		Desc.SectionCount = 2;
		Desc.bAllowUpdate = true;
		Desc.Name = "Two triangles";
		ASSERT_OK(Device->CreateGeometry(Desc, Geometry.ReleaseAndGetAddress()));
		ASSERT_OK(Device->CreateScene({4, false, "Scene"}, Scene.ReleaseAndGetAddress()));
		const FRTBuildSizes A = Geometry->GetBuildSizes(), B = Scene->GetBuildSizes();
		SceneScratchOffset = (std::max(A.BuildScratchBytes, A.UpdateScratchBytes) + 255) / 256 * 256;
		Scratch = MakeBuffer(SceneScratchOffset + B.BuildScratchBytes, ERTBufferUsage::Scratch, ERTMemory::Device, "Scratch");
	}

	static FRTInstance MakeInstance(float X, uint32_t Custom, uint32_t Mask, uint32_t TableOffset, uint32_t Flags, const IRTGeometry& Of)
	{
		FRTInstance Instance = {
		    {1, 0, 0, X, 0, 1, 0, 0, 0, 0, 1, 0}, Custom | Mask << 24, TableOffset | Flags << 24, Of.GetDeviceAddress()};
		return Instance;
	}

	void BuildGeometry(bool bUpdate)
	{
		FRTGeometryBuild Build;
		Build.Geometry = Geometry.Get();
		Build.Sections = Sections;
		Build.SectionCount = 2;
		Build.bUpdate = bUpdate;
		Build.Scratch = Scratch.Get();
		List->BuildGeometries(&Build, 1);
		Barrier(ERTAccess::BuildWrite, ERTAccess::BuildRead | ERTAccess::BuildWrite);
	}

	void BuildScene(const std::vector<FRTInstance>& Items)
	{
		Instances = MakeUpload(Items, ERTBufferUsage::GeometryInput, "Instances");
		List->BuildScene(Scene.Get(), Instances.Get(), 0, static_cast<uint32_t>(Items.size()), Scratch.Get(), SceneScratchOffset);
		Barrier(ERTAccess::BuildWrite, ERTAccess::TraceRead);
	}

	/// Groups: 0 ray generation, 1 miss, 2 opaque, 3 masked.
	void MakePipeline()
	{
		const FRTShaderCode Shaders[] = {MakeCode(Smoke_Trace_rgen, ERTShaderStage::RayGen, "Trace.rgen"),
		    MakeCode(Smoke_Trace_rmiss, ERTShaderStage::Miss, "Trace.rmiss"),
		    MakeCode(Smoke_Trace_rchit, ERTShaderStage::ClosestHit, "Trace.rchit"),
		    MakeCode(Smoke_Trace_rahit, ERTShaderStage::AnyHit, "Trace.rahit")};
		FRTShaderGroup Groups[4];
		Groups[0].General = 0;
		Groups[1].General = 1;
		Groups[2].Kind = ERTGroupKind::Triangles;
		Groups[2].ClosestHit = 2;
		Groups[3].Kind = ERTGroupKind::Triangles;
		Groups[3].ClosestHit = 2;
		Groups[3].AnyHit = 3;
		FRTRayTracingPipelineDesc Desc;
		Desc.Shaders = Shaders;
		Desc.ShaderCount = 4;
		Desc.Groups = Groups;
		Desc.GroupCount = 4;
		Desc.Name = "Trace";
		ASSERT_OK(Device->CreateRayTracingPipeline(Desc, Pipeline.ReleaseAndGetAddress()));
		FRTShaderTableDesc TableDesc;
		TableDesc.Pipeline = Pipeline.Get();
		TableDesc.MissCount = 1;
		TableDesc.HitCount = 200; // more than one word of dirty bits
		TableDesc.RecordDataBytes = sizeof(FRecord);
		TableDesc.Name = "Table";
		ASSERT_OK(Device->CreateShaderTable(TableDesc, Table.ReleaseAndGetAddress()));
		Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
		Table->SetRecord(ERTRecordKind::Miss, 0, 1, nullptr, 0);
	}

	void SetHit(uint32_t Index, uint32_t Group, FRecord Record)
	{
		Table->SetRecord(ERTRecordKind::Hit, Index, Group, &Record, sizeof(Record));
	}

	void Trace(uint32_t Mask, uint32_t Add)
	{
		List->UpdateShaderTable(Table.Get());
		List->SetPipeline(Pipeline.Get());
		const FTracePush Push = {Output->GetDeviceAddress(), Scene->GetIndex(), Mask, 5000, Add, 1.0f};
		List->PushConstants(&Push, sizeof(Push));
		List->TraceRays(Table.Get(), 0, RayCount, 1, 1);
		Barrier(ERTAccess::StorageWrite, ERTAccess::HostRead);
	}

	const FHit* GetHits() { return static_cast<const FHit*>(Output->GetMapped()); }

	bool SkipWithoutPipeline() { return !Device->GetCapabilities().bRayTracingPipeline; }

	TRTRef<IRTBuffer> Vertices, Indices, Instances, Scratch, Output;
	FRTGeometrySection Sections[2];
	TRTRef<IRTGeometry> Geometry;
	TRTRef<IRTScene> Scene;
	TRTRef<IRTPipeline> Pipeline;
	TRTRef<IRTShaderTable> Table;
	uint64_t SceneScratchOffset = 0;
};

TEST_F(FVulkanSmokeTrace, RecordsOfSectionsAndInstancesAreReached)
{
	if (SkipWithoutPipeline()) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	ASSERT_NO_FATAL_FAILURE(MakePipeline());
	SetHit(0, 2, {100, 0});
	SetHit(1, 3, {101, 0});
	SetHit(150, 2, {102, 0});
	SetHit(151, 3, {103, 1}); // its any-hit shader lets the ray through
	ASSERT_OK(List->Begin());
	BuildGeometry(false);
	BuildScene({MakeInstance(0, 11, 1, 0, 0, *Geometry), MakeInstance(2, 12, 2, 150, 0, *Geometry)});
	Trace(0xff, 1000);
	ASSERT_NO_FATAL_FAILURE(Run());
	const FHit* Hits = GetHits();
	EXPECT_EQ(Hits[0].Value, 1100u);
	EXPECT_EQ(Hits[1].Value, 1101u);
	EXPECT_EQ(Hits[2].Value, 1102u);
	EXPECT_EQ(Hits[3].Value, 5000u);
	EXPECT_EQ(Hits[4].Value, 5000u);
	EXPECT_EQ(Hits[0].Custom, 11u);
	EXPECT_EQ(Hits[2].Custom, 12u);
	EXPECT_FLOAT_EQ(Hits[0].Distance, 5.0f);

	// One record changes; the mask hides the second instance.
	SetHit(1, 3, {201, 0});
	ASSERT_OK(List->Begin());
	Trace(1, 2000);
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_EQ(Hits[0].Value, 2100u);
	EXPECT_EQ(Hits[1].Value, 2201u);
	EXPECT_EQ(Hits[2].Value, 5000u);
}

/// VK_GEOMETRY_INSTANCE_TRIANGLE_FLIP_FACING_BIT_KHR
constexpr uint32_t FlipFacing = 2;

TEST_F(FVulkanSmokeTrace, FacingFollowsTheInstanceFlag)
{
	if (SkipWithoutPipeline()) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	ASSERT_NO_FATAL_FAILURE(MakePipeline());
	SetHit(0, 2, {});
	SetHit(1, 2, {});
	ASSERT_OK(List->Begin());
	BuildGeometry(false);
	BuildScene({MakeInstance(0, 0, 1, 0, 0, *Geometry), MakeInstance(2, 0, 1, 0, FlipFacing, *Geometry)});
	Trace(0xff, 0);
	ASSERT_NO_FATAL_FAILURE(Run());
	// Counter-clockwise as seen from the origin of the ray, in a right-handed space: front, as glTF has it.
	EXPECT_EQ(GetHits()[0].Kind, HitFrontFacing);
	EXPECT_EQ(GetHits()[2].Kind, HitBackFacing);
}

TEST_F(FVulkanSmokeTrace, RefitMovesATriangle)
{
	if (SkipWithoutPipeline()) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	ASSERT_NO_FATAL_FAILURE(MakePipeline());
	SetHit(0, 2, {100, 0});
	SetHit(1, 2, {101, 0});
	const std::vector<FRTInstance> Items = {MakeInstance(0, 0, 1, 0, 0, *Geometry)};
	ASSERT_OK(List->Begin());
	BuildGeometry(false);
	BuildScene(Items);
	Trace(0xff, 0);
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_EQ(GetHits()[1].Value, 101u);
	EXPECT_EQ(GetHits()[4].Value, 5000u);
	float* Points = static_cast<float*>(Vertices->GetMapped());
	for (uint32_t Vertex = 3; Vertex < 6; ++Vertex)
	{
		Points[Vertex * 3] += 3;
		Points[Vertex * 3 + 2] += 1;
	}
	ASSERT_OK(List->Begin());
	BuildGeometry(true);
	BuildScene(Items);
	Trace(0xff, 0);
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_EQ(GetHits()[0].Value, 100u);
	EXPECT_EQ(GetHits()[1].Value, 5000u);
	EXPECT_EQ(GetHits()[4].Value, 101u);
	EXPECT_FLOAT_EQ(GetHits()[4].Distance, 4.0f);
}

TEST_F(FVulkanSmokeTrace, RayQueryFindsTheSameHits)
{
	if (!Device->GetCapabilities().bRayQuery) { GTEST_SKIP() << "the device has no ray query"; }
	TRTRef<IRTPipeline> Query = MakeCompute(Smoke_Query_comp, "Query");
	ASSERT_OK(List->Begin());
	BuildGeometry(false);
	BuildScene({MakeInstance(0, 11, 1, 0, 0, *Geometry), MakeInstance(3, 12, 1, 0, 0, *Geometry)});
	List->SetPipeline(Query.Get());
	const FTracePush Push = {Output->GetDeviceAddress(), Scene->GetIndex(), 0xff, 5000, 10, 1.0f};
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch(RayCount, 1, 1);
	Barrier(ERTAccess::StorageWrite, ERTAccess::HostRead);
	ASSERT_NO_FATAL_FAILURE(Run());
	const uint32_t Expected[RayCount] = {10, 11, 5000, 10, 11, 5000, 5000, 5000};
	for (uint32_t Ray = 0; Ray < RayCount; ++Ray) { EXPECT_EQ(GetHits()[Ray].Value, Expected[Ray]) << Ray; }
	EXPECT_EQ(GetHits()[4].Custom, 12u);
}

TEST_F(FVulkanSmokeTrace, AnEmptySceneIsMissed)
{
	if (SkipWithoutPipeline()) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	ASSERT_NO_FATAL_FAILURE(MakePipeline());
	ASSERT_OK(List->Begin());
	List->BuildScene(Scene.Get(), nullptr, 0, 0, Scratch.Get(), SceneScratchOffset);
	Barrier(ERTAccess::BuildWrite, ERTAccess::TraceRead);
	Trace(0xff, 0);
	ASSERT_NO_FATAL_FAILURE(Run());
	EXPECT_EQ(GetHits()[0].Value, 5000u);
}

TEST_F(FVulkanSmokeTrace, ReleaseInFlightWaitsForTheGpu)
{
	if (SkipWithoutPipeline()) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	ASSERT_NO_FATAL_FAILURE(MakePipeline());
	SetHit(0, 2, {100, 0});
	SetHit(1, 2, {101, 0});
	ASSERT_OK(List->Begin());
	BuildGeometry(false);
	BuildScene({MakeInstance(0, 0, 1, 0, 0, *Geometry)});
	Trace(0xff, 0);
	ASSERT_OK(List->End());
	EXPECT_GT(Device->GetMemoryStats().Geometry, 0u);
	IRTCommandList* Lists[] = {List.Get()};
	FRTFence Fence = 0;
	ASSERT_OK(Device->Submit(Lists, 1, &Fence));
	Geometry.Reset();
	Scene.Reset();
	Table.Reset();
	Pipeline.Reset();
	Vertices.Reset();
	Indices.Reset();
	Instances.Reset();
	Scratch.Reset();
	List.Reset();
	ASSERT_OK(Device->WaitFor(Fence, WaitLimitNs));
	EXPECT_EQ(GetHits()[0].Value, 100u);
	EXPECT_EQ(GetHits()[1].Value, 101u);
	const FRTMemoryStats Stats = Device->GetMemoryStats();
	EXPECT_EQ(Stats.Geometry, 0u);
	EXPECT_EQ(Stats.Scene, 0u);
	EXPECT_EQ(Stats.ShaderTable, 0u);
	EXPECT_EQ(Stats.Scratch, 0u);
	EXPECT_GT(Stats.Peak, Stats.Total);
}

TEST_F(FVulkanSmokeTrace, TableStridesAreAlignedTightly)
{
	if (SkipWithoutPipeline()) { GTEST_SKIP() << "the device has no ray-tracing pipelines"; }
	ASSERT_NO_FATAL_FAILURE(MakePipeline());
	const FRTCapabilities& Caps = Device->GetCapabilities();
	const uint64_t Stride = Table->GetRecordStride(ERTRecordKind::Hit);
	EXPECT_EQ(Stride % Caps.ShaderGroupHandleAlignment, 0u);
	EXPECT_GE(Stride, Caps.ShaderGroupHandleSize + sizeof(FRecord));
	EXPECT_LT(Stride, Caps.ShaderGroupHandleSize + sizeof(FRecord) + Caps.ShaderGroupHandleAlignment);
	EXPECT_GE(Table->GetSizeBytes(), 200 * Stride);
}

} // namespace Lantern
