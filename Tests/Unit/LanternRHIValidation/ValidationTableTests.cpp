// The wrapper's messages about libraries, shader tables that grow and change their pipeline, and compaction.
#include "Support/ValidationTestTools.h"
#include "Support/WaitTools.h"

#include <atomic>
#include <thread>

namespace Lantern
{
namespace
{

class FValidationTables : public FValidationFixture
{
protected:
	/// One group: a hit group, or a ray generation one.
	FRTStatus Library(const char* Name, TRTRef<IRTPipeline>& Out, uint32_t Payload = 32, bool bRayGen = false)
	{
		return Make.CreateLibrary(Name, bRayGen ? ERTShaderStage::RayGen : ERTShaderStage::ClosestHit, Payload, Out);
	}
	FRTStatus Link(std::initializer_list<IRTPipeline*> Libraries, TRTRef<IRTPipeline>& Out)
	{
		FRTRayTracingPipelineDesc Desc;
		Desc.Libraries = Libraries.begin();
		Desc.LibraryCount = static_cast<uint32_t>(Libraries.size());
		Desc.Name = "Link";
		return Make.Device->CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress());
	}
	/// A trace of a fresh list, with what the table has before it.
	TRTRef<IRTCommandList> Trace(IRTShaderTable* Table, IRTPipeline* Pipeline, bool bUpdate = true)
	{
		auto List = Make.List();
		if (bUpdate) { List->UpdateShaderTable(Table); }
		List->SetPipeline(Pipeline);
		List->TraceRays(Table, 0, 1, 1, 1);
		return List;
	}
	static void SetFirst(IRTShaderTable* Table, ERTRecordKind Kind, uint32_t Group) { Table->SetGroups(Kind, 0, 1, &Group); }
	/// A table for three hit records, with ray generation, miss, and two of the hit records set.
	TRTRef<IRTShaderTable> FilledTable(IRTPipeline* Pipeline)
	{
		const uint32_t Hits[] = {2, 3};
		auto Table = Make.Table(Pipeline, 3);
		SetFirst(Table.Get(), ERTRecordKind::RayGen, RayGenGroup);
		SetFirst(Table.Get(), ERTRecordKind::Miss, MissGroup);
		Table->SetHitRecords(0, 2, Hits, nullptr);
		return Table;
	}

	static constexpr uint32_t RayGenGroup = 0, MissGroup = 1; ///< of FMockMaker::RayTracing
};

TEST_F(FValidationTables, LibrariesAreNoPipelines)
{
	TRTRef<IRTPipeline> Hit, RayGen, Linked;
	ASSERT_OK(Library("HitLibrary", Hit));
	ASSERT_OK(Library("RayGenLibrary", RayGen, 32, true));
	const auto List = Make.List();
	List->SetPipeline(Hit.Get());
	ExpectMessage({"SetPipeline", "pipeline 'HitLibrary' is a library"});
	FRTShaderTableDesc Desc;
	Desc.Pipeline = RayGen.Get();
	Desc.Name = "OfLibrary";
	TRTRef<IRTShaderTable> Table;
	EXPECT_FALSE(Make.Device->CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
	ExpectMessage({"'OfLibrary'", "'RayGenLibrary' is a library"});
	ASSERT_OK(Link({RayGen.Get(), Hit.Get()}, Linked));
	EXPECT_EQ(Linked->GetGroupCount(), 2u);
	Desc.Pipeline = Linked.Get();
	ASSERT_OK(Make.Device->CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
	Table->SetPipeline(Hit.Get());
	ExpectMessage({"SetPipeline", "'OfLibrary'", "'HitLibrary' is a library"});
	const auto Compute = Make.Compute("Blur");
	Table->SetPipeline(Compute.Get());
	ExpectMessage({"SetPipeline", "'OfLibrary'", "'Blur' is not for ray tracing"});
	Table->SetPipeline(nullptr);
	ExpectMessage({"SetPipeline", "'OfLibrary'", "is null"});
}

TEST_F(FValidationTables, LinksOfWhatDoesNotFit)
{
	const auto Whole = Make.RayTracing("Whole");
	TRTRef<IRTPipeline> Hit, Wide, RayGen, Out;
	ASSERT_OK(Library("Hit", Hit));
	ASSERT_OK(Library("Wide", Wide, 48));
	ASSERT_OK(Library("RayGen", RayGen, 32, true));
	EXPECT_EQ(Link({RayGen.Get(), Wide.Get()}, Out).Code, ERTResult::InvalidArgument);
	ExpectMessage({"'Link'", "'Wide' was made with MaxPayloadBytes 48, the link has 32"});
	EXPECT_FALSE(Link({RayGen.Get(), Whole.Get()}, Out));
	ExpectMessage({"'Link'", "'Whole' is no library"});
	EXPECT_FALSE(Link({Hit.Get()}, Out));
	ExpectMessage({"'Link'", "no group has a ray generation shader"});
	EXPECT_FALSE(Link({RayGen.Get(), nullptr}, Out));
	ExpectMessage({"'Link'", "library 1 is null"});
	EXPECT_EQ(Mock->FindCalls(ERTMockCall::CreateRayTracingPipeline, "Link").size(), 0u);
	FRTRayTracingPipelineDesc Empty;
	Empty.bLibrary = true;
	Empty.Name = "Empty";
	EXPECT_FALSE(Make.Device->CreateRayTracingPipeline(Empty, Out.ReleaseAndGetAddress()));
	ExpectMessage({"'Empty'", "no shaders"});
}

TEST_F(FValidationTables, LibraryOnlyLinksWhereTheDeviceHasNone)
{
	FRTMockDesc Desc;
	Desc.bLibraryOnlyPipelines = false;
	TRTRef<IRTDevice> Bare;
	ASSERT_OK(CreateMockDevice(Desc, Bare.ReleaseAndGetAddress()));
	const auto Callback = [](void* User, const char* Message) { static_cast<std::vector<std::string>*>(User)->push_back(Message); };
	ASSERT_OK(WrapWithValidation(Bare.Get(), Callback, &Messages, Make.Device.ReleaseAndGetAddress()));
	TRTRef<IRTPipeline> Hit, RayGen, Out;
	ASSERT_OK(Library("Hit", Hit));
	ASSERT_OK(Library("RayGen", RayGen, 32, true));
	EXPECT_FALSE(Link({RayGen.Get(), Hit.Get()}, Out));
	ExpectMessage({"'Link'", "'RayGen' has ray generation or miss groups"});
}

TEST_F(FValidationTables, RecordsAndGroupsInRange)
{
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 4, 8);
	const uint32_t Hits[] = {2, 3, 2, 3}, Miss = 1, Beyond = 6;
	Table->SetHitRecords(1, 4, Hits, nullptr);
	ExpectMessage({"SetHitRecords", "'Table'", "hit record 4 is out of range, the table has 4"});
	Table->SetHitRecords(0xfffffff0u, 0x20, Hits, nullptr);
	ExpectMessage({"SetHitRecords", "out of range"});
	Table->SetHitRecords(0, 2, nullptr, nullptr);
	ExpectMessage({"SetHitRecords", "'Table'", "Groups is null"});
	Table->SetHitRecords(3, 1, &Miss, nullptr);
	ExpectMessage({"SetHitRecords", "hit record 3: group 1 of pipeline 'RTPSO' is a general group"});
	Table->SetGroups(ERTRecordKind::Hit, 2, 1, &Beyond);
	ExpectMessage({"SetGroups", "hit record 2: group 6, but pipeline 'RTPSO' has 6"});
	Table->SetGroups(ERTRecordKind::Miss, 0, 2, Hits);
	ExpectMessage({"SetGroups", "miss record 1 is out of range, the table has 1"});
	Table->SetGroups(ERTRecordKind::Miss, 0, 1, Hits);
	ExpectMessage({"SetGroups", "miss record 0: group 2 of pipeline 'RTPSO' is a hit group"});
	// After growth there is room; a smaller number is no mistake.
	const uint32_t Counts[4] = {0, 2, 6, 0};
	ASSERT_OK(Table->Reserve(Counts));
	EXPECT_EQ(Table->GetDesc().HitCount, 6u);
	EXPECT_EQ(Table->GetDesc().CallableCount, 1u);
	EXPECT_EQ(Table->GetDesc().Pipeline, Pipeline.Get());
	Table->SetHitRecords(2, 4, Hits, nullptr);
	EXPECT_FALSE(Table->Reserve(nullptr));
	ExpectMessage({"Reserve", "'Table'", "Counts is null"});
}

TEST_F(FValidationTables, StaleHandlesAfterSetPipeline)
{
	const auto Old = Make.RayTracing("Old"), New = Make.RayTracing("New");
	const auto Table = FilledTable(Old.Get());
	Make.Submit(Trace(Table.Get(), Old.Get()).Get());
	// What was recorded before the swap goes on with the old pipeline.
	const auto Before = Trace(Table.Get(), Old.Get());
	Table->SetPipeline(New.Get());
	Make.Submit(Before.Get());
	auto List = Make.List();
	List->SetPipeline(New.Get());
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	ExpectMessage({"TraceRays", "'Table'", "ray generation record 0 was not set again after SetPipeline"});
	SetFirst(Table.Get(), ERTRecordKind::RayGen, RayGenGroup);
	ExpectRefused(Trace(Table.Get(), New.Get()).Get());
	ExpectMessage({"TraceRays", "miss record 0 of shader table 'Table' was not set again after SetPipeline"});
}

TEST_F(FValidationTables, StaleMissAndHitRecords)
{
	const auto Old = Make.RayTracing("Old"), New = Make.RayTracing("New");
	const auto Table = FilledTable(Old.Get());
	Table->SetPipeline(New.Get());
	SetFirst(Table.Get(), ERTRecordKind::RayGen, RayGenGroup);
	SetFirst(Table.Get(), ERTRecordKind::Miss, MissGroup);
	ExpectRefused(Trace(Table.Get(), New.Get()).Get());
	ExpectMessage({"TraceRays", "hit record 0 of shader table 'Table' was not set again after SetPipeline"});
	// Which records rays reach is not known here, so that one set again is enough not to be certain.
	SetFirst(Table.Get(), ERTRecordKind::Hit, 2);
	Make.Submit(Trace(Table.Get(), New.Get()).Get());
}

TEST_F(FValidationTables, StaleHitRecordsThatInstancesReach)
{
	const auto Vertices = Make.Buffer(36, ERTMemory::Upload, "Vertices"), Instances = Make.Buffer(256, ERTMemory::Upload);
	const auto Scratch = Make.Scratch();
	const auto Section = Make.Section(Vertices.Get());
	const auto Geometry = Make.Geometry(Section);
	const auto Scene = Make.Scene();
	const auto Old = Make.RayTracing("Old"), New = Make.RayTracing("New");
	const auto Table = Make.Table(Old.Get(), 3);
	const FRTInstance Item = Make.Instance(Geometry->GetDeviceAddress(), 1);
	std::memcpy(Instances->GetMapped(), &Item, sizeof(Item));
	const auto Build = Make.List("Build");
	Make.Build(Build.Get(), Geometry.Get(), Section, Scratch.Get());
	Make.BuildBarrier(Build.Get());
	Build->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	Make.BuildBarrier(Build.Get());
	Make.Submit(Build.Get());
	const uint32_t RayGen = 0, Hits[] = {2, 3, 2};
	Table->SetHitRecords(0, 3, Hits, nullptr);
	Table->SetPipeline(New.Get());
	Table->SetGroups(ERTRecordKind::RayGen, 0, 1, &RayGen);
	Table->SetGroups(ERTRecordKind::Hit, 0, 1, Hits);
	ExpectRefused(Trace(Table.Get(), New.Get()).Get());
	ExpectMessage({"TraceRays", "hit record 1 of shader table 'Table' was not set again"});
	Table->SetGroups(ERTRecordKind::Hit, 1, 1, Hits + 1);
	Make.Submit(Trace(Table.Get(), New.Get()).Get()); // nothing reaches record 2
}

TEST_F(FValidationTables, TraceBeforeTheUpdateOfANewPipeline)
{
	const auto Old = Make.RayTracing("Old"), New = Make.RayTracing("New");
	const auto Table = Make.Table(Old.Get(), 0);
	const uint32_t RayGen = 0;
	Table->SetGroups(ERTRecordKind::RayGen, 0, 1, &RayGen);
	Make.Submit(Trace(Table.Get(), Old.Get()).Get());
	Table->SetPipeline(New.Get());
	Table->SetGroups(ERTRecordKind::RayGen, 0, 1, &RayGen);
	const auto Forgotten = Make.List("Forgotten");
	Forgotten->UpdateShaderTable(Table.Get());
	ExpectRefused(Trace(Table.Get(), New.Get(), false).Get());
	ExpectMessage({"TraceRays", "'Table' has got another pipeline, with no UpdateShaderTable since"});
	Table->Invalidate();
	Make.Submit(Trace(Table.Get(), New.Get()).Get());
}

TEST_F(FValidationTables, StagingMeetsSetting)
{
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 4096);
	const uint32_t Group = 2;
	std::atomic<bool> bStop = false;
	// Set… calls may meet each other; staging must not meet them.
	std::thread Other([&] {
		while (!bStop)
		{
			for (uint32_t i = 2048; i < 4096; ++i) { Table->SetGroups(ERTRecordKind::Hit, i, 1, &Group); }
		}
	});
	for (uint32_t i = 0; i < 2048; ++i) { Table->SetGroups(ERTRecordKind::Hit, i, 1, &Group); }
	bStop = true;
	Other.join();
	EXPECT_OK(Table->Stage());
	EXPECT_THAT(Messages, testing::IsEmpty());
}

TEST_F(FValidationTables, SettingWhileAnotherThreadStages)
{
#if defined(__SANITIZE_THREAD__)
	GTEST_SKIP() << "wrong use on purpose";
#endif
	struct FSeen
	{
		std::atomic<bool> bSet = false, bStage = false;
	} Seen;
	const auto Callback = [](void* User, const char* Message) {
		const bool bNamed = std::strstr(Message, "shader table 'Table' is in use by another thread") != nullptr;
		EXPECT_TRUE(bNamed) << Message;
		(std::strstr(Message, "Stage") ? static_cast<FSeen*>(User)->bStage : static_cast<FSeen*>(User)->bSet) = true;
	};
	ASSERT_OK(WrapWithValidation(Inner.Get(), Callback, &Seen, Make.Device.ReleaseAndGetAddress()));
	const auto Pipeline = Make.RayTracing();
	const auto Table = Make.Table(Pipeline.Get(), 4096);
	const std::vector<uint32_t> Groups(4096, 2);
	std::atomic<bool> bStop = false;
	std::thread Other([&] {
		while (!bStop) { EXPECT_OK(Table->Stage()); }
	});
	WaitUntil(
	    "either to meet the other", [&] { return Seen.bSet && Seen.bStage; },
	    [&] { Table->SetGroups(ERTRecordKind::Hit, 0, 4096, Groups.data()); });
	bStop = true;
	Other.join();
}

class FValidationCompaction : public FValidationFixture
{
protected:
	void SetUp() override
	{
		FValidationFixture::SetUp();
		Vertices = Make.Buffer(36, ERTMemory::Upload, "Vertices");
		Scratch = Make.Scratch();
		Section = Make.Section(Vertices.Get());
		Source = Create("Source", true, 0);
		EXPECT_OK(Make.Device->CreateQueryPool(ERTQuery::CompactedSize, 2, Pool.ReleaseAndGetAddress()));
	}
	void TearDown() override
	{
		Vertices.Reset();
		Scratch.Reset();
		Source.Reset();
		Pool.Reset();
		FValidationFixture::TearDown();
	}
	TRTRef<IRTGeometry> Create(const char* Name, bool bCompaction, uint64_t Bytes, bool bUpdate = false)
	{
		return Make.CompactableGeometry(Section, Name, Bytes, bCompaction, bUpdate);
	}
	void BuildSource()
	{
		const auto List = Make.List();
		Make.Build(List.Get(), Source.Get(), Section, Scratch.Get());
		Make.BuildBarrier(List.Get());
		Make.Submit(List.Get());
	}
	uint64_t ReadSize()
	{
		const auto List = Make.List();
		List->ResetQueries(Pool.Get(), 0, 1);
		List->WriteCompactedSize(Pool.Get(), 0, Source.Get());
		Make.Submit(List.Get());
		uint64_t Size = 0;
		EXPECT_TRUE(Pool->GetResults(0, 1, &Size));
		return Size;
	}

	TRTRef<IRTBuffer> Vertices, Scratch;
	FRTGeometrySection Section;
	TRTRef<IRTGeometry> Source;
	TRTRef<IRTQueryPool> Pool;
};

TEST_F(FValidationCompaction, WrongQueries)
{
	BuildSource();
	TRTRef<IRTQueryPool> Times;
	ASSERT_OK(Make.Device->CreateQueryPool(ERTQuery::Timestamp, 1, Times.ReleaseAndGetAddress()));
	const auto Plain = Create("Plain", false, 0);
	const auto List = Make.List();
	List->ResetQueries(Pool.Get(), 0, 2);
	List->WriteCompactedSize(Times.Get(), 0, Source.Get());
	ExpectMessage({"WriteCompactedSize", "'Source'", "not for compacted sizes"});
	List->WriteTimestamp(Pool.Get(), 0);
	ExpectMessage({"WriteTimestamp", "not for timestamps"});
	List->WriteCompactedSize(Pool.Get(), 2, Source.Get());
	ExpectMessage({"WriteCompactedSize", "'Source'", "query 2 of 2"});
	List->WriteCompactedSize(Pool.Get(), 0, Plain.Get());
	ExpectMessage({"WriteCompactedSize", "'Plain' was created without bAllowCompaction"});
	List->WriteCompactedSize(Pool.Get(), 0, Source.Get());
	List->WriteCompactedSize(Pool.Get(), 0, Source.Get());
	ExpectMessage({"WriteCompactedSize", "'Source'", "query 0 was not reset"});
	Make.Build(List.Get(), Source.Get(), Section, Scratch.Get());
	List->WriteCompactedSize(Pool.Get(), 1, Source.Get());
	ExpectMessage({"WriteCompactedSize", "'Source'", "no memory barrier"});
}

TEST_F(FValidationCompaction, SizesOfWhatWasNeverBuilt)
{
	const auto List = Make.List();
	List->ResetQueries(Pool.Get(), 0, 1);
	List->WriteCompactedSize(Pool.Get(), 0, Source.Get());
	ExpectRefused(List.Get());
	ExpectMessage({"WriteCompactedSize", "'Source' was never built"});
}

TEST_F(FValidationCompaction, WrongCopies)
{
	BuildSource();
	const auto Blind = Create("Blind", true, 128);
	auto List = Make.List();
	List->CompactGeometry(Blind.Get(), Source.Get());
	ExpectMessage({"CompactGeometry", "no compacted size of geometry 'Source' has been read"});
	const uint64_t Size = ReadSize();
	ASSERT_GT(Size, 0u);
	const auto Small = Create("Small", true, Size - 1), Updated = Create("Updated", true, Size, true);
	const auto Good = Create("Good", true, Size), Plain = Create("Plain", false, 0);
	List->CompactGeometry(Small.Get(), Source.Get());
	ExpectMessage({"CompactGeometry", "'Small' was created for", "but geometry 'Source' needs"});
	List->CompactGeometry(Plain.Get(), Source.Get());
	ExpectMessage({"CompactGeometry", "'Plain' was created without CompactedBytes"});
	List->CompactGeometry(Good.Get(), Plain.Get());
	ExpectMessage({"CompactGeometry", "'Plain' was created without bAllowCompaction"});
	List->CompactGeometry(Updated.Get(), Source.Get());
	ExpectMessage({"CompactGeometry", "'Updated' was created with other sections or flags than geometry 'Source'"});
	List->CompactGeometry(Source.Get(), Good.Get());
	ExpectMessage({"CompactGeometry", "'Good' is a compacted copy itself"});
	Make.Build(List.Get(), Good.Get(), Section, Scratch.Get());
	ExpectMessage({"BuildGeometries", "'Good' was created for a compacted copy"});
	EXPECT_EQ(Reached(ERTMockCall::CompactGeometry), 0u);
	List->CompactGeometry(Good.Get(), Source.Get());
	Make.BuildBarrier(List.Get());
	Make.Submit(List.Get());
	EXPECT_EQ(Mock->GetGeometry(Unwrap(Good.Get())).CompactedFrom, "Source");
	EXPECT_THAT(Mock->GetErrors(), testing::IsEmpty());
}

TEST_F(FValidationCompaction, ReleasedSourcesAreNamed)
{
	BuildSource();
	const auto Good = Create("Good", true, ReadSize());
	const auto Scene = Make.Scene();
	const FRTInstance Item = Make.Instance(Source->GetDeviceAddress());
	const auto Instances = Make.Buffer(64, ERTMemory::Upload);
	std::memcpy(Instances->GetMapped(), &Item, sizeof(Item));
	auto List = Make.List();
	List->CompactGeometry(Good.Get(), Source.Get());
	Make.BuildBarrier(List.Get());
	Make.Submit(List.Get());
	Source.Reset();
	List = Make.List();
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	ExpectMessage({"BuildScene", "instance 0 points at the released geometry 'Source'"});
}

TEST_F(FValidationCompaction, GeometrySizesAreChecked)
{
	FRTGeometryDesc Desc;
	Desc.Name = "Nothing";
	EXPECT_EQ(Make.Device->GetGeometrySizes(Desc).StructureBytes, 0u);
	ExpectMessage({"GetGeometrySizes", "'Nothing'", "no sections"});
	Desc.Sections = &Section;
	Desc.SectionCount = 1;
	EXPECT_EQ(Make.Device->GetGeometrySizes(Desc).StructureBytes, Source->GetBuildSizes().StructureBytes);
}

} // namespace
} // namespace Lantern
