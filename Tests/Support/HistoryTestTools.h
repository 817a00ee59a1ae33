// For the tests of histories: frames on any device, and what passes of them read.
#pragma once

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/FrameGraph/History.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternRHIValidation/ValidationDevice.h"

namespace Lantern
{

class FHistoryFrames
{
protected:
	~FHistoryFrames() = default;
	void OpenHistory(IRTDevice& On)
	{
		Device = TRTRef<IRTDevice>(&On);
		Resources = std::make_unique<FFrameGraphResources>(On);
		History = std::make_unique<FHistoryResources>(On);
	}
	void CloseHistory()
	{
		History.reset();
		Resources.reset();
		Readbacks.clear();
		Lists.clear();
		Device.Reset();
	}

	struct FFrameCase
	{
		bool bKeep = true; ///< else a cut
		bool bKeepWorld = false;
		bool bSubmit = true; ///< else the frame is lost
	};
	/// One frame, with the passes that AddPasses adds.
	void Frame(const std::function<void(FFrameGraph&)>& AddPasses, FFrameCase Case)
	{
		FFrameGraph Graph(*Resources);
		History->BeginFrame(Graph, Case.bKeep, Case.bKeepWorld);
		AddPasses(Graph);
		TRTRef<IRTCommandList>& List = Lists.emplace_back();
		ASSERT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		ASSERT_TRUE(List->Begin());
		const FRTStatus Status = Graph.Execute(*List);
		EXPECT_TRUE(Status) << Status.Message;
		Dump = Graph.Dump();
		ASSERT_TRUE(List->End());
		if (Case.bSubmit)
		{
			IRTCommandList* const Submitted[] = {List.Get()};
			ASSERT_TRUE(Device->Submit(Submitted, 1, &Fence));
		}
		History->EndFrame(Case.bSubmit);
	}
	void Frame(const std::function<void(FFrameGraph&)>& AddPasses) { Frame(AddPasses, {}); }

	FHistoryTexture Get(const char* Name = "Mean", uint32_t Size = 4, ERTFormat Format = ERTFormat::R32_FLOAT)
	{
		FHistoryTexture Out;
		const FRTStatus Status = History->GetTexture(Name, {Size, Size, Format, ERTTextureUsage::CopySource}, Out);
		EXPECT_TRUE(Status) << Status.Message;
		return Out;
	}
	FHistoryBuffer GetBuffer(const char* Name = "Cache", uint64_t Size = 64, EHistoryScope Scope = EHistoryScope::View)
	{
		FHistoryBuffer Out;
		const FRTStatus Status = History->GetBuffer(Name, {Size, ERTBufferUsage::CopySource}, Out, Scope);
		EXPECT_TRUE(Status) << Status.Message;
		return Out;
	}

	/// Fills Current with Value. Output: what else the pass writes; valid or not.
	static void AddWriter(FFrameGraph& Graph, FGraphTexture Current, float Value, FGraphTexture Output = {}, const char* Name = "Writer")
	{
		Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Write(Current, ERTAccess::CopyWrite);
			if (Output.IsValid()) { Builder.Write(Output, ERTAccess::CopyWrite); }
			return [=](FPassContext& Pass) {
				const float Color[4] = {Value, Value, Value, Value};
				Pass.Commands().ClearTexture(Pass.GetTexture(Current), Color);
				if (Output.IsValid()) { Pass.Commands().ClearTexture(Pass.GetTexture(Output), Color); }
			};
		});
	}
	static void AddWriter(FFrameGraph& Graph, FGraphBuffer Cache, uint32_t Value)
	{
		Graph.AddPass("Writer", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Write(Cache, ERTAccess::CopyWrite);
			return [=](FPassContext& Pass) {
				IRTBuffer* const Buffer = Pass.GetBuffer(Cache);
				Pass.Commands().FillBuffer(Buffer, 0, Buffer->GetDesc().Size, Value);
			};
		});
	}
	/// Copies it to the host: to Readbacks, whose newest is this.
	void AddReader(FFrameGraph& Graph, FGraphTexture Texture)
	{
		const FGraphTextureDesc& Desc = Graph.GetDesc(Texture);
		const FGraphBuffer Host = AddReadback(Graph, uint64_t(Desc.Width) * Desc.Height * BytesPerTexel(Desc.Format));
		Graph.AddPass("Reader", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Texture, ERTAccess::CopyRead);
			Builder.Write(Host, ERTAccess::CopyWrite);
			return
			    [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Host), 0, Pass.GetTexture(Texture), 0, 0); };
		});
	}
	void AddReader(FFrameGraph& Graph, FGraphBuffer Cache)
	{
		const uint64_t Size = Graph.GetDesc(Cache).Size;
		const FGraphBuffer Host = AddReadback(Graph, Size);
		Graph.AddPass("Reader", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Cache, ERTAccess::CopyRead);
			Builder.Write(Host, ERTAccess::CopyWrite);
			return [=](FPassContext& Pass) { Pass.Commands().CopyBuffer(Pass.GetBuffer(Host), 0, Pass.GetBuffer(Cache), 0, Size); };
		});
	}
	/// A frame that writes Value and, where there is one, reads what the frame before left.
	void WriteAndReadBefore(float Value, FFrameCase Case)
	{
		Frame(
		    [&](FFrameGraph& Graph) {
			const FHistoryTexture Mean = Get();
			bHadPrevious = Mean.Previous.IsValid();
			if (bHadPrevious) { AddReader(Graph, Mean.Previous); }
			AddWriter(Graph, Mean.Current, Value);
			AddReader(Graph, Mean.Current);
			// Of the two readbacks the one before is what tests look at.
			if (bHadPrevious) { std::swap(Readbacks.back(), Readbacks[Readbacks.size() - 2]); }
		    },
		    Case);
	}
	void WriteAndReadBefore(float Value) { WriteAndReadBefore(Value, {}); }

	template <class T>
	T ReadNewest(size_t Back = 0)
	{
		T Value;
		std::memcpy(&Value, Readbacks[Readbacks.size() - 1 - Back]->GetMapped(), sizeof(T));
		return Value;
	}
	/// All bytes of the newest readback.
	std::vector<uint8_t> ReadBytes()
	{
		const auto* const Data = static_cast<const uint8_t*>(Readbacks.back()->GetMapped());
		return {Data, Data + Readbacks.back()->GetDesc().Size};
	}
	TRTRef<IRTDevice> Device;
	std::unique_ptr<FFrameGraphResources> Resources;
	std::unique_ptr<FHistoryResources> History;
	std::vector<TRTRef<IRTBuffer>> Readbacks;
	std::vector<TRTRef<IRTCommandList>> Lists;
	std::string Dump; ///< of the newest graph
	FRTFence Fence = 0;
	bool bHadPrevious = false;

private:
	FGraphBuffer AddReadback(FFrameGraph& Graph, uint64_t Size)
	{
		const FRTBufferDesc Desc{(Size + 3) / 4 * 4, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Readback"};
		EXPECT_TRUE(Device->CreateBuffer(Desc, Readbacks.emplace_back().ReleaseAndGetAddress()));
		return Graph.ImportBuffer(Readbacks.back().Get(), ERTAccess::None, ERTAccess::HostRead, "Readback");
	}
};

/// On a mock behind the validation wrapper.
class FHistoryTestBase : public testing::Test, protected FHistoryFrames
{
protected:
	void SetUp() override
	{
		ASSERT_TRUE(CreateMockDevice({}, Inner.ReleaseAndGetAddress()));
		const auto OnMessage = [](void* User, const char* Text) { static_cast<FHistoryTestBase*>(User)->Messages.emplace_back(Text); };
		TRTRef<IRTDevice> Wrapped;
		ASSERT_TRUE(WrapWithValidation(Inner.Get(), OnMessage, this, Wrapped.ReleaseAndGetAddress()));
		OpenHistory(*Wrapped);
	}
	void TearDown() override
	{
		Mock().SetManualFences(false);
		CloseHistory();
		EXPECT_THAT(Messages, testing::IsEmpty());
		EXPECT_THAT(Mock().GetErrors(), testing::IsEmpty());
	}
	FRTMock& Mock() { return GetMock(Inner.Get()); }
	std::vector<std::string> GetPasses()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BeginMarker)) { Names.push_back(Call.Name); }
		return Names;
	}

	TRTRef<IRTDevice> Inner;
	std::vector<std::string> Messages;
};

} // namespace Lantern
