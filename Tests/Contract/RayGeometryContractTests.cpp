// What rays find in acceleration structures: refits, removals, procedural primitives, ray queries.
#include "RayFixture.h"

namespace Lantern
{
namespace
{

class FTraceContract : public FRayContract
{};

TEST_P(FTraceContract, EmptySceneMisses)
{
	MakeTable(1);
	Load({}, {});
	EXPECT_EQ(Trace(3, MakePush()), (FWords{MissOne, MissOne, MissOne}));
}

TEST_P(FTraceContract, ManyInstances)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	std::vector<FRTInstance> Instances;
	FWords Expected;
	for (uint32_t i = 0; i < 64; ++i)
	{
		Instances.push_back(Place(Square, static_cast<float>(i), (i * 7) % 64));
		Expected.push_back(HitValue(1, (i * 7) % 64, 0, 0));
	}
	Load({&Square}, Instances);
	EXPECT_EQ(Trace(64, MakePush()), Expected);
}

TEST_P(FTraceContract, RefitMovesTheTriangles)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares(1, true, true);
	Load({&Square}, {Place(Square, 0)});
	EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 0, 0, 0), MissOne}));
	auto* Vertices = static_cast<float*>(Square.Vertices->GetMapped());
	for (uint32_t i = 0; i < 12; i += 3) { Vertices[i] += 1.0f; }
	const auto List = Make.List("Refit");
	Make.BuildBarrier(List.Get());
	Build(List.Get(), Square, true);
	BuildScene(List.Get(), Scene.Get(), {Place(Square, 0)});
	EXPECT_EQ(Trace(List.Get(), 2, MakePush()), (FWords{MissOne, HitValue(1, 0, 0, 0)}));
}

TEST_P(FTraceContract, RigidMotionTouchesOnlyTheScene)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	Load({&Square}, {Place(Square, 0)});
	for (uint32_t X = 0; X < 3; ++X)
	{
		const auto List = Make.List();
		Make.BuildBarrier(List.Get());
		BuildScene(List.Get(), Scene.Get(), {Place(Square, static_cast<float>(X))});
		FWords Expected(3, MissOne);
		Expected[X] = HitValue(1, 0, 0, 0);
		EXPECT_EQ(Trace(List.Get(), 3, MakePush()), Expected);
	}
}

TEST_P(FTraceContract, NearestOfTwoSheets)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	FRTInstance Near = Place(Square, 0, 1), Far = Place(Square, 0, 2);
	Near.Transform[11] = 0.5f;
	Far.Transform[11] = -5.0f;
	Load({&Square}, {Far, Near});
	EXPECT_EQ(Trace(1, MakePush()), FWords{HitValue(1, 1, 0, 0)});
}

TEST_P(FTraceContract, RemovalWhileRaysAreInFlight)
{
	MakeTable(1);
	SetHit(0, 1);
	FContractGeometry Stays = MakeSquares(), Goes = MakeSquares();
	Load({&Stays, &Goes}, {Place(Stays, 0, 1), Place(Goes, 1, 2)});
	std::vector<TRTRef<IRTBuffer>> Outputs;
	FRTFence Last = 0;
	for (uint32_t Frame = 0; Frame < 6; ++Frame)
	{
		Outputs.push_back(Make.Buffer(8, ERTMemory::Readback, "Output"));
		FContractPush Push = MakePush();
		Push.Output = Outputs.back()->GetDeviceAddress();
		const auto List = Make.List("Frame");
		Make.BuildBarrier(List.Get());
		std::vector<FRTInstance> Instances = {Place(Stays, 0, 1)};
		List->KeepAlive(Stays.Geometry.Get());
		if (Goes.Geometry)
		{
			Instances.push_back(Place(Goes, 1, 2));
			List->KeepAlive(Goes.Geometry.Get());
		}
		BuildScene(List.Get(), Scene.Get(), Instances);
		List->UpdateShaderTable(Table.Get());
		List->SetPipeline(Pipeline.Get());
		List->PushConstants(&Push, sizeof(Push));
		List->TraceRays(Table.Get(), 0, 2, 1, 1);
		Barrier(List.Get(), Outputs.back().Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
		if (Frame == 2) { Goes = {}; }
		Last = Make.Submit(List.Get());
	}
	Wait(Last);
	for (uint32_t Frame = 0; Frame < 6; ++Frame)
	{
		const auto* Got = static_cast<const uint32_t*>(Outputs[Frame]->GetMapped());
		EXPECT_EQ(Got[0], HitValue(1, 1, 0, 0)) << Frame;
		EXPECT_EQ(Got[1], Frame <= 2 ? HitValue(1, 2, 0, 0) : MissOne) << Frame;
	}
}

TEST_P(FTraceContract, IntersectionShader)
{
	MakeTable(1);
	SetHit(0, 4, GroupDisc);
	// Discs of radius 0.4 in unit boxes: the ray at (0.5, 0.25) is inside, at a box shifted by 0.45 it is not.
	const FContractGeometry Boxes = MakeBoxes({0, 0, -0.1f, 1, 1, 0.1f, 1.45f, 0, -0.1f, 2.45f, 1, 0.1f, 3, 0, -0.1f, 4, 1, 0.1f});
	Load({&Boxes}, {Place(Boxes, 0, 6)});
	FContractPush Push = MakePush();
	Push.Input = Boxes.Vertices->GetDeviceAddress();
	EXPECT_EQ(Trace(4, Push), (FWords{HitValue(4, 6, 0, 0), MissOne, MissOne, HitValue(4, 6, 0, 2)}));
}

TEST_P(FTraceContract, TwoScenesByIndex)
{
	MakeTable(1);
	SetHit(0, 1);
	const FContractGeometry Square = MakeSquares();
	const auto Other = Make.Scene(4);
	Load({&Square}, {Place(Square, 0, 1)});
	std::swap(Scene, const_cast<TRTRef<IRTScene>&>(Other));
	Load({}, {Place(Square, 1, 2)});
	EXPECT_EQ(Trace(2, MakePush()), (FWords{MissOne, HitValue(1, 2, 0, 0)}));
	std::swap(Scene, const_cast<TRTRef<IRTScene>&>(Other));
	EXPECT_EQ(Trace(2, MakePush()), (FWords{HitValue(1, 1, 0, 0), MissOne}));
}

TEST_P(FTraceContract, RayQueryFindsTheSame)
{
	if (!Caps().bRayQuery) { GTEST_SKIP() << "the device has no ray query"; }
	const auto Query = MakeComputePipeline(Device(), "Query.comp");
	const FContractGeometry Solid = MakeSquares(2, true), Masked = MakeSquares(1, false);
	FRTInstance Turned = Place(Solid, 5, 5, 0, 0x04);
	Turned.Transform[0] = Turned.Transform[10] = -1.0f;
	Load({&Solid, &Masked}, {Place(Solid, 0, 3, 0, 0x01), Place(Masked, 2, 4, 0, 0x02), Turned});
	const auto Run4 = [&](uint32_t Flags, uint32_t Mask, bool bConfirm) {
		const auto Output = Make.Buffer(16, ERTMemory::Readback, "Output");
		FContractPush Push = MakePush(Flags, Mask);
		Push.Output = Output->GetDeviceAddress();
		Push.D = bConfirm ? 1 : 0;
		Push.E = 4;
		const auto List = Make.List("Query");
		List->SetPipeline(Query.Get());
		List->PushConstants(&Push, sizeof(Push));
		List->Dispatch(1, 1, 1);
		Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
		Run(List.Get());
		const auto* Begin = static_cast<const uint32_t*>(Output->GetMapped());
		return FWords(Begin, Begin + 4);
	};
	const uint32_t First = HitValue(0, 3, 0, 0), Second = HitValue(0, 3, 1, 0), Third = HitValue(0, 4, 0, 0);
	FWords All = Run4(0, 0xff, true);
	EXPECT_EQ(All[3] & ~1u, HitValue(0, 5, 1, 0, true));
	EXPECT_EQ(FWords(All.begin(), All.begin() + 3), (FWords{First, Second, Third}));
	EXPECT_EQ(Run4(0, 0xff, false)[2], MissOne);
	EXPECT_EQ(Run4(RayOpaque, 0xff, false)[2], Third);
	EXPECT_EQ(Run4(0, 0x01, true), (FWords{First, Second, MissOne, MissOne}));
	EXPECT_EQ(Run4(RayCullBack, 0xff, true), (FWords{First, Second, Third, MissOne}));
}

INSTANTIATE_TEST_SUITE_P(RHI, FTraceContract, testing::Values(EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const auto& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
