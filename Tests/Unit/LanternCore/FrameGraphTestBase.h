// What the tests of the frame graph share: a mock device, short ways to declare, and the recorded calls as text.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

inline constexpr ERTAccess Sampled = ERTAccess::ShaderRead, Storage = ERTAccess::StorageWrite;

/// A texture or a buffer, with how it is used.
struct FTestUse
{
	FTestUse(FGraphTexture InTexture, ERTAccess InAccess) : Texture(InTexture), Access(InAccess) {}
	FTestUse(FGraphBuffer InBuffer, ERTAccess InAccess) : Buffer(InBuffer), Access(InAccess) {}
	FGraphTexture Texture;
	FGraphBuffer Buffer;
	ERTAccess Access;
};

inline std::string AccessText(uint64_t Access)
{
	static constexpr const char* Names[] = {"ShaderRead", "StorageRead", "StorageWrite", "RenderTarget", "DepthWrite", "IndexRead",
	    "IndirectRead", "CopyRead", "CopyWrite", "GeometryInput", "BuildRead", "BuildWrite", "TraceRead", "HostRead"};
	std::string Text;
	for (uint32_t Bit = 0; Bit < 14; ++Bit)
	{
		if ((Access >> Bit) & 1u) { Text += (Text.empty() ? "" : "|") + std::string(Names[Bit]); }
	}
	return Text.empty() ? "None" : Text;
}

class FFrameGraphTestBase : public testing::Test
{
protected:
	void SetUp() override { MakeDevice(); }
	void TearDown() override { Clear(); }

	void Clear()
	{
		if (Device) { (void)Device->WaitIdle(); }
		Resources.reset();
		Held.clear();
		HeldBuffers.clear();
		List.Reset();
		Device.Reset();
	}
	void MakeDevice()
	{
		Clear();
		ASSERT_TRUE(CreateMockDevice(FRTMockDesc(), Device.ReleaseAndGetAddress()).IsOk());
		Resources = std::make_unique<FFrameGraphResources>(*Device);
	}
	FRTMock& Mock() { return GetMock(Device.Get()); }

	static FGraphTexture MakeTexture(FFrameGraph& Graph, const char* Name, uint32_t Size = 64)
	{
		FGraphTextureDesc Desc;
		Desc.Width = Desc.Height = Size;
		Desc.Format = ERTFormat::R32_FLOAT;
		return Graph.CreateTexture(Desc, Name);
	}
	static FGraphBuffer MakeBuffer(FFrameGraph& Graph, const char* Name)
	{
		FGraphBufferDesc Desc;
		Desc.Size = 256;
		return Graph.CreateBuffer(Desc, Name);
	}
	FGraphTexture ImportTexture(FFrameGraph& Graph, const char* Name, ERTAccess Current, ERTAccess After)
	{
		FRTTextureDesc Desc;
		Desc.Width = Desc.Height = 64;
		Desc.Format = ERTFormat::R32_FLOAT;
		Desc.Usage = ERTTextureUsage::Sampled | ERTTextureUsage::Storage | ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest |
		             ERTTextureUsage::RenderTarget;
		Desc.Name = Name;
		EXPECT_TRUE(Device->CreateTexture(Desc, Held.emplace_back().ReleaseAndGetAddress()).IsOk());
		return Graph.ImportTexture(Held.back().Get(), Current, After, Name);
	}
	FGraphBuffer ImportBuffer(FFrameGraph& Graph, const char* Name, ERTAccess Current, ERTAccess After)
	{
		FRTBufferDesc Desc;
		Desc.Size = 256;
		Desc.Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopyDest | ERTBufferUsage::CopySource | ERTBufferUsage::Index;
		Desc.Name = Name;
		EXPECT_TRUE(Device->CreateBuffer(Desc, HeldBuffers.emplace_back().ReleaseAndGetAddress()).IsOk());
		return Graph.ImportBuffer(HeldBuffers.back().Get(), Current, After, Name);
	}

	void AddPass(FFrameGraph& Graph, const std::string& Name, std::vector<FTestUse> Reads, std::vector<FTestUse> Writes)
	{
		Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
			for (const FTestUse& Use : Reads)
			{
				Use.Texture.IsValid() ? Builder.Read(Use.Texture, Use.Access) : Builder.Read(Use.Buffer, Use.Access);
			}
			for (const FTestUse& Use : Writes)
			{
				Use.Texture.IsValid() ? Builder.Write(Use.Texture, Use.Access) : Builder.Write(Use.Buffer, Use.Access);
			}
			return [this, Name](FPassContext&) { Ran.push_back(Name); };
		});
	}

	/// Records and submits; nothing is submitted where recording fails.
	FRTStatus Execute(FFrameGraph& Graph)
	{
		Ran.clear();
		FRTStatus Status = Device->CreateCommandList("Frame", List.ReleaseAndGetAddress());
		Status = Status ? List->Begin() : Status;
		Status = Status ? Graph.Execute(*List) : Status;
		const FRTStatus Ended = List->End();
		if (Status && Ended)
		{
			IRTCommandList* Lists[] = {List.Get()};
			Status = Device->Submit(Lists, 1, &Fence);
		}
		return Status;
	}
	/// Names of the passes that ran, of AddPass above.
	std::vector<std::string> Run(FFrameGraph& Graph)
	{
		const FRTStatus Status = Execute(Graph);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Ran;
	}
	/// Markers ("[Name", "]") and barriers ("Name: Before -> After") as recorded.
	std::vector<std::string> Trace()
	{
		std::vector<std::string> Lines;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			if (Call.Kind == ERTMockCall::BeginMarker) { Lines.push_back("[" + Call.Name); }
			else if (Call.Kind == ERTMockCall::EndMarker) { Lines.push_back("]"); }
			else if (Call.Kind == ERTMockCall::Barrier)
			{
				Lines.push_back(Call.Name + ": " + AccessText(Call.Numbers[0]) + " -> " + AccessText(Call.Numbers[1]));
			}
		}
		return Lines;
	}

	TRTRef<IRTDevice> Device;
	std::unique_ptr<FFrameGraphResources> Resources;
	std::vector<TRTRef<IRTTexture>> Held;
	std::vector<TRTRef<IRTBuffer>> HeldBuffers;
	TRTRef<IRTCommandList> List;
	FRTFence Fence = 0;
	std::vector<std::string> Ran;
};

using FrameGraphTest = FFrameGraphTestBase; ///< the suite's name

} // namespace Lantern
