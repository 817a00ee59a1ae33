// Pipelines linked from libraries: rays through them answer as through those made in one piece.
#include "RayStageFixture.h"

#include <thread>

namespace Lantern
{
namespace
{

/// Tests of creation alone run on every RHI.
class FLibraryContract : public FContract
{
protected:
	void SetUp() override
	{
		FContract::SetUp();
		if (!HasFatalFailure() && !Caps().bPipelineLibraries) { GTEST_SKIP() << "the device has no pipeline libraries"; }
	}
};

TEST_P(FLibraryContract, GroupsAreCountedOwnFirst)
{
	const auto Two = MakeRays(Device(), {StageHit, StageParity}, true, {}, "Two");
	const auto One = MakeRays(Device(), {StageBox}, true, {}, "One");
	ASSERT_TRUE(Two && One);
	EXPECT_EQ(Two->GetGroupCount(), 2u);
	EXPECT_EQ(One->GetGroupCount(), 1u);
	const auto Linked = MakeRays(Device(), {StageTrace, StageMiss}, false, {Two.Get(), One.Get()}, "Linked");
	ASSERT_TRUE(Linked);
	EXPECT_EQ(Linked->GetGroupCount(), 5u);
}

TEST_P(FLibraryContract, OneLibraryInManyLinks)
{
	const auto Hit = MakeRays(Device(), {StageHit}, true, {}, "Hit");
	std::vector<TRTRef<IRTPipeline>> Links;
	for (uint32_t Link = 0; Link < 8; ++Link)
	{
		Links.push_back(MakeRays(Device(), {StageTrace, StageMiss}, false, {Hit.Get()}, "Link"));
		ASSERT_TRUE(Links.back());
	}
}

TEST_P(FLibraryContract, LibraryOnlyLinksAreMadeOrRefused)
{
	const auto All = MakeRays(Device(), {StageTrace, StageMiss, StageHit}, true, {}, "All");
	if (!Caps().bLibraryOnlyPipelines && GetParam() != EContractRHI::Vulkan) { GTEST_SKIP() << "mock and wrapper call it wrong use"; }
	TRTRef<IRTPipeline> Linked;
	const FRTStatus Status = CreateRays(Device(), {}, false, {All.Get()}, "Linked", Linked);
	EXPECT_EQ(Status.IsOk(), Caps().bLibraryOnlyPipelines) << Status.Message;
	if (!Status)
	{
		EXPECT_EQ(Status.Code, ERTResult::Unsupported);
		EXPECT_NE(std::string(Status.Message).find("Linked"), std::string::npos) << Status.Message;
	}
}

TEST(PipelineLibraries, AreUnsupportedWhereTheDeviceHasNone)
{
	FRTMockDesc Desc;
	Desc.bPipelineLibraries = false;
	TRTRef<IRTDevice> Device;
	ASSERT_OK(CreateMockDevice(Desc, Device.ReleaseAndGetAddress()));
	EXPECT_FALSE(Device->GetCapabilities().bLibraryOnlyPipelines);
	TRTRef<IRTPipeline> Out;
	EXPECT_EQ(CreateRays(*Device, {StageHit}, true, {}, "Library", Out).Code, ERTResult::Unsupported);
	EXPECT_TRUE(MakeRays(*Device, {StageTrace, StageMiss, StageHit}));
}

/// Tests that trace rays through links.
class FLinkContract : public FRayStageFixture
{
protected:
	void SetUp() override
	{
		FRayStageFixture::SetUp();
		if (HasFatalFailure() || IsSkipped()) { return; }
		if (!Caps().bPipelineLibraries) { GTEST_SKIP() << "the device has no pipeline libraries"; }
		MakeStageScene();
	}
	/// Links its own groups and a library for each of Split. The libraries are released before the link is used.
	void UseLinked(const FGroups& Own, const std::vector<FGroups>& Split, const char* Name = "Linked")
	{
		std::vector<TRTRef<IRTPipeline>> Libraries;
		std::vector<IRTPipeline*> Pointers;
		FGroups Order = Own;
		for (const FGroups& Part : Split)
		{
			Libraries.push_back(MakeRays(Device(), Part, true, {}, "Library"));
			Pointers.push_back(Libraries.back().Get());
			Order.insert(Order.end(), Part.begin(), Part.end());
		}
		Use(MakeRays(Device(), Own, false, Pointers, Name), Order);
		Libraries.clear();
		Device().CollectGarbage();
	}
	static std::vector<FGroups> Each(const FGroups& Items)
	{
		std::vector<FGroups> Out;
		for (const FRayGroup& Item : Items) { Out.push_back({Item}); }
		return Out;
	}
};

TEST_P(FLinkContract, HitGroupsFromALibraryEach)
{
	UseLinked(GetGeneralGroups(), Each(GetHitGroups()));
	MakeStageTable();
	ExpectAllStages("a library per hit group");
}

TEST_P(FLinkContract, AllHitGroupsInOneLibrary)
{
	UseLinked(GetGeneralGroups(), {GetHitGroups()});
	MakeStageTable();
	ExpectAllStages("one library");
}

TEST_P(FLinkContract, SomeHitGroupsAreTheLinksOwn)
{
	FGroups Own = GetGeneralGroups();
	Own.push_back(StageParity);
	Own.push_back(StageBox);
	UseLinked(Own, {{StageCalls, StageHit}, {StageBoxParity}, {StageAnyOnly}});
	MakeStageTable();
	ExpectAllStages("own hit groups before those of libraries");
}

TEST_P(FLinkContract, CallablesFromALibrary)
{
	UseLinked({StageTrace, StageCall, StageMiss}, {{StageSalt}, GetHitGroups()});
	MakeStageTable();
	ExpectAllStages("callable in a library");
}

TEST_P(FLinkContract, EveryGroupFromALibrary)
{
	if (!Caps().bLibraryOnlyPipelines) { GTEST_SKIP() << "the driver needs ray generation and miss groups in the link"; }
	FGroups All = GetGeneralGroups();
	const FGroups Hits = GetHitGroups();
	All.insert(All.end(), Hits.begin(), Hits.end());
	UseLinked({}, Each(All));
	MakeStageTable();
	ExpectAllStages("nothing but libraries");
}

/// Rays hit, but no group of the link has a hit shader (EVulkanQuirk::CrashWithoutHitShaders).
TEST_P(FLinkContract, LinksWithoutHitShaders)
{
	const FRayGroup Empty = {};
	UseLinked({StageTrace, StageMiss}, {{Empty, StageSalt}});
	FRTShaderTableDesc Desc;
	Desc.Pipeline = Pipeline.Get();
	Desc.MissCount = Desc.HitCount = Desc.CallableCount = 1;
	Desc.RecordDataBytes = 4;
	Desc.Name = "Table";
	ASSERT_OK(Device().CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
	Table->SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Miss, 0, 1, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Hit, 0, 2, nullptr, 0);
	Table->SetRecord(ERTRecordKind::Callable, 0, 3, nullptr, 0);
	Load({}, {Place(Squares, 0)});
	EXPECT_EQ(Trace(2, MakeStagePush(3)), (FWords{0, 0xe0000003u}));
}

TEST_P(FLinkContract, RelinkedWithOneMoreWhileTheFirstIsInFlight)
{
	FGroups Hits = GetHitGroups();
	const FRayGroup Late = Hits.back();
	Hits.pop_back();
	std::vector<TRTRef<IRTPipeline>> Libraries;
	std::vector<IRTPipeline*> Pointers;
	FGroups Order = GetGeneralGroups();
	for (const FRayGroup& Hit : Hits)
	{
		Libraries.push_back(MakeRays(Device(), {Hit}, true, {}, "Library"));
		Pointers.push_back(Libraries.back().Get());
		Order.push_back(Hit);
	}
	// Until it is there, a stand-in: record 5 is hit group 0.
	Use(MakeRays(Device(), GetGeneralGroups(), false, Pointers, "Before"), Order);
	ASSERT_NO_FATAL_FAILURE(CreateStageTable());
	Groups.push_back(Late); // for SetStageRecords alone; the table never sees it in Before
	const uint32_t StandIn = Find(StageHit);
	Table->SetRecord(ERTRecordKind::RayGen, 0, Find(StageTrace), nullptr, 0);
	Table->SetRecord(ERTRecordKind::Miss, 0, Find(StageMiss), nullptr, 0);
	Table->SetRecord(ERTRecordKind::Callable, 0, Find(StageSalt), nullptr, 0);
	for (uint32_t Index = 0; Index < HitRecords; ++Index) { SetHit(Index, 10 + Index, Index < Hits.size() ? Find(Hits[Index]) : StandIn); }
	FWords Expected = GetExpected(5);
	Expected[2] = 15 << 16 | 5 << 8 | 3;
	EXPECT_EQ(Trace(10, MakeStagePush(5)), Expected);

	Libraries.push_back(MakeRays(Device(), {Late}, true, {}, "Late"));
	Pointers.push_back(Libraries.back().Get());
	Order.push_back(Late);
	const TRTRef<IRTPipeline> Before = Pipeline;
	Use(MakeRays(Device(), GetGeneralGroups(), false, Pointers, "After"), Order);
	Libraries.clear();
	Table->SetPipeline(Pipeline.Get());
	std::vector<uint32_t> Handles;
	for (const FRayGroup& Hit : GetHitGroups()) { Handles.push_back(Find(Hit)); }
	const uint32_t Trace0[] = {Find(StageTrace), Find(StageCall)}, Miss = Find(StageMiss), Salt = Find(StageSalt);
	Table->SetGroups(ERTRecordKind::RayGen, 0, 2, Trace0);
	Table->SetGroups(ERTRecordKind::Miss, 0, 1, &Miss);
	Table->SetGroups(ERTRecordKind::Callable, 0, 1, &Salt);
	Table->SetGroups(ERTRecordKind::Hit, 0, HitRecords, Handles.data());
	ExpectAllStages("after the swap, data kept");
}

TEST_P(FLinkContract, EightThreadsCompileAndOneLinks)
{
	const FGroups Hits = GetHitGroups();
	constexpr uint32_t PerThread = 12, ThreadCount = 8;
	std::vector<TRTRef<IRTPipeline>> Libraries(PerThread * ThreadCount);
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < ThreadCount; ++Thread)
	{
		Threads.emplace_back([&, Thread] {
			for (uint32_t Index = Thread; Index < Libraries.size(); Index += ThreadCount)
			{
				Libraries[Index] = MakeRays(Device(), {Hits[Index % Hits.size()]}, true, {}, "Library");
			}
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	std::vector<IRTPipeline*> Pointers;
	FGroups Order = GetGeneralGroups();
	for (uint32_t Index = 0; Index < Libraries.size(); ++Index)
	{
		ASSERT_TRUE(Libraries[Index]);
		Pointers.push_back(Libraries[Index].Get());
		Order.push_back(Hits[Index % Hits.size()]);
	}
	Use(MakeRays(Device(), GetGeneralGroups(), false, Pointers, "Linked"), Order);
	// The handles of each round of libraries in turn.
	for (uint32_t First = 0; First < Libraries.size(); First += 5 * HitRecords)
	{
		MakeStageTable();
		for (uint32_t Index = 0; Index < HitRecords; ++Index) { SetHit(Index, 10 + Index, 4 + First + Index); }
		ExpectAllStages("round");
	}
}

INSTANTIATE_TEST_SUITE_P(RHI, FLibraryContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });
INSTANTIATE_TEST_SUITE_P(RHI, FLinkContract, testing::ValuesIn(RayRHIs), [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
