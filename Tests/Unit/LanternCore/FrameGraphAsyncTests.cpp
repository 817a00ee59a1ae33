// Passes on two queues: hazards between queues are ordered by waits, nothing else waits, and results are those of one queue.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include "FrameGraphTestBase.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternRHIValidation/ValidationDevice.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

/// The validation wrapper refuses a list that uses what another queue may still write. No submission ends by itself.
class FFrameGraphAsyncTest : public FFrameGraphTestBase
{
protected:
	void SetUp() override
	{
		FFrameGraphTestBase::SetUp();
		Inner = Device;
		Resources.reset();
		Device.Reset();
		const auto OnMessage = [](void* User, const char* Text) { static_cast<FFrameGraphAsyncTest*>(User)->Messages.emplace_back(Text); };
		ASSERT_TRUE(WrapWithValidation(Inner.Get(), OnMessage, this, Device.ReleaseAndGetAddress()).IsOk());
		Resources = std::make_unique<FFrameGraphResources>(*Device);
		GetInner().SetManualFences(true);
		SetAsync("*");
	}
	void TearDown() override
	{
		GetInner().SetManualFences(false);
		Lists.clear();
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		FFrameGraphTestBase::TearDown();
		EXPECT_THAT(GetInner().GetErrors(), IsEmpty());
		Inner.Reset();
	}
	FRTMock& GetInner() { return GetMock(Inner.Get()); }
	static void SetAsync(const char* Passes)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set("r.RT.Async", Passes, ERTSetBy::Console, "test"));
		FConsoleVariables::Get().BeginFrame();
	}

	/// A pass that copies its first source to its destinations. Without a source it fills them.
	void AddCopy(FFrameGraph& Graph, const std::string& Name, bool bAsync, std::vector<FGraphBuffer> From, std::vector<FGraphBuffer> To,
	    uint32_t Value)
	{
		Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
			for (const FGraphBuffer Buffer : From) { Builder.Read(Buffer, ERTAccess::CopyRead); }
			for (const FGraphBuffer Buffer : To) { Builder.Write(Buffer, ERTAccess::CopyWrite); }
			Builder.NeverCull();
			if (bAsync) { Builder.AllowAsync(); }
			return [=](FPassContext& Context) {
				for (const FGraphBuffer Buffer : To)
				{
					IRTBuffer* const Dest = Context.GetBuffer(Buffer);
					if (From.empty()) { Context.Commands().FillBuffer(Dest, 0, 256, Value); }
					for (size_t I = 0; I < From.size(); ++I)
					{
						Context.Commands().CopyBuffer(Dest, 16 * I, Context.GetBuffer(From[I]), 0, 16);
					}
				}
			};
		});
	}
	FRTStatus Record(FFrameGraph& Graph)
	{
		Used.clear();
		const FGraphRecorder Recorder{[this](ERTQueue Queue, IRTCommandList*& Out) {
			FRTStatus Status = Device->CreateCommandList("List", Lists.emplace_back().ReleaseAndGetAddress(), Queue);
			Out = Lists.back().Get();
			Used.push_back(Out);
			return Status ? Out->Begin() : Status;
		                              },
		    {}, true};
		const FRTStatus Status = Graph.Execute(Recorder);
		for (IRTCommandList* const Item : Used) { EXPECT_TRUE(Item->End().IsOk()); }
		return Status;
	}
	/// Submits as the graph says, or without the waits.
	FRTStatus SubmitAll(const std::vector<FGraphSubmission>& Submissions, bool bWaits = true)
	{
		std::vector<FRTFence> Fences;
		IRTCommandList* const* Next = Used.data();
		for (const FGraphSubmission& Submission : Submissions)
		{
			std::vector<FRTFence> Waits;
			for (const uint32_t Wait : Submission.Waits) { Waits.push_back(Fences[Wait]); }
			if (Submission.bWaitsForLastGraph && LastGraph != 0) { Waits.push_back(LastGraph); }
			if (!bWaits) { Waits.clear(); }
			WaitCount += Waits.size();
			AsyncCount += Submission.Queue == ERTQueue::AsyncCompute ? 1 : 0;
			FRTFence& Out = Fences.emplace_back();
			const FRTStatus Status = Device->Submit(Next, Submission.ListCount, &Out, Waits.data(), static_cast<uint32_t>(Waits.size()));
			if (!Status) { return Status; }
			Next += Submission.ListCount;
		}
		LastGraph = Fences.back();
		return FRTStatus::Success();
	}
	/// The same for the same seed, on whichever queues its passes run.
	void AddRandomPasses(FFrameGraph& Graph, std::mt19937& Random)
	{
		std::vector<FGraphBuffer> Buffers;
		for (const TRTRef<IRTBuffer>& Kept : HeldBuffers)
		{
			Buffers.push_back(Graph.ImportBuffer(Kept.Get(), State, ERTAccess::CopyRead, "Kept"));
		}
		const size_t KeptCount = Buffers.size();
		std::set<size_t> Written;
		for (size_t I = 0; I < KeptCount; ++I) { Written.insert(I); }
		for (int I = 0; I < 5; ++I) { Buffers.push_back(MakeBuffer(Graph, "Transient")); }
		for (uint32_t Pass = 0; Pass < 14; ++Pass)
		{
			std::vector<FGraphBuffer> From;
			const size_t To = Random() % Buffers.size();
			for (uint32_t I = Random() % 3; I > 0; --I)
			{
				auto Source = Written.begin();
				std::advance(Source, Random() % Written.size());
				const bool bTwice =
				    std::any_of(From.begin(), From.end(), [&](FGraphBuffer B) { return B.Index == Buffers[*Source].Index; });
				if (*Source != To && !bTwice) { From.push_back(Buffers[*Source]); }
			}
			const bool bAsync = Random() % 2 != 0;
			AddCopy(Graph, "P" + std::to_string(Pass), bAsync, From, {Buffers[To]}, Random());
			Written.insert(To);
		}
	}
	std::vector<uint8_t> Play(uint32_t Seed, const char* Async)
	{
		SetAsync(Async);
		HeldBuffers.clear();
		State = ERTAccess::CopyWrite;
		for (int I = 0; I < 3; ++I)
		{
			FRTBufferDesc Desc{256, ERTBufferUsage::CopyDest | ERTBufferUsage::CopySource, ERTMemory::Device, "Kept"};
			EXPECT_TRUE(Device->CreateBuffer(Desc, HeldBuffers.emplace_back().ReleaseAndGetAddress()).IsOk());
		}
		FillAll();
		std::mt19937 Random(Seed);
		for (int Frame = 0; Frame < 3; ++Frame)
		{
			FFrameGraph Graph(*Resources);
			AddRandomPasses(Graph, Random);
			EXPECT_TRUE(Record(Graph).IsOk());
			EXPECT_TRUE(SubmitAll(Graph.GetSubmissions()).IsOk()) << "seed " << Seed << "\n" << Graph.Dump();
			State = ERTAccess::CopyRead;
		}
		GetInner().CompleteUpTo(GetInner().GetLastFence());
		std::vector<uint8_t> Bytes;
		for (const TRTRef<IRTBuffer>& Kept : HeldBuffers)
		{
			const uint8_t* const Begin = GetInner().GetBytes(Unwrap(Kept.Get()));
			Bytes.insert(Bytes.end(), Begin, Begin + 256);
		}
		return Bytes;
	}
	/// Imported buffers hold known bytes.
	void FillAll()
	{
		TRTRef<IRTCommandList> Fill;
		ASSERT_TRUE(Device->CreateCommandList("Fill", Fill.ReleaseAndGetAddress()).IsOk());
		ASSERT_TRUE(Fill->Begin().IsOk());
		for (uint32_t I = 0; I < HeldBuffers.size(); ++I) { Fill->FillBuffer(HeldBuffers[I].Get(), 0, 256, 0x01010101u * (I + 1)); }
		ASSERT_TRUE(Fill->End().IsOk());
		IRTCommandList* const Raw = Fill.Get();
		ASSERT_TRUE(Device->Submit(&Raw, 1, &LastGraph).IsOk());
		Lists.push_back(Fill);
	}
	FGraphBuffer Keep(FFrameGraph& Graph, const char* Name) { return ImportBuffer(Graph, Name, ERTAccess::None, ERTAccess::CopyRead); }

	TRTRef<IRTDevice> Inner;
	std::vector<TRTRef<IRTCommandList>> Lists;
	std::vector<IRTCommandList*> Used;
	std::vector<std::string> Messages;
	FRTFence LastGraph = 0;
	ERTAccess State = ERTAccess::None;
	size_t WaitCount = 0, AsyncCount = 0;
};

TEST_F(FFrameGraphAsyncTest, RandomGraphsAreOrderedAndGiveWhatOneQueueGives)
{
	for (uint32_t Seed = 0; Seed < 60; ++Seed)
	{
		const std::vector<uint8_t> Alone = Play(Seed, "");
		ASSERT_EQ(Play(Seed, "*"), Alone) << Seed;
		ASSERT_THAT(Messages, IsEmpty()) << Seed;
	}
	EXPECT_GT(AsyncCount, 100u);
	EXPECT_GT(WaitCount, 100u);
}

// The test above would see a wait that is missing.
TEST_F(FFrameGraphAsyncTest, MissingWaitsAreNoticed)
{
	FFrameGraph Graph(*Resources);
	const FGraphBuffer A = MakeBuffer(Graph, "A"), Out = Keep(Graph, "Out");
	AddCopy(Graph, "Make", false, {}, {A}, 1);
	AddCopy(Graph, "Use", true, {A}, {Out}, 0);
	ASSERT_TRUE(Record(Graph).IsOk());
	EXPECT_FALSE(SubmitAll(Graph.GetSubmissions(), false).IsOk());
	EXPECT_FALSE(Messages.empty());
	EXPECT_THAT(Messages, testing::Each(testing::HasSubstr("another queue has not finished with buffer 'A'")));
	Messages.clear();
}

// Raster beside refits: neither waits for the other, and who reads both waits once.
TEST_F(FFrameGraphAsyncTest, WhatIsIndependentDoesNotWait)
{
	FFrameGraph Graph(*Resources);
	const FGraphToken Structures = Graph.CreateToken("Structures");
	const FGraphBuffer GBuffer = MakeBuffer(Graph, "GBuffer"), Out = Keep(Graph, "Out");
	Graph.AddPass("Refits", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		Builder.AllowAsync();
		Builder.Write(Structures);
		return {};
	});
	Graph.AddPass("Raster", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(GBuffer, ERTAccess::CopyWrite);
		Builder.Without(Structures);
		return {};
	});
	AddCopy(Graph, "Rays", false, {GBuffer}, {Out}, 0);
	ASSERT_TRUE(Record(Graph).IsOk());
	const std::vector<FGraphSubmission> Submissions = Graph.GetSubmissions();
	ASSERT_EQ(Submissions.size(), 3u);
	EXPECT_EQ(Submissions[0].Queue, ERTQueue::AsyncCompute);
	EXPECT_THAT(Submissions[0].Waits, IsEmpty());
	EXPECT_TRUE(Submissions[0].bWaitsForLastGraph);
	EXPECT_EQ(Submissions[1].Queue, ERTQueue::Graphics);
	EXPECT_THAT(Submissions[1].Waits, IsEmpty()) << "the raster runs beside the refits";
	EXPECT_THAT(Submissions[2].Waits, ElementsAre(0u)) << "the rays need both";
	EXPECT_TRUE(SubmitAll(Submissions).IsOk());
}

TEST_F(FFrameGraphAsyncTest, TraceShowsWhichQueueRanWhat)
{
	FTaskTrace::Start();
	FFrameGraph Graph(*Resources);
	const FGraphBuffer A = MakeBuffer(Graph, "A"), One = Keep(Graph, "One");
	AddCopy(Graph, "Make", false, {}, {A}, 1);
	AddCopy(Graph, "Beside", true, {A}, {One}, 0);
	ASSERT_TRUE(Record(Graph).IsOk());
	EXPECT_TRUE(SubmitAll(Graph.GetSubmissions()).IsOk());
	(void)Resources->GetTimings();
	std::map<std::string, std::string> Lanes;
	const auto Read = [&] {
		const std::vector<std::string> Names = FTaskTrace::GetThreadNames();
		for (const FTraceEvent& Event : FTaskTrace::GetEvents())
		{
			if (Event.bDevice) { Lanes[Event.Name] = Names[Event.Thread]; }
		}
	};
	Read();
	EXPECT_THAT(Lanes, IsEmpty()) << "the device has not run it yet";
	GetInner().CompleteUpTo(LastGraph);
	(void)Resources->GetTimings();
	(void)Resources->GetTimings(); // each frame once
	Read();
	FTaskTrace::Stop();
	EXPECT_THAT(Lanes, ElementsAre(testing::Pair("Beside", "GPU, compute queue"), testing::Pair("Make", "GPU, graphics queue")));
	EXPECT_EQ(std::ranges::count_if(FTaskTrace::GetEvents(), &FTraceEvent::bDevice), 2);
	FTaskTrace::Clear();
}

TEST_F(FFrameGraphAsyncTest, ReadersOfTwoQueuesRunBesideEachOther)
{
	FFrameGraph Graph(*Resources);
	const FGraphBuffer A = MakeBuffer(Graph, "A"), One = Keep(Graph, "One"), Two = Keep(Graph, "Two");
	AddCopy(Graph, "Make", false, {}, {A}, 1);
	AddCopy(Graph, "ReadThere", true, {A}, {One}, 0);
	AddCopy(Graph, "ReadHere", false, {A}, {Two}, 0);
	ASSERT_TRUE(Record(Graph).IsOk());
	const std::vector<FGraphSubmission> Submissions = Graph.GetSubmissions();
	ASSERT_GE(Submissions.size(), 3u);
	EXPECT_THAT(Submissions[1].Waits, ElementsAre(0u));
	EXPECT_EQ(Submissions[2].Queue, ERTQueue::Graphics);
	EXPECT_TRUE(SubmitAll(Submissions).IsOk());
	EXPECT_THAT(Messages, IsEmpty());
}

TEST_F(FFrameGraphAsyncTest, OneQueueWhereTheVariableOrTheDeviceSaysSo)
{
	for (const char* const Passes : {"", "Other", "*"})
	{
		SetAsync(Passes);
		FFrameGraph Graph(*Resources);
		const FGraphBuffer Out = Keep(Graph, "Out");
		AddCopy(Graph, "Here", true, {}, {Out}, 1);
		ASSERT_TRUE(Record(Graph).IsOk());
		const bool bTwo = std::string(Passes) == "*";
		EXPECT_EQ(Graph.GetSubmissions().size(), bTwo ? 2u : 1u) << Passes;
		EXPECT_EQ(Graph.GetSubmissions().back().Queue, ERTQueue::Graphics);
		EXPECT_TRUE(SubmitAll(Graph.GetSubmissions()).IsOk());
	}
}

} // namespace
} // namespace Lantern
