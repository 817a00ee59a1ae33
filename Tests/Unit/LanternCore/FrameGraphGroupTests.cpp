// Passes of one group: what moves together, what must not, and what lies between them.
#include <algorithm>
#include <map>

#include <gmock/gmock.h>

#include "FrameGraphTestBase.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;

constexpr const char* Group = "Rays";

class FFrameGraphGroupTest : public FFrameGraphTestBase
{
protected:
	void TearDown() override
	{
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		FFrameGraphTestBase::TearDown();
	}
	/// A pass of the group. Apart: buffers that it shares with others of the group.
	void AddMember(FFrameGraph& Graph, const std::string& Name, std::vector<FGraphTexture> Reads, std::vector<FGraphTexture> Writes,
	    std::vector<FGraphBuffer> Apart = {}, bool bShared = true)
	{
		Graph.AddPass(Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
			for (const FGraphTexture Texture : Reads) { Builder.Read(Texture, Sampled); }
			for (const FGraphTexture Texture : Writes) { Builder.Write(Texture, Storage); }
			for (const FGraphBuffer Buffer : Apart)
			{
				Builder.Write(Buffer, Storage);
				if (bShared) { Builder.ShareApart(Buffer); }
			}
			Builder.NeverCull();
			Builder.RunBeside(Group);
			return [this, Name, Reads, Writes](FPassContext& Context) {
				Ran.push_back(Name);
				for (const FGraphTexture Texture : Reads) { Used[Name].push_back(Context.GetTexture(Texture)); }
				for (const FGraphTexture Texture : Writes) { Used[Name].push_back(Context.GetTexture(Texture)); }
			};
		});
	}
	std::map<std::string, std::vector<IRTTexture*>> Used;
};

/// The second member's list is made before the first, and what reads the first's result comes behind both.
TEST_F(FFrameGraphGroupTest, MembersMoveTogetherWithWhatTheyNeed)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Image = MakeTexture(Graph, "Image"), Filtered = MakeTexture(Graph, "Filtered"), Listed = MakeTexture(Graph, "List"),
	                    Other = MakeTexture(Graph, "Other");
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::ShaderRead, ERTAccess::ShaderRead);
	AddMember(Graph, "First", {}, {Image});
	AddPass(Graph, "Filter", {{Image, Sampled}}, {{Filtered, Storage}});
	AddPass(Graph, "Fill", {}, {{Listed, Storage}});
	AddMember(Graph, "Second", {Listed}, {Other});
	AddPass(Graph, "Compose", {{Filtered, Sampled}, {Other, Sampled}}, {{Out, Storage}});
	EXPECT_THAT(Run(Graph), ElementsAre("Fill", "First", "Second", "Filter", "Compose"));
	const std::vector<std::string> Lines = Trace();
	const auto Second = std::find(Lines.begin(), Lines.end(), "[Second");
	ASSERT_NE(Second, Lines.end());
	EXPECT_EQ(*(Second - 1), "]") << "the first has ended";
	EXPECT_EQ(*(Second + 1), "]") << "the second begins without a barrier";
}

TEST_F(FFrameGraphGroupTest, AMemberThatNeedsAnotherStaysBehind)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Image = MakeTexture(Graph, "Image"), Filtered = MakeTexture(Graph, "Filtered"), Other = MakeTexture(Graph, "Other");
	AddMember(Graph, "First", {}, {Image});
	AddPass(Graph, "Filter", {{Image, Sampled}}, {{Filtered, Storage}});
	AddMember(Graph, "Second", {Filtered}, {Other});
	AddMember(Graph, "Third", {}, {MakeTexture(Graph, "Third")});
	EXPECT_THAT(Run(Graph), ElementsAre("First", "Third", "Filter", "Second"));
}

TEST_F(FFrameGraphGroupTest, WhatIsWrittenApartNeedsNoBarrier)
{
	for (const bool bShared : {true, false})
	{
		SCOPED_TRACE(bShared);
		MakeDevice();
		FFrameGraph Graph(*Resources);
		const FGraphBuffer Votes = MakeBuffer(Graph, "Votes");
		const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B"), C = MakeTexture(Graph, "C");
		AddMember(Graph, "First", {}, {A}, {Votes}, bShared);
		AddPass(Graph, "Filter", {{A, Sampled}}, {{C, Storage}});
		AddMember(Graph, "Second", {}, {B}, {Votes}, bShared);
		const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::ShaderRead, ERTAccess::ShaderRead);
		AddPass(Graph, "Count", {{Votes, ERTAccess::ShaderRead}, {C, Sampled}}, {{Out, Storage}});
		const std::vector<std::string> Order = Run(Graph);
		if (bShared) { EXPECT_THAT(Order, ElementsAre("First", "Second", "Filter", "Count")); }
		else { EXPECT_THAT(Order, ElementsAre("First", "Filter", "Second", "Count")); }
		const std::string Barrier = "Votes: StorageWrite -> StorageWrite";
		const std::vector<std::string> Lines = Trace();
		EXPECT_EQ(std::count(Lines.begin(), Lines.end(), Barrier), bShared ? 0 : 1);
		EXPECT_EQ(std::count(Lines.begin(), Lines.end(), "Votes: StorageWrite -> ShaderRead"), 1) << "behind the group it is waited for";
	}
}

TEST_F(FFrameGraphGroupTest, MembersDoNotShareMemory)
{
	FFrameGraph Graph(*Resources);
	const FGraphTexture Input = MakeTexture(Graph, "Input"), A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B");
	AddPass(Graph, "Make", {}, {{Input, Storage}});
	AddMember(Graph, "First", {Input}, {A});
	AddMember(Graph, "Second", {}, {B});
	EXPECT_THAT(Run(Graph), ElementsAre("Make", "First", "Second"));
	ASSERT_EQ(Used["First"].size(), 2u);
	EXPECT_NE(Used["Second"][0], Used["First"][0]) << "the first may still read it";
	EXPECT_NE(Used["Second"][0], Used["First"][1]);
}

TEST_F(FFrameGraphGroupTest, TheVariableKeepsTheOrder)
{
	EXPECT_FALSE(FConsoleVariables::Get().Set("r.RT.FrameGraph.Groups", "0", ERTSetBy::Console, "test"));
	FConsoleVariables::Get().BeginFrame();
	FFrameGraph Graph(*Resources);
	const FGraphTexture A = MakeTexture(Graph, "A");
	const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::ShaderRead, ERTAccess::ShaderRead);
	AddMember(Graph, "First", {}, {A});
	AddPass(Graph, "Filter", {{A, Sampled}}, {{Out, Storage}});
	AddMember(Graph, "Second", {}, {MakeTexture(Graph, "B")});
	EXPECT_THAT(Run(Graph), ElementsAre("First", "Filter", "Second"));
}

/// The group's time comes before its members, which have none of their own. A pass alone has its own.
TEST_F(FFrameGraphGroupTest, AGroupHasOneTime)
{
	FFrameGraph Graph(*Resources);
	AddMember(Graph, "First", {}, {MakeTexture(Graph, "A")});
	AddMember(Graph, "Second", {}, {MakeTexture(Graph, "B")});
	ASSERT_TRUE(Execute(Graph).IsOk());
	ASSERT_TRUE(Device->WaitIdle().IsOk());
	std::vector<std::string> Names;
	std::vector<double> Times;
	for (const FPassTiming& Timing : Resources->GetTimings())
	{
		Names.push_back(Timing.Name);
		Times.push_back(Timing.GpuMs);
	}
	ASSERT_THAT(Names, ElementsAre(Group, "First", "Second"));
	EXPECT_GT(Times[0], 0.0);
	EXPECT_EQ(Times[1], 0.0);
	EXPECT_EQ(Times[2], 0.0);
}

} // namespace
} // namespace Lantern
