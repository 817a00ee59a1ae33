// Copies of many regions at once: every byte, and nothing else that a list has set.
#include "RayFixture.h"
#include "Support/BufferRegions.h"

namespace Lantern
{
namespace
{

constexpr uint64_t SourceBytes = 1 << 20;

/// Copies from Source to a middle buffer, from there to a last one, and once more from Source over the last one.
class FRegionChain
{
public:
	FRegionChain(const FRHIMaker& InMake, uint32_t Seed) : Make(InMake), First(Seed, SourceBytes), Bytes(MakeRandomBytes(Seed, SourceBytes))
	{
		First.AddSmall(3000);
		First.Add(300'000);
		First.AddUnaligned(Seed % 2 * 40);
		First.Finish();
		const uint64_t Size = First.GetDestBytes();
		FRandomRegions Second(Seed + 1, Size), Third(Seed + 2, SourceBytes);
		Second.AddSmall(1000);
		Third.AddSmall(17);
		Last = {Second.Finish(), Third.Finish()};
		Expected = MakeRandomBytes(~Seed, std::max({Size, Second.GetDestBytes(), Third.GetDestBytes()}));
		Source = Make.Buffer(SourceBytes, ERTMemory::Upload, "Source");
		Before = Make.Buffer(Expected.size(), ERTMemory::Upload, "Before");
		std::memcpy(Source->GetMapped(), Bytes.data(), Bytes.size());
		std::memcpy(Before->GetMapped(), Expected.data(), Expected.size());
		Middle = Make.Buffer(Expected.size(), ERTMemory::Device, "Middle");
		Target = Make.Buffer(Expected.size(), ERTMemory::Device, "Target");
		Readback = Make.Buffer(Expected.size(), ERTMemory::Readback, "Readback");
		std::vector<uint8_t> InMiddle = Expected;
		First.Apply(InMiddle, Bytes);
		Second.Apply(Expected, InMiddle);
		Third.Apply(Expected, Bytes);
	}
	void Record(IRTCommandList* List) const
	{
		const auto Change = [&](const TRTRef<IRTBuffer>& Buffer, ERTAccess From, ERTAccess To) {
			const FRTBarrier Item{Buffer.Get(), nullptr, From, To};
			List->Barriers(&Item, 1);
		};
		for (const auto& Buffer : {Middle, Target})
		{
			List->CopyBuffer(Buffer.Get(), 0, Before.Get(), 0, Expected.size());
			Change(Buffer, ERTAccess::CopyWrite, ERTAccess::CopyWrite);
		}
		List->CopyBufferRegions(Middle.Get(), Source.Get(), First.Get().data(), First.Num());
		Change(Middle, ERTAccess::CopyWrite, ERTAccess::CopyRead);
		List->CopyBufferRegions(Target.Get(), Middle.Get(), Last[0].data(), static_cast<uint32_t>(Last[0].size()));
		Change(Target, ERTAccess::CopyWrite, ERTAccess::CopyWrite);
		List->CopyBufferRegions(Target.Get(), Source.Get(), Last[1].data(), static_cast<uint32_t>(Last[1].size()));
		Change(Target, ERTAccess::CopyWrite, ERTAccess::CopyRead);
		List->CopyBuffer(Readback.Get(), 0, Target.Get(), 0, Expected.size());
		Change(Readback, ERTAccess::CopyWrite, ERTAccess::HostRead);
	}
	bool IsRight() const { return std::memcmp(Readback->GetMapped(), Expected.data(), Expected.size()) == 0; }

private:
	const FRHIMaker& Make;
	FRandomRegions First;
	std::vector<std::vector<FRTBufferRegion>> Last;
	std::vector<uint8_t> Bytes, Expected;
	TRTRef<IRTBuffer> Source, Before, Middle, Target, Readback;
};

CONTRACT_TEST(ThousandsOfRegionsReachTheirPlaces)
{
	const auto List = Make.List();
	for (uint32_t Seed = 0; Seed < 4; ++Seed)
	{
		if (Seed > 0) { ASSERT_OK(List->Begin()); }
		const FRegionChain Chain(Make, Seed);
		Chain.Record(List.Get());
		Run(List.Get());
		EXPECT_TRUE(Chain.IsRight()) << Seed;
	}
}

CONTRACT_TEST(ListsInFlightKeepTheirOwnRegions)
{
	std::vector<std::unique_ptr<FRegionChain>> Chains;
	FRTFence Last = 0;
	for (uint32_t Seed = 0; Seed < 6; ++Seed)
	{
		const auto List = Make.List(); // released before it has run
		Chains.push_back(std::make_unique<FRegionChain>(Make, Seed));
		Chains.back()->Record(List.Get());
		if (Seed == 3) { continue; } // never submitted
		Last = Make.Submit(List.Get());
	}
	Wait(Last);
	for (uint32_t Seed = 0; Seed < 6; ++Seed) { EXPECT_EQ(Chains[Seed]->IsRight(), Seed != 3) << Seed; }
}

CONTRACT_TEST(RegionsOnTheComputeQueue)
{
	if (!Caps().bAsyncComputeQueue) { GTEST_SKIP() << "the device has one queue"; }
	TRTRef<IRTCommandList> Compute;
	ASSERT_OK(Device().CreateCommandList("Compute", Compute.ReleaseAndGetAddress(), ERTQueue::AsyncCompute));
	ASSERT_OK(Compute->Begin());
	const FRegionChain Chain(Make, 1);
	Chain.Record(Compute.Get());
	Run(Compute.Get());
	EXPECT_TRUE(Chain.IsRight());
}

/// Pipeline and constants are set once, before the copies, and dispatches write what copies read and the reverse.
CONTRACT_SHADER_TEST(DispatchesKeepWhatWasSetBeforeACopyOfRegions)
{
	constexpr uint32_t Count = 3000;
	const auto Pipeline = MakeComputePipeline(Device(), "WriteWords.comp");
	const auto A = Make.Buffer(Count * 4), B = Make.Buffer(Count * 4);
	const auto Readback = Make.Buffer(Count * 12, ERTMemory::Readback);
	std::vector<FRTBufferRegion> Reverse;
	for (uint32_t I = 0; I < Count; ++I) { Reverse.push_back({(Count - 1 - I) * 4, I * 4, 4}); }
	FContractPush Push;
	Push.Output = A->GetDeviceAddress();
	Push.A = 5;
	Push.B = 3;
	Push.C = Count;
	const auto List = Make.List();
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	List->Dispatch((Count + 7) / 8, 1, 1);
	Barrier(List.Get(), A.Get(), ERTAccess::StorageWrite, ERTAccess::CopyRead);
	List->CopyBufferRegions(B.Get(), A.Get(), Reverse.data(), Count);
	Barrier(List.Get(), A.Get(), ERTAccess::CopyRead, ERTAccess::StorageWrite);
	Barrier(List.Get(), B.Get(), ERTAccess::CopyWrite, ERTAccess::StorageWrite);
	// Half of B is overwritten by what was set before the copy, but for the address: constants in part.
	const uint64_t Half = B->GetDeviceAddress() + Count / 2 * 4;
	List->PushConstants(&Half, sizeof(Half));
	List->Dispatch(Count / 2 / 8, 1, 1);
	Barrier(List.Get(), B.Get(), ERTAccess::StorageWrite, ERTAccess::CopyRead);
	List->CopyBuffer(Readback.Get(), 0, B.Get(), 0, Count * 4);
	Barrier(List.Get(), B.Get(), ERTAccess::CopyRead, ERTAccess::ShaderRead);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Run(List.Get());
	const auto* Got = static_cast<const uint32_t*>(Readback->GetMapped());
	const uint32_t Written = Count / 2 / 8 * 8;
	for (uint32_t I = 0; I < Count; ++I)
	{
		const bool bByDispatch = I >= Count / 2 && I < Count / 2 + Written;
		ASSERT_EQ(Got[I], 5 + 3 * (bByDispatch ? I - Count / 2 : Count - 1 - I)) << I;
	}
}

/// The two bind points and the constants that they share.
class FRegionRays : public FRayContract
{};

TEST_P(FRegionRays, TracesKeepWhatWasSetBeforeACopyOfRegions)
{
	constexpr uint32_t Width = 2;
	const FContractGeometry Squares = MakeSquares(1);
	Load({&Squares}, {FRHIMaker::Instance(Squares.GetAddress())});
	MakeTable(4);
	SetHit(0, 77);
	const FRegionChain Chain(Make, 7);
	const auto Output = Make.Buffer(Width * 4, ERTMemory::Readback, "Output");
	const auto Compute = MakeComputePipeline(Device(), "WriteWords.comp");
	FContractPush Push = MakePush();
	Push.Output = Output->GetDeviceAddress();
	const auto List = Make.List();
	List->SetPipeline(Compute.Get());
	List->UpdateShaderTable(Table.Get());
	List->SetPipeline(Pipeline.Get());
	List->PushConstants(&Push, sizeof(Push));
	Chain.Record(List.Get());
	List->TraceRays(Table.Get(), 0, Width, 1, 1);
	Barrier(List.Get(), Output.Get(), ERTAccess::StorageWrite, ERTAccess::HostRead);
	Run(List.Get());
	EXPECT_TRUE(Chain.IsRight());
	const auto* Got = static_cast<const uint32_t*>(Output->GetMapped());
	EXPECT_EQ(Got[0], HitValue(77, 0, 0, 0));
	EXPECT_EQ(Got[1], MissOne);
}

INSTANTIATE_TEST_SUITE_P(RHI, FRegionRays, testing::Values(EContractRHI::Vulkan, EContractRHI::VulkanValidated),
    [](const testing::TestParamInfo<EContractRHI>& Info) { return GetName(Info.param); });

} // namespace
} // namespace Lantern
