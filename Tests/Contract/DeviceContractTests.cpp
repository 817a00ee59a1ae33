// Capabilities, lists, fences and queries.
#include <chrono>

#include "ContractFixture.h"

namespace Lantern
{
namespace
{

CONTRACT_TEST(CapabilitiesAreCoherent)
{
	EXPECT_EQ(Device().GetVersion(), RHIVersion);
	EXPECT_STRNE(Caps().DeviceName, "");
	EXPECT_STRNE(Caps().DriverName, "");
	if (Caps().Rung >= ERTRung::Pipeline) { EXPECT_TRUE(Caps().bRayTracingPipeline); }
	if (Caps().Rung == ERTRung::RayQuery) { EXPECT_TRUE(Caps().bRayQuery); }
	if (Caps().bRayTracingPipeline)
	{
		EXPECT_GE(Caps().ShaderGroupHandleSize, 32u);
		EXPECT_GT(Caps().ShaderGroupHandleAlignment, 0u);
		EXPECT_GE(Caps().ShaderGroupBaseAlignment, Caps().ShaderGroupHandleAlignment);
		EXPECT_GE(Caps().MaxRayRecursionDepth, 1u);
	}
	EXPECT_GE(Caps().MaxPushConstantBytes, 128u);
	EXPECT_GE(Caps().MaxTextureDimension, 4096u);
	EXPECT_GT(Caps().ScratchAlignment, 0u);
	EXPECT_GT(Caps().DeviceMemoryBytes, 0u);
}

CONTRACT_TEST(FenceZeroIsComplete)
{
	EXPECT_OK(Device().WaitFor(0, 0));
	EXPECT_OK(Device().WaitIdle());
}

CONTRACT_TEST(FencesRise)
{
	const FRTFence First = Make.Submit(Make.List("A").Get());
	const FRTFence Second = Make.Submit(Make.List("B").Get());
	EXPECT_GT(First, 0u);
	EXPECT_GT(Second, First);
	Wait(Second);
	EXPECT_GE(Device().GetCompletedFence(), Second);
	EXPECT_OK(Device().WaitFor(First, 0));
}

CONTRACT_TEST(ListsAreUsedAgain)
{
	const auto Readback = Make.Buffer(4, ERTMemory::Readback);
	TRTRef<IRTCommandList> List;
	ASSERT_OK(Device().CreateCommandList("Again", List.ReleaseAndGetAddress()));
	for (uint32_t Round = 1; Round < 5; ++Round)
	{
		ASSERT_OK(List->Begin());
		List->FillBuffer(Readback.Get(), 0, 4, Round);
		Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
		Run(List.Get());
		EXPECT_EQ(*static_cast<const uint32_t*>(Readback->GetMapped()), Round);
	}
}

CONTRACT_TEST(ListMayBeDiscarded)
{
	const auto Readback = Make.Buffer(4, ERTMemory::Readback);
	*static_cast<uint32_t*>(Readback->GetMapped()) = 9;
	const auto List = Make.List();
	List->FillBuffer(Readback.Get(), 0, 4, 1);
	EXPECT_OK(List->End());
	EXPECT_OK(List->Begin());
	Run(List.Get());
	EXPECT_EQ(*static_cast<const uint32_t*>(Readback->GetMapped()), 9u);
}

CONTRACT_TEST(ListsOfOneSubmissionRunInOrder)
{
	const auto Readback = Make.Buffer(8, ERTMemory::Readback);
	const auto A = Make.List("A"), B = Make.List("B");
	// The lists were recorded in the other order.
	Barrier(B.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::CopyWrite);
	B->FillBuffer(Readback.Get(), 0, 4, 2);
	Barrier(B.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	A->FillBuffer(Readback.Get(), 0, 8, 1);
	EXPECT_OK(A->End());
	EXPECT_OK(B->End());
	IRTCommandList* Lists[] = {A.Get(), B.Get()};
	FRTFence Fence = 0;
	ASSERT_OK(Device().Submit(Lists, 2, &Fence));
	Wait(Fence);
	EXPECT_EQ(static_cast<const uint32_t*>(Readback->GetMapped())[0], 2u);
	EXPECT_EQ(static_cast<const uint32_t*>(Readback->GetMapped())[1], 1u);
}

CONTRACT_TEST(TimestampsRise)
{
	if (!Caps().bTimestamps) { GTEST_SKIP() << "the device has no timestamps"; }
	TRTRef<IRTQueryPool> Pool;
	ASSERT_OK(Device().CreateQueryPool(ERTQuery::Timestamp, 3, Pool.ReleaseAndGetAddress()));
	EXPECT_EQ(Pool->GetCount(), 3u);
	const auto Buffer = Make.Buffer(1 << 20);
	uint64_t Times[3] = {};
	for (int Round = 0; Round < 2; ++Round)
	{
		const auto List = Make.List();
		List->ResetQueries(Pool.Get(), 0, 3);
		List->WriteTimestamp(Pool.Get(), 0);
		List->FillBuffer(Buffer.Get(), 0, 1 << 20, 7);
		List->WriteTimestamp(Pool.Get(), 1);
		const auto Before = std::chrono::steady_clock::now();
		Run(List.Get());
		const std::chrono::duration<double, std::nano> Around = std::chrono::steady_clock::now() - Before;
		ASSERT_TRUE(Pool->GetResults(0, 2, Times));
		EXPECT_GT(Times[0], 0u);
		EXPECT_GE(Times[1], Times[0]);
		// Between both stands less than around both, however slow the machine; the clocks are not the same.
		EXPECT_LE(static_cast<double>(Times[1] - Times[0]), 2.0 * Around.count() + 1e6) << "nanoseconds";
		EXPECT_FALSE(Pool->GetResults(0, 3, Times)) << "the third was never written";
	}
}

CONTRACT_TEST(MarkersNest)
{
	const auto List = Make.List();
	List->BeginMarker("Frame");
	List->BeginMarker("Pass");
	List->EndMarker();
	List->EndMarker();
	Run(List.Get());
}

CONTRACT_TEST(KeepAliveTakesAnyObject)
{
	const auto List = Make.List();
	auto Texture = Make.Texture(1, 1, ERTFormat::R8_UNORM);
	List->KeepAlive(Texture.Get());
	Texture.Reset();
	Device().CollectGarbage();
	Run(List.Get());
}

} // namespace
} // namespace Lantern
