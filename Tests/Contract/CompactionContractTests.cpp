// Compacted geometries: their sizes, their copies, and rays that cannot tell them from their sources.
#include "RayFixture.h"

namespace Lantern
{
namespace
{

/// The fixture of the tests with and without rays.
template <class TBase>
class TCompaction : public TBase
{
protected:
	void SetUp() override
	{
		TBase::SetUp();
		if (!this->HasFatalFailure() && !this->IsSkipped())
		{
			ASSERT_OK(this->Device().CreateQueryPool(ERTQuery::CompactedSize, 4, Pool.ReleaseAndGetAddress()));
		}
	}
	void TearDown() override
	{
		Pool.Reset();
		TBase::TearDown();
	}
	/// Like MakeSquares, but of a grid of triangles, and allowed to be compacted.
	FContractGeometry MakeSource(uint32_t Squares = 64, bool bUpdate = false, const char* Name = "Source")
	{
		FContractGeometry Out = this->MakeSquares(Squares, true, bUpdate, Name);
		Out.Geometry = MakeGeometry(Out, 0, bUpdate, Name);
		return Out;
	}
	TRTRef<IRTGeometry> MakeGeometry(const FContractGeometry& Like, uint64_t CompactedBytes, bool bUpdate, const char* Name)
	{
		FRTGeometryDesc Desc;
		Desc.Sections = Like.Sections.data();
		Desc.SectionCount = static_cast<uint32_t>(Like.Sections.size());
		Desc.bAllowUpdate = bUpdate;
		Desc.bAllowCompaction = true;
		Desc.CompactedBytes = CompactedBytes;
		Desc.Name = Name;
		TRTRef<IRTGeometry> Out;
		EXPECT_OK(this->Device().CreateGeometry(Desc, Out.ReleaseAndGetAddress()));
		return Out;
	}
	/// Builds the geometries and returns how many bytes each needs.
	std::vector<uint64_t> BuildAndMeasure(const std::vector<const FContractGeometry*>& Sources)
	{
		const auto List = this->Make.List("Measure");
		List->ResetQueries(Pool.Get(), 0, 4);
		for (uint32_t i = 0; i < Sources.size(); ++i)
		{
			this->Build(List.Get(), *Sources[i]);
			List->WriteCompactedSize(Pool.Get(), i, Sources[i]->Geometry.Get());
		}
		this->Run(List.Get());
		std::vector<uint64_t> Sizes(Sources.size());
		EXPECT_TRUE(Pool->GetResults(0, static_cast<uint32_t>(Sizes.size()), Sizes.data()));
		return Sizes;
	}
	/// Compacts, and puts the barrier behind it.
	void Compact(IRTCommandList* List, IRTGeometry* Dest, IRTGeometry* Source)
	{
		List->CompactGeometry(Dest, Source);
		this->Make.BuildBarrier(List);
	}

	TRTRef<IRTQueryPool> Pool;
};

class FCompactionContract : public TCompaction<TSceneFixture<FContract>>
{};

TEST_P(FCompactionContract, SizesAreKnownOnceWritten)
{
	EXPECT_EQ(Pool->GetKind(), ERTQuery::CompactedSize);
	EXPECT_EQ(Pool->GetCount(), 4u);
	uint64_t Sizes[4] = {};
	EXPECT_FALSE(Pool->GetResults(0, 1, Sizes));
	const FContractGeometry Large = MakeSource(64), Small = MakeSource(1, false, "Small");
	for (uint32_t Round = 0; Round < 2; ++Round)
	{
		const std::vector<uint64_t> Found = BuildAndMeasure({&Large, &Small});
		EXPECT_GT(Found[0], 0u);
		// lavapipe's structures are as small as they get. The mock's shrink, so that what comes of it can be tested.
		const uint64_t Whole = Large.Geometry->GetBuildSizes().StructureBytes;
		EXPECT_TRUE(IsVulkan() ? Found[0] <= Whole : Found[0] < Whole) << Found[0] << " of " << Whole;
		EXPECT_GT(Found[0], Found[1]);
		EXPECT_FALSE(Pool->GetResults(0, 4, Sizes)) << "two were never written";
	}
}

TEST_P(FCompactionContract, CopiesAreGeometriesOfTheirOwn)
{
	const FContractGeometry Source = MakeSource();
	const uint64_t Size = BuildAndMeasure({&Source})[0];
	const uint64_t Before = Device().GetMemoryStats().Geometry;
	const auto Copy = MakeGeometry(Source, Size, false, "Copy");
	ASSERT_TRUE(Copy);
	EXPECT_NE(Copy->GetDeviceAddress(), Source.GetAddress());
	EXPECT_EQ(Copy->GetSectionCount(), 64u);
	EXPECT_EQ(Copy->GetBuildSizes().StructureBytes, Size);
	EXPECT_GE(Device().GetMemoryStats().Geometry, Before + Size);
	EXPECT_LT(Device().GetMemoryStats().Geometry, Before + Size + 65'536);
	FRTGeometryDesc Desc;
	Desc.Sections = Source.Sections.data();
	Desc.SectionCount = 64;
	Desc.bAllowCompaction = true;
	Desc.CompactedBytes = Size;
	EXPECT_EQ(Device().GetGeometrySizes(Desc).StructureBytes, Source.Geometry->GetBuildSizes().StructureBytes)
	    << "whole ones are asked for";
	const auto List = Make.List();
	Compact(List.Get(), Copy.Get(), Source.Geometry.Get());
	Run(List.Get());
}

TEST_P(FCompactionContract, SourcesGoWhileTheyAreCopied)
{
	FContractGeometry Source = MakeSource();
	const uint64_t Size = BuildAndMeasure({&Source})[0];
	const auto Copy = MakeGeometry(Source, Size, false, "Copy");
	const auto Scene = Make.Scene();
	const auto List = Make.List();
	Compact(List.Get(), Copy.Get(), Source.Geometry.Get());
	BuildScene(List.Get(), Scene.Get(), {FRHIMaker::Instance(Copy->GetDeviceAddress())});
	const FRTFence Fence = Make.Submit(List.Get());
	Source = {};
	Device().CollectGarbage();
	Wait(Fence);
	Device().CollectGarbage();
	EXPECT_LT(Device().GetMemoryStats().Geometry, Size + 65'536) << "the source is gone";
}

class FCompactedRays : public TCompaction<FRayContract>
{};

TEST_P(FCompactedRays, RaysMeetTheCopyAsTheSource)
{
	MakeTable(8);
	for (uint32_t i = 0; i < 8; ++i) { SetHit(i, 30 + i); }
	FContractGeometry Source = MakeSource(8);
	const uint64_t Size = BuildAndMeasure({&Source})[0];
	FContractGeometry Copy = Source;
	Copy.Geometry = MakeGeometry(Source, Size, false, "Copy");
	Load({}, {Place(Source, 0, 5)});
	FWords Expected;
	for (uint32_t i = 0; i < 8; ++i) { Expected.push_back(HitValue(30 + i, 5, i, 0)); }
	Expected.push_back(MissOne);
	EXPECT_EQ(Trace(9, MakePush()), Expected);
	const auto List = Make.List();
	Compact(List.Get(), Copy.Geometry.Get(), Source.Geometry.Get());
	BuildScene(List.Get(), Scene.Get(), {Place(Copy, 0, 5)});
	Source.Geometry.Reset();
	Run(List.Get());
	Device().CollectGarbage();
	EXPECT_EQ(Trace(9, MakePush()), Expected);
}

TEST_P(FCompactedRays, ManyInOneList)
{
	MakeTable(1);
	SetHit(0, 1);
	std::vector<FContractGeometry> Sources(4);
	std::vector<const FContractGeometry*> Pointers;
	for (FContractGeometry& Source : Sources)
	{
		Source = MakeSource(1);
		Pointers.push_back(&Source);
	}
	const std::vector<uint64_t> Sizes = BuildAndMeasure(Pointers);
	const auto List = Make.List();
	std::vector<TRTRef<IRTGeometry>> Copies;
	std::vector<FRTInstance> Instances;
	FWords Expected;
	for (uint32_t i = 0; i < 4; ++i)
	{
		Copies.push_back(MakeGeometry(Sources[i], Sizes[i], false, "Copy"));
		List->CompactGeometry(Copies[i].Get(), Sources[i].Geometry.Get());
		Instances.push_back(FRHIMaker::Instance(Copies[i]->GetDeviceAddress()));
		Instances[i].Transform[3] = static_cast<float>(3 - i);
		Instances[i].CustomIndexAndMask |= i;
		Expected.insert(Expected.begin(), HitValue(1, i, 0, 0));
	}
	Make.BuildBarrier(List.Get());
	BuildScene(List.Get(), Scene.Get(), Instances);
	Run(List.Get());
	EXPECT_EQ(Trace(4, MakePush()), Expected);
}

TEST_P(FCompactedRays, CopiesMayBeRefitted)
{
	MakeTable(2);
	SetHit(0, 1);
	SetHit(1, 2);
	FContractGeometry Source = MakeSource(2, true);
	const uint64_t Size = BuildAndMeasure({&Source})[0];
	FContractGeometry Copy = Source;
	Copy.Geometry = MakeGeometry(Source, Size, true, "Copy");
	auto List = Make.List();
	Compact(List.Get(), Copy.Geometry.Get(), Source.Geometry.Get());
	BuildScene(List.Get(), Scene.Get(), {Place(Copy, 0)});
	Run(List.Get());
	EXPECT_EQ(Trace(3, MakePush()), (FWords{HitValue(1, 0, 0, 0), HitValue(2, 0, 1, 0), MissOne}));
	// One to the right.
	auto* Positions = static_cast<float*>(Copy.Vertices->GetMapped());
	for (uint32_t i = 0; i < 8; ++i) { Positions[3 * i] += 1.0f; }
	List = Make.List();
	Build(List.Get(), Copy, true);
	BuildScene(List.Get(), Scene.Get(), {Place(Copy, 0)});
	Run(List.Get());
	EXPECT_EQ(Trace(3, MakePush()), (FWords{MissOne, HitValue(1, 0, 0, 0), HitValue(2, 0, 1, 0)}));
}

INSTANTIATE_TEST_SUITE_P(RHI, FCompactionContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });
INSTANTIATE_TEST_SUITE_P(RHI, FCompactedRays, testing::ValuesIn(RayRHIs), [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
