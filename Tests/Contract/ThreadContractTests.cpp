// The device is called from many threads; also a job for the thread sanitizer.
#include "ContractFixture.h"

#include "ContractShaders.h"

#include <atomic>
#include <thread>

namespace Lantern
{
namespace
{

CONTRACT_TEST(CreationAndSubmissionFromManyThreads)
{
	constexpr uint32_t ThreadCount = 4, Rounds = 12;
	const auto Readback = Make.Buffer(ThreadCount * Rounds * 4, ERTMemory::Readback);
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < ThreadCount; ++Thread)
	{
		Threads.emplace_back([&, Thread] {
			for (uint32_t Round = 0; Round < Rounds; ++Round)
			{
				const uint32_t Slot = Thread * Rounds + Round;
				const auto Source = Upload(&Slot, 4);
				const auto Texture = Make.Texture(8, 8, ERTFormat::RGBA8_UNORM);
				const auto List = Make.List();
				List->CopyBuffer(Readback.Get(), Slot * 4, Source.Get(), 0, 4);
				const FRTFence Fence = Make.Submit(List.Get());
				if (Round % 4 == 0) { Wait(Fence); }
				Device().CollectGarbage();
			}
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_OK(Device().WaitIdle());
	for (uint32_t Slot = 0; Slot < ThreadCount * Rounds; ++Slot)
	{
		EXPECT_EQ(static_cast<const uint32_t*>(Readback->GetMapped())[Slot], Slot);
	}
}

CONTRACT_TEST(PipelinesFromManyThreads)
{
	std::atomic<uint32_t> Good = 0;
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < 4; ++Thread)
	{
		Threads.emplace_back([&, Thread] {
			const bool bRays = Thread % 2 == 0 && Caps().bRayTracingPipeline;
			const auto Pipeline = bRays ? MakeRayPipeline(Device()) : MakeComputePipeline(Device(), "WriteWords.comp");
			Good += Pipeline ? 1 : 0;
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Good, 4u);
}

CONTRACT_TEST(ReferencesFromManyThreads)
{
	const auto Buffer = Make.Buffer(16);
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < 4; ++Thread)
	{
		Threads.emplace_back([&] {
			for (uint32_t i = 0; i < 1000; ++i) { const TRTRef<IRTBuffer> Copy = Buffer; }
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Buffer->AddRef(), 2u);
	EXPECT_EQ(Buffer->Release(), 1u);
}

} // namespace
} // namespace Lantern
