// FRTModuleFrame::BackAlbedo: light that arrives on the other side of what an engine's pixels show.
#include <cmath>
#include <numbers>

#include <glm/gtc/packing.hpp>

#include "FlatEngine.h"

namespace Lantern
{
namespace
{

/// Light comes from below the floor, which is not in the scene. The right half of the picture lets it through.
class FBackAlbedoTest : public FFlatEngineTest
{
protected:
	static constexpr double LampDepth = 3.0;
	// As textures of eight bits hold them, and decode them.
	static constexpr double Code = 128.0 / 255.0, Lost = Code;
	const double Front = std::pow((0.8 + 0.055) / 1.055, 2.4), Back = std::pow((Code + 0.055) / 1.055, 2.4);

	void SetUp() override
	{
		FFlatEngineTest::SetUp();
		const uint32_t Through = glm::packUnorm4x8(glm::vec4(float(Code)));
		std::vector<uint32_t> Texels(size_t(Size) * Size);
		for (size_t I = 0; I < Texels.size(); ++I) { Texels[I] = I % Size >= Size / 2 ? Through : 0u; }
		BackAlbedo = MakeTexture({Size, Size, 1, 1, ERTFormat::RGBA8_SRGB, ERTTextureUsage::Sampled, "EngineBackAlbedo"}, Texels.data());
		ChangeFrame = [this](FRTModuleFrame& Frame) { Frame.BackAlbedo = BackAlbedo.Get(); };
		for (const char* const Name : {"r.RT.Shadow.Denoise", "r.RT.Lights.Denoise"}) { SetVariable(Name, "0"); }
	}
	void TearDown() override
	{
		BackAlbedo.Reset();
		FFlatEngineTest::TearDown();
	}
	/// A plate of 100 m at this height.
	static void AddPlate(IRTModuleRenderer& Renderer, float Height)
	{
		FRTModuleMaterial Black;
		Black.bDoubleSided = true;
		for (int Channel = 0; Channel < 3; ++Channel) { Black.BaseColor[Channel] = 0.0f; }
		Black.Specular = 0.0f;
		ERTMaterialHandle MaterialHandle = ERTMaterialHandle::None;
		ASSERT_OK(Renderer.AddMaterial(Black, &MaterialHandle));
		Place(Renderer, AddSquare(Renderer, 50.0f, Height), MaterialHandle, {0, 0, 0}, 1.0);
	}
	/// PlateHeight: 0: there is none.
	FSignalPicture RenderLit(float PlateHeight = 0.0f)
	{
		return Render(
		    [&](IRTModuleRenderer& Renderer) {
			if (PlateHeight != 0.0f) { AddPlate(Renderer, PlateHeight); }
			AddVerticalLights(Renderer, -LampDepth);
		    },
		    FSignalSet{ESignal::SunShadow, ESignal::LocalDiffuse});
	}
	/// What the lamp brings to the right half, over the diffuse albedo of both sides.
	double GetExpectedLamp() const
	{
		double Sum = 0.0;
		for (uint32_t Y = 0; Y < Size; ++Y)
		{
			for (uint32_t X = Size / 2; X < Size; ++X)
			{
				const double PX = 4.0 * ((X + 0.5) / Size - 0.5), PZ = 4.0 * ((Y + 0.5) / Size - 0.5);
				Sum += LampCandela * LampDepth / std::pow(PX * PX + PZ * PZ + LampDepth * LampDepth, 1.5);
			}
		}
		const double Irradiance = Sum / (0.5 * Size * Size);
		return Irradiance / std::numbers::pi * Back / (Front * (1.0 - Lost) + Back);
	}

	TRTRef<IRTTexture> BackAlbedo;
};

TEST_F(FBackAlbedoTest, LightFromBelowShinesThrough)
{
	for (const bool bDerived : {false, true})
	{
		ChangeFrame = [&, this](FRTModuleFrame& Frame) {
			Frame.BackAlbedo = BackAlbedo.Get();
			Frame.Layout.bGeometricInZw = !bDerived;
		};
		const FSignalPicture Picture = RenderLit();
		EXPECT_EQ(GetHalves(Picture, ESignal::SunShadow), std::pair(0.0, 1.0)) << bDerived;
		const auto [Left, Right] = GetHalves(Picture, ESignal::LocalDiffuse);
		EXPECT_EQ(Left, 0.0) << bDerived;
		EXPECT_NEAR(Right, GetExpectedLamp(), 0.01 * GetExpectedLamp()) << bDerived;
	}
}

TEST_F(FBackAlbedoTest, WhatLiesBelowCastsShadow)
{
	const FSignalPicture Picture = RenderLit(-1.0f);
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::LocalDiffuse})
	{
		EXPECT_EQ(GetHalves(Picture, Signal), std::pair(0.0, 0.0)) << GetSignalInfo(Signal).Name;
	}
	EXPECT_EQ(GetHalves(RenderLit(1.0f), ESignal::SunShadow), std::pair(0.0, 1.0)) << "and what hangs above does not";
}

/// Under a black plate, the sky below is all the light that there is.
TEST_F(FBackAlbedoTest, SkyFromBelowIsGathered)
{
	const FSignalPicture Picture = Render(
	    [&](IRTModuleRenderer& Renderer) {
		AddPlate(Renderer, 1.0f);
		const float Sky[3] = {1, 1, 1};
		ASSERT_OK(Renderer.SetSky(Sky));
	    },
	    FSignalSet{ESignal::DiffuseGI});
	const auto [Left, Right] = GetHalves(Picture, ESignal::DiffuseGI);
	const double Expected = Back / (Front * (1.0 - Lost) + Back);
	EXPECT_LT(Left, 0.03) << "past the plate's edge";
	// 1,152 pixels of one path each, which is light or dark.
	const double Error = std::sqrt(Expected * (1.0 - Expected) / (0.5 * Size * Size));
	EXPECT_NEAR(Right, Expected, 0.02 + 3.0 * Error);
}

TEST_F(FBackAlbedoTest, VariableTurnsItOff)
{
	SetVariable("r.RT.DiffuseTransmission", "0");
	const FSignalPicture Picture = RenderLit();
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::LocalDiffuse})
	{
		EXPECT_EQ(GetHalves(Picture, Signal), std::pair(0.0, 0.0)) << GetSignalInfo(Signal).Name;
	}
}

/// A view that is a part of larger textures has its own part of this one.
TEST_F(FBackAlbedoTest, PartOfTheTextures)
{
	ChangeFrame = [this](FRTModuleFrame& Frame) {
		Frame.BackAlbedo = BackAlbedo.Get();
		Frame.OffsetX = Size / 2;
		Frame.Width = Size / 2;
	};
	FSignalPicture Picture;
	SetVariable("r.RT.Shadow.Denoise", "0");
	Picture = RenderLit();
	EXPECT_EQ(Picture.Signals.at(ESignal::SunShadow)[0], 1.0f);
	EXPECT_GT(Picture.Signals.at(ESignal::LocalDiffuse)[0], 0.0f);
}

} // namespace
} // namespace Lantern
