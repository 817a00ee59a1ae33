// The mock device: resources, fences, faults and the call log.
#include "Support/MockTestTools.h"

#include <chrono>
#include <thread>

namespace Lantern
{
namespace
{

class FMockTests : public testing::Test
{
protected:
	void SetUp() override { Create({}); }
	void Create(const FRTMockDesc& Desc)
	{
		Make.Device.Reset();
		ASSERT_OK(CreateMockDevice(Desc, Make.Device.ReleaseAndGetAddress()));
		Mock = &GetMock(Make.Device.Get());
	}
	IRTDevice& Device() { return *Make.Device; }

	FMockMaker Make;
	FRTMock* Mock = nullptr;
};

TEST_F(FMockTests, RefusesAlignmentsThatAreNoPowersOfTwo)
{
	FRTMockDesc Desc;
	Desc.BaseAlignment = 48;
	TRTRef<IRTDevice> Other;
	EXPECT_EQ(CreateMockDevice(Desc, Other.ReleaseAndGetAddress()).Code, ERTResult::InvalidArgument);
}

TEST_F(FMockTests, ExecutesCopiesAndFillsInOrder)
{
	const auto Upload = Make.Buffer(16, ERTMemory::Upload);
	const auto Middle = Make.Buffer(16);
	const auto Readback = Make.Buffer(16, ERTMemory::Readback);
	std::memcpy(Upload->GetMapped(), "0123456789abcdef", 16);
	EXPECT_EQ(Middle->GetMapped(), nullptr);
	const auto List = Make.List();
	List->CopyBuffer(Middle.Get(), 0, Upload.Get(), 0, 16);
	List->FillBuffer(Middle.Get(), 4, 4, 0x41414141);
	List->CopyBuffer(Readback.Get(), 8, Middle.Get(), 2, 8);
	Make.Submit(List.Get());
	EXPECT_EQ(0, std::memcmp(static_cast<char*>(Readback->GetMapped()) + 8, "23AAAA89", 8));
	EXPECT_EQ(0, std::memcmp(Mock->GetBytes(Middle.Get()), "0123AAAA89abcdef", 16));
}

TEST_F(FMockTests, ManualFencesDelayExecution)
{
	Mock->SetManualFences(true);
	const auto Upload = Make.Buffer(4, ERTMemory::Upload);
	const auto Target = Make.Buffer(4);
	auto List = Make.List();
	List->CopyBuffer(Target.Get(), 0, Upload.Get(), 0, 4);
	const FRTFence Fence = Make.Submit(List.Get());
	EXPECT_LT(Device().GetCompletedFence(), Fence);
	EXPECT_EQ(Device().WaitFor(Fence, 1000).Code, ERTResult::Timeout);
	// The CPU writes too early, and the late GPU sees it.
	std::memcpy(Upload->GetMapped(), "late", 4);
	Mock->CompleteUpTo(Fence);
	EXPECT_EQ(Device().GetCompletedFence(), Fence);
	EXPECT_EQ(0, std::memcmp(Mock->GetBytes(Target.Get()), "late", 4));
	EXPECT_EQ(Mock->GetBlockingWaits(), 1u);
}

TEST_F(FMockTests, WaitWithoutLimitCompletes)
{
	Mock->SetManualFences(true);
	const FRTFence First = Make.Submit(Make.List("A").Get());
	const FRTFence Second = Make.Submit(Make.List("B").Get());
	EXPECT_OK(Device().WaitFor(First, ~0ull));
	EXPECT_EQ(Device().GetCompletedFence(), First);
	EXPECT_OK(Device().WaitIdle());
	EXPECT_EQ(Device().GetCompletedFence(), Second);
}

TEST_F(FMockTests, ReleasedObjectsLiveUntilTheirFence)
{
	Mock->SetManualFences(true);
	auto Used = Make.Buffer(4, ERTMemory::Device, "Used");
	auto List = Make.List();
	List->FillBuffer(Used.Get(), 0, 4, 1);
	const FRTFence Fence = Make.Submit(List.Get());
	auto Unrecorded = Make.Texture(4, 4, ERTFormat::R8_UNORM);
	// Shaders may read a bindless texture that no list names: it must wait too.
	Unrecorded.Reset();
	Used.Reset();
	List.Reset();
	Device().CollectGarbage();
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Destroy), 0u);
	EXPECT_EQ(Mock->GetLiveObjects(), (std::vector<std::string>{"Buffer Used", "CommandList List", "Texture Texture"}));
	Mock->CompleteUpTo(Fence);
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Destroy, "Used"), 1u);
	EXPECT_EQ(Mock->GetLiveObjectCount(), 0u);
	EXPECT_EQ(Device().GetMemoryStats().Total, 0u);
}

TEST_F(FMockTests, RecordedListKeepsObjectsBeforeSubmission)
{
	auto Buffer = Make.Buffer(4, ERTMemory::Device, "Kept");
	auto List = Make.List();
	List->KeepAlive(Buffer.Get());
	Buffer.Reset();
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Destroy), 0u);
	Make.Submit(List.Get());
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Destroy, "Kept"), 1u);
}

TEST_F(FMockTests, RecordsCalls)
{
	const auto Pipeline = Make.Compute("Skin");
	const auto List = Make.List("Frame");
	List->SetPipeline(Pipeline.Get());
	const uint32_t Push[] = {7, 8};
	List->PushConstants(Push, sizeof(Push));
	List->Dispatch(3, 2, 1);
	Make.Submit(List.Get());
	const std::vector<FRTMockCall> Found = Mock->FindDispatches("Skin");
	ASSERT_EQ(Found.size(), 1u);
	EXPECT_EQ(Found[0].List, "Frame");
	EXPECT_EQ(Found[0].Numbers, (FRTMockNumbers{3, 2, 1}));
	ASSERT_EQ(Found[0].Bytes.size(), sizeof(Push));
	EXPECT_EQ(0, std::memcmp(Found[0].Bytes.data(), Push, sizeof(Push)));
	EXPECT_TRUE(Mock->FindDispatches("Other").empty());
	EXPECT_EQ(Mock->GetCreatedPipelines(), std::vector<std::string>{"Skin"});
	Mock->ClearCalls();
	EXPECT_EQ(Mock->CountCalls(ERTMockCall::Dispatch), 0u);
}

TEST_F(FMockTests, FailsTheChosenAllocations)
{
	TRTRef<IRTBuffer> Buffer;
	const FRTBufferDesc Desc = {64, ERTBufferUsage::Storage, ERTMemory::Device, "B"};
	const auto Create = [&] { return Device().CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()).Code; };
	Mock->FailAllocation(2);
	EXPECT_EQ(Create(), ERTResult::Ok);
	EXPECT_EQ(Create(), ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(Create(), ERTResult::Ok);
	Mock->FailEveryAllocation(3);
	for (int Round = 0; Round < 2; ++Round)
	{
		EXPECT_EQ(Create(), ERTResult::Ok);
		EXPECT_EQ(Create(), ERTResult::Ok);
		EXPECT_EQ(Create(), ERTResult::OutOfDeviceMemory);
	}
}

TEST_F(FMockTests, HasABudgetAndAPeak)
{
	FRTMockDesc Desc;
	Desc.DeviceMemoryBytes = 1000;
	Create(Desc);
	auto A = Make.Buffer(600);
	TRTRef<IRTBuffer> B;
	const FRTBufferDesc Second = {401, ERTBufferUsage::Scratch, ERTMemory::Device, "B"};
	EXPECT_EQ(Device().CreateBuffer(Second, B.ReleaseAndGetAddress()).Code, ERTResult::OutOfDeviceMemory);
	A.Reset();
	EXPECT_OK(Device().CreateBuffer(Second, B.ReleaseAndGetAddress()));
	const FRTMemoryStats Stats = Device().GetMemoryStats();
	EXPECT_EQ(Stats.Scratch, 401u);
	EXPECT_EQ(Stats.Buffer, 0u);
	EXPECT_EQ(Stats.Total, 401u);
	EXPECT_EQ(Stats.Peak, 600u);
}

TEST_F(FMockTests, FullHeapsAreErrors)
{
	FRTMockDesc Desc;
	Desc.MaxBindlessTextures = 1;
	Desc.MaxScenes = 1;
	Create(Desc);
	auto First = Make.Texture(1, 1, ERTFormat::R8_UNORM);
	FRTTextureDesc More;
	More.Width = More.Height = 1;
	More.Format = ERTFormat::R8_UNORM;
	More.Usage = ERTTextureUsage::Sampled;
	TRTRef<IRTTexture> Second;
	EXPECT_EQ(Device().CreateTexture(More, Second.ReleaseAndGetAddress()).Code, ERTResult::OutOfDescriptors);
	First.Reset();
	ASSERT_OK(Device().CreateTexture(More, Second.ReleaseAndGetAddress()));
	EXPECT_EQ(Second->GetSampledIndex(), 0u);
	const auto Scene = Make.Scene();
	TRTRef<IRTScene> Other;
	EXPECT_EQ(Device().CreateScene({1, false, ""}, Other.ReleaseAndGetAddress()).Code, ERTResult::OutOfDescriptors);
}

TEST_F(FMockTests, CompilesSlowlyOrNotAtAllOnDemand)
{
	Mock->SlowCompile("Slow", 30);
	Mock->FailCompile("Broken");
	const auto Start = std::chrono::steady_clock::now();
	Make.Compute("VerySlowOne");
	EXPECT_GE(std::chrono::steady_clock::now() - Start, std::chrono::milliseconds(30));
	FRTComputePipelineDesc Desc;
	Desc.Shader = {DummyWords, std::size(DummyWords), ERTShaderStage::Compute, ""};
	Desc.Name = "ABrokenOne";
	TRTRef<IRTPipeline> Pipeline;
	const FRTStatus Status = Device().CreateComputePipeline(Desc, Pipeline.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
	EXPECT_NE(std::string(Status.Message).find("ABrokenOne"), std::string::npos);
	Mock->ClearCompileFaults();
	EXPECT_OK(Device().CreateComputePipeline(Desc, Pipeline.ReleaseAndGetAddress()));
	Mock->StarveCompiles("Broken");
	const FRTStatus Starved = Device().CreateComputePipeline(Desc, Pipeline.ReleaseAndGetAddress());
	EXPECT_EQ(Starved.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_NE(std::string(Starved.Message).find("ABrokenOne"), std::string::npos);
	Make.Compute("Other");
	Mock->ClearCompileFaults();
	EXPECT_OK(Device().CreateComputePipeline(Desc, Pipeline.ReleaseAndGetAddress()));
}

TEST_F(FMockTests, DeviceLossStays)
{
	const auto Buffer = Make.Buffer(4);
	const auto List = Make.List();
	Mock->LoseDeviceAt(ERTMockCall::FillBuffer);
	List->FillBuffer(Buffer.Get(), 0, 4, 0);
	EXPECT_EQ(List->End().Code, ERTResult::DeviceLost);
	TRTRef<IRTBuffer> Other;
	EXPECT_EQ(Device().CreateBuffer({4, AnyUsage}, Other.ReleaseAndGetAddress()).Code, ERTResult::DeviceLost);
	EXPECT_EQ(Device().WaitIdle().Code, ERTResult::DeviceLost);
}

TEST_F(FMockTests, RungDecidesWhatIsSupported)
{
	FRTMockDesc Desc;
	Desc.Rung = ERTRung::RayQuery;
	Create(Desc);
	EXPECT_TRUE(Device().GetCapabilities().bRayQuery);
	EXPECT_FALSE(Device().GetCapabilities().bRayTracingPipeline);
	TRTRef<IRTPipeline> Pipeline;
	EXPECT_EQ(Device().CreateRayTracingPipeline({}, Pipeline.ReleaseAndGetAddress()).Code, ERTResult::Unsupported);
	Desc.Rung = ERTRung::None;
	Create(Desc);
	TRTRef<IRTScene> Scene;
	EXPECT_EQ(Device().CreateScene({1, false, ""}, Scene.ReleaseAndGetAddress()).Code, ERTResult::Unsupported);
}

TEST_F(FMockTests, ClearsAndMips)
{
	const auto Texture = Make.Texture(3, 2, ERTFormat::RGBA8_SRGB, 2);
	const auto Upload = Make.Buffer(24, ERTMemory::Upload);
	auto* Bytes = static_cast<uint8_t*>(Upload->GetMapped());
	for (int i = 0; i < 24; ++i) { Bytes[i] = i < 12 ? 0 : 255; }
	const auto List = Make.List();
	List->CopyBufferToTexture(Texture.Get(), 0, 0, Upload.Get(), 0);
	List->GenerateMips(Texture.Get());
	Make.Submit(List.Get());
	// Half of linear white is 188 in sRGB; alpha is linear.
	EXPECT_EQ(Mock->GetTexels(Texture.Get(), 1), (std::vector<uint8_t>{188, 188, 188, 128}));
	const auto Again = Make.List();
	const float Colour[] = {1, 0, 0, 1};
	Again->ClearTexture(Texture.Get(), Colour);
	Make.Submit(Again.Get());
	EXPECT_EQ(Mock->GetTexels(Texture.Get(), 1), (std::vector<uint8_t>{255, 0, 0, 255}));
}

TEST_F(FMockTests, FindsBuffersByAddress)
{
	const auto A = Make.Buffer(100), B = Make.Buffer(100);
	uint64_t Offset = 0;
	EXPECT_EQ(Mock->FindBuffer(B->GetDeviceAddress() + 99, &Offset), B.Get());
	EXPECT_EQ(Offset, 99u);
	EXPECT_EQ(Mock->FindBuffer(B->GetDeviceAddress() + 100), nullptr);
	EXPECT_EQ(Mock->FindBuffer(A->GetDeviceAddress() - 1), nullptr);
}

TEST_F(FMockTests, SceneTellsDanglingAndUnbuiltGeometries)
{
	const auto Vertices = Make.Buffer(36, ERTMemory::Upload);
	const auto Scratch = Make.Scratch();
	const FRTGeometrySection Section = Make.Section(Vertices.Get());
	auto Rock = Make.Geometry(Section, "Rock"), Tree = Make.Geometry(Section, "Tree"), Bush = Make.Geometry(Section, "Bush");
	const auto Scene = Make.Scene();
	const auto Instances = Make.Buffer(3 * sizeof(FRTInstance), ERTMemory::Upload);
	auto* Items = static_cast<FRTInstance*>(Instances->GetMapped());
	Items[0] = Make.Instance(Rock->GetDeviceAddress());
	Items[1] = Make.Instance(Tree->GetDeviceAddress());
	Items[2] = Make.Instance(Bush->GetDeviceAddress());
	const auto List = Make.List();
	Make.Build(List.Get(), Rock.Get(), Section, Scratch.Get());
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 3, Scratch.Get(), 0);
	Tree.Reset();
	Make.Submit(List.Get());
	EXPECT_EQ(Mock->GetErrors(), (std::vector<std::string>{"Scene: instance 1 of destroyed Tree", "Scene: instance 2 of unbuilt Bush"}));
	const auto Found = Mock->GetSceneInstances(Scene.Get());
	ASSERT_EQ(Found.size(), 3u);
	EXPECT_TRUE(Found[0].bBuilt && !Found[0].bDangling && Found[0].Geometry == Rock.Get());
	EXPECT_TRUE(Found[1].bDangling && Found[1].GeometryName == "Tree" && !Found[1].Geometry);
	EXPECT_TRUE(!Found[2].bBuilt && !Found[2].bDangling);
	EXPECT_EQ(Mock->GetGeometry(Rock.Get()).BuildCount, 1u);
	EXPECT_EQ(Mock->GetGeometry(Rock.Get()).Sections.at(0).Vertices, Vertices.Get());
}

TEST_F(FMockTests, ImportedListRunsWhenTheEngineHasSubmitted)
{
	TRTRef<IRTCommandList> List;
	ASSERT_OK(Device().ImportCommandList(0x1234, List.ReleaseAndGetAddress()));
	EXPECT_EQ(List->GetNative(ERTNative::CommandBuffer), 0x1234u);
	const auto Buffer = Make.Buffer(4);
	List->FillBuffer(Buffer.Get(), 0, 4, 0x01010101);
	EXPECT_EQ(Mock->GetBytes(Buffer.Get())[0], 0);
	IRTCommandList* Raw = List.Get();
	FRTFence Fence = 0;
	ASSERT_OK(Device().NotifyExternalSubmit(&Raw, 1, &Fence));
	EXPECT_EQ(Fence, Device().GetCompletedFence());
	EXPECT_EQ(Mock->GetBytes(Buffer.Get())[0], 1);
}

TEST_F(FMockTests, ErrorsOnAnImportedListAreReportedAndItsWorkIsCovered)
{
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 8, 16);
	TRTRef<IRTCommandList> List;
	ASSERT_OK(Device().ImportCommandList(0x1234, List.ReleaseAndGetAddress()));
	for (uint32_t Update = 0; Update <= Table->GetDesc().Copies; ++Update) // one more than there are host copies
	{
		EXPECT_TRUE(List->GetStatus().IsOk()) << Update;
		Table->SetRecord(ERTRecordKind::Hit, 7, 2, &Update, 4);
		if (Update == Table->GetDesc().Copies) { Mock->FailAllocation(1); }
		List->UpdateShaderTable(Table.Get());
	}
	EXPECT_EQ(List->GetStatus().Code, ERTResult::OutOfDeviceMemory);
	IRTCommandList* Raw = List.Get();
	FRTFence Fence = 0;
	EXPECT_EQ(Device().NotifyExternalSubmit(&Raw, 1, &Fence).Code, ERTResult::OutOfDeviceMemory);
	EXPECT_GT(Fence, 0u) << "the engine's list runs all the same";
	EXPECT_EQ(Fence, Device().GetCompletedFence());
}

TEST_F(FMockTests, TimestampsRise)
{
	TRTRef<IRTQueryPool> Pool;
	ASSERT_OK(Device().CreateQueryPool(ERTQuery::Timestamp, 2, Pool.ReleaseAndGetAddress()));
	uint64_t Times[2] = {};
	EXPECT_FALSE(Pool->GetResults(0, 2, Times));
	const auto List = Make.List();
	List->ResetQueries(Pool.Get(), 0, 2);
	List->WriteTimestamp(Pool.Get(), 0);
	List->WriteTimestamp(Pool.Get(), 1);
	Make.Submit(List.Get());
	ASSERT_TRUE(Pool->GetResults(0, 2, Times));
	EXPECT_LT(Times[0], Times[1]);
}

TEST_F(FMockTests, CreationFromManyThreads)
{
	std::vector<std::thread> Threads;
	for (int Thread = 0; Thread < 4; ++Thread)
	{
		Threads.emplace_back([&] {
			for (int i = 0; i < 50; ++i)
			{
				const auto Buffer = Make.Buffer(64);
				const auto Texture = Make.Texture(4, 4, ERTFormat::R8_UNORM);
				const auto List = Make.List();
				List->FillBuffer(Buffer.Get(), 0, 64, 1);
				Make.Submit(List.Get());
			}
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Mock->GetLiveObjectCount(), 0u);
	EXPECT_EQ(Mock->GetLastFence(), 200u);
}

} // namespace
} // namespace Lantern
