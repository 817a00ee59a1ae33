// Poisoned histories on a real device: the bits arrive in every format, with the right barriers, and none of them reaches
// a picture.
#include <cmath>

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

} // namespace
} // namespace Lantern
