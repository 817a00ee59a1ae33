// FRenderer::EndFrame with work ahead of an engine's list: on which queue it runs.
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FRendererAheadTest : public FRendererTest
{
protected:
	static void Publish(const char* Async)
	{
		Set("r.RT.Async", Async);
		FConsoleVariables::Get().BeginFrame();
	}
	/// Renders one frame into a list of the engine's. Meanwhile: called between the choice of the queue and the frame.
	void RenderAhead(const std::function<void()>& Meanwhile)
	{
		FAheadWork Work;
		Work.Queue = FindAheadQueue(*Device);
		Meanwhile();
		FRenderer& Renderer = Engine->GetRenderer();
		FFrameFeatures Features;
		Features.bRays = true;
		FView View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24);
		View.FrameIndex = FrameIndex++;
		ASSERT_TRUE(Renderer.BeginFrame(Engine->GetScene().GetScene(), View, Features));
		TRTRef<IRTCommandList> List;
		ASSERT_TRUE(Device->CreateCommandList("Engine", List.ReleaseAndGetAddress(), ERTQueue::Graphics));
		ASSERT_TRUE(List->Begin());
		Mock().ClearCalls();
		FRTFence Ahead = 0, Fence = 0;
		ASSERT_TRUE(Renderer.EndFrame(*List, Work, Ahead));
		Submissions = Mock().FindCalls(ERTMockCall::Submit);
		ASSERT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		ASSERT_TRUE(Device->Submit(Lists, 1, &Fence, &Ahead, Ahead != 0 && Work.Queue != ERTQueue::Graphics ? 1 : 0));
		Renderer.FrameSubmitted(Fence);
		ASSERT_TRUE(Device->WaitFor(Fence, 1'000'000'000));
	}

	std::vector<FRTMockCall> Submissions; ///< by EndFrame
	uint32_t FrameIndex = 0;
	double Moves = 0.0;
};

/// Lists that the caller recorded before are of the queue that it asked for, and are submitted with the others.
TEST_F(FRendererAheadTest, QueueIsThatOfTheCallerWhateverIsPublishedSince)
{
	ASSERT_TRUE(Load({.bSun = true}));
	for (const ERTQueue Queue : {ERTQueue::AsyncCompute, ERTQueue::Graphics})
	{
		const bool bAsync = Queue == ERTQueue::AsyncCompute;
		Publish(bAsync ? "*" : "");
		for (const char* const Meanwhile : {bAsync ? "*" : "", bAsync ? "" : "*"})
		{
			SCOPED_TRACE(std::string(bAsync ? "compute" : "graphics") + ", meanwhile \"" + Meanwhile + "\"");
			Publish(bAsync ? "*" : "");
			glm::dmat4 Moved(1.0);
			Moved[3].x = ++Moves;
			Engine->GetScene().SetTransform(0, Moved); // so that there is something to build
			ASSERT_NO_FATAL_FAILURE(RenderAhead([=] { Publish(Meanwhile); }));
			// Without names, no pass may run on the compute queue.
			EXPECT_EQ(Submissions.size(), bAsync && *Meanwhile == 0 ? 0u : 1u);
			for (const FRTMockCall& Submission : Submissions) { EXPECT_EQ(Submission.Numbers[2], uint64_t(Queue)); }
		}
	}
}

} // namespace
} // namespace Lantern
