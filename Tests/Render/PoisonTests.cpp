// Poisoned histories on a real device: the bits arrive in every format, with the right barriers, and none of them reaches
// a picture.
#include <cmath>
#include <initializer_list>

#include <gmock/gmock.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRenderer/Frame.h"
#include "Support/HistoryTestTools.h"
#include "Support/RenderFixture.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::Each;
using ::testing::Not;

class FPoisonTest : public FRenderTest, protected FHistoryFrames
{
protected:
	void SetUp() override
	{
		FRenderTest::SetUp();
		OpenHistory(GetDevice());
	}
	void TearDown() override
	{
		EXPECT_OK(GetDevice().WaitIdle());
		CloseHistory();
		FRenderTest::TearDown();
	}
	/// What a frame finds of the one before, which wrote 1.
	std::vector<uint8_t> ReadBefore(ERTFormat Format, uint32_t Size)
	{
		Frame([&](FFrameGraph& Graph) {
			const FHistoryTexture Mean = Get("Mean", Size, Format);
			AddWriter(Graph, Mean.Current, 1.0f);
			AddReader(Graph, Mean.Current);
			if (Mean.Previous.IsValid()) { AddReader(Graph, Mean.Previous); }
		});
		EXPECT_OK(GetDevice().WaitIdle());
		std::vector<uint8_t> Bytes = ReadBytes();
		Bytes.resize(size_t(Size) * Size * BytesPerTexel(Format));
		return Bytes;
	}
};

TEST_F(FPoisonTest, BitsArriveInEveryFormat)
{
	for (const ERTFormat Format : {ERTFormat::R16_FLOAT, ERTFormat::RG16_FLOAT, ERTFormat::RGBA16_FLOAT, ERTFormat::R32_FLOAT,
	         ERTFormat::RG32_FLOAT, ERTFormat::RGBA32_FLOAT, ERTFormat::R11G11B10_FLOAT})
	{
		for (const uint32_t Size : {1u, 3u, 20u})
		{
			History->Clear();
			ReadBefore(Format, Size);
			EXPECT_THAT(ReadBefore(Format, Size), Contains(Not(0xff)));
			Resources->PoisonHistory("Mean");
			EXPECT_THAT(ReadBefore(Format, Size), Each(0xff)) << BytesPerTexel(Format) << " bytes, size " << Size;
			EXPECT_THAT(ReadBefore(Format, Size), Contains(Not(0xff))) << "once";
		}
	}
}

TEST_F(FPoisonTest, BuffersAreFilled)
{
	for (int Index = 0; Index < 4; ++Index)
	{
		if (Index == 2) { Resources->PoisonHistory(""); }
		Frame([&](FFrameGraph& Graph) {
			const FHistoryBuffer Cache = GetBuffer("Cache", 1000);
			EXPECT_EQ(Cache.bFresh, Index == 0);
			if (Index == 0 || Index == 3) { AddWriter(Graph, Cache.Buffer, 7); }
			AddReader(Graph, Cache.Buffer);
		});
		EXPECT_OK(GetDevice().WaitIdle());
		const std::vector<uint8_t> Bytes = ReadBytes();
		if (Index == 2) { EXPECT_THAT(Bytes, Each(0xff)); }
		else { EXPECT_THAT(Bytes, Contains(7)); }
	}
}

/// Every signal that keeps anything, poisoned in each frame: no picture has a number that is none.
TEST_F(FPoisonTest, NoPictureHasANumberThatIsNone)
{
	ASSERT_TRUE(Load("courtyard"));
	SetSun(2.0);
	SetSky(glm::vec3(1.0f));
	FFrameCapture Capture;
	Capture.bLighting = Capture.bDisplay = true;
	Capture.Signals = {ESignal::SunShadow, ESignal::AmbientOcclusion};
	FView View = MakeView(48, 32);
	for (const char* Every : {"0", "3", "1"})
	{
		SetVariable("r.RT.Debug.PoisonHistory", Every);
		uint32_t Poisoned = 0;
		for (int Index = 0; Index < 6; ++Index)
		{
			FCapturedFrame Captured;
			View.Position.x += 0.01;
			ASSERT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
			const auto& Timings = GetEngine().GetRenderer().GetGraphResources().GetTimings();
			Poisoned +=
			    uint32_t(std::count_if(Timings.begin(), Timings.end(), [](const FPassTiming& Pass) { return Pass.Name == "Poison"; }));
			for (const FImage* Image : {&Captured.Lighting, &Captured.Get(ESignal::SunShadow), &Captured.Get(ESignal::AmbientOcclusion)})
			{
				EXPECT_FALSE(Image->Pixels.empty());
				const auto IsNone = [](float Value) { return !std::isfinite(Value); };
				EXPECT_EQ(std::count_if(Image->Pixels.begin(), Image->Pixels.end(), IsNone), 0) << "every " << Every << ", frame " << Index;
			}
		}
		EXPECT_EQ(Poisoned, Every[0] == '0' ? 0u : Every[0] == '3' ? 2u : 6u) << "every " << Every;
	}
}

/// Memory of many lamps: the guide of tiles, and the histories of either lobe. What was poisoned has gone a frame later.
TEST_F(FPoisonTest, LampsForgetWhatIsNoNumber)
{
	ASSERT_TRUE(Load("courtyard"));
	SetSun(0.0, 0.0f);
	SetSky({});
	for (int I = 0; I < 12; ++I)
	{
		FSceneLight Light;
		Light.Position = {-3.0 + I % 4 * 2.0, 1.0 + 0.2 * I, -2.0 + I / 4 * 2.0};
		Light.Color = glm::vec3(3);
		GetScene().GetScene().AddLight(Light);
	}
	FFrameCapture Capture;
	Capture.Signals = {ESignal::LocalDiffuse, ESignal::LocalSpecular};
	const FView View = MakeView(48, 32);
	const auto IsNone = [](float Value) { return !std::isfinite(Value); };
	constexpr uint32_t Frames = 5;
	/// Of each frame: means of the lobes, and how many values are no numbers.
	struct FPlayed
	{
		double Diffuse[Frames] = {}, Specular[Frames] = {};
		ptrdiff_t None = 0;
	};
	const auto Play = [&](std::initializer_list<const char*> Poison) {
		FPlayed Played;
		GetEngine().SetFrameIndex(0);
		EXPECT_OK(GetEngine().RenderFrame(MakeView(8, 8), 0.0, {}, nullptr)); // another size: nothing to keep
		for (uint32_t Index = 0; Index < Frames; ++Index)
		{
			for (const char* const Names : Poison)
			{
				if (Index == 2) { GetEngine().GetRenderer().GetGraphResources().PoisonHistory(Names); }
			}
			FCapturedFrame Captured;
			EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
			const FImage &Diffuse = Captured.Get(ESignal::LocalDiffuse), &Specular = Captured.Get(ESignal::LocalSpecular);
			Played.Diffuse[Index] = MeanGreen(Diffuse);
			Played.Specular[Index] = MeanGreen(Specular);
			for (const FImage* Image : {&Diffuse, &Specular})
			{
				Played.None += std::count_if(Image->Pixels.begin(), Image->Pixels.end(), IsNone);
			}
		}
		return Played;
	};
	// Surfaces that are no numbers keep all else from being read, so a frame poisons what lies behind them alone.
	const FPlayed Right = Play({}), Poisoned = Play({"Local", "LightGuide"});
	EXPECT_EQ(Play({""}).None, 0);
	EXPECT_EQ(Right.None + Poisoned.None, 0);
	EXPECT_NE(Poisoned.Diffuse[2], Right.Diffuse[2]) << "nothing was poisoned";
	for (uint32_t Index = 0; Index < Frames; ++Index)
	{
		EXPECT_GT(Right.Diffuse[Index], 0.0);
		// A frame without memory is another sample of the same light: 1,536 pixels of one ray scatter by 2 %, highlights by 10 %.
		EXPECT_NEAR(Poisoned.Diffuse[Index] / Right.Diffuse[Index], 1.0, 0.1) << Index;
		EXPECT_NEAR(Poisoned.Specular[Index] / Right.Specular[Index], 1.0, 0.5) << Index;
	}
	SetVariable("r.RT.Debug.Denoise.Guard", "0");
	SetVariable("r.RT.Debug.Denoise.Adapt", "0");
	EXPECT_GT(Play({"Local"}).None, 0) << "the planted fault goes unnoticed";
}

} // namespace
} // namespace Lantern
