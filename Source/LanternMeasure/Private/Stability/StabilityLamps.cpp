// Cases about noise of local lights: 8 boiling, 13 thin specular, 17 light grid.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "LanternImage/ImageStatistics.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"
#include "Stability/StabilityGeometry.h"

namespace Lantern
{

namespace
{
/// Frames of a still picture, the first Skip left out.
FRTStatus PlayStill(FStabilityStage& Stage, const FView& View, size_t Skip, size_t Count, std::vector<FImage>& Out)
{
	FRTStatus S = Stage.Play(RepeatView(View, Skip + Count, Skip), Out);
	Out = DropUnkept(std::move(Out));
	return S;
}

/// A picture of the means of blocks.
FImage MakeBlocks(const FImage& Image, uint32_t Size)
{
	const std::vector<double> Means = ComputeBlockMeans(Image, Size);
	FImage Blocks(static_cast<uint32_t>(Means.size()), 1, 1);
	for (size_t I = 0; I < Means.size(); ++I) { Blocks.Pixels[I] = static_cast<float>(Means[I]); }
	return Blocks;
}

/// What a method that keeps nothing shows of noise is recorded without a limit.
std::optional<double> LimitNoise(const FStabilityStage& Stage, double Value)
{
	return Stage.KeepsHistory() ? std::optional<double>(Value) : std::nullopt;
}
} // namespace

/// Temporal σ of a hall of 640 lamps in which nothing moves, as an eye sees it that blurs 16 × 16 pixels. The fault: one candidate for
/// each pixel, and nothing is known of which lamps are hidden.
FRTStatus MeasureBoiling(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	constexpr uint32_t Box = 16;
	if (FRTStatus S = Stage.Load("stability-boiling"); !S) { return S; }
	std::vector<FImage> Frames;
	if (FRTStatus S = PlayStill(Stage, Stage.MakeView(), 60, 32, Frames); !S) { return S; }
	Stage.AddToStrip(Frames.front(), {});
	Stage.AddToStrip(Frames.back(), {});
	std::vector<FImage> Blocks;
	for (const FImage& Frame : Frames) { Blocks.push_back(MakeBlocks(Frame, Box)); }
	Out.push_back({"sigma of blocks", TemporalSigma(Blocks), LimitNoise(Stage, 0.01)});
	Out.push_back({"sigma of pixels", TemporalSigma(Frames), std::nullopt});
	return FRTStatus::Success();
}

/// Temporal σ of a railing of metal whose bars are a pixel wide, under 24 lamps. The fault is that of boiling.
FRTStatus MeasureThinSpecular(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load(fmt::format("stability-railing:{}:24", Stage.GetSettings().Height)); !S) { return S; }
	const FView View = Stage.MakeView();
	std::vector<FImage> Frames;
	if (FRTStatus S = PlayStill(Stage, View, 60, 32, Frames); !S) { return S; }
	Stage.AddToStrip(Frames.front(), {});
	Stage.AddToStrip(Frames.back(), {});
	const FSceneDescription& Scene = Stage.GetScene().GetDescription();
	const auto Hits = TracePicture(FCpuScene(Scene, 0.0), View);
	FPixelMask Mask(Hits.size());
	for (size_t Pixel = 0; Pixel < Hits.size(); ++Pixel)
	{
		Mask[Pixel] = Hits[Pixel] && Scene.Nodes[static_cast<size_t>(Hits[Pixel]->Node)].Name == "railing" ? 1 : 0;
	}
	Out.push_back({"sigma on the railing", TemporalSigma(Frames, Mask), LimitNoise(Stage, 0.05)});
	return FRTStatus::Success();
}

namespace
{
/// By how much steps between columns of a picture at borders exceed those elsewhere. bBorder: by column, the step to the one before.
double CompareSteps(const FImage& Ratio, const std::vector<bool>& bBorder)
{
	std::vector<double> Columns(Ratio.Width);
	for (uint32_t X = 0; X < Ratio.Width; ++X)
	{
		for (uint32_t Y = 0; Y < Ratio.Height; ++Y) { Columns[X] += double(GetLuminance(Ratio, X, Y)) / Ratio.Height; }
	}
	double Sums[2] = {}, Counts[2] = {};
	for (uint32_t X = 2; X + 1 < Ratio.Width; ++X)
	{
		const double Beside = 0.5 * (Columns[X - 1] - Columns[X - 2] + Columns[X + 1] - Columns[X]);
		Sums[bBorder[X]] += std::abs(Columns[X] - Columns[X - 1] - Beside);
		Counts[bBorder[X]] += 1.0;
	}
	return std::max(0.0, Sums[1] / std::max(Counts[1], 1.0) - Sums[0] / std::max(Counts[0], 1.0));
}
} // namespace

/// A floor under 640 lamps with a range, from above: the mean of frames over the reference, and its steps at borders of light cells of
/// 1 and 2 m and of tiles. The fault: every other metre is 5 % brighter.
FRTStatus MeasureLightGrid(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	constexpr double Height = 10.0, FovY = 60.0;
	if (FRTStatus S = Stage.Load("stability-lightgrid:6"); !S) { return S; }
	const FView View = Stage.MakeView({0, Height, 1e-3}, {0, 0, 0}, FovY);
	std::vector<FImage> Frames;
	if (FRTStatus S = PlayStill(Stage, View, 32, 64, Frames); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(View, 0.0, Reference); !S) { return S; }
	FImage Ratio = MeanImage(Frames);
	Stage.AddToStrip(Ratio, Reference.Mean);
	const double Energy = MeanOver(Ratio) / MeanOver(Reference.Mean);
	const double Scale = 2.0 * Height * std::tan(0.5 * glm::radians(FovY)) / Ratio.Height; // metres of a pixel
	const auto CellOf = [&](uint32_t X, double Size) { return std::floor((double(X) + 0.5 - 0.5 * Ratio.Width) * Scale / Size); };
	for (size_t I = 0; I < Ratio.Pixels.size(); ++I)
	{
		const auto X = static_cast<uint32_t>(I / Ratio.Channels % Ratio.Width);
		Ratio.Pixels[I] /= std::max(Reference.Mean.Pixels[I], 1e-6f);
		if (Stage.IsFaulty() && std::fmod(std::abs(CellOf(X, 1.0)), 2.0) > 0.5) { Ratio.Pixels[I] *= 1.05f; }
	}
	double Worst = 0.0;
	for (const double Size : {1.0, 2.0})
	{
		std::vector<bool> bBorder(Ratio.Width);
		for (uint32_t X = 1; X < Ratio.Width; ++X) { bBorder[X] = CellOf(X, Size) != CellOf(X - 1, Size); }
		Worst = std::max(Worst, CompareSteps(Ratio, bBorder));
	}
	Out.push_back({"step at cell borders", Worst, 0.01});
	std::vector<bool> bTile(Ratio.Width);
	for (uint32_t X = 0; X < Ratio.Width; ++X) { bTile[X] = X % 8 == 0; }
	Out.push_back({"step at tile borders", CompareSteps(Ratio, bTile), Stage.IsFaulty() ? std::nullopt : std::optional<double>(0.01)});
	Out.push_back({"mean", std::abs(Energy - 1.0), Stage.IsFaulty() ? std::nullopt : std::optional<double>(0.003)});
	return FRTStatus::Success();
}

} // namespace Lantern
