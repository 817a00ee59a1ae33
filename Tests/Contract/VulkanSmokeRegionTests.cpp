// Copies of many regions on Vulkan: which commands they become, and where the list of regions lives.
#include "Support/BufferRegions.h"
#include "VulkanSmokeEngine.h"

namespace Lantern
{
namespace
{

constexpr uint64_t SourceBytes = 1 << 20;

/// What a device was told, seen from an engine's loader.
struct FHeard
{
	std::vector<std::string> Calls;
	bool bNoBuffers = false; ///< buffers find no memory

	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	PFN_vkGetDeviceProcAddr GetDeviceProcAddr = nullptr;
	PFN_vkCreateBuffer CreateBuffer = nullptr;
	PFN_vkCmdCopyBuffer CmdCopyBuffer = nullptr;
	PFN_vkCmdDispatch CmdDispatch = nullptr;
	PFN_vkCmdPipelineBarrier2 CmdPipelineBarrier2 = nullptr;
};
FHeard Heard;

VkResult VKAPI_CALL HearCreateBuffer(VkDevice Device, const VkBufferCreateInfo* Info, const VkAllocationCallbacks* Host, VkBuffer* Out)
{
	return Heard.bNoBuffers ? VK_ERROR_OUT_OF_DEVICE_MEMORY : Heard.CreateBuffer(Device, Info, Host, Out);
}

void VKAPI_CALL HearCopy(VkCommandBuffer List, VkBuffer From, VkBuffer To, uint32_t Count, const VkBufferCopy* Regions)
{
	Heard.Calls.push_back("copy " + std::to_string(Count));
	Heard.CmdCopyBuffer(List, From, To, Count, Regions);
}

void VKAPI_CALL HearDispatch(VkCommandBuffer List, uint32_t X, uint32_t Y, uint32_t Z)
{
	Heard.Calls.push_back(X <= 65535 ? "dispatch" : "dispatch of too many groups"); // what every device has
	Heard.CmdDispatch(List, X, Y, Z);
}

void VKAPI_CALL HearBarrier(VkCommandBuffer List, const VkDependencyInfo* Info)
{
	const VkMemoryBarrier2 Memory = Info->memoryBarrierCount == 1 ? *Info->pMemoryBarriers : VkMemoryBarrier2{};
	constexpr VkAccessFlags2 Copies = VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
	constexpr VkAccessFlags2 Shaders = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
	const auto Is = [](VkPipelineStageFlags2 Stages, VkAccessFlags2 Access, VkPipelineStageFlags2 Stage, VkAccessFlags2 Accesses) {
		return (Stages & Stage) == Stage && (Access & Accesses) == Accesses;
	};
	const bool bFromCopies = Is(Memory.srcStageMask, Memory.srcAccessMask, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, Copies);
	const bool bToCopies = Is(Memory.dstStageMask, Memory.dstAccessMask, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, Copies);
	const bool bFromShaders = Is(Memory.srcStageMask, Memory.srcAccessMask, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, Shaders);
	const bool bToShaders = Is(Memory.dstStageMask, Memory.dstAccessMask, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, Shaders);
	Heard.Calls.push_back(bFromCopies && bToShaders   ? "copies before shaders"
	                      : bFromShaders && bToCopies ? "shaders before copies"
	                                                  : "barrier");
	Heard.CmdPipelineBarrier2(List, Info);
}

PFN_vkVoidFunction VKAPI_CALL HearDevice(VkDevice Device, const char* Name)
{
	const PFN_vkVoidFunction Found = Heard.GetDeviceProcAddr(Device, Name);
	const auto Replace = [&]<class T>(const char* Which, T& Original, T Mine, PFN_vkVoidFunction& Out) {
		if (strcmp(Name, Which) != 0) { return; }
		Original = reinterpret_cast<T>(Found);
		Out = reinterpret_cast<PFN_vkVoidFunction>(Mine);
	};
	PFN_vkVoidFunction Result = Found;
	Replace("vkCreateBuffer", Heard.CreateBuffer, &HearCreateBuffer, Result);
	Replace("vkCmdCopyBuffer", Heard.CmdCopyBuffer, &HearCopy, Result);
	Replace("vkCmdDispatch", Heard.CmdDispatch, &HearDispatch, Result);
	Replace("vkCmdPipelineBarrier2", Heard.CmdPipelineBarrier2, &HearBarrier, Result);
	return Result;
}

PFN_vkVoidFunction VKAPI_CALL HearInstance(VkInstance Instance, const char* Name)
{
	const PFN_vkVoidFunction Found = Heard.GetInstanceProcAddr(Instance, Name);
	if (strcmp(Name, "vkGetDeviceProcAddr") != 0) { return Found; }
	Heard.GetDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(Found);
	return reinterpret_cast<PFN_vkVoidFunction>(&HearDevice);
}

using FCalls = std::vector<std::string>;
const FCalls Scattered = {"copies before shaders", "dispatch", "shaders before copies"};

/// A device with three queues that are one to Vulkan, so that drivers with one queue do for every kind of list.
class FVulkanSmokeRegions : public FVulkanSmokeTest
{
protected:
	void SetUp() override
	{
		FVulkanSmokeTest::SetUp();
		if (IsSkipped() || HasFatalFailure()) { return; }
		ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, Device->GetCapabilities().DeviceName, Requirements));
		Heard = {};
		Heard.GetInstanceProcAddr = Engine.GetProc;
		FRTVulkanExternalDesc Desc = Engine.Describe(Requirements.Get());
		Desc.GetInstanceProcAddr = &HearInstance;
		Desc.TransferQueue = Desc.ComputeQueue = Engine.Queue;
		ASSERT_OK(AdoptVulkanDevice(Desc, Adopted.ReleaseAndGetAddress()));
		Bytes = MakeRandomBytes(1, SourceBytes);
		Source = Make(SourceBytes, ERTMemory::Upload);
		memcpy(Source->GetMapped(), Bytes.data(), Bytes.size());
		ASSERT_OK(Adopted->CreateCommandList("Regions", Copies.ReleaseAndGetAddress()));
	}
	void TearDown() override
	{
		Source.Reset();
		Target.Reset();
		Copies.Reset();
		Adopted.Reset();
		for (VkCommandPool Pool : Pools) { Engine.Get<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(Engine.Device, Pool, nullptr); }
		EXPECT_EQ(Engine.Messages, "");
		FVulkanSmokeTest::TearDown();
	}
	TRTRef<IRTBuffer> Make(uint64_t Size, ERTMemory Memory)
	{
		TRTRef<IRTBuffer> Out;
		const FRTStatus Status = Adopted->CreateBuffer(
		    {Size, ERTBufferUsage::Storage | ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest, Memory, "Regions"},
		    Out.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	static FRandomRegions MakeSmall(uint32_t Count, uint32_t Seed = 1)
	{
		FRandomRegions Regions(Seed, SourceBytes);
		Regions.AddSmall(Count);
		Regions.Finish();
		return Regions;
	}
	/// Records the copy into a buffer of zeros, and returns what the device was told of it.
	FCalls Record(IRTCommandList& Into, const FRandomRegions& Regions)
	{
		Target = Make(Regions.GetDestBytes(), ERTMemory::Readback);
		memset(Target->GetMapped(), 0, Regions.GetDestBytes());
		Heard.Calls.clear();
		Into.CopyBufferRegions(Target.Get(), Source.Get(), Regions.Get().data(), Regions.Num());
		return Heard.Calls;
	}
	void Submit(IRTCommandList& Into)
	{
		ASSERT_OK(Into.End());
		IRTCommandList* const Lists[] = {&Into};
		FRTFence Fence = 0;
		ASSERT_OK(Adopted->Submit(Lists, 1, &Fence));
		ASSERT_OK(Adopted->WaitFor(Fence, WaitLimitNs));
	}
	void ExpectCopied(const FRandomRegions& Regions)
	{
		std::vector<uint8_t> Expected(Regions.GetDestBytes(), 0);
		Regions.Apply(Expected, Bytes);
		EXPECT_EQ(memcmp(Target->GetMapped(), Expected.data(), Expected.size()), 0);
	}
	void ExpectBecomes(const FRandomRegions& Regions, const FCalls& Calls)
	{
		ASSERT_OK(Copies->Begin());
		EXPECT_EQ(Record(*Copies, Regions), Calls);
		const FRTBarrier Read{Target.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead};
		Copies->Barriers(&Read, 1);
		ASSERT_NO_FATAL_FAILURE(Submit(*Copies));
		ExpectCopied(Regions);
	}

	FEngine Engine;
	TRTRef<IRTVulkanRequirements> Requirements;
	TRTRef<IRTDevice> Adopted;
	TRTRef<IRTBuffer> Source, Target;
	TRTRef<IRTCommandList> Copies;
	std::vector<uint8_t> Bytes;
	std::vector<VkCommandPool> Pools;
};

TEST_F(FVulkanSmokeRegions, ManyBecomeOneDispatchAndFewACopy)
{
	ExpectBecomes(MakeSmall(16), {"copy 16"});
	ExpectBecomes(MakeSmall(17), Scattered);
	ExpectBecomes(MakeSmall(5000), Scattered);
}

TEST_F(FVulkanSmokeRegions, LargeAndUnalignedOnesAreCopiedBesideTheDispatch)
{
	FRandomRegions Regions(2, SourceBytes);
	Regions.AddSmall(2000);
	Regions.Add(400'000);
	Regions.AddUnaligned(2);
	ASSERT_EQ(Regions.Finish().size(), 2003u);
	ExpectBecomes(Regions, {"copies before shaders", "copy 3", "dispatch", "shaders before copies"});
	FRandomRegions Odd(3, SourceBytes);
	Odd.AddSmall(16);
	Odd.AddUnaligned(500);
	Odd.Finish();
	ExpectBecomes(Odd, {"copy 516"});
	FRandomRegions Huge(4, SourceBytes);
	for (int I = 0; I < 20; ++I) { Huge.Add(100'000); }
	ExpectBecomes(Huge, {"copy 20"});
}

TEST_F(FVulkanSmokeRegions, OneDispatchHasFewerGroupsThanTheLimit)
{
	FRandomRegions Regions(5, SourceBytes);
	for (int I = 0; I < 400; ++I) { Regions.Add(60'000); } // 6 million words, 94,000 groups of 64
	ExpectBecomes(Regions, Scattered);
}

TEST_F(FVulkanSmokeRegions, QueuesForCopiesGetCopies)
{
	const FRandomRegions Regions = MakeSmall(3000);
	for (const ERTQueue Queue : {ERTQueue::Transfer, ERTQueue::AsyncCompute})
	{
		TRTRef<IRTCommandList> Other;
		ASSERT_OK(Adopted->CreateCommandList("Other", Other.ReleaseAndGetAddress(), Queue));
		ASSERT_OK(Other->Begin());
		EXPECT_EQ(Record(*Other, Regions), Queue == ERTQueue::Transfer ? FCalls{"copy 3000"} : Scattered);
		ASSERT_NO_FATAL_FAILURE(Submit(*Other));
		ExpectCopied(Regions);
	}
}

TEST_F(FVulkanSmokeRegions, WithoutMemoryForTheListTheyAreCopied)
{
	const FRandomRegions Regions = MakeSmall(3000);
	ASSERT_OK(Copies->Begin());
	Target = Make(Regions.GetDestBytes(), ERTMemory::Readback);
	memset(Target->GetMapped(), 0, Regions.GetDestBytes());
	Heard.bNoBuffers = true;
	Heard.Calls.clear();
	Copies->CopyBufferRegions(Target.Get(), Source.Get(), Regions.Get().data(), Regions.Num());
	EXPECT_EQ(Heard.Calls, FCalls{"copy 3000"});
	Heard.bNoBuffers = false;
	EXPECT_TRUE(Copies->GetStatus().IsOk()) << "a slower way is no error";
	ASSERT_NO_FATAL_FAILURE(Submit(*Copies));
	ExpectCopied(Regions);
	ExpectBecomes(Regions, Scattered);
}

TEST_F(FVulkanSmokeRegions, AnEnginesListsKeepTheirRegionsUntilTheyHaveRun)
{
	const uint64_t Before = Adopted->GetMemoryStats().Total;
	std::vector<FRandomRegions> Regions;
	std::vector<TRTRef<IRTBuffer>> Targets;
	FRTFence Last = 0;
	for (uint32_t Frame = 0; Frame < 4; ++Frame)
	{
		Regions.push_back(MakeSmall(2000, Frame));
		const VkCommandBuffer Commands = Engine.BeginCommands();
		Pools.push_back(Engine.Pool);
		TRTRef<IRTCommandList> Imported;
		ASSERT_OK(Adopted->ImportCommandList((uint64_t)Commands, Imported.ReleaseAndGetAddress()));
		EXPECT_EQ(Record(*Imported, Regions.back()), Scattered);
		Targets.push_back(Target);
		const FRTBarrier Read{Target.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead};
		Imported->Barriers(&Read, 1);
		Engine.Submit(Commands);
		IRTCommandList* const Lists[] = {Imported.Get()};
		ASSERT_OK(Adopted->NotifyExternalSubmit(Lists, 1, &Last));
	}
	ASSERT_OK(Adopted->WaitFor(Last, WaitLimitNs));
	for (uint32_t Frame = 0; Frame < 4; ++Frame)
	{
		Target = Targets[Frame];
		ExpectCopied(Regions[Frame]);
	}
	Target.Reset();
	Targets.clear();
	ASSERT_OK(Adopted->WaitIdle());
	Adopted->CollectGarbage();
	EXPECT_EQ(Adopted->GetMemoryStats().Total, Before);
}

TEST_F(FVulkanSmokeRegions, AListUsesItsMemoryAgainAndReturnsWhatItNoLongerNeeds)
{
	const FRandomRegions Small = MakeSmall(500);
	Target = Make(std::max(Small.GetDestBytes(), SourceBytes), ERTMemory::Readback);
	std::vector<FRTBufferRegion> Words;
	for (uint32_t I = 0; I < SourceBytes / 4; ++I) { Words.push_back({I * 4, SourceBytes - 4 - I * 4, 4}); }
	const auto Repeat = [&](const std::vector<FRTBufferRegion>& Regions, uint32_t Times, uint32_t Calls) {
		for (uint32_t Time = 0; Time < Times; ++Time)
		{
			const FRTBarrier Again{Target.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::CopyWrite};
			EXPECT_TRUE(Copies->Begin().IsOk());
			for (uint32_t Call = 0; Call < Calls; ++Call)
			{
				Copies->CopyBufferRegions(Target.Get(), Source.Get(), Regions.data(), static_cast<uint32_t>(Regions.size()));
				Copies->Barriers(&Again, 1);
			}
			Submit(*Copies);
		}
		Adopted->CollectGarbage();
		return Adopted->GetMemoryStats().Total;
	};
	const uint64_t Few = Repeat(Small.Get(), 4, 5);
	EXPECT_EQ(Repeat(Small.Get(), 30, 5), Few) << "the memory is used again";
	const uint64_t Many = Repeat(Words, 1, 1);
	EXPECT_GT(Many, Few);
	EXPECT_LT(Repeat(Small.Get(), 100, 5), Many) << "the memory of one large frame is given back";
}

} // namespace
} // namespace Lantern
