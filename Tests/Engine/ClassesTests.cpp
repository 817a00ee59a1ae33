// Classes of pixels as an engine hands them over: characters cast no shadow on pixels that show one.
#include "FlatEngine.h"

namespace Lantern
{
namespace
{

/// A plate that is a character hangs over the whole floor, under the sun or a lamp. The right half of the picture shows a character, as the
/// engine says.
class FClassesTest : public FFlatEngineTest
{
protected:
	static constexpr uint8_t CharacterBit = 1;

	void MakeClasses(uint8_t Right)
	{
		std::vector<uint8_t> Texels(size_t(Size) * Size);
		for (size_t I = 0; I < Texels.size(); ++I) { Texels[I] = I % Size >= Size / 2 ? Right : uint8_t(0); }
		Classes = MakeTexture({Size, Size, 1, 1, ERTFormat::R8_UNORM, ERTTextureUsage::Sampled, "EngineClasses"}, Texels.data());
	}
	static void AddPlate(IRTModuleRenderer& Renderer, bool bCharacter)
	{
		FRTModuleMaterial Material;
		Material.bDoubleSided = true;
		FRTModuleObject Object;
		ERTMaterialHandle MaterialHandle = ERTMaterialHandle::None;
		ERTObjectHandle Handle = ERTObjectHandle::None;
		ASSERT_OK(Renderer.AddMaterial(Material, &MaterialHandle));
		Object.Mesh = AddSquare(Renderer, 50.0f, 5.0f);
		Object.Materials = &MaterialHandle;
		Object.MaterialCount = 1;
		Object.bCharacter = bCharacter;
		ASSERT_OK(Renderer.AddObject(Object, &Handle));
	}
	FSignalPicture RenderPlate(bool bCharacter)
	{
		SetVariable("r.RT.Shadow.Denoise", "0");
		SetVariable("r.RT.Lights.Denoise", "0");
		return Render(
		    [&](IRTModuleRenderer& Renderer) {
			AddPlate(Renderer, bCharacter);
			AddVerticalLights(Renderer, 10.0);
		    },
		    FSignalSet{ESignal::SunShadow, ESignal::LocalDiffuse});
	}
};

TEST_F(FClassesTest, CharactersCastOnAllButCharacters)
{
	MakeClasses(CharacterBit);
	const FSignalPicture Picture = RenderPlate(true);
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::LocalDiffuse})
	{
		const auto [Left, Right] = GetHalves(Picture, Signal);
		EXPECT_EQ(Left, 0.0) << GetSignalInfo(Signal).Name << ": the floor is in the character's shadow";
		EXPECT_GT(Right, 0.1) << GetSignalInfo(Signal).Name << ": what shows a character is not";
	}
}

TEST_F(FClassesTest, OtherCastersCastOnCharacters)
{
	MakeClasses(CharacterBit);
	const FSignalPicture Picture = RenderPlate(false);
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::LocalDiffuse}) { EXPECT_EQ(GetHalves(Picture, Signal).second, 0.0); }
}

TEST_F(FClassesTest, WithoutClassesCharactersCastOnAll)
{
	const FSignalPicture None = RenderPlate(true);
	MakeClasses(0);
	const FSignalPicture Empty = RenderPlate(true);
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::LocalDiffuse})
	{
		EXPECT_EQ(GetHalves(None, Signal).second, 0.0);
		EXPECT_EQ(GetHalves(Empty, Signal).second, 0.0);
	}
}

// Planted: shaders are not told which pixels show characters.
TEST_F(FClassesTest, FaultIsSeen)
{
	MakeClasses(CharacterBit);
	SetVariable("r.RT.Debug.Shadow.Receivers", "0");
	EXPECT_EQ(GetHalves(RenderPlate(true), ESignal::SunShadow).second, 0.0);
}

} // namespace
} // namespace Lantern
