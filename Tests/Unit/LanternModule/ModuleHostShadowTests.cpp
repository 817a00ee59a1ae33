// The engine's shadow map on a mock device: what is refused, by which name, and what a frame with one runs.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleHostShadowTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		Map = MakeTexture(ERTFormat::D32_FLOAT, 128);
		ASSERT_OK(SetSun(-1.0));
	}
	void TearDown() override
	{
		Map.Reset();
		Other.Reset();
		FModuleTest::TearDown();
	}
	/// Two cascades of one texture, which look down on a square of 10 m and one of 40 m.
	FRTModuleHostShadow MakeShadow()
	{
		FRTModuleHostShadow Shadow;
		Shadow.CascadeCount = 2;
		Shadow.Held = ERTModuleCasters::Still | ERTModuleCasters::Moving | ERTModuleCasters::Characters;
		for (uint32_t I = 0; I < 2; ++I)
		{
			FRTModuleShadowCascade& Cascade = Shadow.Cascades[I];
			const double Edge = I == 0 ? 10.0 : 40.0;
			Cascade.Texture = Map.Get();
			Cascade.OffsetX = 64 * I;
			Cascade.Width = 64;
			Cascade.TexelSize = static_cast<float>(Edge / 64.0);
			const double Rows[12] = {1.0 / Edge, 0, 0, 0.5, 0, 0, 1.0 / Edge, 0.5, 0, 0.01, 0, 0.5};
			std::copy(std::begin(Rows), std::end(Rows), Cascade.WorldToMap);
		}
		return Shadow;
	}
	template <class TChange>
	FRTStatus RenderWith(const TChange& Change)
	{
		FRTModuleFrame Frame = DescribeFrame();
		FRTModuleHostShadow Shadow = MakeShadow();
		Change(Shadow);
		Frame.HostShadow = &Shadow;
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		return Status ? Renderer->EndFrame(nullptr) : Status;
	}
	/// The frame names Part, changes nothing, and the next one is fine.
	template <class TChange>
	void ExpectRefused(const TChange& Change, const char* Part)
	{
		EXPECT_REFUSED(RenderWith(Change), Part);
		EXPECT_OK(RenderWith([](FRTModuleHostShadow&) {}));
	}

	TRTRef<IRTTexture> Map, Other;
};

TEST_F(FModuleHostShadowTest, WhatCannotBeAMapIsRefusedByName)
{
	constexpr float Infinite = std::numeric_limits<float>::infinity();
	for (const int Element : {0, 5, 11})
	{
		ExpectRefused([=](auto& S) { S.Cascades[1].WorldToMap[Element] = NAN; }, "Cascades[1].WorldToMap is not finite");
	}
	ExpectRefused([](auto& S) { std::fill_n(S.Cascades[0].WorldToMap, 12, 0.0); }, "Cascades[0].WorldToMap has rows that lie in one plane");
	ExpectRefused([](auto& S) { S.CascadeCount = 0; }, "CascadeCount must be 1 to 4");
	ExpectRefused([](auto& S) { S.CascadeCount = 5; }, "CascadeCount must be 1 to 4");
	for (const float Wrong : {0.0f, -1.0f, NAN, Infinite})
	{
		ExpectRefused([=](auto& S) { S.Cascades[1].TexelSize = Wrong; }, "Cascades[1].TexelSize must be positive");
	}
	for (const float Wrong : {-1.0f, NAN, Infinite})
	{
		ExpectRefused([=](auto& S) { S.Cascades[0].DepthBias = Wrong; }, "Cascades[0].DepthBias");
	}
	ExpectRefused([](auto& S) { S.Cascades[1].Texture = nullptr; }, "Cascades[1].Texture is null");
	ExpectRefused([](auto& S) { S.Cascades[0].Access = ERTAccess::None; }, "Cascades[0].Access");
	ExpectRefused([](auto& S) { S.Cascades[1].OffsetX = 128; }, "Cascades[1].OffsetX");
	ExpectRefused([](auto& S) { S.Cascades[1].Width = 65; }, "Cascades[1].OffsetX or Width");
	ExpectRefused([](auto& S) { S.Cascades[0].Height = ~0u; }, "Cascades[0].OffsetY or Height");
	ExpectRefused([](auto& S) { S.Held = static_cast<ERTModuleCasters>(16); }, "Held");
	ExpectRefused([](auto& S) { S.ShaderData = 64; }, "ShaderData has no FRTModuleRendererDesc::HostShadowShader");
	Other = MakeTexture(ERTFormat::RGBA8_UNORM, 128);
	ExpectRefused([this](auto& S) { S.Cascades[0].Texture = Other.Get(); }, "Cascades[0].Texture must be D32_FLOAT");
	Other = MakeTexture(ERTFormat::D32_FLOAT, 128, ERTTextureUsage::Depth);
	ExpectRefused([this](auto& S) { S.Cascades[0].Texture = Other.Get(); }, "Cascades[0].Texture needs ERTTextureUsage::Sampled");
}

TEST_F(FModuleHostShadowTest, OwnShaderMustBeAFile)
{
	TRTRef<IRTModuleRenderer> Second;
	for (const char* const Path : {"", "Tiles/HostShadow.glsl", "/nowhere/Map.glsl"})
	{
		FRTModuleRendererDesc Desc;
		Desc.HostShadowShader = Path;
		EXPECT_REFUSED(Module->CreateRenderer(Device.Get(), Desc, Second.ReleaseAndGetAddress()), "HostShadowShader");
		FRTModuleRendererDesc Sky;
		Sky.SkyShader = Path;
		EXPECT_REFUSED(Module->CreateRenderer(Device.Get(), Sky, Second.ReleaseAndGetAddress()), "SkyShader");
	}
}

// The map costs passes only in frames that have one.
TEST_F(FModuleHostShadowTest, FramesWithAMapMakeItsPyramid)
{
	ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
	FRTModuleFrame Frame = DescribeFrame();
	FRTModuleHostShadow Shadow = MakeShadow();
	Frame.HostShadow = &Shadow;
	ASSERT_OK(Renderer->Precache(Frame, nullptr, nullptr));
	ASSERT_OK(RenderWith([](FRTModuleHostShadow&) {}));
	Mock().ClearCalls();
	ASSERT_OK(RenderWith([](FRTModuleHostShadow&) {}));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker, "HostShadowPyramid"), 1u);
	EXPECT_TRUE(Outputs.Get(ESignal::SunShadow));
	Mock().ClearCalls();
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker, "HostShadowPyramid"), 0u);
}

} // namespace
} // namespace Lantern
