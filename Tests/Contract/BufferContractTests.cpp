// Buffers: memory, copies and fills.
#include "ContractFixture.h"

namespace Lantern
{
namespace
{

CONTRACT_TEST(BufferKeepsItsDescription)
{
	std::string Name = "Named";
	const auto Device = Make.Buffer(1000, ERTMemory::Device, Name.c_str());
	Name = "Gone";
	EXPECT_STREQ(Device->GetDesc().Name, "Named") << "descriptions are copied";
	EXPECT_EQ(Device->GetDesc().Size, 1000u);
	EXPECT_EQ(Device->GetDesc().Usage, AnyUsage);
	EXPECT_EQ(Device->GetMapped(), nullptr);
	const auto Upload = Make.Buffer(16, ERTMemory::Upload), Readback = Make.Buffer(16, ERTMemory::Readback);
	EXPECT_NE(Upload->GetMapped(), nullptr);
	EXPECT_NE(Readback->GetMapped(), nullptr);
	EXPECT_NE(Device->GetDeviceAddress(), 0u);
	EXPECT_NE(Upload->GetDeviceAddress(), Readback->GetDeviceAddress());
}

CONTRACT_TEST(ReferencesAreCounted)
{
	auto Buffer = Make.Buffer(16);
	EXPECT_EQ(Buffer->AddRef(), 2u);
	EXPECT_EQ(Buffer->Release(), 1u);
	TRTRef<IRTBuffer> Copy = Buffer;
	EXPECT_EQ(Buffer->AddRef(), 3u);
	EXPECT_EQ(Buffer->Release(), 2u);
	TRTRef<IRTBuffer> Moved = std::move(Copy);
	EXPECT_FALSE(Copy);
	EXPECT_EQ(Moved, Buffer);
}

CONTRACT_TEST(ImportedMemoryIsReleasedOnceAndLate)
{
	const auto Owner = Make.Buffer(1024, ERTMemory::Upload);
	int Released = 0;
	FRTNativeBuffer Native;
	Native.Handle = Owner->GetNative(ERTNative::Buffer);
	Native.Address = Owner->GetDeviceAddress() / 16 * 16;
	Native.Released = [](void* User) { ++*static_cast<int*>(User); };
	Native.User = &Released;
	TRTRef<IRTBuffer> Imported;
	ASSERT_OK(
	    Make.Device->ImportBuffer({1000, ERTBufferUsage::Storage, ERTMemory::Upload, "Theirs"}, Native, Imported.ReleaseAndGetAddress()));
	EXPECT_STREQ(Imported->GetDesc().Name, "Theirs");
	EXPECT_EQ(Imported->GetDesc().Size, 1000u);
	EXPECT_EQ(Imported->GetMapped(), nullptr) << "it is the host that may write to it";
	EXPECT_NE(Imported->GetDeviceAddress(), 0u);
	const auto List = Make.List();
	List->KeepAlive(Imported.Get());
	Imported.Reset();
	Make.Device->CollectGarbage();
	EXPECT_EQ(Released, 0) << "the list may still run";
	Run(List.Get());
	ASSERT_OK(List->Begin()); // lets go of what it held
	ASSERT_OK(List->End());
	ASSERT_OK(Make.Device->WaitIdle());
	Make.Device->CollectGarbage();
	EXPECT_EQ(Released, 1);
}

CONTRACT_TEST(CopiesThroughDeviceMemory)
{
	std::vector<uint32_t> Values(256);
	for (uint32_t i = 0; i < 256; ++i) { Values[i] = i * i; }
	const auto Source = Upload(Values);
	const auto Middle = Make.Buffer(1024);
	const auto Readback = Make.Buffer(1024, ERTMemory::Readback);
	const auto List = Make.List();
	List->CopyBuffer(Middle.Get(), 64, Source.Get(), 0, 960);
	List->CopyBuffer(Middle.Get(), 0, Source.Get(), 960, 64);
	Barrier(List.Get(), Middle.Get(), ERTAccess::CopyWrite, ERTAccess::CopyRead);
	List->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 1024);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Run(List.Get());
	const auto* Got = static_cast<const uint32_t*>(Readback->GetMapped());
	for (uint32_t i = 0; i < 256; ++i) { ASSERT_EQ(Got[i], Values[(i + 240) % 256]) << i; }
}

CONTRACT_TEST(CopiesManyRegionsAtOnce)
{
	std::vector<uint32_t> Values(256);
	for (uint32_t i = 0; i < 256; ++i) { Values[i] = i + 1; }
	const auto Source = Upload(Values);
	const auto Readback = Make.Buffer(1024, ERTMemory::Readback);
	// The words back to front, all but one.
	std::vector<FRTBufferRegion> Regions;
	for (uint32_t i = 0; i < 255; ++i) { Regions.push_back({(255u - i) * 4u, i * 4u, 4u}); }
	const auto List = Make.List();
	List->FillBuffer(Readback.Get(), 0, 1024, 0);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::CopyWrite);
	List->CopyBufferRegions(Readback.Get(), Source.Get(), Regions.data(), static_cast<uint32_t>(Regions.size()));
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Run(List.Get());
	const auto* Got = static_cast<const uint32_t*>(Readback->GetMapped());
	for (uint32_t i = 0; i < 256; ++i) { ASSERT_EQ(Got[i], i == 0 ? 0u : 256u - i) << i; }
}

CONTRACT_TEST(FillsAPart)
{
	const auto Readback = Make.Buffer(32, ERTMemory::Readback);
	const auto List = Make.List();
	List->FillBuffer(Readback.Get(), 0, 32, 0x11111111);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::CopyWrite);
	List->FillBuffer(Readback.Get(), 8, 12, 0xdeadbeef);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Run(List.Get());
	const auto* Got = static_cast<const uint32_t*>(Readback->GetMapped());
	for (uint32_t i = 0; i < 8; ++i) { EXPECT_EQ(Got[i], i >= 2 && i < 5 ? 0xdeadbeefu : 0x11111111u) << i; }
}

CONTRACT_TEST(RecordedListKeepsBuffersAlive)
{
	const uint32_t Value = 1234567;
	auto Source = Upload(&Value, 4);
	auto Middle = Make.Buffer(4);
	const auto Readback = Make.Buffer(4, ERTMemory::Readback);
	const auto List = Make.List();
	List->CopyBuffer(Middle.Get(), 0, Source.Get(), 0, 4);
	Barrier(List.Get(), Middle.Get(), ERTAccess::CopyWrite, ERTAccess::CopyRead);
	List->CopyBuffer(Readback.Get(), 0, Middle.Get(), 0, 4);
	Barrier(List.Get(), Readback.Get(), ERTAccess::CopyWrite, ERTAccess::HostRead);
	Source.Reset();
	Middle.Reset();
	Device().CollectGarbage();
	Run(List.Get());
	EXPECT_EQ(*static_cast<const uint32_t*>(Readback->GetMapped()), Value);
}

CONTRACT_TEST(FreshObjectsEveryFrameWithoutWaiting)
{
	const auto Readback = Make.Buffer(64 * 4, ERTMemory::Readback);
	FRTFence Last = 0;
	for (uint32_t Frame = 0; Frame < 64; ++Frame)
	{
		const auto Source = Upload(&Frame, 4);
		const auto List = Make.List();
		List->CopyBuffer(Readback.Get(), Frame * 4, Source.Get(), 0, 4);
		const FRTFence Fence = Make.Submit(List.Get());
		EXPECT_GT(Fence, Last);
		Last = Fence;
	}
	Wait(Last);
	for (uint32_t Frame = 0; Frame < 64; ++Frame) { EXPECT_EQ(static_cast<const uint32_t*>(Readback->GetMapped())[Frame], Frame); }
}

CONTRACT_TEST(TooLargeBufferIsAnError)
{
	TRTRef<IRTBuffer> Buffer;
	const FRTStatus Status = Device().CreateBuffer({1ull << 50, AnyUsage, ERTMemory::Device, "Huge"}, Buffer.ReleaseAndGetAddress());
	EXPECT_FALSE(Status.IsOk());
	EXPECT_FALSE(Buffer);
	EXPECT_STRNE(Status.Message, "");
	const auto Small = Make.Buffer(16);
	EXPECT_TRUE(Small) << "the device goes on";
}

CONTRACT_TEST(MemoryIsCounted)
{
	const FRTMemoryStats Before = Device().GetMemoryStats();
	{
		const auto Buffer = Make.Buffer(1 << 20);
		const auto Texture = Make.Texture(64, 64, ERTFormat::RGBA8_UNORM);
		const auto Scratch = Make.Scratch(1 << 16);
		const FRTMemoryStats Now = Device().GetMemoryStats();
		EXPECT_GE(Now.Buffer - Before.Buffer, 1u << 20);
		EXPECT_GE(Now.Texture - Before.Texture, 64u * 64 * 4);
		EXPECT_GE(Now.Scratch - Before.Scratch, 1u << 16);
		EXPECT_GE(Now.Total - Before.Total, (1u << 20) + (1u << 16) + 64 * 64 * 4);
	}
	EXPECT_OK(Device().WaitIdle());
	Device().CollectGarbage();
	EXPECT_EQ(Device().GetMemoryStats().Total, Before.Total);
	EXPECT_GE(Device().GetMemoryStats().Peak, 1u << 20);
}

} // namespace
} // namespace Lantern
