// Lights that are added, removed and swapped in each frame: slots are used again, and neither the guide of tiles nor the filter takes one
// light for another.
#include <cmath>
#include <utility>

#include "LanternImage/ImageStatistics.h"
#include "LocalLightsFixture.h"

namespace Lantern
{

namespace
{
constexpr uint32_t LampCount = 64;
constexpr double Tolerance = 0.005;

class FLightIdentityTest : public FLocalLightsFixture
{
protected:
	struct FLamp
	{
		FSceneLight Light;
		FLightId Id;
		uint32_t Slot = 0; // that it has, or had
	};
	/// Means over the picture.
	struct FMeans
	{
		double Luminance = 0.0, Blue = 0.0;
	};

	/// Lamps around posts, of which every third is blue. No other light has any blue.
	void SetUp() override
	{
		FLocalLightsFixture::SetUp();
		ASSERT_NO_FATAL_FAILURE(LoadPosts());
		for (uint32_t I = 0; I < LampCount; ++I)
		{
			const double Angle = 2.4 * I, Far = 2.6 * std::sqrt((I + 0.5) / LampCount);
			FSceneLight Light;
			Light.Position = {Far * std::cos(Angle), 0.5 + 0.13 * (I % 9), Far * std::sin(Angle)};
			Light.Color = IsBlue(I) ? glm::vec3(0, 0, 1) : glm::vec3(0.06f, 0.05f, 0);
			const FLightId Id = GetWorld().AddLight(Light);
			Lamps.push_back({Light, Id, Id.Index});
		}
	}
	static bool IsBlue(uint32_t Lamp) { return Lamp % 3 == 2; }
	static FView GetView() { return LookAt({0, 3.0, 4.5}, {0, 0.2, 0}, 0.9f, 48, 27); }

	/// Takes a third of all lamps away, another one in each frame, and brings them back into slots of each other. Blue ones stay away if
	/// bBlue is off.
	void Swap(uint32_t Frame, bool bBlue)
	{
		std::vector<uint32_t> Away;
		for (uint32_t I = 0; I < LampCount; ++I)
		{
			const bool bGoes = bBlue ? (I / 3 + Frame) % 3 == 0 : IsBlue(I);
			if (bGoes && Lamps[I].Id.IsValid()) { GetWorld().RemoveLight(std::exchange(Lamps[I].Id, {})); }
			if (!Lamps[I].Id.IsValid() && (bBlue || !IsBlue(I))) { Away.push_back(I); }
		}
		for (size_t I = 0; I < Away.size(); ++I)
		{
			FLamp& Lamp = Lamps[Away[(I + 1 + Frame) % Away.size()]];
			Lamp.Id = GetWorld().AddLight(Lamp.Light);
			Swapped += Lamp.Id.Index != std::exchange(Lamp.Slot, Lamp.Id.Index) ? 1 : 0;
		}
	}
	/// The first frame starts anew; each later one has the histories of the one before.
	FMeans Render(uint32_t Frame)
	{
		FView View = GetView();
		View.FrameIndex = Frame;
		View.bCut = Frame == 0;
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::LocalDiffuse);
		FCapturedFrame Captured;
		EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
		const FImageMeans Means = ComputeMeans(Captured.Get(ESignal::LocalDiffuse));
		return {Means.Luminance, Means.Channel[2]};
	}
	/// What all lamps bring, or all but the blue ones, by the reference.
	double TraceLuminance(bool bBlue)
	{
		if (!bBlue) { Swap(0, false); }
		std::vector<double> Values;
		for (uint32_t Batch = 0; Batch < 4; ++Batch)
		{
			Values.push_back(ComputeMeans(TraceSignal(ESignal::LocalDiffuse, GetView(), 192, 1, 1 + Batch)).Luminance);
		}
		if (!bBlue) { Swap(0, true); }
		const FEstimate Truth = MakeEstimate(Values);
		EXPECT_LT(Truth.StandardError, 0.3 * Tolerance * Truth.Mean) << "too few samples to tell";
		return Truth.Mean;
	}

	std::vector<FLamp> Lamps;
	uint32_t Swapped = 0; ///< lamps that have come into another slot than they had
};

// The picture stays as it is, whatever slots its lamps have. A guide that takes a lamp for the former one of its slot only adds noise.
TEST_F(FLightIdentityTest, SwappedLampsBringWhatTheyBrought)
{
	const double Truth = TraceLuminance(true);
	const auto Play = [&] {
		std::vector<double> Values;
		for (uint32_t Frame = 0; Frame < 160; ++Frame)
		{
			Swap(Frame, true);
			const double Value = Render(Frame).Luminance;
			if (Frame >= 32) { Values.push_back(Value); }
		}
		EXPECT_GT(std::exchange(Swapped, 0), 160u * LampCount / 4) << "slots stayed";
		return MakeEstimate(Values).Mean / Truth;
	};
	SetVariable("r.RT.Lights.Denoise", "0");
	const double Raw = Play();
	EXPECT_NEAR(Raw, 1.0, Tolerance);
	// Nobody knows how visible a lamp is that came into a slot, and histories keep some of what was guessed: Performance.md.
	SetVariable("r.RT.Lights.Denoise", "1");
	PrintFigure(fmt::format("swapped lamps over the reference: raw {:.5f}, filtered {:.5f}", Raw, Play()));
	SetVariable("r.RT.Lights.Denoise", "0");
	SetVariable("r.RT.Debug.Lights.Weight", "0");
	EXPECT_GT(std::abs(Play() - 1.0), 4.0 * Tolerance) << "the planted fault goes unnoticed";
}

// A third of the lamps dies in every other frame, and is born again in the next one.
TEST_F(FLightIdentityTest, DeadLampsBringNothing)
{
	const double All = TraceLuminance(true), Others = TraceLuminance(false);
	EXPECT_LT(Others, 0.8 * All);
	for (const char* const Filter : {"0", "1"})
	{
		SetVariable("r.RT.Lights.Denoise", Filter);
		constexpr uint32_t First = 32, Frames = 96;
		FMeans OfAll, OfOthers;
		for (uint32_t Frame = 0; Frame < First + Frames; ++Frame)
		{
			const bool bBlue = Frame % 2 == 0;
			Swap(Frame, bBlue);
			const FMeans Means = Render(Frame);
			FMeans& Sum = bBlue ? OfAll : OfOthers;
			if (Frame < First) { continue; }
			Sum.Luminance += Means.Luminance / (Frames / 2);
			Sum.Blue += Means.Blue / (Frames / 2);
		}
		PrintFigure(fmt::format("filter {}: all over the reference {:.5f}, without the dead {:.5f}", Filter, OfAll.Luminance / All,
		    OfOthers.Luminance / Others));
		EXPECT_GT(OfAll.Blue, 0.0) << Filter;
		EXPECT_EQ(OfOthers.Blue, 0.0) << Filter;
		if (Filter[0] != '0') { continue; } // as above
		EXPECT_NEAR(OfAll.Luminance / All, 1.0, Tolerance);
		EXPECT_NEAR(OfOthers.Luminance / Others, 1.0, Tolerance);
	}
}

} // namespace
} // namespace Lantern
