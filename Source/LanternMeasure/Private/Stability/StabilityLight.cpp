// Cases about how much light there is: 1 thin wall, 4 light switch, 5 time of day, 6 flicker, 7 tiny emitters, 19 furnace.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "LanternImage/ImageStatistics.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"
#include "Stability/StabilityGeometry.h"

namespace Lantern
{

/// Mean of the signal inside the sealed room over its mean in the view of the room from outside. Without a reference: what
/// is inside is zero by construction. The fault for sun shadows shortens their rays; else it is a slit in the roof.
FRTStatus MeasureThinWall(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	for (const int Centimetres : {0, 1, 5, 10})
	{
		if (FRTStatus S = Stage.Load(fmt::format("stability-wall:{}:{}", Centimetres, Stage.IsFaulty() ? 20 : 0)); !S) { return S; }
		std::vector<FImage> Frames;
		if (FRTStatus S = Stage.Play(RepeatView(Stage.MakeView({9, 4, 10}, {0, 1.5, 0}, 45), 2, 1), Frames); !S) { return S; }
		const double Outside = MeanOver(Frames[1]);
		Stage.AddToStrip(Frames[1], {});
		if (FRTStatus S = Stage.Play(RepeatView(Stage.MakeView(), 8, 0), Frames); !S) { return S; }
		const FImage Inside = MeanImage(Frames);
		Stage.AddToStrip(Inside, {});
		Out.push_back({fmt::format("{} cm", Centimetres), MeanOver(Inside) / Outside, Centimetres > 0 ? 1e-4 : 1e-3});
	}
	return FRTStatus::Success();
}

/// A lamp is dark for 30 frames, shines for 64, and is dark again. The means of the picture say how soon. The fault: histories of a
/// minute, or a switch ten frames late.
FRTStatus MeasureLightSwitch(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-switch:4"); !S) { return S; }
	constexpr int Dark = 30, Lit = 64;
	constexpr double OnSeconds = 1.0, OffSeconds = 3.0; // times of the scene at which it does not change
	std::vector<FStabilityShot> Shots(Dark + 2 * Lit);
	const int Late = Stage.IsFaulty() ? 10 : 0;
	for (int I = 0; I < int(Shots.size()); ++I)
	{
		Shots[I].View = Stage.MakeView();
		Shots[I].Time = I >= Dark + Late && I < Dark + Lit + Late ? OnSeconds : OffSeconds;
		Shots[I].bKeep = true;
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(Shots[0].View, OnSeconds, Reference); !S) { return S; }
	const double Whole = MeanOver(Reference.Mean);
	std::vector<double> Means;
	for (const FImage& Frame : Frames) { Means.push_back(MeanOver(Frame)); }
	for (const int At : {Dark, Dark + 2, Dark + 16, Dark + Lit, Dark + Lit + 2}) { Stage.AddToStrip(Frames[size_t(At)], Reference.Mean); }
	const double Frames90 = Stage.GetSignal() == ESignal::DiffuseGI ? 16.0 : 6.0; // light of several bounces
	Out.push_back({"frames to 90 % of the light", CountFramesTo(Means, Dark, 0.9 * Whole, true), Frames90});
	// Where no lamp shines, nothing is accumulated: the filter cannot be made to fail there, and a late switch can.
	const bool bStale = Stage.IsBroken() && !Stage.IsFaulty();
	Out.push_back({"frames to 10 % of the light", CountFramesTo(Means, Dark + Lit, 0.1 * Whole, false),
	    bStale ? std::nullopt : std::optional<double>(Frames90)});
	const double Least = *std::min_element(Means.begin() + Dark + 16, Means.begin() + Dark + Lit);
	// A method that keeps nothing cannot fail these.
	const auto Limit = [&](double Value) { return Stage.KeepsHistory() ? std::optional<double>(Value) : std::nullopt; };
	Out.push_back({"undershoot", std::max(1.0 - Least / Whole, 0.0), Limit(0.05)});
	Out.push_back({"60 frames after it is out", Means[size_t(Dark + Lit + 59)] / Whole, bStale ? std::nullopt : Limit(0.01)});
	return FRTStatus::Success();
}

namespace
{
constexpr int FlickerPeriod = 12; ///< frames at 60 Hz: one of 5 Hz, three of 15 Hz

/// The share of each pixel that goes through Waves periods in FlickerPeriod frames. Frames: some whole FlickerPeriods.
std::vector<std::complex<double>> FindWave(const std::vector<FImage>& Frames, int Waves)
{
	std::vector<std::complex<double>> Wave(Frames[0].Pixels.size());
	for (size_t Frame = 0; Frame < Frames.size(); ++Frame)
	{
		const double Angle = -2.0 * std::numbers::pi * Waves * double(Frame) / FlickerPeriod;
		const std::complex<double> Turn = std::polar(1.0 / double(Frames.size()), Angle);
		for (size_t I = 0; I < Wave.size(); ++I) { Wave[I] += Turn * double(Frames[Frame].Pixels[I]); }
	}
	return Wave;
}

/// Absolute value: amplitude over that of R. Argument: by which F is ahead. All pixels count alike, however bright they are in Mean.
std::complex<double> CompareWaves(
    const std::vector<std::complex<double>>& F, const std::vector<std::complex<double>>& R, const FImage& Mean)
{
	std::complex<double> Sum = 0.0;
	double Whole = 0.0;
	const double Least = 0.1 * MeanOver(Mean);
	for (size_t I = 0; I < F.size(); ++I)
	{
		const double Weight = 1.0 / std::pow(std::max(double(Mean.Pixels[I]), Least), 2.0);
		Sum += Weight * F[I] * std::conj(R[I]);
		Whole += Weight * std::norm(R[I]);
	}
	return Sum / Whole;
}
} // namespace

/// 32 lamps are switched on and off 5 and 15 times a second, in eight phases. The picture's waves against those of references. The
/// fault: histories of a minute, or lamps that are five frames late.
FRTStatus MeasureFlicker(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-flicker"); !S) { return S; }
	constexpr int Warm = 2 * FlickerPeriod, Count = 4 * FlickerPeriod;
	const int Late = Stage.IsFaulty() ? 5 : 0;
	const FView View = Stage.MakeView();
	std::vector<FStabilityShot> Shots = RepeatView(View, Warm + Count, Warm);
	for (int I = 0; I < Warm + Count; ++I) { Shots[size_t(I)].Time = double(I - Late) / 60.0; }
	std::vector<FImage> Frames, References;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	Frames = DropUnkept(std::move(Frames));
	for (int I = 0; I < FlickerPeriod; ++I)
	{
		FSignalReference Reference;
		if (FRTStatus S = Stage.GetReference(View, double(I) / 60.0, Reference); !S) { return S; }
		References.push_back(std::move(Reference.Mean));
	}
	for (const size_t At : {0, 3, 6, 9}) { Stage.AddToStrip(Frames[size_t(Count) - FlickerPeriod + At], References[At]); }
	const FImage Mean = MeanImage(References);
	const std::complex<double> Slow = CompareWaves(FindWave(Frames, 1), FindWave(References, 1), Mean),
	                           Fast = CompareWaves(FindWave(Frames, 3), FindWave(References, 3), Mean);
	// What is late has its amplitude all the same. What keeps all of its history lags by three frames at most.
	Out.push_back({"amplitude at 5 Hz", std::abs(Slow), Stage.IsFaulty() ? std::nullopt : std::optional<double>(0.8), true});
	const bool bStale = Stage.IsBroken() && !Stage.IsFaulty();
	const double Lag = -std::arg(Slow) / (2.0 * std::numbers::pi) * FlickerPeriod;
	Out.push_back({"lag at 5 Hz, frames", Lag, bStale ? std::nullopt : std::optional<double>(3.0)});
	Out.push_back({"amplitude at 15 Hz", std::abs(Fast), std::nullopt, true});
	return FRTStatus::Success();
}

/// The sun jumps from 60° to 5° between two frames, then sweeps at 15° a second. Error: see QuarterError. The fault: the
/// plugin is never told.
FRTStatus MeasureTimeOfDay(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-time"); !S) { return S; }
	const FSunLight Noon = Stage.GetScene().GetScene().GetSun();
	const auto SunAt = [&](double Degrees) {
		FSunLight Sun = Noon;
		const double Angle = glm::radians(Degrees);
		Sun.Direction = glm::dvec3(-std::cos(Angle), -std::sin(Angle), 0.2 * std::cos(Angle));
		Sun.Direction = glm::normalize(Sun.Direction);
		return Sun;
	};
	constexpr int Still = 20, Jump = 64, Sweep = 60;
	const auto ElevationAt = [&](int Frame) {
		if (Frame < Still) { return 60.0; }
		return 5.0 + 0.25 * std::clamp(Frame - Still - Jump, 0, Sweep);
	};
	std::vector<FStabilityShot> Shots(Still + Jump + Sweep + 1);
	for (int I = 0; I < int(Shots.size()); ++I)
	{
		Shots[I].View = Stage.MakeView();
		Shots[I].Change = [Sun = SunAt(ElevationAt(Stage.IsFaulty() ? 0 : I))](FHostScene& Scene) { Scene.SetSun(Sun); };
		const int Since = I - Still + 1;
		Shots[I].bKeep = (Since >= 16 && Since < 20) || (Since >= 60 && Since < 64) || I + 1 == int(Shots.size());
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	FSignalReference Low, High;
	Stage.GetScene().SetSun(SunAt(5.0));
	if (FRTStatus S = Stage.GetReference(Shots[0].View, 0.0, Low); !S) { return S; }
	Stage.GetScene().SetSun(SunAt(20.0));
	if (FRTStatus S = Stage.GetReference(Shots[0].View, 0.0, High); !S) { return S; }
	const auto Mean4 = [&](int Since) {
		const auto First = Frames.begin() + Still - 1 + Since;
		return MeanImage({First, First + 4});
	};
	const FImage At16 = Mean4(16), At60 = Mean4(60);
	Stage.AddToStrip(At16, Low.Mean);
	Stage.AddToStrip(At60, Low.Mean);
	Stage.AddToStrip(Frames.back(), High.Mean);
	Out.push_back({"16 frames after a jump", QuarterError(At16, Low.Mean), 0.10});
	Out.push_back({"60 frames after a jump", QuarterError(At60, Low.Mean), 0.03});
	Out.push_back({"in a sweep of 15 deg/s", QuarterError(Frames.back(), High.Mean), 0.10});
	return FRTStatus::Success();
}

namespace
{
/// Per million pixels: those above ten times the median of the 5 × 5 around them (and of a tenth of the mean at least), unless the
/// reference is as bright there: a candle is brighter than what is behind it.
double CountFireflies(const FImage& Image, const FImage& Reference)
{
	const double Floor = 0.1 * MeanOver(Image);
	uint64_t Count = 0;
	for (uint32_t Y = 0; Y < Image.Height; ++Y)
	{
		for (uint32_t X = 0; X < Image.Width; ++X)
		{
			std::vector<float> Around;
			for (int Dy = -2; Dy <= 2; ++Dy)
			{
				for (int Dx = -2; Dx <= 2; ++Dx)
				{
					const uint32_t Nx = static_cast<uint32_t>(std::clamp(int(X) + Dx, 0, int(Image.Width) - 1)),
					               Ny = static_cast<uint32_t>(std::clamp(int(Y) + Dy, 0, int(Image.Height) - 1));
					Around.push_back(GetLuminance(Image, Nx, Ny));
				}
			}
			std::nth_element(Around.begin(), Around.begin() + 12, Around.end());
			const double Value = GetLuminance(Image, X, Y), Right = GetLuminance(Reference, X, Y);
			Count += Value > 10.0 * std::max(double(Around[12]), Floor) && Value > 2.0 * Right ? 1 : 0;
		}
	}
	return 1e6 * double(Count) / double(Image.GetPixelCount());
}
} // namespace

/// After 60 frames of a still picture. Of methods that keep nothing, noise is recorded without a limit. The fault: a fifth
/// of the candles is out.
FRTStatus MeasureTinyEmitters(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-candles"); !S) { return S; }
	std::vector<FStabilityShot> Shots = RepeatView(Stage.MakeView(), 76, 60);
	if (Stage.IsFaulty())
	{
		Shots[0].Change = [](FHostScene& Scene) {
			for (size_t I = 2; I < Scene.GetInstanceCount(); I += 5)
			{
				Scene.SetTransform(I, glm::dmat4(glm::dvec4(1, 0, 0, 0), {0, 1, 0, 0}, {0, 0, 1, 0}, {0, -50, 0, 1}));
			}
		};
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	Frames = DropUnkept(std::move(Frames));
	if (FRTStatus S = Stage.Load("stability-candles"); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(Shots[0].View, 0.0, Reference); !S) { return S; }
	Stage.AddToStrip(Frames[0], Reference.Mean);
	const FImage Mean = MeanImage(Frames);
	Stage.AddToStrip(Mean, Reference.Mean);
	const bool bKeeps = Stage.KeepsHistory();
	const auto Limit = [&](double Value) { return bKeeps ? std::optional<double>(Value) : std::nullopt; };
	Out.push_back({"sigma", TemporalSigma(Frames), Limit(0.03)});
	Out.push_back({"fireflies per Mpx", CountFireflies(Frames.back(), Reference.Mean), Limit(5.0)});
	Out.push_back({"energy", std::abs(MeanOver(Mean) / MeanOver(Reference.Mean) - 1.0), 0.03});
	return FRTStatus::Success();
}

/// Spheres of roughness 0 to 1 under a sky of 1, each against the path tracer: the worst one's mean over 32 frames, off by so
/// much. The fault: the plugin's sky is 5 % brighter.
FRTStatus MeasureFurnace(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-furnace"); !S) { return S; }
	const FView View = Stage.MakeView();
	std::vector<FStabilityShot> Shots = RepeatView(View, 40, 8);
	if (Stage.IsFaulty())
	{
		Shots[0].Change = [](FHostScene& Scene) { Scene.GetScene().SetSky(glm::vec3(1.05f)); };
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	const FImage Mean = MeanImage(DropUnkept(std::move(Frames)));
	if (FRTStatus S = Stage.Load("stability-furnace"); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(View, 0.0, Reference); !S) { return S; }
	Stage.AddToStrip(Mean, Reference.Mean);
	const FSceneDescription& Scene = Stage.GetScene().GetDescription();
	const auto Hits = TracePicture(FCpuScene(Scene, 0.0), View);
	for (const char* Kind : {"dielectric", "metal"})
	{
		double Worst = 0.0;
		for (int I = 0; I < 5; ++I)
		{
			const std::string Name = fmt::format("{} {}", Kind, I);
			FPixelMask Mask(Hits.size());
			for (size_t Pixel = 0; Pixel < Hits.size(); ++Pixel)
			{
				if (!Hits[Pixel] || Scene.Nodes[static_cast<size_t>(Hits[Pixel]->Node)].Name != Name) { continue; }
				// The rim is left out: a pixel there holds sky too.
				const glm::dvec3 Center = Scene.Nodes[static_cast<size_t>(Hits[Pixel]->Node)].Translation,
				                 Off = Hits[Pixel]->Position - Center;
				Mask[Pixel] = Off.x * Off.x + Off.y * Off.y < 0.6 ? 1 : 0;
			}
			const double R = MeanOver(Reference.Mean, Mask);
			if (R > 1e-3) { Worst = std::max(Worst, std::abs(MeanOver(Mean, Mask) / R - 1.0)); }
		}
		// A signal may have nothing on one kind, as diffuse light on metal.
		if (Worst > 0.0) { Out.push_back({Kind, Worst, 0.01}); }
	}
	return FRTStatus::Success();
}

} // namespace Lantern
