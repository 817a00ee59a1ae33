// The Vulkan backend alone: how devices are found, made, taken over and let go.
#include "VulkanSmokeFixture.h"

#include "VulkanSmokeEngine.h"

#include "VulkanSmokeShaders/Fill_comp.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace Lantern
{

using FVulkanSmokeDevice = FVulkanSmokeTest;

TEST_F(FVulkanSmokeDevice, ListNamesTheDeviceThatIsCreated)
{
	FRTVulkanDeviceInfo Infos[8];
	uint32_t Count = 0;
	ASSERT_OK(ListVulkanDevices(Infos, 8, &Count));
	ASSERT_GT(Count, 0u);
	bool bFound = false;
	for (uint32_t Index = 0; Index < std::min(Count, 8u); ++Index)
	{
		bFound |= strcmp(Infos[Index].Name, Device->GetCapabilities().DeviceName) == 0;
		EXPECT_NE(Infos[Index].Type[0], 0);
		// Either nothing is missing, or it is said what.
		EXPECT_TRUE(Infos[Index].Rung == ERTRung::Micromap || Infos[Index].Missing[0]);
	}
	EXPECT_TRUE(bFound);
}

TEST_F(FVulkanSmokeDevice, TheLadderCanBeCut)
{
	const FRTCapabilities& Full = Device->GetCapabilities();
	FRTVulkanDeviceDesc Desc;
	Desc.bValidation = bValidation;
	TRTRef<IRTDevice> Lower;
	if (Full.bRayQuery)
	{
		Desc.MaxRung = ERTRung::RayQuery;
		ASSERT_OK(CreateVulkanDevice(Desc, Lower.ReleaseAndGetAddress()));
		EXPECT_EQ(Lower->GetCapabilities().Rung, ERTRung::RayQuery);
		EXPECT_FALSE(Lower->GetCapabilities().bRayTracingPipeline);
		TRTRef<IRTPipeline> Pipeline;
		EXPECT_EQ(Lower->CreateRayTracingPipeline({}, Pipeline.ReleaseAndGetAddress()).Code, ERTResult::Unsupported);
		EXPECT_EQ(Lower->GetValidationMessageCount(), 0u);
	}
	Desc.MaxRung = ERTRung::None;
	const FRTStatus Status = CreateVulkanDevice(Desc, Lower.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::Unsupported);
	EXPECT_NE(strstr(Status.Message, Full.DeviceName), nullptr) << Status.Message;
	Desc.bAllowNoRayTracing = true;
	ASSERT_OK(CreateVulkanDevice(Desc, Lower.ReleaseAndGetAddress()));
	EXPECT_EQ(Lower->GetCapabilities().Rung, ERTRung::None);
	TRTRef<IRTScene> Scene;
	EXPECT_EQ(Lower->CreateScene({1, false, "Refused"}, Scene.ReleaseAndGetAddress()).Code, ERTResult::Unsupported);
	EXPECT_EQ(Lower->GetValidationMessageCount(), 0u);
}

TEST_F(FVulkanSmokeDevice, EachCallIsTimedOnDemand)
{
	std::map<std::string, uint32_t> Calls;
	FRTVulkanDeviceDesc Desc;
	Desc.bValidation = bValidation;
	Desc.CallSink.User = &Calls;
	Desc.CallSink.Call = [](void* User, const char* Name, uint64_t) { ++(*static_cast<std::map<std::string, uint32_t>*>(User))[Name]; };
	TRTRef<IRTDevice> Timed;
	ASSERT_OK(CreateVulkanDevice(Desc, Timed.ReleaseAndGetAddress()));
	TRTRef<IRTBuffer> Buffer;
	ASSERT_OK(Timed->CreateBuffer({64, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Timed"}, Buffer.ReleaseAndGetAddress()));
	TRTRef<IRTCommandList> Filling;
	ASSERT_OK(Timed->CreateCommandList("Filling", Filling.ReleaseAndGetAddress()));
	ASSERT_OK(Filling->Begin());
	Filling->FillBuffer(Buffer.Get(), 0, 64, 7);
	ASSERT_OK(Filling->End());
	IRTCommandList* Lists[] = {Filling.Get()};
	Calls.clear();
	ASSERT_OK(Timed->Submit(Lists, 1, nullptr));
	EXPECT_EQ(Calls["vkQueueSubmit2"], 1u);
	ASSERT_OK(Timed->WaitIdle());
	EXPECT_EQ(*static_cast<uint32_t*>(Buffer->GetMapped()), 7u);
	TRTRef<IRTBuffer> Large;
	Calls.clear();
	ASSERT_OK(Timed->CreateBuffer({300u << 20, ERTBufferUsage::Storage, ERTMemory::Device, "Large"}, Large.ReleaseAndGetAddress()));
	EXPECT_GE(Calls["vkAllocateMemory"], 1u) << "the allocator's calls, too";
	EXPECT_EQ(Timed->GetValidationMessageCount(), 0u);
	for (TRTRef<IRTBuffer>* Made : {&Large, &Buffer}) { Made->Reset(); }
	Filling.Reset();
	Timed.Reset();
	// A device without a sink is left alone.
	Calls.clear();
	ASSERT_OK(Device->WaitIdle());
	TRTRef<IRTBuffer> Untimed;
	ASSERT_OK(Device->CreateBuffer({64, ERTBufferUsage::Storage, ERTMemory::Device, "Untimed"}, Untimed.ReleaseAndGetAddress()));
	EXPECT_TRUE(Calls.empty());
}

TEST_F(FVulkanSmokeDevice, FramesDestroyNoPipeline)
{
	struct FDestroyed
	{
		std::mutex Mutex;
		std::vector<std::thread::id> Threads;
	} Destroyed;
	FRTVulkanDeviceDesc Desc;
	Desc.bValidation = bValidation;
	Desc.CallSink.User = &Destroyed;
	Desc.CallSink.Call = [](void* User, const char* Name, uint64_t) {
		if (strcmp(Name, "vkDestroyPipeline") != 0) { return; }
		auto& Out = *static_cast<FDestroyed*>(User);
		const std::scoped_lock Lock(Out.Mutex);
		Out.Threads.push_back(std::this_thread::get_id());
	};
	TRTRef<IRTDevice> Timed;
	ASSERT_OK(CreateVulkanDevice(Desc, Timed.ReleaseAndGetAddress()));
	for (int I = 0; I < 3; ++I)
	{
		TRTRef<IRTPipeline> Pipeline;
		ASSERT_OK(Timed->CreateComputePipeline(
		    {MakeCode(Smoke_Fill_comp, ERTShaderStage::Compute, "Fill"), "Fill"}, Pipeline.ReleaseAndGetAddress()));
		Pipeline.Reset();
		ASSERT_OK(Timed->Submit(nullptr, 0, nullptr));
		ASSERT_OK(Timed->WaitIdle());
	}
	EXPECT_EQ(Timed->GetValidationMessageCount(), 0u);
	const auto CountHere = [&] {
		const std::scoped_lock Lock(Destroyed.Mutex);
		return std::count(Destroyed.Threads.begin(), Destroyed.Threads.end(), std::this_thread::get_id());
	};
	EXPECT_EQ(CountHere(), 0);
	Timed.Reset(); // waits for all of them, and destroys the one of its own
	EXPECT_EQ(CountHere(), 1);
	EXPECT_EQ(Destroyed.Threads.size(), 4u);
}

TEST_F(FVulkanSmokeDevice, AWrongIndexIsNamed)
{
	FRTVulkanDeviceDesc Desc;
	Desc.DeviceIndex = 1000;
	TRTRef<IRTDevice> None;
	const FRTStatus Status = CreateVulkanDevice(Desc, None.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_NE(strstr(Status.Message, "1000"), nullptr) << Status.Message;
}

TEST_F(FVulkanSmokeDevice, ErrorsCarryTheObjectsName)
{
	TRTRef<IRTTexture> Texture;
	const FRTStatus Status = Device->CreateTexture(
	    {1u << 30, 1, 1, 1, ERTFormat::R8_UNORM, ERTTextureUsage::Sampled, "Too wide"}, Texture.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::Unsupported);
	EXPECT_NE(strstr(Status.Message, "Too wide"), nullptr) << Status.Message;
	EXPECT_FALSE(Texture);
}

/// The layers of newer releases would have a message for each.
TEST_F(FVulkanSmokeDevice, WhatIsBeyondTheLimitsIsRefusedBeforeVulkanSeesIt)
{
	const auto Expect = [](const FRTStatus& Status, const char* Limit) {
		EXPECT_EQ(Status.Code, ERTResult::Unsupported);
		EXPECT_NE(strstr(Status.Message, "Too large"), nullptr) << Status.Message;
		EXPECT_NE(strstr(Status.Message, Limit), nullptr) << Status.Message;
	};
	TRTRef<IRTBuffer> Buffer;
	Expect(Device->CreateBuffer({1ull << 60, ERTBufferUsage::Storage, ERTMemory::Device, "Too large"}, Buffer.ReleaseAndGetAddress()),
	    "the device's limit is");
	const uint64_t Most = Device->GetCapabilities().MaxPrimitiveCount;
	if (Most == 0 || Most >= ~0u) { GTEST_SKIP() << "no number of triangles is too large"; }
	TRTRef<IRTBuffer> Vertices;
	ASSERT_OK(Device->CreateBuffer(
	    {36, ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Device, "Vertices"}, Vertices.ReleaseAndGetAddress()));
	FRTGeometrySection Section;
	Section.Vertices = Vertices.Get();
	Section.VertexCount = 3;
	Section.VertexStride = 12;
	Section.TriangleCount = static_cast<uint32_t>(Most + 1);
	FRTGeometryDesc Desc;
	Desc.Sections = &Section;
	Desc.SectionCount = 1;
	Desc.Name = "Too large";
	EXPECT_EQ(Device->GetGeometrySizes(Desc).StructureBytes, 0u);
	TRTRef<IRTGeometry> Geometry;
	Expect(Device->CreateGeometry(Desc, Geometry.ReleaseAndGetAddress()), "the limit is");
	FRTSceneDesc Scene;
	Scene.MaxInstances = static_cast<uint32_t>(std::min<uint64_t>(Device->GetCapabilities().MaxInstanceCount + 1, ~0u));
	Scene.Name = "Too large";
	TRTRef<IRTScene> NoScene;
	Expect(Device->CreateScene(Scene, NoScene.ReleaseAndGetAddress()), "the device's limit is");
}

/// Without this the zero that every other test asserts would prove nothing.
TEST_F(FVulkanSmokeDevice, ValidationMessagesAreCounted)
{
	if (!bValidation) { GTEST_SKIP() << "LANTERN_TEST_WITHOUT_LAYERS is set"; }
	std::string Messages;
	FRTVulkanDeviceDesc Desc;
	Desc.bValidation = true;
	Desc.MessageUser = &Messages;
	Desc.MessageCallback = [](void* User, ERTVulkanMessage, const char* Text) { *static_cast<std::string*>(User) += Text; };
	TRTRef<IRTDevice> Other;
	ASSERT_OK(CreateVulkanDevice(Desc, Other.ReleaseAndGetAddress()));
	TRTRef<IRTBuffer> NoCopies;
	ASSERT_OK(Other->CreateBuffer({64, ERTBufferUsage::Storage, ERTMemory::Device, "NoCopies"}, NoCopies.ReleaseAndGetAddress()));
	TRTRef<IRTCommandList> Wrong;
	ASSERT_OK(Other->CreateCommandList("Wrong", Wrong.ReleaseAndGetAddress()));
	ASSERT_OK(Wrong->Begin());
	Wrong->FillBuffer(NoCopies.Get(), 0, 64, 0);
	(void)Wrong->End();
	EXPECT_GT(Other->GetValidationMessageCount(), 0u);
	EXPECT_NE(Messages.find("NoCopies"), std::string::npos) << "objects carry their names: " << Messages;
}

TEST_F(FVulkanSmokeDevice, IndicesComeBackOnceTheGpuIsDone)
{
	TRTRef<IRTTexture> Texture;
	const FRTTextureDesc Desc = {4, 4, 1, 1, ERTFormat::R8_UNORM, ERTTextureUsage::Sampled, "Indexed"};
	ASSERT_OK(Device->CreateTexture(Desc, Texture.ReleaseAndGetAddress()));
	const uint32_t First = Texture->GetSampledIndex();
	Texture.Reset();
	ASSERT_OK(Device->WaitIdle());
	ASSERT_OK(Device->CreateTexture(Desc, Texture.ReleaseAndGetAddress()));
	EXPECT_EQ(Texture->GetSampledIndex(), First);
}

TEST_F(FVulkanSmokeDevice, ManyThreadsMayCreateSubmitAndRelease)
{
	TRTRef<IRTPipeline> Pipeline = MakeCompute(Smoke_Fill_comp, "Fill");
	std::atomic<uint32_t> Failures{0};
	const auto Work = [&](uint32_t Seed) {
		for (uint32_t Round = 0; Round < 20; ++Round)
		{
			TRTRef<IRTBuffer> Words;
			TRTRef<IRTCommandList> Mine;
			TRTRef<IRTTexture> Texture;
			bool bOk =
			    Device->CreateBuffer({1024, ERTBufferUsage::Storage, ERTMemory::Readback, "Words"}, Words.ReleaseAndGetAddress()).IsOk();
			bOk = bOk && Device->CreateCommandList("Mine", Mine.ReleaseAndGetAddress()).IsOk();
			bOk = bOk && Device
			                 ->CreateTexture(
			                     {8, 8, 1, 1, ERTFormat::R8_UNORM, ERTTextureUsage::Sampled, "Texture"}, Texture.ReleaseAndGetAddress())
			                 .IsOk();
			bOk = bOk && Mine->Begin().IsOk();
			if (bOk)
			{
				Mine->SetPipeline(Pipeline.Get());
				struct
				{
					uint64_t Address;
					uint32_t Count, Factor;
				} Push = {Words->GetDeviceAddress(), 256, Seed + Round};
				Mine->PushConstants(&Push, sizeof(Push));
				Mine->Dispatch(4, 1, 1);
				FRTBarrier Item;
				Item.Before = ERTAccess::StorageWrite;
				Item.After = ERTAccess::HostRead;
				Mine->Barriers(&Item, 1);
				Mine->KeepAlive(Words.Get());
				bOk = Mine->End().IsOk();
				IRTCommandList* Lists[] = {Mine.Get()};
				FRTFence Fence = 0;
				bOk = bOk && Device->Submit(Lists, 1, &Fence).IsOk();
				if (bOk && Round % 2)
				{
					bOk = Device->WaitFor(Fence, ~0ull).IsOk() && static_cast<uint32_t*>(Words->GetMapped())[255] == 255 * (Seed + Round);
				}
			}
			Failures += !bOk;
		}
	};
	std::vector<std::thread> Threads;
	for (uint32_t Seed = 0; Seed < 4; ++Seed) { Threads.emplace_back(Work, Seed * 100); }
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Failures.load(), 0u);
}

TEST_F(FVulkanSmokeDevice, ObjectsMayOutliveTheDevicesReference)
{
	FRTVulkanDeviceDesc Desc;
	Desc.bValidation = bValidation;
	TRTRef<IRTDevice> Other;
	ASSERT_OK(CreateVulkanDevice(Desc, Other.ReleaseAndGetAddress()));
	TRTRef<IRTBuffer> Buffer;
	ASSERT_OK(Other->CreateBuffer({64, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Late"}, Buffer.ReleaseAndGetAddress()));
	TRTRef<IRTCommandList> Filling;
	ASSERT_OK(Other->CreateCommandList("Filling", Filling.ReleaseAndGetAddress()));
	ASSERT_OK(Filling->Begin());
	Filling->FillBuffer(Buffer.Get(), 0, 64, 9);
	ASSERT_OK(Filling->End());
	IRTCommandList* Lists[] = {Filling.Get()};
	ASSERT_OK(Other->Submit(Lists, 1, nullptr));
	Other.Reset();
	EXPECT_EQ(*static_cast<uint32_t*>(Buffer->GetMapped()), 9u);
}

// ------------------------------------------------------------------------------------------------ pipeline cache

TEST_F(FVulkanSmokeDevice, PipelineCacheIsKeptAndADamagedOneDiscarded)
{
	const std::string File = ::testing::TempDir() + "LanternSmoke.pipelinecache";
	remove(File.c_str());
	std::string Messages;
	FRTVulkanDeviceDesc Desc;
	Desc.PipelineCacheFile = File.c_str();
	Desc.MessageUser = &Messages;
	Desc.MessageCallback = [](void* User, ERTVulkanMessage, const char* Text) {
		*static_cast<std::string*>(User) += std::string(Text) + "\n";
	};
	const auto MakeOnce = [&] {
		TRTRef<IRTDevice> Other;
		ASSERT_OK(CreateVulkanDevice(Desc, Other.ReleaseAndGetAddress()));
		TRTRef<IRTPipeline> Pipeline;
		ASSERT_OK(Other->CreateComputePipeline(
		    {MakeCode(Smoke_Fill_comp, ERTShaderStage::Compute, "Fill"), "Fill"}, Pipeline.ReleaseAndGetAddress()));
	};
	ASSERT_NO_FATAL_FAILURE(MakeOnce());
	EXPECT_EQ(Messages, "");
	FILE* Stream = fopen(File.c_str(), "r+b");
	ASSERT_NE(Stream, nullptr);
	fclose(Stream);
	ASSERT_NO_FATAL_FAILURE(MakeOnce());
	EXPECT_EQ(Messages, "");

	Stream = fopen(File.c_str(), "r+b");
	fseek(Stream, -1, SEEK_END);
	const int Last = fgetc(Stream);
	fseek(Stream, -1, SEEK_END);
	fputc(Last ^ 1, Stream);
	fclose(Stream);
	ASSERT_NO_FATAL_FAILURE(MakeOnce());
	EXPECT_NE(Messages.find("damaged"), std::string::npos) << Messages;
	Messages.clear();
	namespace fs = std::filesystem;
	const auto Leave = [&](const char* Suffix, int Hours) {
		std::ofstream(File + Suffix) << "half";
		fs::last_write_time(File + Suffix, fs::file_time_type::clock::now() - std::chrono::hours(Hours));
	};
	Leave(".aB3dEf", 30);
	Leave(".gH4iJk", 1);
	Leave(".notes", 30);
	ASSERT_NO_FATAL_FAILURE(MakeOnce()); // written anew
	EXPECT_EQ(Messages, "");
	EXPECT_FALSE(fs::exists(File + ".aB3dEf")) << "left by a process that was killed";
	EXPECT_TRUE(fs::exists(File + ".gH4iJk")) << "another process may be writing it";
	EXPECT_TRUE(fs::exists(File + ".notes"));
	for (const char* Suffix : {"", ".gH4iJk", ".notes"}) { fs::remove(File + Suffix); }
}

TEST_F(FVulkanSmokeDevice, ManyMayShareAPipelineCacheFile)
{
	const std::string File = ::testing::TempDir() + "LanternSmokeShared.pipelinecache";
	remove(File.c_str());
	std::atomic<int> MessageCount = 0;
	FRTVulkanDeviceDesc Desc;
	Desc.PipelineCacheFile = File.c_str();
	Desc.MessageUser = &MessageCount;
	Desc.MessageCallback = [](void* User, ERTVulkanMessage, const char*) { ++*static_cast<std::atomic<int>*>(User); };
	std::vector<TRTRef<IRTDevice>> Devices(3);
	for (TRTRef<IRTDevice>& Other : Devices)
	{
		ASSERT_OK(CreateVulkanDevice(Desc, Other.ReleaseAndGetAddress()));
		TRTRef<IRTPipeline> Pipeline;
		ASSERT_OK(Other->CreateComputePipeline(
		    {MakeCode(Smoke_Fill_comp, ERTShaderStage::Compute, "Fill"), "Fill"}, Pipeline.ReleaseAndGetAddress()));
	}
	std::vector<std::thread> Threads;
	std::atomic<int> Failed = 0;
	for (TRTRef<IRTDevice>& Other : Devices)
	{
		Threads.emplace_back([&] {
			for (int Round = 0; Round < 200; ++Round) { Failed += SaveVulkanPipelineCache(Other.Get()) ? 0 : 1; }
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Failed, 0);
	Devices.clear();
	Devices.resize(1);
	ASSERT_OK(CreateVulkanDevice(Desc, Devices[0].ReleaseAndGetAddress()));
	EXPECT_EQ(MessageCount, 0) << "the file must be whole, whoever wrote it last";
	Devices.clear();
	remove(File.c_str());
}

// ------------------------------------------------------------------------------------------------ take-over

/// The engine records, Lantern writes into its command buffer, the engine submits.
void WriteThroughEngine(FEngine& Engine, IRTDevice& Adopted)
{
	const VkCommandBuffer Commands = Engine.BeginCommands();
	TRTRef<IRTBuffer> Words;
	ASSERT_OK(Adopted.CreateBuffer({256, ERTBufferUsage::Storage, ERTMemory::Readback, "Words"}, Words.ReleaseAndGetAddress()));
	TRTRef<IRTPipeline> Pipeline;
	ASSERT_OK(Adopted.CreateComputePipeline(
	    {MakeCode(Smoke_Fill_comp, ERTShaderStage::Compute, "Fill"), "Fill"}, Pipeline.ReleaseAndGetAddress()));
	TRTRef<IRTCommandList> Imported;
	ASSERT_OK(Adopted.ImportCommandList((uint64_t)Commands, Imported.ReleaseAndGetAddress()));
	Imported->SetPipeline(Pipeline.Get());
	const struct
	{
		uint64_t Address;
		uint32_t Count, Factor;
	} Push = {Words->GetDeviceAddress(), 64, 5};
	Imported->PushConstants(&Push, sizeof(Push));
	Imported->Dispatch(1, 1, 1);
	FRTBarrier Item;
	Item.Before = ERTAccess::StorageWrite;
	Item.After = ERTAccess::HostRead;
	Imported->Barriers(&Item, 1);
	Engine.Submit(Commands);

	IRTCommandList* Lists[] = {Imported.Get()};
	FRTFence Fence = 0;
	ASSERT_OK(Adopted.NotifyExternalSubmit(Lists, 1, &Fence));
	Pipeline.Reset(); // kept by the submission
	Imported.Reset();
	ASSERT_OK(Adopted.WaitFor(Fence, WaitLimitNs));
	EXPECT_EQ(static_cast<uint32_t*>(Words->GetMapped())[63], 63u * 5);
}

TEST_F(FVulkanSmokeDevice, AnEnginesDeviceIsTakenOverAndLeftAlive)
{
	FEngine Engine;
	TRTRef<IRTVulkanRequirements> Requirements;
	ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, Device->GetCapabilities().DeviceName, Requirements));

	FRTVulkanExternalDesc Desc = Engine.Describe(Requirements.Get());
	int LockDepth = 0;
	Desc.QueueUser = &LockDepth;
	Desc.LockQueue = [](void* User) { ++*static_cast<int*>(User); };
	Desc.UnlockQueue = [](void* User) { *static_cast<int*>(User) += 100 - 1; };
	TRTRef<IRTDevice> Adopted;
	ASSERT_OK(AdoptVulkanDevice(Desc, Adopted.ReleaseAndGetAddress()));
	EXPECT_EQ(Adopted->GetNative(ERTNative::Device), (uint64_t)Engine.Device);
	EXPECT_EQ(Adopted->GetCapabilities().Rung, Device->GetCapabilities().Rung);

	WriteThroughEngine(Engine, *Adopted);
	EXPECT_EQ(LockDepth, 100) << "the queue's lock was taken and given back once";
	EXPECT_EQ(Adopted->GetValidationMessageCount(), 0u);
	Adopted.Reset();

	// The device is still the engine's, and alive.
	Engine.Get<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(Engine.Device, Engine.Pool, nullptr);
	EXPECT_EQ(Engine.Get<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(Engine.Device), VK_SUCCESS);
}

TEST_F(FVulkanSmokeDevice, AnEnginesDeviceWithoutTheExtensionsIsRefused)
{
	FEngine Engine;
	ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, Device->GetCapabilities().DeviceName));
	TRTRef<IRTVulkanRequirements> Requirements;
	ASSERT_OK(GetVulkanRequirements(Engine.DescribeRequirements(), Requirements.ReleaseAndGetAddress()));
	ASSERT_TRUE(Engine.CreateDevice(nullptr, 0, nullptr));
	TRTRef<IRTDevice> Adopted;
	const FRTStatus Status = AdoptVulkanDevice(Engine.Describe(Requirements.Get()), Adopted.ReleaseAndGetAddress());
	EXPECT_EQ(Status.Code, ERTResult::Unsupported);
	EXPECT_NE(strstr(Status.Message, "not enabled"), nullptr) << Status.Message;
	EXPECT_FALSE(Adopted);
}

} // namespace Lantern
