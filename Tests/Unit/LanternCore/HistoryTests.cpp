// What one frame leaves for the next: which frame sees what, and when it is gone.
#include "Support/HistoryTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class FHistoryTest : public FHistoryTestBase
{};

TEST_F(FHistoryTest, AFrameSeesWhatTheOneBeforeWrote)
{
	WriteAndReadBefore(1.0f);
	EXPECT_FALSE(bHadPrevious) << "the first";
	for (float Value = 2.0f; Value < 7.0f; ++Value)
	{
		WriteAndReadBefore(Value);
		ASSERT_TRUE(bHadPrevious);
		EXPECT_EQ(ReadNewest<float>(), Value - 1.0f);
		EXPECT_EQ(ReadNewest<float>(1), Value) << "its own";
	}
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateTexture), 2u) << "in turn";
	EXPECT_EQ(History->GetBytes(), 2u * 4 * 4 * 4);
}

TEST_F(FHistoryTest, NamesAreApart)
{
	for (int Index = 0; Index < 3; ++Index)
	{
		Frame([&](FFrameGraph& Graph) {
			for (const auto& [Name, Value] : {std::pair{"Mean", 1.0f}, std::pair{"Length", 2.0f}})
			{
				const FHistoryTexture Texture = Get(Name);
				AddWriter(Graph, Texture.Current, Value);
				AddReader(Graph, Index > 0 ? Texture.Previous : Texture.Current);
				if (Index > 0) { AddReader(Graph, Texture.Current); }
			}
		});
	}
	EXPECT_EQ(ReadNewest<float>(0), 2.0f);
	EXPECT_EQ(ReadNewest<float>(1), 2.0f);
	EXPECT_EQ(ReadNewest<float>(2), 1.0f);
	EXPECT_EQ(ReadNewest<float>(3), 1.0f);
}

TEST_F(FHistoryTest, AnotherFormatStartsAnewAndAnotherSizeDoesNot)
{
	uint32_t SizeBefore = 0;
	const auto Write = [&](uint32_t Size, ERTFormat Format) {
		Frame([&](FFrameGraph& Graph) {
			const FHistoryTexture Mean = Get("Mean", Size, Format);
			bHadPrevious = Mean.Previous.IsValid();
			if (bHadPrevious) { EXPECT_EQ(Graph.GetDesc(Mean.Previous).Width, SizeBefore); }
			SizeBefore = Size;
			EXPECT_EQ(Graph.GetDesc(Mean.Current).Width, Size);
			EXPECT_EQ(Graph.GetDesc(Mean.Current).Format, Format);
			AddWriter(Graph, Mean.Current, 1.0f);
			AddReader(Graph, Mean.Current);
		});
		return bHadPrevious;
	};
	EXPECT_FALSE(Write(4, ERTFormat::R32_FLOAT));
	EXPECT_TRUE(Write(4, ERTFormat::R32_FLOAT));
	EXPECT_TRUE(Write(8, ERTFormat::R32_FLOAT)) << "at its own resolution";
	EXPECT_TRUE(Write(8, ERTFormat::R32_FLOAT));
	EXPECT_FALSE(Write(8, ERTFormat::R16_FLOAT));
	EXPECT_EQ(History->GetBytes(), 2u * 8 * 8 * 2) << "what it was before is gone";
	Device->CollectGarbage();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "Mean"), 4u);
}

TEST_F(FHistoryTest, ACutForgetsTheContentAndKeepsTheMemory)
{
	WriteAndReadBefore(1.0f);
	WriteAndReadBefore(2.0f);
	WriteAndReadBefore(3.0f, {.bKeep = false});
	EXPECT_FALSE(bHadPrevious);
	WriteAndReadBefore(4.0f);
	ASSERT_TRUE(bHadPrevious);
	EXPECT_EQ(ReadNewest<float>(), 3.0f);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateTexture), 2u);
}

TEST_F(FHistoryTest, AfterALostFrameThereIsNone)
{
	for (const float First : {1.0f, 10.0f, 20.0f}) // also where the very first is lost
	{
		WriteAndReadBefore(First, {.bSubmit = First > 10.0f});
		WriteAndReadBefore(First + 1.0f, {.bSubmit = false});
		WriteAndReadBefore(First + 2.0f);
		EXPECT_FALSE(bHadPrevious);
		WriteAndReadBefore(First + 3.0f);
		ASSERT_TRUE(bHadPrevious);
		EXPECT_EQ(ReadNewest<float>(), First + 2.0f);
	}
}

TEST_F(FHistoryTest, AFrameThatDoesNotAskEndsItAndManyFreeIt)
{
	WriteAndReadBefore(1.0f);
	Frame([](FFrameGraph&) {});
	WriteAndReadBefore(3.0f);
	EXPECT_FALSE(bHadPrevious) << "of two frames before";
	for (uint32_t Index = 1; Index < FHistoryResources::KeepFrames; ++Index)
	{
		Frame([](FFrameGraph&) {});
	}
	EXPECT_GT(History->GetBytes(), 0u);
	Frame([](FFrameGraph&) {});
	EXPECT_EQ(History->GetBytes(), 0u);
	Lists.clear(); // they refer to it
	Device->CollectGarbage();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "Mean"), 2u);
}

TEST_F(FHistoryTest, WhatIsFreedInFlightLivesUntilItHasRun)
{
	Mock().SetManualFences(true);
	WriteAndReadBefore(1.0f);
	Frame([&](FFrameGraph& Graph) { // another format: the old pair goes
		const FHistoryTexture Mean = Get("Mean", 4, ERTFormat::R16_FLOAT);
		AddWriter(Graph, Mean.Current, 1.0f);
		AddReader(Graph, Mean.Current);
	});
	Lists.clear();
	Device->CollectGarbage();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "Mean"), 0u);
	Mock().CompleteUpTo(Fence);
	Device->CollectGarbage();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "Mean"), 2u);
}

TEST_F(FHistoryTest, TwoFramesInFlightDoNotMeet)
{
	Mock().SetManualFences(true);
	FRTFence Earlier = 0;
	for (float Value = 1.0f; Value < 9.0f; ++Value)
	{
		Mock().ClearCalls();
		WriteAndReadBefore(Value);
		// Frame n writes what frame n - 1 reads, and both are in flight: only a barrier stands between them.
		const std::vector<FRTMockCall> Barriers = Mock().FindCalls(ERTMockCall::Barrier, "Mean");
		const auto Orders = [](const FRTMockCall& Call) {
			return Call.Numbers[0] == uint64_t(ERTAccess::ShaderRead) && Call.Numbers[1] == uint64_t(ERTAccess::CopyWrite);
		};
		EXPECT_EQ(std::count_if(Barriers.begin(), Barriers.end(), Orders), Value > 2.0f ? 1 : 0);
		if (Earlier > 0) { Mock().CompleteUpTo(Earlier); } // as a renderer waits: one stays in flight
		Earlier = Fence;
	}
	Mock().CompleteUpTo(Fence);
	EXPECT_EQ(ReadNewest<float>(), 7.0f);
	EXPECT_EQ(ReadNewest<float>(1), 8.0f);
	EXPECT_EQ(ReadNewest<float>(2), 6.0f);
}

// Culling ------------------------------------------------------------------------------------------------------------

TEST_F(FHistoryTest, WritingItKeepsNothingAliveAndThenItEnds)
{
	WriteAndReadBefore(1.0f);
	Mock().ClearCalls();
	Frame([&](FFrameGraph& Graph) {
		const FHistoryTexture Mean = Get();
		const FGraphTexture Filtered = Graph.CreateTexture({4, 4, ERTFormat::R32_FLOAT}, "Filtered");
		EXPECT_TRUE(Mean.Previous.IsValid());
		AddWriter(Graph, Mean.Current, 2.0f, Filtered); // and nobody reads it
	});
	EXPECT_THAT(GetPasses(), ElementsAre());
	Mock().ClearCalls();
	WriteAndReadBefore(3.0f);
	EXPECT_FALSE(bHadPrevious) << "nothing wrote it";
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::Barrier, "Mean").at(0).Numbers[0], uint64_t(ERTAccess::ShaderRead))
	    << "but the frame left it where histories rest";
	WriteAndReadBefore(4.0f);
	EXPECT_TRUE(bHadPrevious);
	EXPECT_EQ(ReadNewest<float>(), 3.0f);
}

TEST_F(FHistoryTest, APassWhoseOtherOutputIsReadWritesIt)
{
	for (int Index = 0; Index < 3; ++Index)
	{
		Frame([&](FFrameGraph& Graph) {
			const FHistoryTexture Mean = Get();
			EXPECT_EQ(Mean.Previous.IsValid(), Index > 0);
			const FGraphTexture Filtered = Graph.CreateTexture({4, 4, ERTFormat::R32_FLOAT}, "Filtered");
			AddWriter(Graph, Mean.Current, 2.0f, Filtered);
			AddReader(Graph, Filtered);
		});
	}
}

/// A pass that copies the G-buffer for the next frame has no reader in its own.
void AddUserOf(FFrameGraph& Graph, const FHistoryTexture& Surface, FGraphTexture Output)
{
	Graph.AddPass("User", [&](FPassBuilder& Builder) -> FPassExecute {
		if (Surface.Previous.IsValid()) { Builder.Read(Surface.Previous, ERTAccess::ShaderRead); }
		Builder.Keep(Surface.Current);
		Builder.Write(Output, ERTAccess::CopyWrite);
		return [=](FPassContext& Pass) {
			const float Zero[4] = {};
			Pass.Commands().ClearTexture(Pass.GetTexture(Output), Zero);
		};
	});
}

TEST_F(FHistoryTest, WhatAPassKeepsIsWrittenBeforeItAndBehindIt)
{
	for (const bool bWriterFirst : {true, false})
	{
		for (int Index = 0; Index < 4; ++Index)
		{
			Mock().ClearCalls();
			const bool bRead = Index != 2;
			Frame([&](FFrameGraph& Graph) {
				const FHistoryTexture Surface = Get(bWriterFirst ? "First" : "Second");
				EXPECT_EQ(Surface.Previous.IsValid(), Index == 1 || Index == 2);
				const FGraphTexture Output = Graph.CreateTexture({4, 4, ERTFormat::R32_FLOAT}, "Output");
				if (bWriterFirst) { AddWriter(Graph, Surface.Current, 1.0f); }
				AddUserOf(Graph, Surface, Output);
				if (!bWriterFirst) { AddWriter(Graph, Surface.Current, 1.0f); }
				if (bRead) { AddReader(Graph, Output); }
			});
			EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker, "Writer"), bRead ? 1u : 0u) << Index;
			EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker, "User"), bRead ? 1u : 0u) << Index;
		}
	}
}

TEST_F(FHistoryTest, WhatIsKeptMayKeepMore)
{
	Frame([&](FFrameGraph& Graph) {
		const FHistoryTexture A = Get("A"), B = Get("B"), Unused = Get("C");
		const FGraphTexture Output = Graph.CreateTexture({4, 4, ERTFormat::R32_FLOAT}, "Output");
		AddUserOf(Graph, A, Output);
		AddReader(Graph, Output);
		AddWriter(Graph, B.Current, 1.0f, {}, "WritesB");
		AddUserOf(Graph, B, A.Current); // writes A for the first, and keeps B for itself
		AddWriter(Graph, Unused.Current, 1.0f, {}, "WritesC");
	});
	EXPECT_THAT(GetPasses(), ElementsAre("User", "Reader", "WritesB", "User"));
	EXPECT_THAT(Dump, HasSubstr("keep    B"));
	EXPECT_THAT(Dump, HasSubstr("WritesC (culled)"));
}

TEST_F(FHistoryTest, KeepingWhatIsNotOfTheGraphIsAnError)
{
	FFrameGraph Graph(*Resources);
	Graph.AddPass("Bad", [](FPassBuilder& Builder) -> FPassExecute {
		Builder.Keep(FGraphTexture{77});
		return {};
	});
	const FRTStatus Status = Graph.Compile();
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_THAT(std::string(Status.Message), HasSubstr("'Bad' declares a texture that is not of this graph"));
}

// Its memory is another's in the next frame, or its writers are kept anyway: whoever says so is mistaken.
TEST_F(FHistoryTest, KeepingWhatIsNotForLaterIsAnError)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Mine = Graph.CreateTexture({4, 4, ERTFormat::R32_FLOAT}, "Mine");
	Graph.AddPass("Bad", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Keep(Mine);
		Builder.NeverCull();
		return {};
	});
	const FRTStatus Status = Graph.Compile();
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_THAT(std::string(Status.Message), AllOf(HasSubstr("'Bad'"), HasSubstr("'Mine'"), HasSubstr("MarkForLater")));
}

// Caches -------------------------------------------------------------------------------------------------------------

TEST_F(FHistoryTest, ACacheIsFreshUntilItIsWrittenAndKeepsItsContent)
{
	bool bFresh = false, bOfLastFrame = false;
	const auto Use = [&](uint32_t Value, FFrameCase Case, bool bRead = true) {
		Frame(
		    [&](FFrameGraph& Graph) {
			const FHistoryBuffer Cache = GetBuffer();
			bFresh = Cache.bFresh;
			bOfLastFrame = Cache.bOfLastFrame;
			if (Value > 0) { AddWriter(Graph, Cache.Buffer, Value); }
			if (bRead) { AddReader(Graph, Cache.Buffer); }
		    },
		    Case);
	};
	Use(1, {}, false);
	EXPECT_TRUE(bFresh);
	Use(1, {});
	EXPECT_TRUE(bFresh) << "nobody read it, so it was not written";
	Use(0, {});
	EXPECT_FALSE(bFresh);
	EXPECT_TRUE(bOfLastFrame);
	EXPECT_EQ(ReadNewest<uint32_t>(), 1u);
	Frame([](FFrameGraph&) {});
	Use(0, {});
	EXPECT_FALSE(bFresh) << "a frame that does not ask changes nothing";
	EXPECT_FALSE(bOfLastFrame) << "but what it holds is older";
	EXPECT_EQ(ReadNewest<uint32_t>(), 1u);
	Use(4, {});
	Use(1, {});
	Use(2, {.bSubmit = false});
	Use(0, {});
	EXPECT_FALSE(bFresh);
	EXPECT_TRUE(bOfLastFrame);
	EXPECT_EQ(ReadNewest<uint32_t>(), 1u) << "what was lost never ran";
	Use(3, {.bKeep = false});
	EXPECT_TRUE(bFresh) << "a cut";
	Use(0, {});
	EXPECT_EQ(ReadNewest<uint32_t>(), 3u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateBuffer, "Cache"), 1u);
	for (uint32_t Index = 0; Index < FHistoryResources::KeepFrames; ++Index)
	{
		Frame([](FFrameGraph&) {});
	}
	EXPECT_EQ(History->GetBytes(), 0u);
}

TEST_F(FHistoryTest, ACacheOfTheWorldOutlivesACutAndNotTheWorld)
{
	bool bFresh = false, bOfLastFrame = false;
	const auto Use = [&](FFrameCase Case, EHistoryScope Scope) {
		Frame(
		    [&](FFrameGraph& Graph) {
			const FHistoryBuffer Cache = GetBuffer("Cache", 64, Scope);
			bFresh = Cache.bFresh;
			bOfLastFrame = Cache.bOfLastFrame;
			AddWriter(Graph, Cache.Buffer, 1);
			AddReader(Graph, Cache.Buffer);
		    },
		    Case);
		return bFresh;
	};
	Use({}, EHistoryScope::World);
	EXPECT_FALSE(Use({.bKeep = false, .bKeepWorld = true}, EHistoryScope::World));
	EXPECT_TRUE(Use({.bKeep = false}, EHistoryScope::World)) << "another world";
	Use({}, EHistoryScope::View);
	EXPECT_TRUE(Use({.bKeep = false, .bKeepWorld = true}, EHistoryScope::View)) << "the view's own";
}

TEST_F(FHistoryTest, ACacheOfAnotherSizeIsFresh)
{
	for (const uint64_t Size : {64u, 64u, 128u})
	{
		Frame([&](FFrameGraph& Graph) {
			const FHistoryBuffer Cache = GetBuffer("Cache", Size);
			EXPECT_EQ(Cache.bFresh, Readbacks.size() != 1);
			AddWriter(Graph, Cache.Buffer, 1);
			AddReader(Graph, Cache.Buffer);
		});
	}
	EXPECT_EQ(History->GetBytes(), 128u);
}

// Faults -------------------------------------------------------------------------------------------------------------

TEST_F(FHistoryTest, NoMemoryIsAnErrorAndTheNextFrameTriesAgain)
{
	for (const uint32_t Failing : {1u, 2u})
	{
		History->Clear();
		FFrameGraph Graph(*Resources);
		History->BeginFrame(Graph, true);
		Mock().FailEveryAllocation(Failing);
		FHistoryTexture Mean;
		const FRTStatus Status = History->GetTexture("Mean", {4, 4, ERTFormat::R32_FLOAT, ERTTextureUsage::CopySource}, Mean);
		Mock().FailEveryAllocation(0);
		if (Failing == 1)
		{
			EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
			EXPECT_FALSE(Mean.Current.IsValid());
			EXPECT_EQ(History->GetBytes(), 0u);
		}
		else { EXPECT_TRUE(Status) << "the second try, when what was released is gone"; }
		History->EndFrame(false);
	}
	WriteAndReadBefore(1.0f);
	WriteAndReadBefore(2.0f);
	EXPECT_EQ(ReadNewest<float>(), 1.0f);
}

} // namespace
} // namespace Lantern
