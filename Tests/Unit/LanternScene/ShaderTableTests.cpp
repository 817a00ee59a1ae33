// FShaderTable: how much is written, copied, made and waited for.
#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/SceneTestTools.h"
#include "TableModel.h"

namespace Lantern
{
namespace
{

/// Sections without a scene: one geometry for each of Count ranges, or Count material sets of one.
class FTableBindingTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		for (uint32_t I = 0; I < 2; ++I) { Pipelines.push_back(FModelPipeline::Make(*Device, I, 2, 5 + I)); }
		Geometry = MakeGeometry("Tree", 1);
		Bindings = std::make_unique<FShaderTable>(*Device);
	}
	void TearDown() override
	{
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		Bindings.reset();
		Pipelines.clear();
		FSceneTest::TearDown();
	}
	void SetMode(int Mode)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set("r.RT.SBT.Mode", std::to_string(Mode), ERTSetBy::Console, "test"));
		FConsoleVariables::Get().BeginFrame();
	}
	void AddRanges(uint32_t Count)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			Materials.Add(MakeMaterial());
			Table.Acquire(*Geometry, {Materials.Num() - 1});
		}
	}
	FRTFence Submit(uint32_t Pipeline)
	{
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		EXPECT_TRUE(Bindings->Sync(*List, Pipelines[Pipeline]->Pipeline, Table));
		EXPECT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		EXPECT_TRUE(Device->Submit(Lists, 1, &Fence));
		return Fence;
	}
	const FShaderTableStats& Frame(uint32_t Pipeline = 0)
	{
		Submit(Pipeline);
		return Bindings->GetStats();
	}
	uint64_t Stride() const { return Bindings->GetTable()->GetRecordStride(ERTRecordKind::Hit); }
	void ExpectRecord(uint32_t Pipeline, uint32_t Section, uint32_t Type)
	{
		const FRTMockRecord Record = Mock().ResolveRecord(Bindings->GetTable(), ERTRecordKind::Hit, 2 * Section + Type);
		ASSERT_TRUE(Record.IsGood()) << Record.Error;
		ASSERT_EQ(Record.ClosestHit, Pipelines[Pipeline]->Expect(Table.GetHitProgram(Section), Type).ClosestHit);
		ASSERT_EQ(std::memcmp(Record.Data.data(), &Table.Get(Section), sizeof(FSectionData)), 0) << "section " << Section;
	}
	void ExpectAllRecords(uint32_t Pipeline)
	{
		for (uint32_t Record = 0; Record < 2 * Table.GetCapacity(); ++Record)
		{
			ASSERT_NO_FATAL_FAILURE(ExpectRecord(Pipeline, Record / 2, Record % 2));
		}
	}

	std::vector<std::shared_ptr<FModelPipeline>> Pipelines;
	FRTGeometryRef Geometry;
	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> Programs;
	FSectionContext Context{Materials, Programs};
	FSectionTable Table{Context};
	std::unique_ptr<FShaderTable> Bindings;
};

TEST_F(FTableBindingTest, StaticFrameWritesCopiesAndMakesNothing)
{
	AddRanges(1000);
	EXPECT_EQ(Frame().RecordsWritten, 2000u);
	Mock().ClearCalls();
	for (int I = 0; I < 10; ++I)
	{
		const FShaderTableStats& Stats = Frame();
		EXPECT_EQ(Stats.RecordsWritten + Stats.HandlesWritten, 0u);
		EXPECT_EQ(Stats.BytesCopied, 0u);
	}
	for (const ERTMockCall Kind : {ERTMockCall::UpdateShaderTable, ERTMockCall::StageShaderTable, ERTMockCall::CreateBuffer,
	         ERTMockCall::MakeHostCopy, ERTMockCall::Barrier})
	{
		EXPECT_EQ(Mock().CountCalls(Kind), 0u);
	}
}

TEST_F(FTableBindingTest, FrameCopiesTheRecordsOfChangedSectionsAlone)
{
	AddRanges(1000);
	Frame();
	for (const uint32_t Material : {3u, 500u, 501u, 999u})
	{
		Materials.Set(Material, MakeMaterial(MATERIAL_DOUBLE_SIDED));
		Table.MaterialChanged(Material);
	}
	const FShaderTableStats& Stats = Frame();
	EXPECT_EQ(Stats.RecordsWritten, 8u);
	EXPECT_EQ(Stats.BytesCopied, 8 * Stride());
	ExpectAllRecords(0);
}

TEST_F(FTableBindingTest, SwapWritesHandlesAndNoData)
{
	AddRanges(1000);
	Frame();
	Mock().ClearCalls();
	const FShaderTableStats& Stats = Frame(1);
	EXPECT_EQ(Stats.RecordsWritten, 0u);
	EXPECT_EQ(Stats.HandlesWritten, 2000u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateShaderTable), 0u) << "the table is kept";
	ExpectAllRecords(1);
	EXPECT_EQ(Frame(1).HandlesWritten, 0u);
}

TEST_F(FTableBindingTest, ManySectionsAreWrittenInParallel)
{
	AddRanges(30'000);
	Frame();
	ExpectAllRecords(0);
	for (uint32_t Material = 0; Material < 30'000; Material += 2)
	{
		Materials.Set(Material, MakeMaterial(MATERIAL_DOUBLE_SIDED));
		Table.MaterialChanged(Material);
	}
	EXPECT_EQ(Frame(1).RecordsWritten, 30'000u);
	ExpectAllRecords(1);
}

TEST_F(FTableBindingTest, GrowthWaitsForNothingAndKeepsWhatWasWritten)
{
	Mock().SetManualFences(true);
	AddRanges(10);
	Submit(0);
	uint32_t Growths = 0;
	FRTFence Last = 0;
	for (int I = 0; I < 20; ++I)
	{
		const uint32_t Had = Bindings->GetTable()->GetDesc().HitCount;
		const uint32_t Before = Table.GetCapacity();
		AddRanges(1 + Before / 4);
		Last = Submit(0);
		EXPECT_EQ(Bindings->GetStats().RecordsWritten, 2 * (Table.GetCapacity() - Before)) << "what was there is written again";
		Growths += Bindings->GetTable()->GetDesc().HitCount > Had;
	}
	EXPECT_GE(Growths, 8u);
	EXPECT_LE(Growths, 14u) << "it grows by a half at a time";
	EXPECT_EQ(Mock().GetBlockingWaits(), 0u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::WaitFor) + Mock().CountCalls(ERTMockCall::WaitIdle), 0u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateShaderTable), 1u);
	Mock().CompleteUpTo(Last);
	ExpectAllRecords(0);
	Mock().SetManualFences(false);
}

TEST_F(FTableBindingTest, ModeOfThePaperWritesAndCopiesEverythingEachFrame)
{
	AddRanges(1000);
	Frame();
	SetMode(0);
	for (int I = 0; I < 3; ++I)
	{
		const FShaderTableStats& Stats = Frame();
		EXPECT_EQ(Stats.RecordsWritten, 2000u);
		EXPECT_GE(Stats.BytesCopied, 2000 * Stride());
	}
	AddRanges(10);
	Frame(1);
	ExpectAllRecords(1);
	SetMode(1);
	EXPECT_EQ(Frame(1).BytesCopied, 0u) << "it left nothing undone";
	ExpectAllRecords(1);
}

TEST_F(FTableBindingTest, ManyInstancesOfOneTreeHaveTheRecordsOfOne)
{
	Materials.Add(MakeMaterial());
	for (int I = 0; I < 100'000; ++I) { Table.Acquire(*Geometry, {0}); }
	EXPECT_EQ(Frame().RecordsWritten, 2u);
	EXPECT_EQ(Table.GetRangeCount(), 1u);
}

TEST_F(FTableBindingTest, StrideIsTheTightestThatTheDeviceAllows)
{
	struct FCase
	{
		uint32_t Handle, Alignment, Base, Stride;
	};
	for (const FCase& Case : {FCase{32, 16, 32, 64}, FCase{32, 32, 64, 64}, FCase{32, 64, 64, 64}, FCase{64, 64, 256, 128}})
	{
		FRTMockDesc Desc;
		Desc.HandleSize = Case.Handle;
		Desc.HandleAlignment = Case.Alignment;
		Desc.BaseAlignment = Case.Base;
		TRTRef<IRTDevice> Other = MakeMockDevice(Desc);
		FShaderTable OtherBindings(*Other);
		const auto Pipeline = FModelPipeline::Make(*Other, 0, 2, 1);
		ASSERT_TRUE(OtherBindings.Prepare(Pipeline->Pipeline, Table));
		EXPECT_EQ(OtherBindings.GetTable()->GetRecordStride(ERTRecordKind::Hit), Case.Stride);
	}
}

TEST_F(FTableBindingTest, PreparedAheadIsRecordedOnce)
{
	AddRanges(10);
	ASSERT_TRUE(Bindings->Prepare(Pipelines[0]->Pipeline, Table));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::UpdateShaderTable), 0u) << "preparing records nothing";
	AddRanges(10);
	ASSERT_TRUE(Bindings->Prepare(Pipelines[0]->Pipeline, Table)) << "the frame of the first was dropped";
	Frame();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::UpdateShaderTable), 1u);
	ExpectAllRecords(0);
	Frame();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::UpdateShaderTable), 1u);
}

TEST_F(FTableBindingTest, NoMemoryToGrowLeavesTheTableAsItWas)
{
	AddRanges(10);
	Frame();
	AddRanges(100);
	Mock().FailAllocation(1);
	const FRTStatus Status = Bindings->Prepare(Pipelines[0]->Pipeline, Table);
	EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_NE(std::string(Status.Message).find("ShaderTable"), std::string::npos) << Status.Message;
	ExpectRecord(0, 9, 1);
	Frame();
	ExpectAllRecords(0);
}

TEST_F(FTableBindingTest, AnotherTableAtTheSameAddressIsNotTakenForTheFirst)
{
	AddRanges(3);
	alignas(FSectionTable) unsigned char Memory[sizeof(FSectionTable)];
	FShaderTable Other(*Device), Reader(*Device);
	for (uint32_t Material = 0; Material < 2; ++Material)
	{
		auto* const Sections = new (Memory) FSectionTable(Context);
		Sections->Acquire(*Geometry, {Material});
		// Somebody else has taken the news of the second one.
		ASSERT_TRUE((Material ? Reader : Other).Prepare(Pipelines[0]->Pipeline, *Sections));
		ASSERT_TRUE(Other.Prepare(Pipelines[0]->Pipeline, *Sections));
		TRTRef<IRTCommandList> List;
		ASSERT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		ASSERT_TRUE(List->Begin());
		ASSERT_TRUE(Other.Record(*List));
		ASSERT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		ASSERT_TRUE(Device->Submit(Lists, 1, nullptr));
		const FRTMockRecord Record = Mock().ResolveRecord(Other.GetTable(), ERTRecordKind::Hit, 0);
		EXPECT_EQ(reinterpret_cast<const FSectionData*>(Record.Data.data())->Material, Material);
		Sections->~FSectionTable();
	}
}

} // namespace
} // namespace Lantern
