// The frame graph on the mock device: what runs, which barriers, which memory.
#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "FrameGraphTestBase.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// -------------------------------------------------------------------------------------------------- culling

// What GetDesc returns lies in a list that grows (the address sanitizer sees what is read from where it was).
TEST_F(FrameGraphTest, ResourcesAreMadeLikeOthers)
{
	FFrameGraph Graph(*Resources);
	FGraphTexture Texture = Graph.CreateTexture({7, 5, ERTFormat::R16_FLOAT}, "First");
	FGraphBuffer Buffer = Graph.CreateBuffer({12}, "First");
	for (int I = 0; I < 200; ++I)
	{
		Texture = Graph.CreateTexture(Graph.GetDesc(Texture), "Next");
		Buffer = Graph.CreateBuffer(Graph.GetDesc(Buffer), "Next");
		ASSERT_EQ(Graph.GetDesc(Texture).Width, 7u);
		ASSERT_EQ(Graph.GetDesc(Texture).Format, ERTFormat::R16_FLOAT);
		ASSERT_EQ(Graph.GetDesc(Buffer).Size, 12u);
	}
}

TEST_F(FrameGraphTest, AChainThatNobodyReadsIsCulledToItsRoot)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B"), C = MakeTexture(Graph, "C");
	AddPass(Graph, "MakeA", {}, {{A, Storage}});
	AddPass(Graph, "AtoB", {{A, Sampled}}, {{B, Storage}});
	AddPass(Graph, "BtoC", {{B, Sampled}}, {{C, Storage}});
	EXPECT_THAT(Run(Graph), IsEmpty());
	EXPECT_EQ(Graph.GetPassCount(), 3u);
	EXPECT_EQ(Graph.GetCulledPassCount(), 3u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateTexture), 0u) << "a culled pass must cost no memory";
}

TEST_F(FrameGraphTest, OnlyWhatLeadsToAnImportedResourceRuns)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B"), Side = MakeTexture(Graph, "Side");
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "MakeA", {}, {{A, Storage}});
	AddPass(Graph, "AtoB", {{A, Sampled}}, {{B, Storage}});
	AddPass(Graph, "AtoSide", {{A, Sampled}}, {{Side, Storage}});
	AddPass(Graph, "BtoOut", {{B, Sampled}}, {{Out, Storage}});
	AddPass(Graph, "AfterLastRead", {{A, Sampled}}, {{B, Storage}});
	EXPECT_THAT(Run(Graph), ElementsAre("MakeA", "AtoB", "BtoOut"));
	EXPECT_EQ(Graph.GetCulledPassCount(), 2u);
}

TEST_F(FrameGraphTest, NeverCullKeepsAPassAndWhatItReads)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A");
	AddPass(Graph, "MakeA", {}, {{A, Storage}});
	Graph.AddPass("Probe", [&](FPassBuilder& B) {
		B.Read(A, Sampled);
		B.NeverCull();
		return [this](FPassContext&) { Ran.push_back("Probe"); };
	});
	EXPECT_THAT(Run(Graph), ElementsAre("MakeA", "Probe"));
}

TEST_F(FrameGraphTest, EarlierPartialWritersOfAReadResourceAreKept)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A"), Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "Clear", {}, {{A, ERTAccess::CopyWrite}});
	AddPass(Graph, "Half", {}, {{A, Storage}});
	AddPass(Graph, "Use", {{A, Sampled}}, {{Out, Storage}});
	EXPECT_THAT(Run(Graph), ElementsAre("Clear", "Half", "Use"));
}

TEST_F(FrameGraphTest, APassToggledOffTakesItsMemoryAndItsUpstreamWithIt)
{
	for (const bool bFog : {true, false, true})
	{
		Mock().ClearCalls();
		FFrameGraph Graph(*Resources);
		const FGraphTexture Noise = MakeTexture(Graph, "Noise"), Fog = MakeTexture(Graph, "Fog", 32);
		const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "Noise", {}, {{Noise, Storage}});
		if (bFog)
		{
			AddPass(Graph, "Fog", {{Noise, Sampled}}, {{Fog, Storage}});
			AddPass(Graph, "Composite", {{Fog, Sampled}}, {{Out, Storage}});
			EXPECT_THAT(Run(Graph), ElementsAre("Noise", "Fog", "Composite"));
		}
		else
		{
			AddPass(Graph, "Composite", {}, {{Out, Storage}});
			EXPECT_THAT(Run(Graph), ElementsAre("Composite"));
		}
		Resources->Trim(1);
	}
}

// ------------------------------------------------------------------------------------------------- barriers

TEST_F(FrameGraphTest, BarriersOfAWriteReadWriteChainAreExact)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A");
	const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::HostRead);
	AddPass(Graph, "Write", {}, {{A, Storage}});
	AddPass(Graph, "Read1", {{A, Sampled}}, {{Out, Storage}});
	AddPass(Graph, "Read2", {{A, Sampled}}, {{Out, Storage}});
	AddPass(Graph, "Again", {}, {{A, Storage}});
	AddPass(Graph, "Copy", {{A, ERTAccess::CopyRead}}, {{Out, ERTAccess::CopyWrite}});
	Run(Graph);
	EXPECT_THAT(Trace(), ElementsAre("[Write", "A: None -> StorageWrite", "]",                              //
	                         "[Read1", "A: StorageWrite -> ShaderRead", "]",                                //
	                         "[Read2", "Out: StorageWrite -> StorageWrite", "]",                            //
	                         "[Again", "A: ShaderRead -> StorageWrite", "]",                                //
	                         "[Copy", "A: StorageWrite -> CopyRead", "Out: StorageWrite -> CopyWrite", "]", //
	                         "Out: CopyWrite -> HostRead"));
}

TEST_F(FrameGraphTest, BarriersOfOnePassAreOneCall)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B"), C = MakeTexture(Graph, "C");
	Graph.AddPass("Three", [&](FPassBuilder& Builder) {
		Builder.Write(A, Storage);
		Builder.Write(B, ERTAccess::RenderTarget);
		Builder.Write(C, ERTAccess::CopyWrite);
		Builder.NeverCull();
		return [](FPassContext&) {};
	});
	Run(Graph);
	EXPECT_THAT(Trace(), ElementsAre("[Three", "A: None -> StorageWrite", "B: None -> RenderTarget", "C: None -> CopyWrite", "]"));
}

TEST_F(FrameGraphTest, DifferentReadsOfABufferAreEnteredTogether)
{
	FFrameGraph Graph(*Resources);
	const FGraphBuffer Args = MakeBuffer(Graph, "Args");
	const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "Make", {}, {{Args, Storage}});
	AddPass(Graph, "Shade", {{Args, Sampled}}, {{Out, Storage}});
	AddPass(Graph, "Draw", {{Args, ERTAccess::IndirectRead}}, {{Out, Storage}});
	Run(Graph);
	EXPECT_THAT(Trace(), ElementsAre("[Make", "]", "[Shade", "Args: StorageWrite -> ShaderRead|IndirectRead", "]", "[Draw",
	                         "Out: StorageWrite -> StorageWrite", "]"));
}

TEST_F(FrameGraphTest, DifferentReadsOfATextureNeedALayoutChange)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A");
	const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "Make", {}, {{A, Storage}});
	AddPass(Graph, "Sample", {{A, Sampled}}, {{Out, Storage}});
	AddPass(Graph, "Load", {{A, ERTAccess::StorageRead}}, {});
	AddPass(Graph, "Load2", {{A, ERTAccess::StorageRead}}, {{Out, Storage}});
	Run(Graph);
	EXPECT_THAT(Trace(), ElementsAre("[Make", "A: None -> StorageWrite", "]", "[Sample", "A: StorageWrite -> ShaderRead", "]", "[Load2",
	                         "A: ShaderRead -> StorageRead", "Out: StorageWrite -> StorageWrite", "]"));
}

TEST_F(FrameGraphTest, ReadModifyWriteIsOneState)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = ImportTexture(Graph, "A", Sampled, Sampled);
	AddPass(Graph, "Blend", {{A, ERTAccess::StorageRead}}, {{A, Storage}});
	Run(Graph);
	EXPECT_THAT(
	    Trace(), ElementsAre("[Blend", "A: ShaderRead -> StorageRead|StorageWrite", "]", "A: StorageRead|StorageWrite -> ShaderRead"));
}

TEST_F(FrameGraphTest, ImportedResourcesStartAndEndAsTold)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Depth = ImportTexture(Graph, "Depth", ERTAccess::DepthWrite, Sampled);
	const FGraphTexture Same = ImportTexture(Graph, "Same", Sampled, Sampled);
	const FGraphTexture Unused = ImportTexture(Graph, "Unused", ERTAccess::RenderTarget, Sampled);
	const FGraphTexture Left = ImportTexture(Graph, "Left", Sampled, ERTAccess::None);
	AddPass(Graph, "P", {{Depth, Sampled}, {Same, Sampled}}, {{Left, Storage}});
	Run(Graph);
	EXPECT_TRUE(Unused.IsValid());
	EXPECT_THAT(Trace(), ElementsAre("[P", "Depth: DepthWrite -> ShaderRead", "Left: ShaderRead -> StorageWrite", "]",
	                         "Unused: RenderTarget -> ShaderRead"));
}

TEST_F(FrameGraphTest, ImportingTwiceGivesTheSameResource)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = ImportTexture(Graph, "Twice", ERTAccess::None, ERTAccess::None);
	const FGraphTexture B = Graph.ImportTexture(Held.back().Get(), ERTAccess::None, Sampled, "Twice");
	EXPECT_EQ(A.Index, B.Index);
	AddPass(Graph, "W", {}, {{A, Storage}});
	Run(Graph);
	EXPECT_THAT(Trace(), ElementsAre("[W", "Twice: None -> StorageWrite", "]", "Twice: StorageWrite -> ShaderRead"));
}

// ------------------------------------------------------------------------------------------------ transients

TEST_F(FrameGraphTest, UsageFollowsFromTheAccessesOfPassesThatRun)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A");
	const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
	const FGraphTexture Nobody = MakeTexture(Graph, "Nobody");
	ERTTextureUsage Usage = ERTTextureUsage::None;
	AddPass(Graph, "Draw", {}, {{A, ERTAccess::RenderTarget}});
	Graph.AddPass("Copy", [&](FPassBuilder& B) {
		B.Read(A, ERTAccess::CopyRead);
		B.Write(Out, ERTAccess::CopyWrite);
		return [&, A](FPassContext& C) { Usage = C.GetTexture(A)->GetDesc().Usage; };
	});
	AddPass(Graph, "Culled", {{A, Sampled}}, {{Nobody, Storage}});
	Run(Graph);
	EXPECT_EQ(Usage, ERTTextureUsage::RenderTarget | ERTTextureUsage::CopySource);
}

TEST_F(FrameGraphTest, MemoryIsSharedByThoseThatDoNotOverlap)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B"), C = MakeTexture(Graph, "C");
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "1", {}, {{A, Storage}});
	AddPass(Graph, "2", {{A, Sampled}}, {{B, Storage}});
	AddPass(Graph, "3", {{B, Sampled}}, {{C, Storage}});
	AddPass(Graph, "4", {{C, Sampled}}, {{Out, Storage}});
	Run(Graph);
	EXPECT_THAT(Mock().GetCreatedTextures(), ElementsAre("Out", "A", "B")) << "C takes the place of A";
	// The new tenant waits for the old one's readers.
	EXPECT_THAT(Trace(), ElementsAre("[1", "A: None -> StorageWrite", "]",                                //
	                         "[2", "A: StorageWrite -> ShaderRead", "B: None -> StorageWrite", "]",       //
	                         "[3", "B: StorageWrite -> ShaderRead", "A: ShaderRead -> StorageWrite", "]", //
	                         "[4", "A: StorageWrite -> ShaderRead", "Out: None -> StorageWrite", "]"));
	EXPECT_EQ(Resources->GetPooledBytes(), 2u * 64 * 64 * 4);
	EXPECT_THAT(Graph.Dump(), HasSubstr("in place of 'A'"));
}

TEST_F(FrameGraphTest, OtherDescriptionsDoNotShare)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A", 64), B = MakeTexture(Graph, "B", 32);
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "1", {}, {{A, Storage}});
	AddPass(Graph, "2", {{A, Sampled}}, {{Out, Storage}});
	AddPass(Graph, "3", {}, {{B, Storage}});
	AddPass(Graph, "4", {{B, Sampled}}, {{Out, Storage}});
	Run(Graph);
	EXPECT_THAT(Mock().GetCreatedTextures(), ElementsAre("Out", "A", "B"));
}

TEST_F(FrameGraphTest, TheNextFrameReusesByNameAndWaitsForThisOne)
{
	for (int Frame = 0; Frame < 3; ++Frame)
	{
		Mock().ClearCalls();
		FFrameGraph Graph(*Resources);
		const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B");
		const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "1", {}, {{A, Storage}, {B, Storage}});
		AddPass(Graph, "2", {{A, Sampled}, {B, Sampled}}, {{Out, Storage}});
		Run(Graph);
		EXPECT_EQ(Mock().GetCreatedTextures().size(), Frame == 0 ? 2u : 0u);
		const char* From = Frame == 0 ? "None" : "ShaderRead";
		EXPECT_THAT(
		    Trace(), ElementsAre("[1", std::string("A: ") + From + " -> StorageWrite", std::string("B: ") + From + " -> StorageWrite", "]",
		                 "[2", "A: StorageWrite -> ShaderRead", "B: StorageWrite -> ShaderRead", "]"));
	}
}

TEST_F(FrameGraphTest, TrimFreesWhatWasNotUsedForAWhile)
{
	const auto Frame = [&](uint32_t Size) {
		FFrameGraph Graph(*Resources);
		const FGraphTexture A = MakeTexture(Graph, "A", Size);
		const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "1", {}, {{A, Storage}});
		AddPass(Graph, "2", {{A, Sampled}}, {{Out, Storage}});
		Run(Graph);
	};
	Frame(64);
	for (int I = 0; I < 3; ++I) { Frame(32); }
	Resources->Trim(4);
	EXPECT_EQ(Resources->GetPooledBytes(), 4u * (64 * 64 + 32 * 32));
	Resources->Trim(3);
	EXPECT_EQ(Resources->GetPooledBytes(), 4u * 32 * 32);
	Resources->Trim(0);
	EXPECT_EQ(Resources->GetPooledBytes(), 0u);
}

// Nobody calls Trim. What the device still uses stays until it is done.
TEST_F(FrameGraphTest, ThePoolHoldsWhatTheLastFramesUsed)
{
	constexpr uint32_t KeepFrames = 8; // r.RT.FrameGraph.KeepFrames
	const auto Frame = [&](uint32_t Size) {
		FFrameGraph Graph(*Resources);
		const FGraphTexture A = MakeTexture(Graph, "A", Size);
		const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "1", {}, {{A, Storage}});
		AddPass(Graph, "2", {{A, Sampled}}, {{Out, Storage}});
		Run(Graph);
	};
	Mock().SetManualFences(true);
	std::vector<uint64_t> Used;
	for (uint32_t Size = 1; Size <= 40; ++Size)
	{
		Frame(Size);
		Used.push_back(4ull * Size * Size);
		const auto Oldest = Used.end() - std::min<ptrdiff_t>(KeepFrames, Used.end() - Used.begin());
		EXPECT_EQ(Resources->GetPooledBytes(), std::accumulate(Oldest, Used.end(), uint64_t(0))) << Size;
	}
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "A"), 0u) << "in flight";
	Mock().SetManualFences(false);
	Device->CollectGarbage();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Destroy, "A"), 40u - KeepFrames);
}

TEST_F(FrameGraphTest, TwoGraphsCompiledAtOnceDoNotShare)
{
	FFrameGraph One(*Resources), Two(*Resources);
	const FGraphTexture A = MakeTexture(One, "A"), B = MakeTexture(Two, "B");
	IRTTexture *First = nullptr, *Second = nullptr;
	const auto Add = [](FFrameGraph& Graph, FGraphTexture Texture, IRTTexture*& Out) {
		Graph.AddPass("W", [&](FPassBuilder& Builder) {
			Builder.Write(Texture, Storage);
			Builder.NeverCull();
			return [&Out, Texture](FPassContext& C) { Out = C.GetTexture(Texture); };
		});
	};
	Add(One, A, First);
	Add(Two, B, Second);
	ASSERT_TRUE(One.Compile().IsOk());
	ASSERT_TRUE(Two.Compile().IsOk());
	Resources->Trim(0); // may not take what a compiled graph holds
	Run(One);
	Run(Two);
	EXPECT_NE(First, nullptr);
	EXPECT_NE(First, Second);
}

/// Two outputs, one of them only for who reads it.
TEST_F(FrameGraphTest, OutputsThatNobodyReadsAreNotMade)
{
	for (const bool bRead : {false, true})
	{
		MakeDevice();
		FFrameGraph Graph(*Resources);
		const FGraphTexture Color = MakeTexture(Graph, "Color"), Motion = MakeTexture(Graph, "Motion");
		const FGraphTexture Unread = MakeTexture(Graph, "Unread");
		const FGraphTexture Result = ImportTexture(Graph, "Result", ERTAccess::None, ERTAccess::ShaderRead);
		bool bMade = false;
		Graph.AddPass("Raster", [&](FPassBuilder& Builder) {
			Builder.Write(Color, ERTAccess::RenderTarget);
			Builder.WriteIfRead(Motion, ERTAccess::RenderTarget);
			return [&bMade, Motion](FPassContext& C) { bMade = C.GetTexture(Motion) != nullptr; };
		});
		AddPass(Graph, "Nobody", {{Motion, ERTAccess::ShaderRead}}, {{Unread, Storage}}); // culled, and does not count
		std::vector<FTestUse> Reads = {{Color, ERTAccess::ShaderRead}};
		if (bRead) { Reads.push_back({Motion, ERTAccess::ShaderRead}); }
		AddPass(Graph, "Compose", Reads, {{Result, Storage}});
		EXPECT_EQ(Run(Graph), std::vector<std::string>({"Compose"}));
		EXPECT_EQ(bMade, bRead);
		const std::vector<std::string> Created = Mock().GetCreatedTextures();
		EXPECT_EQ(std::count(Created.begin(), Created.end(), "Motion"), bRead ? 1 : 0);
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::Barrier, "Motion"), bRead ? 2u : 0u);
	}
}

// What a pass also reads is no output alone: it must be there.
TEST_F(FrameGraphTest, WhatAPassReadsItselfIsMadeThoughNobodyElseReadsIt)
{
	MakeDevice();
	FFrameGraph Graph(*Resources);
	const FGraphTexture Sum = MakeTexture(Graph, "Sum");
	const FGraphTexture Result = ImportTexture(Graph, "Result", ERTAccess::None, ERTAccess::ShaderRead);
	AddPass(Graph, "Clear", {}, {{Sum, Storage}});
	bool bMade = false;
	Graph.AddPass("Add", [&](FPassBuilder& Builder) {
		Builder.Read(Sum, ERTAccess::StorageRead);
		Builder.WriteIfRead(Sum, Storage);
		Builder.Write(Result, Storage);
		return [&bMade, Sum](FPassContext& C) { bMade = C.GetTexture(Sum) != nullptr; };
	});
	EXPECT_EQ(Run(Graph), std::vector<std::string>({"Clear"}));
	EXPECT_TRUE(bMade);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Barrier, "Sum"), 2u) << "and it waits for what was written before";
}

} // namespace
} // namespace Lantern
