// Outputs of the module that are no signals: glass, light in the air and in fog, and the light mask.
#include <limits>

#include "ModuleSignalFixture.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using FModuleOutputTest = FModuleSignalTest;

TEST_F(FModuleOutputTest, GlassIsAnOutputOfItsOwn)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {};
	Frame.bTransmission = true;
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Transmission.Light, nullptr) << "light shines through nothing";
	EXPECT_THAT(GetPasses(), Not(Contains(StartsWith("Transmission"))));
	FRTModuleMaterial Glass;
	Glass.Transmission = 1.0f;
	ERTMaterialHandle Handle{};
	ASSERT_OK(Renderer->AddMaterial(Glass, &Handle));
	ASSERT_OK(AddObject(AddOpaqueMesh(), Handle));
	RenderUntilComplete(Frame);
	ASSERT_NE(Outputs.Transmission.Light, nullptr);
	ASSERT_NE(Outputs.Transmission.Transmittance, nullptr);
	ASSERT_NE(Outputs.Transmission.Looks, nullptr);
	EXPECT_EQ(Outputs.Transmission.Light->GetDesc().Format, ERTFormat::RGBA16_FLOAT);
	EXPECT_EQ(Outputs.Transmission.Transmittance->GetDesc().Format, ERTFormat::RGBA8_UNORM);
	EXPECT_EQ(Outputs.Transmission.Looks->GetDesc().Format, ERTFormat::RGBA32_UINT);
	EXPECT_EQ(Outputs.Transmission.Looks->GetDesc().Width, 64u);
	Frame.bTransmission = false;
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Transmission.Light, nullptr) << "nobody asks";
	Frame.bTransmission = true;
	Glass.Transmission = 0.0f;
	ASSERT_OK(Renderer->SetMaterial(Handle, Glass));
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Transmission.Light, nullptr) << "the glass has become opaque";
}

TEST_F(FModuleOutputTest, IndirectVolumeIsAnOutputOfItsOwn)
{
	SetVariable("r.RT.GI", "3");
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {ESignal::DiffuseGI};
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.IndirectVolume.Light, nullptr) << "nobody asks";
	EXPECT_EQ(Outputs.IndirectVolume.ColumnCount, 0u);
	EXPECT_THAT(GetPasses(), Not(Contains(StartsWith("IndirectVolume"))));
	Frame.bIndirectVolume = true;
	ASSERT_TRUE(WaitUntil(
	    "light in the air", [&] { return Outputs.IndirectVolume.Light != nullptr; }, [&] { RenderUntilComplete(Frame); }));
	const FRTModuleIndirectVolume& Volume = Outputs.IndirectVolume;
	for (const IRTTexture* const Texture : {Volume.Light, Volume.Moment})
	{
		EXPECT_EQ(Texture->GetDesc().Format, ERTFormat::RGBA16_FLOAT);
		EXPECT_EQ(Texture->GetDesc().Width, Volume.ColumnCount * Volume.SlicesPerRow);
		EXPECT_GE(Texture->GetDesc().Height * Volume.SlicesPerRow, Volume.RowCount * Volume.SliceCount);
	}
	EXPECT_EQ(Volume.ColumnCount, (64 + Volume.PixelSize - 1) / Volume.PixelSize);
	EXPECT_GT(Volume.Distance, 0.0f);
	EXPECT_THAT(GetPasses(), Not(Contains(StartsWith("Fog"))));
	Frame.Wanted = {};
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.IndirectVolume.Light, nullptr) << "nothing keeps radiance cells";
	Frame.Wanted = {ESignal::DiffuseGI};
	SetVariable("r.RT.GI.Volume", "0");
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.IndirectVolume.Light, nullptr);
}

TEST_F(FModuleOutputTest, FogIsAnOutputOfItsOwn)
{
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = {};
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.Fog.Visibility, nullptr) << "nobody asks";
	EXPECT_EQ(Outputs.Fog.ColumnCount, 0u);
	EXPECT_THAT(GetPasses(), Not(Contains(StartsWith("Fog"))));
	Frame.bFog = true;
	Frame.FogPhase = 0.5f;
	RenderUntilComplete(Frame);
	ASSERT_NE(Outputs.Fog.Visibility, nullptr);
	EXPECT_EQ(Outputs.Fog.Light, nullptr) << "there are no lamps";
	EXPECT_EQ(Outputs.Fog.Visibility->GetDesc().Format, ERTFormat::R8_UNORM);
	EXPECT_EQ(Outputs.Fog.Visibility->GetDesc().Width, Outputs.Fog.ColumnCount * Outputs.Fog.SlicesPerRow);
	EXPECT_EQ(Outputs.Fog.Visibility->GetDesc().Height, Outputs.Fog.RowCount * (Outputs.Fog.SliceCount / Outputs.Fog.SlicesPerRow));
	EXPECT_EQ(Outputs.Fog.ColumnCount, (64 + Outputs.Fog.PixelSize - 1) / Outputs.Fog.PixelSize);
	EXPECT_GT(Outputs.Fog.Distance, 0.0f);
	FRTModuleLight Lamp;
	Lamp.Color[0] = 1.0f;
	ERTLightHandle Handle{};
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	ASSERT_TRUE(WaitUntil(
	    "light in fog", [&] { return Outputs.Fog.Light != nullptr; }, [&] { RenderUntilComplete(Frame); }));
	EXPECT_EQ(Outputs.Fog.Light->GetDesc().Format, ERTFormat::RGBA16_FLOAT);
	Frame = DescribeFrame();
	for (const float Bad : {1.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()})
	{
		Frame.FogPhase = Bad;
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
		EXPECT_THAT(Status.Message, HasSubstr("FRTModuleFrame::FogPhase"));
	}
}

TEST_F(FModuleOutputTest, TheLightMaskIsAnOutputOfItsOwn)
{
	FRTModuleLight Lamp;
	Lamp.Color[0] = 1.0f;
	ERTLightHandle Handle{};
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	FRTModuleFrame Frame = DescribeFrame(); // without base colours
	Frame.Wanted = {};
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.LightMask.Visibility, nullptr) << "nobody asks";
	EXPECT_EQ(Outputs.LightMask.Lights, nullptr);
	EXPECT_THAT(GetPasses(), Not(Contains(HasSubstr("Mask"))));
	Frame.bLightMask = true;
	RenderUntilComplete(Frame);
	ASSERT_NE(Outputs.LightMask.Visibility, nullptr);
	ASSERT_NE(Outputs.LightMask.Lights, nullptr);
	EXPECT_EQ(Outputs.LightMask.Visibility->GetDesc().Format, ERTFormat::R32_UINT);
	EXPECT_EQ(Outputs.LightMask.Visibility->GetDesc().Width, 64u);
	EXPECT_EQ(Outputs.LightMask.Lights->GetDesc().Format, ERTFormat::R32_UINT);
	EXPECT_EQ(Outputs.LightMask.Lights->GetDesc().Width, 64u);
	EXPECT_EQ(Outputs.LightMask.Lights->GetDesc().Height, (Outputs.LightMask.Visibility->GetDesc().Height + 7) / 8);
	EXPECT_EQ(Outputs.Get(ESignal::LocalDiffuse), nullptr) << "nobody asks for it";
	EXPECT_THAT(GetPasses(), Contains("ShadowLightsMask"));
	ASSERT_OK(Renderer->RemoveLight(Handle));
	RenderUntilComplete(Frame);
	EXPECT_EQ(Outputs.LightMask.Visibility, nullptr) << "there are no lamps";
}

TEST_F(FModuleOutputTest, TheLightMaskAndTheRestComeTogether)
{
	FRTModuleLight Lamp;
	std::vector<ERTLightHandle> Handles(12);
	for (ERTLightHandle& Handle : Handles) { ASSERT_OK(Renderer->AddLight(Lamp, &Handle)); }
	FRTModuleFrame Frame = DescribeAll();
	Frame.Wanted = {ESignal::LocalDiffuse, ESignal::LocalSpecular};
	Frame.bLightMask = true;
	const auto Step = [&] {
		Frame.Commands = DescribeFrame().Commands;
		ASSERT_OK(Renderer->RenderFrame(Frame, &Outputs));
		ASSERT_OK(Renderer->EndFrame(nullptr));
		const bool bMask = Outputs.LightMask.Visibility != nullptr;
		EXPECT_EQ(Outputs.Get(ESignal::LocalDiffuse) != nullptr, bMask) << "else light is missing, or counted twice";
		EXPECT_EQ(Outputs.Get(ESignal::LocalSpecular) != nullptr, bMask);
	};
	ASSERT_TRUE(WaitUntil(
	    "a complete frame", [&] { return Outputs.bComplete; }, Step));
	EXPECT_NE(Outputs.LightMask.Visibility, nullptr);
}

// Lower bits serve as an index, and upper ones tell a light from one before it.
TEST_F(FModuleOutputTest, LightNumbersAreSmallAndNotUsedTwice)
{
	FRTModuleLight Lamp;
	std::vector<uint32_t> Numbers;
	ERTLightHandle Handle{};
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
		Numbers.push_back(GetLightNumber(Handle));
	}
	EXPECT_EQ(GetLightNumber(ERTLightHandle::None), 0u);
	EXPECT_EQ(Numbers, (std::vector<uint32_t>{1, 2, 3}));
	ASSERT_OK(Renderer->RemoveLight(Handle));
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	EXPECT_EQ(GetLightNumber(Handle), 3u | 1u << 24);
}

} // namespace
} // namespace Lantern
