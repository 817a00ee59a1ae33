// Signals are made where the composite or somebody else uses them, and nowhere else.
#include "Support/RendererTestTools.h"

namespace Lantern
{

namespace
{
using ::testing::Contains;
using ::testing::Not;

class FSignalCaptureTest : public FRendererTest
{
protected:
	void Capture(std::initializer_list<ESignal> Signals, bool bLighting = false)
	{
		FFrameCapture Capture;
		Capture.bLighting = bLighting;
		for (const ESignal Signal : Signals) { Capture.Signals.Add(Signal); }
		Captured = {};
		Mock().ClearCalls();
		const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, Capture, &Captured);
		ASSERT_TRUE(Status) << Status.Message;
	}
	std::vector<std::string> GetDispatched()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateComputePipeline)) { Names.push_back(Call.Name); }
		return Names;
	}
};

TEST_F(FSignalCaptureTest, EachHasItsChannels)
{
	LoadAndRender({.bSky = true});
	Capture({ESignal::SunShadow, ESignal::AmbientOcclusion, ESignal::Frame}, true);
	EXPECT_EQ(Captured.Get(ESignal::SunShadow).Channels, 1u);
	EXPECT_EQ(Captured.Get(ESignal::AmbientOcclusion).Channels, 1u);
	EXPECT_EQ(Captured.Get(ESignal::AmbientOcclusion).Width, 40u);
	EXPECT_EQ(Captured.Get(ESignal::Frame).Channels, 3u);
	EXPECT_EQ(Captured.Lighting.Pixels, Captured.Get(ESignal::Frame).Pixels);
	Capture({ESignal::Frame});
	EXPECT_TRUE(Captured.Lighting.IsEmpty());
	EXPECT_FALSE(Captured.Get(ESignal::Frame).IsEmpty());
	EXPECT_TRUE(Captured.Get(ESignal::SunShadow).IsEmpty()) << "nobody asked";
}

TEST_F(FSignalCaptureTest, WithoutASkyThereIsNoAmbientOcclusion)
{
	LoadAndRender({.bSun = false});
	EXPECT_FALSE(HasPass("AmbientOcclusion"));
	EXPECT_EQ(GetRTPSO(), nullptr);
	EXPECT_THAT(Mock().GetCreatedTextures(), Not(Contains("AmbientOcclusion")));
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::CreateScene).size(), 0u) << "and no acceleration structure for it";
}

TEST_F(FSignalCaptureTest, WhatIsAskedForIsMadeWithoutUse)
{
	for (const char* const Path : {"1", "2"})
	{
		Set("r.RT.AO.Path", Path);
		LoadAndRender({.bSun = false});
		Capture({ESignal::AmbientOcclusion});
		EXPECT_TRUE(HasPass("AmbientOcclusion")) << Path;
		EXPECT_FALSE(HasPass("DirectLighting")) << "nobody reads it";
		EXPECT_EQ(Mock().FindCalls(ERTMockCall::TraceRays).size(), Path[0] == '1' ? 1u : 0u);
		EXPECT_FALSE(Captured.Get(ESignal::AmbientOcclusion).IsEmpty());
		Capture({ESignal::SunShadow}, true);
		EXPECT_FALSE(HasPass("AmbientOcclusion")) << "no longer";
		EXPECT_TRUE(Captured.Get(ESignal::SunShadow).IsEmpty()) << "there is no sun";
	}
}

TEST_F(FSignalCaptureTest, AskedForInEveryFrame)
{
	LoadAndRender({.bSun = false});
	Engine->Signals.Wanted.Add(ESignal::AmbientOcclusion);
	Capture({}, true);
	EXPECT_TRUE(HasPass("AmbientOcclusion")) << "for those that follow";
}

TEST_F(FSignalCaptureTest, SunShadowsAskedForInEveryFrame)
{
	LoadAndRender({});
	Capture({});
	EXPECT_FALSE(HasPass("SunShadowTemporal")) << "nobody looks";
	Engine->Signals.Wanted.Add(ESignal::SunShadow);
	Capture({});
	EXPECT_TRUE(HasPass("SunShadowTemporal"));
}

TEST_F(FSignalCaptureTest, WhatTheFrameNoLongerHasIsNotThatOfTheFrameBefore)
{
	LoadAndRender({});
	const auto Again = [&] {
		FFrameCapture Capture;
		Capture.bDisplay = true;
		Capture.Signals.Add(ESignal::SunShadow);
		const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, Capture, &Captured);
		ASSERT_TRUE(Status) << Status.Message;
	};
	Again();
	EXPECT_FALSE(Captured.Get(ESignal::SunShadow).IsEmpty());
	EXPECT_TRUE(Captured.Lighting.IsEmpty()) << "nobody asked";
	Set("r.RT.Shadow", "0");
	Again();
	EXPECT_TRUE(Captured.Get(ESignal::SunShadow).IsEmpty());
	EXPECT_FALSE(Captured.Display.IsEmpty());
}

TEST_F(FSignalCaptureTest, AmbientOcclusionBringsNoHitGroupsOfItsOwn)
{
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.AO.Path", "1");
	LoadAndRender({.bMasked = true});
	const uint32_t Types = GetRTPSO()->GetRayTypeCount(), Groups = GetRTPSO()->GetHitGroupCount();
	Capture({ESignal::AmbientOcclusion, ESignal::SunShadow});
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::TraceRays).size(), 1u);
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::TraceRaysIndirect).size(), 1u);
	EXPECT_EQ(GetRTPSO()->GetRayTypeCount(), Types);
	EXPECT_EQ(GetRTPSO()->GetHitGroupCount(), Groups);
}

TEST_F(FSignalCaptureTest, NoObjectsNoOcclusion)
{
	LoadAndRender({.bObjects = false, .bSun = false, .bSky = true});
	EXPECT_FALSE(HasPass("AmbientOcclusion"));
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::BuildScene).size(), 0u);
}

// Asking for something between frames moves the scene, and the frame after skins it all the same.
TEST_F(FSignalCaptureTest, SeekingKeepsWhatMustBeSkinned)
{
	ASSERT_TRUE(Load({.bSkinned = true}));
	Engine->SeekTo(0.5);
	EXPECT_EQ(Engine->GetTime(), 0.5);
	EXPECT_EQ(Engine->MoveTo(0.5).size(), 1u);
	EXPECT_EQ(Engine->MoveTo(0.5).size(), 0u);
	Engine->SeekTo(0.75);
	Engine->SeekTo(1.0);
	Render(1.0);
	EXPECT_TRUE(HasPass("Skinning"));
}

} // namespace
} // namespace Lantern
