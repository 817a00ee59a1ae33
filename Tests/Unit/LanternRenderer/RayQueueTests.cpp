// The queue of shadow rays on the mock: what a frame makes for it, with room and without, and how a queue grows.
#include <cstring>

#include "LanternCore/FrameGraph/FrameGraph.h"
#include "Rays/RayQueueDemand.h"
#include "Support/CoreTestTools.h"
#include "Support/RendererTestTools.h"
#include "TileTypes.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

constexpr uint32_t Pixels = 40 * 24; // of FRendererTest::Render

class FRayQueueTest : public FRendererTest
{
protected:
	/// Bytes of the last buffer of this name; 0: there is none.
	uint64_t GetBytes(const std::string& Name)
	{
		uint64_t Bytes = 0;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateBuffer))
		{
			if (Call.Name == Name) { Bytes = Call.Numbers[0]; }
		}
		return Bytes;
	}
	/// Push constants of the last call of this kind whose pipeline's name begins so.
	template <class T>
	T GetConstants(ERTMockCall Kind, const std::string& Pipeline)
	{
		T Constants{};
		for (const FRTMockCall& Call : Mock().FindCalls(Kind))
		{
			if (Call.Name.rfind(Pipeline, 0) != 0) { continue; }
			EXPECT_EQ(Call.Bytes.size(), sizeof(T));
			std::memcpy(&Constants, Call.Bytes.data(), std::min(sizeof(T), Call.Bytes.size()));
		}
		return Constants;
	}
	/// Shaders check bounds by what they are told: it must be what was allocated, and the addresses those of the buffers.
	void ExpectBounds(uint64_t Address, uint32_t Capacity)
	{
		uint64_t Offset = 1;
		IRTBuffer* const Requests = Mock().FindBuffer(Address, &Offset);
		ASSERT_TRUE(Requests);
		EXPECT_EQ(Offset, 0u);
		EXPECT_EQ(Requests->GetDesc().Size, Capacity * sizeof(FRayRequest));
	}
};

TEST_F(FRayQueueTest, RoomForAllCostsNothingMore)
{
	Set("r.RT.Shadow.Denoise", "0");
	LoadAndRender({});
	EXPECT_THAT(GetPasses(), ElementsAre("SceneUpdate", "GBuffer", "Structures", "ShadowTiles", "ShadowQueue", "ShadowRays", "SunShadow",
	                             "DirectLighting", "ToneMap"));
	EXPECT_EQ(GetBytes("RayRequests"), Pixels * sizeof(FRayRequest)) << "the sun asks for one ray per pixel at most";
	EXPECT_EQ(GetBytes("RayQueueCounters"), sizeof(FRayQueueCounters));
	EXPECT_EQ(GetBytes("RayAnswers"), Pixels * 4u);
	EXPECT_EQ(GetBytes("Tiles"), 5 * 3 * sizeof(FTile));
	EXPECT_EQ(GetBytes("SunWidths"), 0u) << "no filter asks";
	EXPECT_EQ(GetBytes("RayQueueDemand"), 0u);
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains("Tiles/ShareQueue.comp")));
	for (const std::string& Name : Mock().GetCreatedTextures()) { EXPECT_EQ(Name.find("Kept"), std::string::npos) << Name; }
	Render();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateBuffer, "RayRequests"), 0u) << "the graph keeps it";
}

TEST_F(FRayQueueTest, QueueThatMayLackRoom)
{
	Set("r.RT.Shadow.Denoise", "0");
	Set("r.RT.Rays.QueuePerPixel", "0.125");
	for (const char* const Path : {"1", "2"})
	{
		Set("r.RT.Shadow.Path", Path);
		LoadAndRender({});
		const std::vector<std::string> Passes = GetPasses();
		for (const char* const Name : {"ShadowTiles", "ShadowQueue", "ShadowShare", "ShadowDemand", "ShadowRays", "SunShadow"})
		{
			EXPECT_THAT(Passes, Contains(Name)) << Path;
		}
		const auto Sort = GetConstants<FSunQueueConstants>(ERTMockCall::Dispatch, "Tiles/QueueSun.comp");
		const auto Share = GetConstants<FSunQueueConstants>(ERTMockCall::Dispatch, "Tiles/ShareQueue.comp");
		const ERTMockCall Trace = Path[0] == '1' ? ERTMockCall::TraceRaysIndirect : ERTMockCall::DispatchIndirect;
		const auto Rays = GetConstants<FShadowQueueConstants>(Trace, "");
		EXPECT_EQ(Sort.Capacity, Pixels / 8);
		ExpectBounds(Sort.Requests, Sort.Capacity);
		ExpectBounds(Share.Requests, Share.Capacity);
		ExpectBounds(Rays.Requests, Rays.Capacity);
	}
	Set("r.RT.Shadow", "0");
	Render();
	EXPECT_FALSE(HasPass("ShadowDemand")) << "nothing asks for rays";
}

TEST_F(FRayQueueTest, WhereNobodyLooksNothingIsCounted)
{
	Set("r.RT.Rays.QueuePerPixel", "0.125");
	LoadAndRender({});
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr));
	EXPECT_FALSE(HasPass("ShadowTiles"));
	EXPECT_FALSE(HasPass("ShadowDemand"));
}

/// A launch of the last known count would lose rays of a frame that asks for more.
TEST_F(FRayQueueTest, WithoutIndirectTracesTheWholeRoomIsLaunched)
{
	FRTMockDesc Desc;
	Desc.bIndirectTrace = false;
	Open(Desc);
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.Shadow.MoreRays", "0");
	LoadAndRender({});
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::TraceRaysIndirect), 0u);
	const std::vector<FRTMockCall> Traces = Mock().FindCalls(ERTMockCall::TraceRays);
	ASSERT_EQ(Traces.size(), 1u);
	EXPECT_EQ(Traces[0].Numbers[1], Pixels);
	EXPECT_EQ(Traces[0].Numbers[2], 1u);
	Set("r.RT.Shadow.Path", "2");
	Render();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::DispatchIndirect), 1u) << "every device has this";
}

/// A first frame has no history, a second one of the same view needs no further rays.
TEST_F(FRayQueueTest, FurtherRaysAreAskedForWherePicturesMove)
{
	Set("r.RT.Shadow.MoreRays", "8");
	LoadAndRender({});
	EXPECT_TRUE(HasPass("ShadowMoreRays"));
	Render();
	EXPECT_FALSE(HasPass("ShadowMoreRays"));
	const auto RenderFrom = [&](double X) {
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::SunShadow);
		FCapturedFrame Frame;
		Mock().ClearCalls();
		EXPECT_TRUE(Engine->RenderFrame(LookAt({X, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, Capture, &Frame));
	};
	RenderFrom(0.1);
	EXPECT_TRUE(HasPass("ShadowMoreAsk"));
	Set("r.RT.Shadow.MoreRays", "0");
	RenderFrom(0.2);
	EXPECT_FALSE(HasPass("ShadowMoreAsk"));
}

TEST_F(FRayQueueTest, PicturesOfMorePixelsThanRequestsCanNameGoWithout)
{
	FLogCapture Log;
	ASSERT_TRUE(Load({}));
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::SunShadow);
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 8193, 8192), 0.0, Capture, nullptr));
	EXPECT_FALSE(HasPass("SunShadow"));
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 1u) << ::testing::PrintToString(Log.GetTexts());
}

class FRayQueueDemandTest : public FRendererTest
{
protected:
	static constexpr uint32_t Capacity = 100, Of = 1000;

	/// A frame whose tiles ask for Wanted rays. Returns the room that its queue should have had.
	double RunFrame(uint32_t Wanted, double PerPixel = 0.1, bool bSubmitted = true)
	{
		Demand->BeginFrame(Flight = 1 - Flight);
		const double Room = Demand->GetRoom(PerPixel);
		FFrameGraph Graph(*Resources);
		const FGraphBuffer Counters = Graph.CreateBuffer({sizeof(FRayQueueCounters)}, "Counters");
		Graph.AddPass("Tiles", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Write(Counters, ERTAccess::CopyWrite);
			return [=](FPassContext& Pass) {
				// Segments share the room.
				IRTBuffer* const Buffer = Pass.GetBuffer(Counters);
				constexpr uint32_t Segments = offsetof(FRayQueueCounters, Segments);
				Pass.Commands().FillBuffer(Buffer, Segments, sizeof(FRayQueueCounters::Segments), 0);
				Pass.Commands().FillBuffer(Buffer, Segments, 4, Wanted / 2);
				Pass.Commands().FillBuffer(Buffer, Segments + sizeof(FRaySegment), 4, Wanted - Wanted / 2);
			};
		});
		const FGraphBuffer Read = Demand->AddRead(Graph, "Demand", {Counters, Capacity, Of});
		Graph.AddPass("Rays", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Counters, ERTAccess::ShaderRead);
			Builder.Keep(Read);
			Builder.NeverCull();
			return [](FPassContext&) {};
		});
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress(), ERTQueue::Graphics));
		EXPECT_TRUE(List->Begin());
		const FRTStatus Status = Graph.Execute(*List.Get());
		EXPECT_TRUE(Status) << Status.Message;
		EXPECT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		if (bSubmitted)
		{
			EXPECT_TRUE(Device->Submit(Lists, 1, &Fence));
			EXPECT_TRUE(Device->WaitFor(Fence, ~0ull));
		}
		Demand->EndFrame(bSubmitted);
		return Room;
	}
	void SetUp() override
	{
		FRendererTest::SetUp();
		Resources = std::make_unique<FFrameGraphResources>(*Device);
		Demand = std::make_unique<FRayQueueDemand>(*Device);
	}
	void TearDown() override
	{
		Demand.reset();
		Resources.reset();
		FRendererTest::TearDown();
	}

	std::unique_ptr<FFrameGraphResources> Resources;
	std::unique_ptr<FRayQueueDemand> Demand;
	uint32_t Flight = 0;
};

TEST_F(FRayQueueDemandTest, GrowsTwoFramesLaterAndSaysSoOnce)
{
	FLogCapture Log;
	EXPECT_EQ(RunFrame(Capacity), 0.1) << "all had room";
	EXPECT_EQ(RunFrame(400), 0.1);
	EXPECT_EQ(RunFrame(200), 0.1) << "nobody knows yet";
	EXPECT_EQ(Log.Count(ERTLogLevel::Warning), 0u);
	EXPECT_DOUBLE_EQ(RunFrame(0), 0.5) << "400 of 1,000, and a quarter more";
	EXPECT_DOUBLE_EQ(RunFrame(0), 0.5) << "it does not shrink";
	EXPECT_LE(Log.Count(ERTLogLevel::Warning), 1u) << "once in a process";
	EXPECT_EQ(RunFrame(0, 0.2), 0.2) << "another setting starts anew";
	EXPECT_EQ(RunFrame(0, 0.1), 0.1);
}

TEST_F(FRayQueueDemandTest, FramesThatNeverRunCountNothing)
{
	RunFrame(400, 0.1, false);
	for (int Frame = 0; Frame < 3; ++Frame) { EXPECT_EQ(RunFrame(0), 0.1); }
}

} // namespace
} // namespace Lantern
