// Geometries: sizes, builds and refits.
#include "Support/ContractScene.h"

namespace Lantern
{
namespace
{

class FGeometryContract : public TSceneFixture<FContract>
{};

TEST_P(FGeometryContract, SizesGrowWithTheGeometry)
{
	const auto Sizes = [&](uint32_t Triangles, bool bUpdate) {
		FRTGeometrySection Section;
		Section.VertexCount = Triangles * 3;
		Section.TriangleCount = Triangles;
		Section.IndexType = ERTIndexType::None;
		const auto Geometry = Make.Geometry(Section, "Sized", bUpdate);
		return Geometry->GetBuildSizes();
	};
	const FRTBuildSizes Small = Sizes(2, false), Large = Sizes(20000, false), Refit = Sizes(20000, true);
	EXPECT_GT(Small.StructureBytes, 0u);
	EXPECT_GT(Small.BuildScratchBytes, 0u);
	EXPECT_GT(Large.StructureBytes, 10 * Small.StructureBytes);
	EXPECT_GE(Large.BuildScratchBytes, Small.BuildScratchBytes) << "a CPU driver may need a constant amount";
	// A refit may need no scratch at all, but never as much as a build.
	EXPECT_LE(Refit.UpdateScratchBytes, Refit.BuildScratchBytes);
	EXPECT_GE(Device().GetMemoryStats().Peak, Large.StructureBytes);
}

TEST_P(FGeometryContract, HaveAddressesAndSections)
{
	const FContractGeometry One = MakeSquares(1), Three = MakeSquares(3);
	EXPECT_EQ(One.Geometry->GetSectionCount(), 1u);
	EXPECT_EQ(Three.Geometry->GetSectionCount(), 3u);
	EXPECT_NE(One.GetAddress(), 0u);
	EXPECT_NE(One.GetAddress(), Three.GetAddress());
}

TEST_P(FGeometryContract, BuildThenRefitThenRebuild)
{
	const FContractGeometry Item = MakeSquares(2, true, true);
	const auto List = Make.List();
	Build(List.Get(), Item);
	Build(List.Get(), Item, true);
	Build(List.Get(), Item, true);
	Build(List.Get(), Item);
	Run(List.Get());
}

TEST_P(FGeometryContract, ManyBuildsInOneCall)
{
	const uint64_t Alignment = Caps().ScratchAlignment;
	std::vector<FContractGeometry> Items;
	std::vector<FRTGeometryBuild> Builds;
	uint64_t Offset = 0;
	for (uint32_t i = 0; i < 16; ++i) { Items.push_back(MakeSquares(1 + i % 3)); }
	for (const FContractGeometry& Item : Items)
	{
		FRTGeometryBuild& Desc = Builds.emplace_back();
		Desc.Geometry = Item.Geometry.Get();
		Desc.Sections = Item.Sections.data();
		Desc.SectionCount = static_cast<uint32_t>(Item.Sections.size());
		Desc.Scratch = Scratch.Get();
		Desc.ScratchOffset = Offset;
		Offset += (Item.Geometry->GetBuildSizes().BuildScratchBytes + Alignment - 1) / Alignment * Alignment;
	}
	ASSERT_LE(Offset, Scratch->GetDesc().Size);
	const auto List = Make.List();
	List->BuildGeometries(Builds.data(), 16);
	Make.BuildBarrier(List.Get());
	Run(List.Get());
}

TEST_P(FGeometryContract, ListKeepsWhatItBuilds)
{
	FContractGeometry Item = MakeSquares();
	const auto List = Make.List();
	Build(List.Get(), Item);
	Item = {};
	Device().CollectGarbage();
	Run(List.Get());
}

TEST_P(FGeometryContract, MemoryIsCounted)
{
	const uint64_t Before = Device().GetMemoryStats().Geometry;
	{
		const FContractGeometry Item = MakeSquares();
		EXPECT_GE(Device().GetMemoryStats().Geometry, Before + Item.Geometry->GetBuildSizes().StructureBytes);
	}
	EXPECT_OK(Device().WaitIdle());
	Device().CollectGarbage();
	EXPECT_EQ(Device().GetMemoryStats().Geometry, Before);
}

INSTANTIATE_TEST_SUITE_P(RHI, FGeometryContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
