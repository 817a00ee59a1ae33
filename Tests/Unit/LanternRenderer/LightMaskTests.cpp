// The light mask on the mock: what a frame makes for it, and that it makes nothing where nobody reads it or there is nothing in it.
#include "Support/RendererTestTools.h"

#include "LanternRenderer/Frame.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class FLightMaskTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow", "0");
		Set("r.RT.AO", "0");
	}
	FRTScene& GetWorld() { return Engine->GetScene().GetScene(); }
	void AddLamp(bool bExtent)
	{
		FSceneLight Light;
		Light.Position = {0, 0, 1};
		Light.Color = glm::vec3(1);
		Light.Type = bExtent ? LIGHT_SPHERE : LIGHT_POINT;
		Light.Size = {bExtent ? 0.1f : 0.0f, 0};
		GetWorld().AddLight(Light);
	}
	/// A frame whose mask is read, or not. Calls are those of this frame.
	void RenderWith(bool bMask, bool bAlone = false)
	{
		Engine->Signals.bLightMask = bMask;
		Engine->Signals.bNothingElse = bAlone;
		Mock().ClearCalls();
		Engine->ExtraPasses = [&](FFrameContext& Context, const FGBuffer&, const FFrameOutputs& Frame) {
			bMade = Frame.LightMask.IsValid();
			if (!bMade) { return; }
			Context.Graph.AddPass("ReadMask", [&](FPassBuilder& Builder) -> FPassExecute {
				for (const FGraphTexture Texture : {Frame.LightMask.Visibility, Frame.LightMask.Lights})
				{
					Builder.Read(Texture, ERTAccess::ShaderRead);
				}
				Builder.NeverCull();
				return [](FPassContext&) {};
			});
		};
		const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr);
		ASSERT_TRUE(Status) << Status.Message;
		Engine->ExtraPasses = {};
	}
	std::vector<FRTMockCall> GetTextures(const char* Begin)
	{
		std::vector<FRTMockCall> Calls = Mock().FindCalls(ERTMockCall::CreateTexture);
		std::erase_if(Calls, [=](const FRTMockCall& Call) { return Call.Name.rfind(Begin, 0) != 0; });
		return Calls;
	}
	/// Whether nothing of the mask was made since the device was opened.
	void ExpectNothing()
	{
		EXPECT_FALSE(bMade);
		EXPECT_FALSE(HasPass("ShadowLightsMask"));
		EXPECT_TRUE(GetTextures("LightMask").empty());
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("LocalLights/Mask.comp"))));
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("LIGHT_MASK"))));
	}
	bool bMade = false;
};

TEST_F(FLightMaskTest, NobodyPaysWhoDoesNotRead)
{
	ASSERT_TRUE(Load({}));
	AddLamp(true);
	RenderWith(false);
	ExpectNothing();
	RenderWith(true);
	EXPECT_TRUE(bMade);
	EXPECT_TRUE(HasPass("ShadowLightsMask"));
}

TEST_F(FLightMaskTest, ScenesWithoutLampsHaveNone)
{
	ASSERT_TRUE(Load({.bEmissive = true}));
	RenderWith(true);
	ExpectNothing();
	AddLamp(false);
	Set("r.RT.Lights", "0");
	RenderWith(true);
	ExpectNothing();
	Set("r.RT.Lights", "1");
	RenderWith(true);
	EXPECT_TRUE(bMade);
}

// Two frames of what slots are, and of means where some lamp has an extent.
TEST_F(FLightMaskTest, PointLampsNeedNoHistory)
{
	ASSERT_TRUE(Load({}));
	AddLamp(false);
	for (int Frame = 0; Frame < 2; ++Frame)
	{
		RenderWith(true, true);
		EXPECT_TRUE(bMade);
		EXPECT_TRUE(GetTextures("LightMaskMeans").empty());
		EXPECT_FALSE(HasPass("Surface"));
	}
	AddLamp(true);
	Mock().ClearCalls();
	RenderWith(true, true);
	EXPECT_FALSE(GetTextures("LightMaskMeans").empty());
	EXPECT_TRUE(HasPass("Surface"));
	Set("r.RT.Lights.Denoise", "0");
	RenderWith(true, true);
	EXPECT_FALSE(HasPass("Surface"));
}

TEST_F(FLightMaskTest, TheMaskAloneShadesNothing)
{
	ASSERT_TRUE(Load({.bEmissive = true}));
	for (int I = 0; I < 12; ++I) { AddLamp(false); }
	RenderWith(true, true);
	EXPECT_TRUE(bMade);
	EXPECT_TRUE(HasPass("ShadowLights"));
	EXPECT_FALSE(HasPass("ShadowLightsShade"));
	EXPECT_FALSE(HasPass("ShadowEmitters")) << "they are in no mask";
	for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateBuffer)) { EXPECT_NE(Call.Name, "LightChoices"); }
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(StartsWith("LocalLights/Shade.comp"))));
	// Somebody reads the rest.
	Engine->Signals.bNothingElse = false;
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::LocalDiffuse);
	FCapturedFrame Shown;
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, Capture, &Shown));
	EXPECT_TRUE(HasPass("ShadowLightsShade"));
}

TEST_F(FLightMaskTest, TexturesAreAsLargeAsTheirTiles)
{
	ASSERT_TRUE(Load({}));
	AddLamp(true);
	Mock().ClearCalls();
	RenderWith(true);
	const std::vector<FRTMockCall> Lights = GetTextures("LightMaskLights");
	ASSERT_EQ(Lights.size(), 2u) << "this frame's and the last one's";
	EXPECT_EQ(Lights[0].Numbers[0], 40u);
	EXPECT_EQ(Lights[0].Numbers[1], 3u);
}

} // namespace
} // namespace Lantern
