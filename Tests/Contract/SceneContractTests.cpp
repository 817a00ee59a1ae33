// Scenes: builds of top-level acceleration structures, and their geometries' lives.
#include "Support/ContractScene.h"

namespace Lantern
{
namespace
{

class FSceneContract : public TSceneFixture<FContract>
{};

TEST_P(FSceneContract, HasAnIndexAndSizes)
{
	const auto A = Make.Scene(10), B = Make.Scene(10000);
	EXPECT_NE(A->GetIndex(), B->GetIndex());
	EXPECT_EQ(A->GetMaxInstances(), 10u);
	EXPECT_GT(A->GetBuildSizes().StructureBytes, 0u);
	EXPECT_GT(B->GetBuildSizes().StructureBytes, A->GetBuildSizes().StructureBytes);
	EXPECT_GT(B->GetBuildSizes().BuildScratchBytes, 0u);
}

TEST_P(FSceneContract, BuildsWithNoInstances)
{
	const auto Scene = Make.Scene(8);
	const auto List = Make.List();
	BuildScene(List.Get(), Scene.Get(), {});
	Run(List.Get());
}

TEST_P(FSceneContract, BuildsWithManyInstancesAtAnOffset)
{
	const FContractGeometry Square = MakeSquares();
	const uint32_t Count = 5000;
	const auto Scene = Make.Scene(Count);
	const auto Instances = Make.Buffer((Count + 1) * sizeof(FRTInstance), ERTMemory::Upload, "Instances");
	auto* Items = static_cast<FRTInstance*>(Instances->GetMapped());
	for (uint32_t i = 1; i <= Count; ++i) { Items[i] = Place(Square, static_cast<float>(i), i % 256); }
	ASSERT_LE(Scene->GetBuildSizes().BuildScratchBytes, Scratch->GetDesc().Size);
	const auto List = Make.List();
	Build(List.Get(), Square);
	List->BuildScene(Scene.Get(), Instances.Get(), sizeof(FRTInstance), Count, Scratch.Get(), 0);
	Make.BuildBarrier(List.Get());
	Run(List.Get());
}

TEST_P(FSceneContract, InstancesFromDeviceMemory)
{
	const FContractGeometry Square = MakeSquares();
	const auto Scene = Make.Scene(1);
	const std::vector<FRTInstance> Items = {Place(Square, 0)};
	const auto Source = Upload(Items);
	const auto Instances = Make.Buffer(sizeof(FRTInstance), ERTMemory::Device, "Instances");
	const auto List = Make.List();
	Build(List.Get(), Square);
	List->CopyBuffer(Instances.Get(), 0, Source.Get(), 0, sizeof(FRTInstance));
	Barrier(List.Get(), Instances.Get(), ERTAccess::CopyWrite, ERTAccess::GeometryInput);
	List->BuildScene(Scene.Get(), Instances.Get(), 0, 1, Scratch.Get(), 0);
	Make.BuildBarrier(List.Get());
	Run(List.Get());
}

TEST_P(FSceneContract, GeometryRemovedWhileFramesAreInFlight)
{
	FContractGeometry Stays = MakeSquares(1, true, false, "Stays"), Goes = MakeSquares(1, true, false, "Goes");
	const auto Scene = Make.Scene(2);
	auto List = Make.List("Load");
	Build(List.Get(), Stays);
	Build(List.Get(), Goes);
	Make.Submit(List.Get());
	FRTFence Last = 0;
	for (uint32_t Frame = 0; Frame < 6; ++Frame)
	{
		List = Make.List("Frame");
		Make.BuildBarrier(List.Get());
		std::vector<FRTInstance> Instances = {Place(Stays, 0)};
		List->KeepAlive(Stays.Geometry.Get());
		if (Goes.Geometry)
		{
			Instances.push_back(Place(Goes, 1));
			List->KeepAlive(Goes.Geometry.Get());
		}
		BuildScene(List.Get(), Scene.Get(), Instances);
		// Removed between recording and submission, with earlier frames still running.
		if (Frame == 2) { Goes = {}; }
		Last = Make.Submit(List.Get());
	}
	Wait(Last);
}

TEST_P(FSceneContract, IndexIsGivenBack)
{
	uint32_t First = ~0u;
	for (uint32_t i = 0; i < 40; ++i)
	{
		const auto Scene = Make.Scene(1);
		First = i == 0 ? Scene->GetIndex() : First;
		EXPECT_LE(Scene->GetIndex(), First + 1);
		Device().CollectGarbage(); // destroys those before this one
	}
}

INSTANTIATE_TEST_SUITE_P(RHI, FSceneContract,
    testing::Values(EContractRHI::Mock, EContractRHI::MockValidated, EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
