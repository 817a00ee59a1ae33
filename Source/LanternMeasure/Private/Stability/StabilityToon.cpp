// Cases about objects of a stylised look: 22 toon edge.
#include <algorithm>

#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"
#include "Stability/StabilityGeometry.h"

namespace Lantern
{

namespace
{
/// A ramp of three bands, as an engine may draw light.
struct FRamp
{
	double Low = 0.0, High = 0.0; ///< luminance between bands
	int Find(double Luminance) const { return Luminance < Low ? 0 : Luminance < High ? 1 : 2; }
};

std::vector<double> FindLuminances(const FImage& Image)
{
	std::vector<double> Out(Image.GetPixelCount());
	for (size_t I = 0; I < Out.size(); ++I)
	{
		const float* const P = &Image.Pixels[I * Image.Channels];
		Out[I] = Image.Channels < 3 ? double(P[0]) : 0.2126 * double(P[0]) + 0.7152 * double(P[1]) + 0.0722 * double(P[2]);
	}
	return Out;
}

/// Thirds of the pixels of Mask.
FRamp MakeRamp(const std::vector<double>& Luminances, const FPixelMask& Mask)
{
	std::vector<double> Sorted;
	for (size_t I = 0; I < Luminances.size(); ++I)
	{
		if (Mask[I]) { Sorted.push_back(Luminances[I]); }
	}
	std::sort(Sorted.begin(), Sorted.end());
	return Sorted.empty() ? FRamp() : FRamp{Sorted[Sorted.size() / 3], Sorted[Sorted.size() * 2 / 3]};
}

/// Pixels of Mask beside one of another band.
FPixelMask FindEdges(const std::vector<double>& Luminances, const FPixelMask& Mask, const FRamp& Ramp, uint32_t Width)
{
	FPixelMask Edges(Mask.size(), 0);
	const auto Compare = [&](size_t A, size_t B) {
		if (Mask[A] && Mask[B] && Ramp.Find(Luminances[A]) != Ramp.Find(Luminances[B])) { Edges[A] = Edges[B] = 1; }
	};
	for (size_t I = 0; I < Mask.size(); ++I)
	{
		if ((I + 1) % Width != 0) { Compare(I, I + 1); }
		if (I + Width < Mask.size()) { Compare(I, I + Width); }
	}
	return Edges;
}

FPixelMask FindStyled(FStabilityStage& Stage, const FView& View)
{
	const FSceneDescription& Scene = Stage.GetScene().GetDescription();
	const auto Seen = TracePicture(FCpuScene(Scene, 0.0), View);
	FPixelMask Mask(Seen.size(), 0);
	for (size_t I = 0; I < Seen.size(); ++I) { Mask[I] = Seen[I] && Seen[I]->Node >= 0 && Scene.Nodes[size_t(Seen[I]->Node)].Toon ? 1 : 0; }
	return Mask;
}
} // namespace

/// Smooth shapes with a style, in light from walls, drawn in three bands. Nothing moves, and pixels beside the border between two bands
/// must stay in theirs. The fault: a history of one frame.
FRTStatus MeasureToonEdge(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-toon"); !S) { return S; }
	constexpr size_t Warm = 300, Count = 60;
	constexpr double FramesPerSecond = 60.0;
	const std::vector<FStabilityShot> Shots = RepeatView(Stage.MakeView(), Warm + Count, Warm);
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	Frames.erase(Frames.begin(), Frames.begin() + Warm);
	const FPixelMask Styled = FindStyled(Stage, Shots[0].View);
	const std::vector<double> Mean = FindLuminances(MeanImage(Frames));
	const FRamp Ramp = MakeRamp(Mean, Styled);
	const FPixelMask Edges = FindEdges(Mean, Styled, Ramp, Frames[0].Width);
	uint64_t Flips = 0;
	std::vector<double> Before = FindLuminances(Frames[0]);
	for (size_t Frame = 1; Frame < Frames.size(); ++Frame)
	{
		std::vector<double> Now = FindLuminances(Frames[Frame]);
		for (size_t I = 0; I < Edges.size(); ++I) { Flips += Edges[I] && Ramp.Find(Now[I]) != Ramp.Find(Before[I]) ? 1 : 0; }
		Before = std::move(Now);
	}
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(Shots[0].View, 0.0, Reference); !S) { return S; }
	for (const size_t At : {size_t(0), Count - 1}) { Stage.AddToStrip(Frames[At], Reference.Mean); }
	const double Seconds = double(Count - 1) / FramesPerSecond;
	Out.push_back({"flips per second and edge pixel", double(Flips) / (double(std::max<uint64_t>(CountPixels(Edges), 1)) * Seconds), 0.5});
	Out.push_back({"light of styled objects over the reference", MeanOver(MeanImage(Frames), Styled) / MeanOver(Reference.Mean, Styled),
	    std::nullopt});
	return FRTStatus::Success();
}

} // namespace Lantern
