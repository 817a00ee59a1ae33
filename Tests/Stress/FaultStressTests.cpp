// Shortage of memory at every n-th allocation, and loss of the device in every phase, while the world streams and
// pipelines compile. Every fault is one error; the engine goes on, on a new device where the old one is lost.
#include "StreamingWorld.h"
#include "Support/RendererTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

class FFaultStressTest : public FRendererTest
{
protected:
	static constexpr FContent Content{.bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bSky = true};
	/// One second of flight; the first error.
	FRTStatus Fly(FStreamingWorld& World, int First, int Frames)
	{
		for (int Frame = First; Frame < First + Frames; ++Frame)
		{
			const glm::dvec3 Camera = FStreamingWorld::FlightAt(Frame / 10.0);
			if (FRTStatus S = World.MoveTo(Camera); !S) { return S; }
			if (FRTStatus S = RenderFrame(Frame / 30.0, Camera); !S) { return S; }
		}
		return FRTStatus::Success();
	}
	/// Pipelines are compiled beside the frames: once they are done, a loss in them has been met, and the frame after sees it.
	FRTStatus FlyUntilCompiled(FStreamingWorld& World, int First)
	{
		FRTStatus Status;
		bool bBusy = true;
		const auto Step = [&] {
			bBusy = Engine->GetRenderer().GetRayCompiler().GetStats().bBusy;
			Status = Fly(World, First++, 1);
			GiveWay();
		};
		WaitUntil(
		    "the pipelines", [&] { return !Status || !bBusy; }, Step);
		return Status;
	}
	/// A lost device stays lost.
	ERTResult RenderFrameIfLoaded() { return bLoaded ? RenderFrame().Code : ERTResult::DeviceLost; }
	bool bLoaded = false;
};

TEST_F(FFaultStressTest, EveryAllocationFailsOnceAfterTheOther)
{
	Set("r.RT.Shadow.Path", "1");
	ASSERT_NO_FATAL_FAILURE(LoadAndRender(Content));
	Engine->bRealTime = true;
	FStreamingWorld World(*Device, Engine->GetScene().GetScene(), {.ObjectsPerTile = 4, .MeshesPerTile = 2});
	uint32_t Failures = 0;
	int Frame = 0;
	for (uint32_t N = 1; N <= 120; ++N)
	{
		SCOPED_TRACE("allocation " + std::to_string(N));
		Mock().ClearCalls();
		Mock().FailAllocation(N);
		const FRTStatus Status = Fly(World, Frame, 4);
		if (!Status)
		{
			++Failures;
			ASSERT_EQ(Status.Code, ERTResult::OutOfDeviceMemory) << Status.Message;
			ASSERT_GT(std::strlen(Status.Message), 10u);
		}
		Mock().FailAllocation(0);
		const FRTStatus Again = Fly(World, Frame, 4);
		ASSERT_TRUE(Again) << "does not recover: " << Again.Message;
		ASSERT_EQ(Messages, std::vector<std::string>());
		ASSERT_EQ(Mock().GetErrors(), std::vector<std::string>());
		Frame += 4;
	}
	EXPECT_GT(Failures, 20u) << "the fault was hardly met";
}

TEST_F(FFaultStressTest, DeviceLostInEveryPhaseIsRecoveredByANewOne)
{
	Set("r.RT.Shadow.Path", "1");
	const ERTMockCall Phases[] = {ERTMockCall::CreateBuffer, ERTMockCall::CreateTexture, ERTMockCall::CreateGeometry,
	    ERTMockCall::CreateScene, ERTMockCall::CreateShaderTable, ERTMockCall::CreateRayTracingPipeline, ERTMockCall::CreateComputePipeline,
	    ERTMockCall::Begin, ERTMockCall::End, ERTMockCall::Submit, ERTMockCall::WaitFor};
	uint32_t Losses = 0;
	for (const ERTMockCall Phase : Phases)
	{
		for (const bool bWhileLoading : {true, false})
		{
			SCOPED_TRACE("call " + std::to_string(static_cast<int>(Phase)) + (bWhileLoading ? " while loading" : " in flight"));
			Open();
			Engine->bRealTime = true;
			if (bWhileLoading) { Mock().LoseDeviceAt(Phase); }
			FRTStatus Status = Load(Content);
			bLoaded = Status.IsOk();
			if (Status)
			{
				FStreamingWorld World(*Device, Engine->GetScene().GetScene(), {.ObjectsPerTile = 4, .MeshesPerTile = 2});
				if (!bWhileLoading)
				{
					ASSERT_TRUE(Fly(World, 0, 3));
					Set("r.RT.Shadow.Soft", "0"); // something new to compile
					Mock().LoseDeviceAt(Phase);
				}
				Status = Fly(World, 3, 30);
				if (Status) { Status = FlyUntilCompiled(World, 33); }
				Set("r.RT.Shadow.Soft", "1");
			}
			if (!Status)
			{
				++Losses;
				EXPECT_EQ(Status.Code, ERTResult::DeviceLost) << Status.Message;
				EXPECT_EQ(RenderFrameIfLoaded(), ERTResult::DeviceLost);
			}
			// What an engine does then: everything anew.
			Open();
			ASSERT_NO_FATAL_FAILURE(LoadAndRender(Content));
		}
	}
	EXPECT_GE(Losses, 16u) << "of 22: the fault was hardly met";
}

} // namespace
} // namespace Lantern
