// Every stage of a ray-tracing pipeline, and the ray flags that choose among them.
#include "RayStageFixture.h"

namespace Lantern
{
namespace
{

class FStageContract : public FRayStageFixture
{
protected:
	void SetUp() override
	{
		FRayStageFixture::SetUp();
		if (HasFatalFailure() || IsSkipped()) { return; }
		FGroups All = GetGeneralGroups();
		const FGroups Hits = GetHitGroups();
		All.insert(All.end(), Hits.begin(), Hits.end());
		Use(MakeRays(Device(), All), All);
		MakeStageTable();
		MakeStageScene();
	}
};

TEST_P(FStageContract, AllAnswerAndGetTheConstants) { ExpectAllStages("monolithic"); }

TEST_P(FStageContract, OpaqueRaysRunNoAnyHit)
{
	FWords Expected = GetExpected(2);
	Expected[3] = 11 << 16 | 2 << 8 | 4;
	Expected[8] = 14 << 16 | 3 << 8 | 5;
	EXPECT_EQ(Trace(10, MakeStagePush(2, RayOpaque)), Expected);
}

TEST_P(FStageContract, NoOpaqueRaysRunItOnSolids)
{
	FWords Expected = GetExpected(2);
	Expected[1] = 0xe0000002u; // record 1 has Parity: 11 + 0 + 2 is odd
	EXPECT_EQ(Trace(10, MakeStagePush(2, RayNoOpaque)), Expected);
}

TEST_P(FStageContract, OpacityCulls)
{
	FWords Solid = GetExpected(5), Open = Solid;
	for (const uint32_t Pixel : {3u, 4u, 7u, 8u}) { Solid[Pixel] = 0xe0000005u; }
	for (const uint32_t Pixel : {0u, 1u, 2u, 5u, 6u}) { Open[Pixel] = 0xe0000005u; }
	EXPECT_EQ(Trace(10, MakeStagePush(5, RayCullNoOpaque)), Solid);
	EXPECT_EQ(Trace(10, MakeStagePush(5, RayCullOpaque)), Open);
}

TEST_P(FStageContract, ClosestHitMayBeSkippedAndTheMissShaderKept)
{
	FWords Expected = GetExpected(2);
	for (uint32_t& Word : Expected) { Word = Word == 0xe0000002u ? Word : 0; }
	EXPECT_EQ(Trace(10, MakeStagePush(2, RaySkipClosestHit)), Expected);
	// Shadow rays: the same, ending at whatever is met first.
	EXPECT_EQ(Trace(10, MakeStagePush(2, RaySkipClosestHit | RayFirstHit)), Expected);
}

TEST_P(FStageContract, AHoleShowsWhatIsBehind)
{
	FRTInstance Behind = Place(Squares, 0, 6, 0), Before = Place(Masked, 0, 4, 1);
	Behind.Transform[11] = -2.0f;
	Load({}, {Before, Behind});
	EXPECT_EQ(Trace(1, MakeStagePush(2)), FWords{10 << 16 | 2 << 8 | 6});
	EXPECT_EQ(Trace(1, MakeStagePush(5)), FWords{11 << 16 | 5 << 8 | 4});
}

TEST_P(FStageContract, TheNearerOfBoxAndTriangle)
{
	FRTInstance Above = Place(Squares, 0, 6, 0);
	for (const float Height : {0.5f, 0.1f})
	{
		Above.Transform[11] = Height; // the boxes' tops are at 0.25
		Load({}, {Place(Boxes, 0, 7, 3), Above});
		const uint32_t Box = 13 << 16 | 5 << 8 | 5, Square = 10 << 16 | 5 << 8 | 6;
		EXPECT_EQ(Trace(1, MakeStagePush(5)), FWords{Height > 0.25f ? Square : Box});
	}
}

TEST_P(FStageContract, MasksCullBoxesToo)
{
	Load({}, {Place(Boxes, 0, 7, 3, 0x02), Place(OpenBoxes, 2, 9, 3, 0x04)});
	FContractPush Push = MakeStagePush(5);
	Push.C = 0x04;
	const uint32_t Miss = 0xe0000005u;
	EXPECT_EQ(Trace(4, Push), (FWords{Miss, Miss, 13 << 16 | 5 << 8 | 5, 13 << 16 | 6 << 8 | 5}));
}

TEST_P(FStageContract, FaceCullingLeavesBoxes)
{
	FRTInstance Mirrored = Place(Squares, 3, 6, 0);
	Mirrored.Transform[0] = -1.0f; // a mirror does not turn the winding
	FRTInstance Turned = Place(Squares, 4, 8, 0);
	Turned.Transform[0] = Turned.Transform[10] = -1.0f;
	Load({}, {Place(Boxes, 0, 7, 3), Mirrored, Turned});
	const uint32_t Miss = 0xe0000005u, One = 13 << 16 | 5 << 8 | 5, Two = 13 << 16 | 6 << 8 | 5;
	const uint32_t Front = 10 << 16 | 5 << 8 | 6, Back = 10 << 16 | 5 << 8 | 8;
	EXPECT_EQ(Trace(4, MakeStagePush(5)), (FWords{One, Two, Front, Back}));
	EXPECT_EQ(Trace(4, MakeStagePush(5, RayCullBack)), (FWords{One, Two, Front, Miss}));
	EXPECT_EQ(Trace(4, MakeStagePush(5, RayCullFront)), (FWords{One, Two, Miss, Back}));
}

/// The one that was built goes as soon as it has been copied; instances know the copy's address only.
TEST_P(FStageContract, RaysFindCompactedGeometry)
{
	std::vector<float> Vertices;
	for (uint32_t Strip = 0; Strip < 64; ++Strip)
	{
		const float Y = static_cast<float>(Strip) / 64, Next = static_cast<float>(Strip + 1) / 64;
		Vertices.insert(Vertices.end(), {0, Y, 0, 1, Y, 0, 1, Next, 0, 0, Y, 0, 1, Next, 0, 0, Next, 0});
	}
	FContractGeometry Full;
	Full.Vertices = Upload(Vertices, "Strips");
	FRTGeometrySection& Section = Full.Sections.emplace_back();
	Section.Vertices = Full.Vertices.Get();
	Section.VertexCount = 64 * 6;
	Section.TriangleCount = 64 * 2;
	Section.IndexType = ERTIndexType::None;
	FRTGeometryDesc Desc;
	Desc.Sections = Full.Sections.data();
	Desc.SectionCount = 1;
	Desc.bAllowCompaction = true;
	Desc.Name = "Full";
	ASSERT_OK(Device().CreateGeometry(Desc, Full.Geometry.ReleaseAndGetAddress()));
	TRTRef<IRTQueryPool> Queries;
	ASSERT_OK(Device().CreateQueryPool(ERTQuery::CompactedSize, 2, Queries.ReleaseAndGetAddress()));
	const auto First = Make.List("Build");
	First->ResetQueries(Queries.Get(), 0, 2);
	Build(First.Get(), Full);
	First->WriteCompactedSize(Queries.Get(), 1, Full.Geometry.Get());
	Run(First.Get());
	uint64_t Bytes = 0;
	ASSERT_TRUE(Queries->GetResults(1, 1, &Bytes));
	EXPECT_FALSE(Queries->GetResults(0, 1, &Desc.CompactedBytes)) << "never written";
	const auto Reset = Make.List("Reset");
	Reset->ResetQueries(Queries.Get(), 1, 1);
	Run(Reset.Get());
	EXPECT_FALSE(Queries->GetResults(1, 1, &Desc.CompactedBytes)) << "reset since";
	EXPECT_GT(Bytes, 0u);
	EXPECT_LE(Bytes, Full.Geometry->GetBuildSizes().StructureBytes);

	Desc.CompactedBytes = Bytes;
	Desc.Name = "Compacted";
	FContractGeometry Small = Full;
	ASSERT_OK(Device().CreateGeometry(Desc, Small.Geometry.ReleaseAndGetAddress()));
	EXPECT_EQ(Small.Geometry->GetBuildSizes().StructureBytes, Bytes);
	const auto Second = Make.List("Compact");
	Second->CompactGeometry(Small.Geometry.Get(), Full.Geometry.Get());
	Make.BuildBarrier(Second.Get());
	BuildScene(Second.Get(), Scene.Get(), {Place(Small, 1, 6, 0), Place(Squares, 2, 7, 0)});
	Run(Second.Get());
	Full.Geometry.Reset();
	Device().CollectGarbage();
	const uint32_t Miss = 0xe0000005u;
	EXPECT_EQ(Trace(4, MakeStagePush(5)), (FWords{Miss, 10 << 16 | 5 << 8 | 6, 10 << 16 | 5 << 8 | 7, Miss}));
}

TEST_P(FStageContract, NullRecordsRunNothing)
{
	if (GetParam() == EContractRHI::VulkanValidated) { GTEST_SKIP() << "the wrapper reports them"; }
	const uint32_t Counts[4] = {2, 1, HitRecords + 4, 1};
	ASSERT_OK(Table->Reserve(Counts));
	Load({}, {Place(Squares, 0, 1, HitRecords), Place(Squares, 1, 2, 0)});
	EXPECT_EQ(Trace(3, MakeStagePush(5)), (FWords{0, 10 << 16 | 5 << 8 | 2, 0xe0000005u}));
}

INSTANTIATE_TEST_SUITE_P(RHI, FStageContract, testing::ValuesIn(RayRHIs), [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
