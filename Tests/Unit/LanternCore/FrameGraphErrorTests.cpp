// The frame graph on the mock device: errors, timings, the dump.
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

// --------------------------------------------------------------------------------------------------- errors

TEST_F(FrameGraphTest, OutOfMemoryNamesTheResourceAndRecordsNothing)
{
	for (const uint32_t Failing : {1u, 2u, 3u})
	{
		MakeDevice();
		FFrameGraph Graph(*Resources);
		std::vector<FGraphTexture> Chain;
		for (const char* Name : {"First", "Second", "Third"}) { Chain.push_back(MakeTexture(Graph, Name, 16 << Chain.size())); }
		const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "P0", {}, {{Chain[0], Storage}});
		AddPass(Graph, "P1", {{Chain[0], Sampled}}, {{Chain[1], Storage}});
		AddPass(Graph, "P2", {{Chain[1], Sampled}}, {{Chain[2], Storage}});
		AddPass(Graph, "P3", {{Chain[2], Sampled}}, {{Out, Storage}});
		Mock().FailAllocation(Failing);
		const FRTStatus Status = Execute(Graph);
		EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
		const char* Names[] = {"'First' (16x16 R32_FLOAT)", "'Second' (32x32", "'Third' (64x64"};
		EXPECT_THAT(Status.Message, HasSubstr(Names[Failing - 1]));
		EXPECT_THAT(Status.Message, HasSubstr("'P" + std::to_string(Failing - 1) + "'"));
		EXPECT_THAT(Trace(), IsEmpty());
	}
}

TEST_F(FrameGraphTest, AfterAFailedFrameTheNextOneRuns)
{
	const auto Build = [&](FFrameGraph& Graph) {
		const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B", 32);
		const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "1", {}, {{A, Storage}, {B, Storage}});
		AddPass(Graph, "2", {{A, Sampled}, {B, Sampled}}, {{Out, Storage}});
	};
	{
		FFrameGraph Graph(*Resources);
		Build(Graph);
		Mock().FailAllocation(2);
		EXPECT_FALSE(Execute(Graph).IsOk());
	}
	FFrameGraph Graph(*Resources);
	Build(Graph);
	EXPECT_THAT(Run(Graph), ElementsAre("1", "2"));
}

TEST_F(FrameGraphTest, IdleLeftoversGiveWayWhenMemoryIsShort)
{
	{
		FFrameGraph Graph(*Resources);
		const FGraphTexture Old = MakeTexture(Graph, "Old", 128);
		const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
		AddPass(Graph, "1", {}, {{Old, Storage}});
		AddPass(Graph, "2", {{Old, Sampled}}, {{Out, Storage}});
		Run(Graph);
	}
	FFrameGraph Graph(*Resources);
	const FGraphTexture New = MakeTexture(Graph, "New");
	const FGraphBuffer Out = ImportBuffer(Graph, "Out2", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "1", {}, {{New, Storage}});
	AddPass(Graph, "2", {{New, Sampled}}, {{Out, Storage}});
	Mock().FailAllocation(1);
	EXPECT_THAT(Run(Graph), ElementsAre("1", "2"));
	EXPECT_EQ(Resources->GetPooledBytes(), 64u * 64 * 4) << "the old one is gone";
}

TEST_F(FrameGraphTest, WrongDeclarationsAreErrorsThatNamePassAndResource)
{
	struct FCase
	{
		const char* Text;
		std::function<void(FPassBuilder&, FGraphTexture, FGraphBuffer)> Declare;
	};
	const FCase Cases[] =
	    {
	        {"no pass before it writes", [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) { B.Read(T, Sampled); }},
	        {"no pass before it writes", [](FPassBuilder& B, FGraphTexture, FGraphBuffer F) { B.Read(F, Sampled); }},
	        {"no pass before it writes",
	            [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) {
		B.Read(T, ERTAccess::StorageRead);
		B.Write(T, Storage);
	         }},
	        {"writing access with Read()", [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) { B.Read(T, Storage); }},
	        {"reading access with Write()", [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) { B.Write(T, Sampled); }},
	        {"exclude each other",
	            [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) {
		B.Write(T, ERTAccess::RenderTarget);
		B.Write(T, Storage);
	         }},
	            {"as only a buffer can be", [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) { B.Read(T, ERTAccess::IndexRead); }},
	            {"as only a texture can be", [](FPassBuilder& B, FGraphTexture, FGraphBuffer F) { B.Write(F, ERTAccess::RenderTarget); }},
	            {"on the host", [](FPassBuilder& B, FGraphTexture, FGraphBuffer F) { B.Read(F, ERTAccess::HostRead); }},
	            {"not of this graph", [](FPassBuilder& B, FGraphTexture, FGraphBuffer) { B.Read(FGraphTexture(), Sampled); }},
	            {"not of this graph", [](FPassBuilder& B, FGraphTexture T, FGraphBuffer) { B.Read(FGraphBuffer{T.Index}, Sampled); }},
	            };
	for (const FCase& Case : Cases)
	{
		FFrameGraph Graph(*Resources);
		const FGraphTexture Texture = MakeTexture(Graph, "TheResource");
		const FGraphBuffer Buffer = MakeBuffer(Graph, "TheResource");
		Graph.AddPass("ThePass", [&](FPassBuilder& B) {
			Case.Declare(B, Texture, Buffer);
			B.NeverCull();
			return [](FPassContext&) { ADD_FAILURE() << "ran"; };
		});
		const FRTStatus Status = Execute(Graph);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		EXPECT_THAT(Status.Message, HasSubstr(Case.Text));
		EXPECT_THAT(Status.Message, HasSubstr("'ThePass'"));
		if (std::string(Case.Text) != "not of this graph") { EXPECT_THAT(Status.Message, HasSubstr("'TheResource'")); }
	}
}

TEST_F(FrameGraphTest, AnImportedTextureWithoutContentsCannotBeRead)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture In = ImportTexture(Graph, "In", ERTAccess::None, ERTAccess::None);
	const FGraphBuffer Out = ImportBuffer(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "P", {{In, Sampled}}, {{Out, Storage}});
	EXPECT_THAT(Execute(Graph).Message, HasSubstr("'In'"));
}

#if !defined(NDEBUG)
TEST_F(FrameGraphTest, GettingWhatWasNotDeclaredAsserts)
{
	testing::FLAGS_gtest_death_test_style = "threadsafe";
	EXPECT_DEATH(
	    {
		    FFrameGraph Graph(*Resources);
		    const FGraphTexture A = MakeTexture(Graph, "A");
		    Graph.AddPass("P", [&](FPassBuilder& B) {
			    B.NeverCull();
			    return [A](FPassContext& C) { C.GetTexture(A); };
		    });
		    Run(Graph);
	    },
	    "may use only what it declared");
}
#endif

// -------------------------------------------------------------------------------------------------- numbers

TEST_F(FrameGraphTest, TimingsComeWithTheGpuAndNeverFromAnEarlierFrame)
{
	Mock().SetManualFences(true);
	const auto Frame = [&](const char* Name, uint64_t Rays) {
		FFrameGraph Graph(*Resources);
		Graph.AddPass(Name, [&](FPassBuilder& B) {
			B.NeverCull();
			return [Rays](FPassContext& C) {
				C.CountRays(Rays);
				C.CountRays(1);
			};
		});
		Graph.AddPass("Culled", [](FPassBuilder&) { return [](FPassContext&) {}; });
		Run(Graph);
		return Fence;
	};
	const auto Newest = [&] { return Resources->GetTimings().empty() ? "" : Resources->GetTimings()[0].Name; };
	const FRTFence One = Frame("One", 10);
	EXPECT_EQ(Newest(), "");
	Mock().CompleteUpTo(One);
	ASSERT_EQ(Resources->GetTimings().size(), 1u) << "culled passes are absent";
	EXPECT_EQ(Newest(), "One");
	EXPECT_EQ(Resources->GetTimings()[0].Rays, 11u);
	EXPECT_GE(Resources->GetTimings()[0].GpuMs, 0.0);
	EXPECT_GE(Resources->GetTimings()[0].CpuMs, 0.0);

	// Reuses the query pool of One, in which the old times still stand.
	Frame("Two", 20);
	EXPECT_EQ(Newest(), "One");
	const FRTFence Three = Frame("Three", 30);
	EXPECT_EQ(Newest(), "One");
	Mock().CompleteUpTo(Three);
	EXPECT_EQ(Newest(), "Three");
	EXPECT_LE(Mock().CountCalls(ERTMockCall::CreateQueryPool), 2u);
}

TEST_F(FrameGraphTest, ManyFramesThatNeverFinishDoNotGrowTheRing)
{
	Mock().SetManualFences(true);
	for (int I = 0; I < 50; ++I)
	{
		FFrameGraph Graph(*Resources);
		Graph.AddPass("P", [](FPassBuilder& B) {
			B.NeverCull();
			return [](FPassContext&) {};
		});
		Run(Graph);
	}
	EXPECT_LE(Mock().CountCalls(ERTMockCall::CreateQueryPool), 8u);
}

TEST_F(FrameGraphTest, EveryPassStandsInItsMarkerWithTwoTimestamps)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
	AddPass(Graph, "P", {}, {{Out, Storage}});
	Run(Graph);
	std::vector<ERTMockCall> Kinds;
	for (const FRTMockCall& Call : Mock().GetCalls()) { Kinds.push_back(Call.Kind); }
	const std::vector<ERTMockCall> Expected = {ERTMockCall::ResetQueries, ERTMockCall::BeginMarker, ERTMockCall::WriteTimestamp,
	    ERTMockCall::Barrier, ERTMockCall::WriteTimestamp, ERTMockCall::EndMarker, ERTMockCall::End};
	const auto Begin = std::find(Kinds.begin(), Kinds.end(), ERTMockCall::ResetQueries);
	ASSERT_GE(static_cast<size_t>(Kinds.end() - Begin), Expected.size());
	EXPECT_EQ(std::vector<ERTMockCall>(Begin, Begin + static_cast<long>(Expected.size())), Expected);
}

TEST_F(FrameGraphTest, TheDumpShowsPassesBarriersAndResources)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A"), Lost = MakeTexture(Graph, "Lost");
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::RenderTarget, Sampled);
	AddPass(Graph, "Make", {}, {{A, Storage}});
	AddPass(Graph, "Waste", {{A, Sampled}}, {{Lost, Storage}});
	AddPass(Graph, "Use", {{A, Sampled}}, {{Out, Storage}});
	ASSERT_TRUE(Graph.Compile().IsOk());
	EXPECT_EQ(Graph.Dump(), "frame graph: 3 passes, 1 culled, 4 barriers\n"
	                        "    0 Make\n"
	                        "      barrier A  None -> StorageWrite\n"
	                        "      write   A  StorageWrite\n"
	                        "    1 Waste (culled)\n"
	                        "      read    A  ShaderRead\n"
	                        "      write   Lost  StorageWrite\n"
	                        "    2 Use\n"
	                        "      barrier A  StorageWrite -> ShaderRead\n"
	                        "      barrier Out  RenderTarget -> StorageWrite\n"
	                        "      read    A  ShaderRead\n"
	                        "      write   Out  StorageWrite\n"
	                        "  end\n"
	                        "      barrier Out  StorageWrite -> ShaderRead\n"
	                        "resources\n"
	                        "  texture 'A' (64x64 R32_FLOAT), transient, passes 0 to 2, 16384 bytes\n"
	                        "  texture 'Lost' (64x64 R32_FLOAT), transient, unused\n"
	                        "  texture 'Out' (64x64 R32_FLOAT), imported, passes 2 to 2\n");
}

TEST_F(FrameGraphTest, AThousandPassesNeedOnlyTwoTextures)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::None);
	FGraphTexture Last = MakeTexture(Graph, "T");
	AddPass(Graph, "First", {}, {{Last, Storage}});
	for (int I = 0; I < 1000; ++I)
	{
		const FGraphTexture Next = MakeTexture(Graph, "T");
		AddPass(Graph, "Step", {{Last, Sampled}}, {{Next, Storage}});
		Last = Next;
	}
	AddPass(Graph, "Final", {{Last, Sampled}}, {{Out, Storage}});
	EXPECT_EQ(Run(Graph).size(), 1002u);
	EXPECT_EQ(Mock().GetCreatedTextures().size(), 3u);
}

} // namespace
} // namespace Lantern
