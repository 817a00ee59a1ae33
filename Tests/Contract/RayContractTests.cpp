// Which shader record a ray reaches, and what ray and instance flags do to it.
#include "RayFixture.h"

namespace Lantern
{
namespace
{

class FRecordContract : public FRayContract
{};

TEST_P(FRecordContract, HitAndMiss)
{
	MakeTable(1);
	SetHit(0, 7);
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0, 3), Place(Square, 2, 5)});
	EXPECT_EQ(Trace(4, MakePush()), (FWords{HitValue(7, 3, 0, 0), MissOne, HitValue(7, 5, 0, 0), MissOne}));
}

/// As many rays as an earlier command of the same list has written: two of three that would hit.
TEST_P(FRecordContract, IndirectTraceReadsItsSizeOnTheDevice)
{
	if (!Caps().bIndirectTrace) { GTEST_SKIP() << "no indirect traces"; }
	MakeTable(1);
	SetHit(0, 7);
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0, 3), Place(Square, 1, 5), Place(Square, 2, 6)});
	const auto Size = Upload(std::vector<uint32_t>{99, 2, 1, 1});
	const auto Arguments = Make.Buffer(16, ERTMemory::Device, "Arguments", ERTBufferUsage::Indirect | ERTBufferUsage::CopyDest);
	const auto Output = Make.Buffer(12, ERTMemory::Readback, "Output");
	FContractPush Push = MakePush();
	Push.Output = Output->GetDeviceAddress();
	const auto List = Make.List("Trace");
	List->FillBuffer(Output.Get(), 0, 12, 0);
	Barrier(List.Get(), Output.Get(), ERTAccess::CopyWrite, ERTAccess::StorageWrite);
	List->CopyBuffer(Arguments.Get(), 0, Size.Get(), 0, 16);
	Barrier(List.Get(), Arguments.Get(), ERTAccess::CopyWrite, ERTAccess::IndirectRead);
	List->UpdateShaderTable(Table.Get());
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->TraceRaysIndirect(Table.Get(), 0, Arguments.Get(), 4);
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	if (!IsVulkan()) { return; } // the mock records rays and traces none
	const auto* const Got = static_cast<const uint32_t*>(Output->GetMapped());
	EXPECT_EQ((FWords{Got[0], Got[1], Got[2]}), (FWords{HitValue(7, 3, 0, 0), HitValue(7, 5, 0, 0), 0}));
}

TEST_P(FRecordContract, SecondMissShader)
{
	MakeTable(1);
	SetHit(0, 7);
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0)});
	FContractPush Push = MakePush();
	Push.F = 1;
	EXPECT_EQ(Trace(2, Push), (FWords{HitValue(7, 0, 0, 0), MissTwo}));
}

TEST_P(FRecordContract, OffsetPlusSectionTimesMultiplierPlusRayType)
{
	// Two instances of three sections with two ray types: 12 records, each with a value of its own.
	MakeTable(13);
	for (uint32_t i = 0; i < 13; ++i) { SetHit(i, 100 + i); }
	const FContractGeometry Squares = MakeSquares(3);
	Load({&Squares}, {Place(Squares, 0, 1, 1), Place(Squares, 3, 2, 7)});
	for (uint32_t RayType = 0; RayType < 2; ++RayType)
	{
		FContractPush Push = MakePush();
		Push.D = RayType;
		Push.E = 2;
		const FWords Got = Trace(6, Push);
		for (uint32_t Pixel = 0; Pixel < 6; ++Pixel)
		{
			const uint32_t Instance = Pixel / 3, Section = Pixel % 3;
			const uint32_t Record = 1 + Instance * 6 + Section * 2 + RayType;
			EXPECT_EQ(Got[Pixel], HitValue(100 + Record, Instance + 1, Section, 0)) << Pixel;
		}
	}
	// Multiplier 0: one record for all sections.
	FContractPush Push = MakePush();
	Push.E = 0;
	EXPECT_EQ(Trace(3, Push), (FWords{HitValue(101, 1, 0, 0), HitValue(101, 1, 1, 0), HitValue(101, 1, 2, 0)}));
}

TEST_P(FRecordContract, TableChangesBetweenFrames)
{
	MakeTable(2);
	SetHit(0, 1);
	SetHit(1, 2);
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0, 0, 0), Place(Square, 1, 0, 1)});
	EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), HitValue(2, 0, 0, 0)}));
	SetHit(1, 9);
	EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), HitValue(9, 0, 0, 0)}));
	EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), HitValue(9, 0, 0, 0)}));
}

TEST_P(FRecordContract, ScatteredChangesReachTheirRecordsOnly)
{
	MakeTable(400);
	const FContractGeometry Square = MakeSquares();
	std::vector<FRTInstance> Instances;
	FWords Expected;
	for (uint32_t i = 0; i < 64; ++i)
	{
		Instances.push_back(Place(Square, static_cast<float>(i), 0, 5 * i + 1));
		Expected.push_back(HitValue(1000 + i, 0, 0, 0));
	}
	for (uint32_t i = 0; i < 400; ++i) { SetHit(i, i % 5 == 1 ? 1000 + i / 5 : 9); }
	Load({&Square}, Instances);
	EXPECT_EQ(Trace(64, MakePush()), Expected);
	for (uint32_t Round = 0; Round < 3; ++Round)
	{
		// Most of those looked at, and their neighbours; the last round while the table grows.
		for (uint32_t i = Round; i < 64; i += 2)
		{
			SetHit(5 * i + 1, 2000 + 100 * Round + i);
			SetHit(5 * i, 7);
			Expected[i] = HitValue(2000 + 100 * Round + i, 0, 0, 0);
		}
		const uint32_t Counts[4] = {2, 2, 1000, 2};
		ASSERT_OK(Round == 2 ? Table->Reserve(Counts) : FRTStatus());
		EXPECT_EQ(Trace(64, MakePush()), Expected) << Round;
	}
}

TEST_P(FRecordContract, InvalidateMakesGoodForAListNeverSubmitted)
{
	const FContractGeometry Square = MakeSquares();
	for (const bool bGrows : {false, true})
	{
		Load({&Square}, {Place(Square, 0, 0, 0), Place(Square, 1, 0, 1)});
		MakeTable(2);
		SetHit(0, 1);
		SetHit(1, 2);
		EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), HitValue(2, 0, 0, 0)}));
		SetHit(1, 3);
		const uint32_t Counts[4] = {2, 2, 6, 2};
		ASSERT_OK(bGrows ? Table->Reserve(Counts) : FRTStatus());
		{
			const auto Dropped = Make.List("Dropped");
			Dropped->UpdateShaderTable(Table.Get());
			EXPECT_OK(Dropped->End());
		}
		Table->Invalidate();
		if (bGrows) { SetHit(5, 4); }
		EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), HitValue(3, 0, 0, 0)})) << bGrows;
	}
	Load({}, {Place(Square, 0, 0, 5)});
	EXPECT_EQ(Trace(1, MakePush()), FWords{HitValue(4, 0, 0, 0)});
}

TEST_P(FRecordContract, UpdatesLeavePipelineAndConstantsAlone)
{
	if (!IsVulkan()) { GTEST_SKIP() << "the mock runs no shaders"; }
	MakeTable(400);
	for (uint32_t i = 0; i < 400; i += 3) { SetHit(i, i); }
	const auto Compute = MakeComputePipeline(Device(), "WriteWords.comp");
	const auto Output = Make.Buffer(32, ERTMemory::Readback);
	FContractPush Push;
	Push.Output = Output->GetDeviceAddress();
	Push.A = 5;
	Push.B = 2;
	Push.C = 8;
	const auto List = Make.List();
	List->SetPipeline(Compute.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->UpdateShaderTable(Table.Get());
	List->Dispatch(1, 1, 1);
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	for (uint32_t i = 0; i < 8; ++i) { EXPECT_EQ(static_cast<const uint32_t*>(Output->GetMapped())[i], 5 + i * 2); }
}

TEST_P(FRecordContract, TableChangesWithinAList)
{
	if (IsMock()) { GTEST_SKIP() << "the mock's rays are followed at the end of a list only"; }
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0)});
	const auto First = Make.Buffer(4, ERTMemory::Readback, "First");
	const auto List = Make.List();
	FContractPush Push = MakePush();
	Push.Output = First->GetDeviceAddress();
	List->UpdateShaderTable(Table.Get());
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->TraceRays(Table.Get(), 0, 1, 1, 1);
	SetHit(0, 2);
	EXPECT_EQ(Trace(List.Get(), 1, MakePush()), FWords{HitValue(2, 0, 0, 0)});
	EXPECT_EQ(*static_cast<const uint32_t*>(First->GetMapped()), HitValue(1, 0, 0, 0));
}

TEST_P(FRecordContract, NewTableForTheSamePipeline)
{
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0)});
	for (uint32_t Value = 1; Value < 4; ++Value)
	{
		MakeTable(Value); // replaces one that earlier frames used
		SetHit(0, Value);
		EXPECT_EQ(Trace(1, MakePush()), FWords{HitValue(Value, 0, 0, 0)});
	}
}

TEST_P(FRecordContract, CallableShaders)
{
	MakeTable(0);
	FContractPush Push = MakePush();
	EXPECT_EQ(Trace(4, Push, 1), (FWords{1, 3, 5, 7}));
	Push.D = 1;
	EXPECT_EQ(Trace(4, Push, 1), (FWords{0, 1, 4, 9}));
}

TEST_P(FRecordContract, InstanceMasks)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	Load({&Square},
	    {Place(Square, 0, 0, 0, 0x01), Place(Square, 1, 1, 0, 0x02), Place(Square, 2, 2, 0, 0x80), Place(Square, 3, 3, 0, 0x00)});
	const uint32_t Hits[4] = {HitValue(1, 0, 0, 0), HitValue(1, 1, 0, 0), HitValue(1, 2, 0, 0), MissOne};
	EXPECT_EQ(Trace(4, MakePush(0, 0x01)), (FWords{Hits[0], MissOne, MissOne, MissOne}));
	EXPECT_EQ(Trace(4, MakePush(0, 0x82)), (FWords{MissOne, Hits[1], Hits[2], MissOne}));
	EXPECT_EQ(Trace(4, MakePush(0, 0xff)), (FWords{Hits[0], Hits[1], Hits[2], MissOne}));
}

TEST_P(FRecordContract, FaceCullingIsChosenPerDispatch)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	// Rotated by half a turn about y: the rays see its back.
	FRTInstance Turned = Place(Square, 2, 1);
	Turned.Transform[0] = Turned.Transform[10] = -1.0f;
	FRTInstance Never = Turned;
	Never.Transform[3] = 3;
	Never.CustomIndexAndMask = 2 | 0xff000000u;
	Never.TableOffsetAndFlags |= static_cast<uint32_t>(InstanceCullDisable) << 24;
	FRTInstance Swapped = Place(Square, 3, 3);
	Swapped.TableOffsetAndFlags |= FlipFacing << 24;
	Load({&Square}, {Place(Square, 0, 0), Turned, Never, Swapped});
	const FWords All = Trace(4, MakePush());
	const uint32_t Front = HitValue(1, 0, 0, 0);
	EXPECT_EQ(All[0], Front);
	for (uint32_t i = 1; i < 4; ++i) { EXPECT_EQ(All[i] & ~1u, HitValue(1, i, 0, 0, true)) << i; }
	const FWords NoBack = Trace(4, MakePush(RayCullBack));
	EXPECT_EQ(NoBack, (FWords{Front, MissOne, All[2], MissOne}));
	const FWords NoFront = Trace(4, MakePush(RayCullFront));
	EXPECT_EQ(NoFront, (FWords{MissOne, All[1], All[2], All[3]}));
}

TEST_P(FRecordContract, AnyHitRunsOnNonOpaqueOnly)
{
	MakeTable(1);
	SetHit(0, 1, GroupMasked);
	const FContractGeometry Solid = MakeSquares(1, true), Masked = MakeSquares(1, false);
	FRTInstance Forced = Place(Masked, 2, 2), Opened = Place(Solid, 3, 3);
	Forced.TableOffsetAndFlags |= static_cast<uint32_t>(InstanceForceOpaque) << 24;
	Opened.TableOffsetAndFlags |= static_cast<uint32_t>(InstanceForceNoOpaque) << 24;
	Load({&Solid, &Masked}, {Place(Solid, 0, 0), Place(Masked, 1, 1), Forced, Opened});
	const uint32_t Hits[4] = {HitValue(1, 0, 0, 0), HitValue(1, 1, 0, 0), HitValue(1, 2, 0, 0), HitValue(1, 3, 0, 0)};
	EXPECT_EQ(Trace(4, MakePush()), (FWords{Hits[0], MissOne, Hits[2], MissOne}));
	EXPECT_EQ(Trace(4, MakePush(RayOpaque)), (FWords{Hits[0], Hits[1], Hits[2], Hits[3]}));
	EXPECT_EQ(Trace(4, MakePush(RayNoOpaque)), (FWords{MissOne, MissOne, MissOne, MissOne}));
}

// What counts as opaque is decided by the instance before rays cull it. The groups have no any-hit shader: what is not opaque is hit.
TEST_P(FRecordContract, InstancesDecideWhatIsCulledAsOpaque)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Solid = MakeSquares(1, true), Masked = MakeSquares(1, false);
	FRTInstance Forced = Place(Masked, 2, 2), Opened = Place(Solid, 3, 3);
	Forced.TableOffsetAndFlags |= static_cast<uint32_t>(InstanceForceOpaque) << 24;
	Opened.TableOffsetAndFlags |= static_cast<uint32_t>(InstanceForceNoOpaque) << 24;
	Load({&Solid, &Masked}, {Place(Solid, 0, 0), Place(Masked, 1, 1), Forced, Opened});
	EXPECT_EQ(Trace(4, MakePush(RayCullOpaque)), (FWords{MissOne, HitValue(1, 1, 0, 0), MissOne, HitValue(1, 3, 0, 0)}));
}

TEST_P(FRecordContract, AnyHitOfOneSectionOnly)
{
	MakeTable(2);
	SetHit(0, 1);
	SetHit(1, 2, GroupMasked);
	const FContractGeometry Squares = MakeSquares(2, false);
	Load({&Squares}, {Place(Squares, 0)});
	EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), MissOne}));
}

INSTANTIATE_TEST_SUITE_P(RHI, FRecordContract, testing::ValuesIn(RayRHIs), [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
