// FRefitQuality: whose results reach which store, and when.
#include "Skinning/RefitQuality.h"

#include <cstring>

#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FRefitQualityBatchTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Skinning.RebuildInterval", "1000");
		FRendererDesc Desc;
		Desc.ShaderFolders = {GetShaderFolder()};
		Desc.CacheFolder = LANTERN_TEST_CACHE;
		Other = std::make_unique<FSampleEngine>(*Device, Desc);
		Shared = std::make_unique<FRenderer>(*Device, Desc);
		Quality = std::make_unique<FRefitQuality>(*Device);
		for (FSampleEngine* const Of : {Engine.get(), Other.get()})
		{
			ASSERT_TRUE(Of->Load(MakeDescription({.bSkinned = true})));
			FSunLight Sun;
			Sun.Irradiance = 3.0f;
			Of->GetScene().SetSun(Sun);
			ASSERT_TRUE(Move(*Of)); // the first build
		}
	}
	void TearDown() override
	{
		Quality.reset();
		Shared.reset();
		Other.reset();
		FRendererTest::TearDown();
	}
	/// Deforms the body and draws it.
	FRTStatus Move(FSampleEngine& Of)
	{
		FFrameCapture Capture;
		Capture.bDisplay = true;
		return Of.RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 8, 8), Time += 0.25, Capture, &Captured);
	}
	/// A frame of that scene in which boxes are found to be this much larger than triangles.
	void Measure(FSampleEngine& Of, float Looseness)
	{
		FGeometryStore& Store = Of.GetScene().GetScene().GetGeometries();
		Quality->BeginFrame(Flight = 1 - Flight, Store);
		const FRefitQuality::FWork Work = Quality->Prepare(Store, Of.MoveTo(Time += 0.25));
		ASSERT_FALSE(Work.Dispatches.empty());
		static_cast<FRefitQualitySum*>(Work.Results->GetMapped())[0] = {Looseness, 1.0f};
		Quality->EndFrame(Store, true);
	}
	bool IsRebuilt(FSampleEngine& Of)
	{
		Mock().ClearCalls();
		EXPECT_TRUE(Move(Of));
		return HasRebuilt();
	}

	/// A frame of one renderer that shows both scenes in turn. The device finds boxes to be this much larger than triangles.
	void Show(FSampleEngine& Of, float Looseness)
	{
		FFrameFeatures Features;
		Features.bRays = true;
		Features.Skinning = Of.MoveTo(Time += 0.25);
		Mock().ClearCalls();
		ASSERT_TRUE(Shared->BeginFrame(Of.GetScene().GetScene(), LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 8, 8), Features));
		ASSERT_TRUE(Shared->EndFrame(nullptr));
		ASSERT_TRUE(Shared->WaitForAll());
		const std::vector<FRTMockCall> Measures = Mock().FindCalls(ERTMockCall::Dispatch, "Skinning/RefitQuality.comp");
		ASSERT_EQ(Measures.size(), 1u);
		FRefitQualityConstants Constants{};
		ASSERT_EQ(Measures[0].Bytes.size(), sizeof(Constants));
		std::memcpy(&Constants, Measures[0].Bytes.data(), sizeof(Constants));
		uint64_t Offset = 0;
		IRTBuffer* const Sums = Mock().FindBuffer(Constants.Sums, &Offset);
		ASSERT_TRUE(Sums);
		const FRefitQualitySum Sum = {Looseness, 1.0f};
		std::memcpy(static_cast<uint8_t*>(Sums->GetMapped()) + Offset, &Sum, sizeof(Sum));
	}
	/// Whether the frame of the last Show built the body's structure anew.
	bool HasRebuilt()
	{
		const std::vector<FRTMockCall> Builds = Mock().FindCalls(ERTMockCall::BuildGeometry, "Body");
		EXPECT_EQ(Builds.size(), 1u);
		return Builds.size() == 1 && Builds[0].Numbers[1] == 0;
	}

	std::unique_ptr<FSampleEngine> Other;
	std::unique_ptr<FRenderer> Shared; ///< of both scenes
	std::unique_ptr<FRefitQuality> Quality;
	double Time = 0.0;
	uint32_t Flight = 0;
};

TEST_F(FRefitQualityBatchTest, LooseBoxesAreRebuilt)
{
	for (int I = 0; I < 3; ++I) { ASSERT_NO_FATAL_FAILURE(Measure(*Engine, 1.0f)); }
	EXPECT_FALSE(IsRebuilt(*Engine));
	for (int I = 0; I < 3; ++I) { ASSERT_NO_FATAL_FAILURE(Measure(*Engine, 5.0f)); }
	EXPECT_TRUE(IsRebuilt(*Engine));
}

// What was measured in frames of one scene arrives although frames of another were drawn by then.
TEST_F(FRefitQualityBatchTest, ResultsWaitForAFrameOfTheirScene)
{
	for (int I = 0; I < 3; ++I) { ASSERT_NO_FATAL_FAILURE(Measure(*Engine, 1.0f)); }
	ASSERT_NO_FATAL_FAILURE(Measure(*Engine, 5.0f));
	for (int I = 0; I < 4; ++I) { ASSERT_NO_FATAL_FAILURE(Measure(*Other, 1.0f)); }
	ASSERT_NO_FATAL_FAILURE(Measure(*Engine, 5.0f));
	EXPECT_TRUE(IsRebuilt(*Engine));
	EXPECT_FALSE(IsRebuilt(*Other));
}

// A renderer that shows two scenes: the frames of the other one are those in which what was measured arrives.
TEST_F(FRefitQualityBatchTest, FramesOfAnotherSceneDropNoResults)
{
	for (int I = 0; I < 4; ++I)
	{
		ASSERT_NO_FATAL_FAILURE(Show(*Engine, 1.0f));
		EXPECT_FALSE(HasRebuilt());
	}
	ASSERT_NO_FATAL_FAILURE(Show(*Engine, 5.0f));
	for (int I = 0; I < 4; ++I)
	{
		ASSERT_NO_FATAL_FAILURE(Show(*Other, 1.0f));
		EXPECT_FALSE(HasRebuilt()) << "it is not this scene's";
	}
	ASSERT_NO_FATAL_FAILURE(Show(*Engine, 1.0f));
	EXPECT_TRUE(HasRebuilt());
}

// Geometries of two scenes have equal slots: each keeps its own figure of the last build.
TEST_F(FRefitQualityBatchTest, ScenesHaveFiguresOfTheirOwn)
{
	const auto Both = [&](float Looseness) {
		for (int I = 0; I < 3; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Measure(*Engine, Looseness));
			ASSERT_NO_FATAL_FAILURE(Measure(*Other, 10.0f));
		}
	};
	Both(1.0f);
	Both(5.0f);
	EXPECT_TRUE(IsRebuilt(*Engine));
	EXPECT_FALSE(IsRebuilt(*Other));
}

} // namespace
} // namespace Lantern
