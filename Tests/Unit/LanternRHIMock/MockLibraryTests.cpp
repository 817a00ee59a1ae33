// Pipeline libraries, compaction and large scenes on the mock.
#include "Support/MockTestTools.h"
#include "Support/WaitTools.h"

#include <atomic>
#include <chrono>
#include <gmock/gmock.h>
#include <thread>

namespace Lantern
{
namespace
{

using std::chrono::milliseconds;
using std::chrono::steady_clock;

class FMockLibraryTests : public testing::Test
{
protected:
	void SetUp() override { Open({}); }
	void Open(const FRTMockDesc& Desc)
	{
		ASSERT_OK(CreateMockDevice(Desc, Make.Device.ReleaseAndGetAddress()));
		Mock = &GetMock(Make.Device.Get());
	}
	/// One group with one shader of that name.
	TRTRef<IRTPipeline> Library(
	    const char* Name, ERTShaderStage Stage = ERTShaderStage::ClosestHit, uint32_t Payload = 32, ERTResult Expected = ERTResult::Ok)
	{
		TRTRef<IRTPipeline> Out;
		EXPECT_EQ(Make.CreateLibrary(Name, Stage, Payload, Out).Code, Expected);
		return Out;
	}
	/// With a ray generation group of its own.
	TRTRef<IRTPipeline> Link(const std::vector<IRTPipeline*>& Libraries, const char* Name = "Link")
	{
		const FRTShaderCode Shader = {DummyWords, std::size(DummyWords), ERTShaderStage::RayGen, "OwnRayGen"};
		FRTShaderGroup Group;
		Group.General = 0;
		FRTRayTracingPipelineDesc Desc;
		Desc.Shaders = &Shader;
		Desc.ShaderCount = 1;
		Desc.Groups = &Group;
		Desc.GroupCount = 1;
		Desc.Libraries = Libraries.data();
		Desc.LibraryCount = static_cast<uint32_t>(Libraries.size());
		Desc.Name = Name;
		TRTRef<IRTPipeline> Out;
		EXPECT_OK(Make.Device->CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}

	FMockMaker Make;
	FRTMock* Mock = nullptr;
};

TEST_F(FMockLibraryTests, GroupsOfALinkResolveThroughItsLibraries)
{
	auto Stone = Library("Stone"), Leaf = Library("Leaf"), Sky = Library("Sky", ERTShaderStage::Miss);
	const auto Pipeline = Link({Stone.Get(), Sky.Get(), Leaf.Get()});
	ASSERT_EQ(Pipeline->GetGroupCount(), 4u);
	// The linked pipeline keeps what it needs.
	Stone.Reset();
	Leaf.Reset();
	Sky.Reset();
	EXPECT_THAT(Mock->GetLiveObjects(), testing::ElementsAre("Pipeline Link"));
	const auto Table = Make.Table(Pipeline.Get(), 2);
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Miss, 0, 2, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Hit, 0, 1, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Hit, 1, 3, nullptr, 0);
	const auto List = Make.List();
	List->UpdateShaderTable(Table.Get());
	Make.Submit(List.Get());
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::RayGen, 0).General, "OwnRayGen");
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Miss, 0).General, "Sky");
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 0).ClosestHit, "Stone");
	EXPECT_EQ(Mock->ResolveRecord(Table.Get(), ERTRecordKind::Hit, 1).ClosestHit, "Leaf");
	const auto Calls = Mock->FindCalls(ERTMockCall::CreateRayTracingPipeline);
	ASSERT_EQ(Calls.size(), 4u);
	EXPECT_EQ(Calls[0].Numbers, (FRTMockNumbers{1, 1, 1, 32, 0, 1}));
	EXPECT_EQ(Calls[3].Numbers, (FRTMockNumbers{1, 1, 1, 32, 3, 0}));
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
}

TEST_F(FMockLibraryTests, WrongUseOfLibrariesIsAnError)
{
	const auto Stone = Library("Stone"), Wide = Library("Wide", ERTShaderStage::ClosestHit, 64);
	const auto Whole = Make.RayTracing("Whole");
	Link({Wide.Get()});
	Link({Whole.Get()});
	const auto Table = Make.Table(Stone.Get(), 1);
	Table->SetPipeline(Wide.Get());
	const auto List = Make.List();
	List->SetPipeline(Stone.Get());
	EXPECT_THAT(Mock->GetErrors(), testing::ElementsAre("Link: linked from Wide of other recursion, payload or attribute sizes",
	                                   "Link: linked from Whole, which is no library", "Table: made for the library Stone",
	                                   "Table: SetPipeline of the library Wide", "List: SetPipeline of the library Stone"));
}

TEST_F(FMockLibraryTests, DevicesWithoutLibraryOnlyPipelines)
{
	FRTMockDesc Desc;
	Desc.bLibraryOnlyPipelines = false;
	Open(Desc);
	EXPECT_TRUE(Make.Device->GetCapabilities().bPipelineLibraries);
	EXPECT_FALSE(Make.Device->GetCapabilities().bLibraryOnlyPipelines);
	const auto Stone = Library("Stone"), Sky = Library("Sky", ERTShaderStage::Miss);
	const auto Lamp = Library("Lamp", ERTShaderStage::Callable);
	Link({Stone.Get(), Lamp.Get()});
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
	Link({Stone.Get(), Sky.Get()});
	EXPECT_EQ(Mock->GetErrors().size(), 1u);
}

TEST_F(FMockLibraryTests, DevicesWithoutLibraries)
{
	FRTMockDesc Desc;
	Desc.bPipelineLibraries = false;
	Open(Desc);
	EXPECT_FALSE(Make.Device->GetCapabilities().bLibraryOnlyPipelines);
	Library("Stone", ERTShaderStage::ClosestHit, 32, ERTResult::Unsupported);
}

TEST_F(FMockLibraryTests, FaultsAreByTheNameOfTheLibrary)
{
	Mock->FailCompile("Broken");
	Library("BrokenLeaf", ERTShaderStage::ClosestHit, 32, ERTResult::CompileFailed);
	const auto Stone = Library("Stone");
	Link({Stone.Get()});
	Mock->ClearCompileFaults();
	Library("BrokenLeaf");
}

TEST_F(FMockLibraryTests, SlowCompilesSleepSideBySide)
{
	Mock->SlowCompile("Slow", 2);
	std::atomic<bool> bStop = false;
	std::vector<std::thread> Threads;
	for (uint32_t i = 0; i < 3; ++i)
	{
		Threads.emplace_back([&] {
			while (!bStop) { Library("Slow"); }
		});
	}
	WaitUntil("three compiles that sleep at once", [&] { return Mock->GetCompilesInDriver() == 3; });
	bStop = true;
	for (std::thread& Thread : Threads) { Thread.join(); }
}

TEST_F(FMockLibraryTests, HeldCompilesWaitSideBySideAndTheDeviceGoesOn)
{
	constexpr uint32_t Count = 16;
	Mock->HoldCompiles("Held");
	std::atomic<uint32_t> Made = 0;
	std::vector<std::thread> Threads;
	for (uint32_t i = 0; i < Count; ++i)
	{
		Threads.emplace_back([&] {
			Library("Held");
			++Made;
		});
	}
	WaitUntil("all of them in the driver", [&] { return Mock->GetCompilesInDriver() == Count; });
	{
		const FHangGuard Guard("the device beside held compiles", [&] { Mock->ClearCompileFaults(); });
		Library("Quick");
		Make.Buffer(64);
	}
	EXPECT_EQ(Mock->GetCompilesInDriver(), Count);
	EXPECT_EQ(Made, 0u);
	Mock->ClearCompileFaults();
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Made, Count);
	EXPECT_EQ(Mock->GetCompilesInDriver(), 0u);
}

class FMockCompactionTests : public FMockLibraryTests
{
protected:
	TRTRef<IRTGeometry> Create(const char* Name, uint64_t CompactedBytes = 0, bool bCompaction = true)
	{
		return Make.CompactableGeometry(Section, Name, CompactedBytes, bCompaction);
	}
	void SetUp() override
	{
		FMockLibraryTests::SetUp();
		Vertices = Make.Buffer(36, ERTMemory::Upload, "Vertices");
		Scratch = Make.Scratch();
		Section = Make.Section(Vertices.Get());
		Section.TriangleCount = 1000;
		EXPECT_OK(Make.Device->CreateQueryPool(ERTQuery::CompactedSize, 2, Pool.ReleaseAndGetAddress()));
	}

	TRTRef<IRTBuffer> Vertices, Scratch;
	FRTGeometrySection Section;
	TRTRef<IRTQueryPool> Pool;
};

TEST_F(FMockCompactionTests, SizesThenCopies)
{
	auto Source = Create("Source");
	EXPECT_EQ(Pool->GetKind(), ERTQuery::CompactedSize);
	uint64_t Size = 0;
	EXPECT_FALSE(Pool->GetResults(0, 1, &Size));
	auto List = Make.List();
	Make.Build(List.Get(), Source.Get(), Section, Scratch.Get());
	List->ResetQueries(Pool.Get(), 0, 2);
	List->WriteCompactedSize(Pool.Get(), 1, Source.Get());
	Make.Submit(List.Get());
	EXPECT_FALSE(Pool->GetResults(0, 1, &Size));
	ASSERT_TRUE(Pool->GetResults(1, 1, &Size));
	const uint64_t Whole = Source->GetBuildSizes().StructureBytes;
	EXPECT_NEAR(static_cast<double>(Size), 0.6 * static_cast<double>(Whole), 256);
	const uint64_t Live = Make.Device->GetMemoryStats().Geometry;
	const auto Small = Create("Small", Size);
	EXPECT_EQ(Small->GetBuildSizes().StructureBytes, Size);
	EXPECT_EQ(Make.Device->GetMemoryStats().Geometry, Live + Size);
	EXPECT_NE(Small->GetDeviceAddress(), Source->GetDeviceAddress());
	EXPECT_EQ(Make.Device->GetGeometrySizes({&Section, 1, false, false, true, Size, ""}).StructureBytes, Whole);
	List = Make.List();
	List->CompactGeometry(Small.Get(), Source.Get());
	Make.Submit(List.Get());
	const FRTMockGeometry Built = Mock->GetGeometry(Small.Get());
	EXPECT_TRUE(Built.IsUsable());
	EXPECT_EQ(Built.CompactedFrom, "Source");
	// A scene of the copy is good, one of the source is not once that is gone.
	const uint64_t Old = Source->GetDeviceAddress();
	Source.Reset();
	EXPECT_EQ(Make.Device->GetMemoryStats().Geometry, Size);
	const auto Scene = Make.Scene();
	const FRTInstance Items[] = {Make.Instance(Small->GetDeviceAddress()), Make.Instance(Old)};
	const auto Instances = Make.Buffer(sizeof(Items), ERTMemory::Upload);
	std::memcpy(Instances->GetMapped(), Items, sizeof(Items));
	List = Make.List();
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	Make.Submit(List.Get());
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
	List = Make.List();
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 2, Scratch.Get(), 0);
	Make.Submit(List.Get());
	EXPECT_THAT(Mock->GetErrors(), testing::ElementsAre("Scene: instance 1 of destroyed Source"));
}

TEST_F(FMockCompactionTests, WrongUseIsAnError)
{
	const auto Source = Create("Source"), Plain = Create("Plain", 0, false), Wrong = Create("Wrong", 128);
	const auto List = Make.List();
	List->ResetQueries(Pool.Get(), 0, 2);
	List->WriteCompactedSize(Pool.Get(), 0, Source.Get());
	Make.Build(List.Get(), Source.Get(), Section, Scratch.Get());
	Make.Build(List.Get(), Plain.Get(), Section, Scratch.Get());
	List->WriteCompactedSize(Pool.Get(), 1, Plain.Get());
	List->CompactGeometry(Wrong.Get(), Source.Get());
	Make.Build(List.Get(), Wrong.Get(), Section, Scratch.Get());
	Make.Submit(List.Get());
	const char* Asked = ": compacted size asked of one that is not built, or made without bAllowCompaction";
	EXPECT_THAT(Mock->GetErrors(), testing::ElementsAre(std::string("Source") + Asked, std::string("Plain") + Asked,
	                                   "Wrong: not made for the compacted copy of Source", "Wrong: built, but made for a compacted copy"));
}

TEST_F(FMockCompactionTests, AMillionInstances)
{
	constexpr uint32_t Count = 1'000'000, Geometries = 1000;
	std::vector<TRTRef<IRTGeometry>> Rocks;
	auto List = Make.List();
	for (uint32_t i = 0; i < Geometries; ++i)
	{
		Rocks.push_back(Create("Rock"));
		Make.Build(List.Get(), Rocks.back().Get(), Section, Scratch.Get());
	}
	const auto Scene = Make.Scene(Count);
	const auto Instances = Make.Buffer(Count * sizeof(FRTInstance), ERTMemory::Upload);
	auto* Items = static_cast<FRTInstance*>(Instances->GetMapped());
	for (uint32_t i = 0; i < Count; ++i) { Items[i] = Make.Instance(Rocks[i % Geometries]->GetDeviceAddress(), i); }
	Make.Submit(List.Get());
	Mock->ClearTraffic();
	const auto Start = steady_clock::now();
	List = Make.List();
	List->BuildScene(Scene.Get(), Instances.Get(), 0, Count, Scratch.Get(), 0);
	Make.Submit(List.Get());
	const auto Took = steady_clock::now() - Start; // about 100 ms when nothing else runs; only reported
	RecordProperty("milliseconds", static_cast<int>(std::chrono::duration_cast<milliseconds>(Took).count()));
	EXPECT_EQ(Mock->GetTraffic().Instances, Count * sizeof(FRTInstance));
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
	const auto Seen = Mock->GetSceneInstances(Scene.Get());
	ASSERT_EQ(Seen.size(), Count);
	EXPECT_TRUE(Seen.back().bBuilt);
}

TEST_F(FMockCompactionTests, LongRunsStayBounded)
{
	Mock->SetCallRecording(false);
	const size_t Before = Mock->GetCalls().size();
	const auto Scene = Make.Scene();
	const auto List = Make.List();
	EXPECT_OK(List->End());
	for (uint32_t i = 0; i < 2000; ++i)
	{
		const auto Streamed = Create("Streamed");
		ASSERT_OK(List->Begin());
		Make.Build(List.Get(), Streamed.Get(), Section, Scratch.Get());
		// Never reset: an error each time.
		List->WriteCompactedSize(Pool.Get(), 0, Streamed.Get());
		Make.Submit(List.Get());
	}
	EXPECT_EQ(Mock->GetCalls().size(), Before);
	EXPECT_EQ(Mock->GetErrors().size(), 1000u);
	Mock->LoseDeviceAt(ERTMockCall::BuildGeometry);
	const auto Last = Create("Last");
	ASSERT_OK(List->Begin());
	Make.Build(List.Get(), Last.Get(), Section, Scratch.Get());
	EXPECT_EQ(List->End().Code, ERTResult::DeviceLost) << "faults work all the same";
	Mock->SetCallRecording(true);
	Make.Device->CollectGarbage();
	(void)Make.Device->WaitIdle();
	EXPECT_EQ(Mock->GetCalls().back().Kind, ERTMockCall::WaitIdle);
}

} // namespace
} // namespace Lantern
