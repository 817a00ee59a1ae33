// Cases about what moves: 9 disocclusion, 10 ghost, 11 shadow lag, 12 mover in a mirror, 18 frame rate, 30 carried emitter.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "LanternImage/ImageStatistics.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"
#include "Stability/StabilityGeometry.h"

namespace Lantern
{

namespace
{
constexpr double FrameSeconds = 1.0 / 60.0;

/// The camera moves for Moving frames and stops. Mask: what only the last moving frame uncovered, so that frame 4 after it
/// is the fourth in which it is seen.
FRTStatus MeasureUncovering(
    FStabilityStage& Stage, const char* What, const std::function<FView(double)>& ViewAt, std::vector<FStabilityFigure>& Out)
{
	constexpr size_t Moving = 24, Rest = 64, After = 3;
	std::vector<FStabilityShot> Shots(Moving + Rest);
	for (size_t I = 0; I < Shots.size(); ++I)
	{
		Shots[I].View = ViewAt(double(std::min(I, Moving - 1)) / (Moving - 1));
		Shots[I].bKeep = I + 1 >= Moving;
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	const FView& View = Shots.back().View;
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(View, 0.0, Reference); !S) { return S; }
	const FPixelMask Mask = FindDisoccluded(FCpuScene(Stage.GetScene().GetDescription(), 0.0), View, Shots[Moving - 2].View);
	const FImage& Fourth = Frames[Moving - 1 + After];
	double Converged = 0.0;
	constexpr size_t LastFrames = 8;
	for (size_t I = Frames.size() - LastFrames; I < Frames.size(); ++I)
	{
		Converged += RelMseOver(Frames[I], Reference, Mask) / LastFrames;
	}
	Stage.AddToStrip(Frames[Moving - 1], Reference.Mean);
	Stage.AddToStrip(Fourth, Reference.Mean);
	Stage.AddToStrip(Frames.back(), Reference.Mean);
	const bool bKeeps = Stage.KeepsHistory();
	const auto Limit = [&](double Value) { return bKeeps ? std::optional<double>(Value) : std::nullopt; };
	// An error of 1e-3 is 3 % of the signal: where little is uncertain the converged one may be far below what can be seen.
	Out.push_back(
	    {fmt::format("{}: relMSE to converged", What), RelMseOver(Fourth, Reference, Mask) / std::max(Converged, 1e-3), Limit(3.0)});
	Out.push_back(
	    {fmt::format("{}: mean, off by", What), std::abs(1.0 - MeanOver(Fourth, Mask) / MeanOver(Reference.Mean, Mask)), Limit(0.05)});
	const std::vector<FImage> Last(Frames.end() - 16, Frames.end());
	Out.push_back({fmt::format("{}: sigma", What), TemporalSigma(Last, MakeFullMask(Last[0])), std::nullopt});
	return FRTStatus::Success();
}
} // namespace

/// Strafing past poles at 6 m/s, and a turn of 180° in 24 frames. Of methods that keep nothing: recorded without a limit.
FRTStatus MeasureDisocclusion(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.LoadLit("stability-poles"); !S) { return S; }
	const auto Strafe = [&](double Part) {
		const glm::dvec3 At(-1.2 + 2.3 * Part, 1.5, 0);
		return Stage.MakeView(At, At + glm::dvec3(0, -0.2, -6), 50);
	};
	if (FRTStatus S = MeasureUncovering(Stage, "strafe", Strafe, Out); !S) { return S; }
	const auto Whip = [&](double Part) {
		const double Angle = glm::radians(180.0) * Part;
		return Stage.MakeView({0.3, 1.5, 0.2}, glm::dvec3(0.3, 1.5, 0.2) + glm::dvec3(6 * std::sin(Angle), -0.2, -6 * std::cos(Angle)), 50);
	};
	return MeasureUncovering(Stage, "whip", Whip, Out);
}

namespace
{
/// Sums of a projection: how much of what was there is still in the picture.
struct FTrail
{
	std::vector<uint8_t> Where; ///< by pixel; empty: everywhere
	double Kept = 0.0, All = 0.0;

	/// Where Old and Now differ by a fifth of their swing, and Later and Now by much less: what was uncovered between the two. Rest:
	/// what the method makes of Now when all stands still, for what it does to that is no trail.
	void Add(const FImage& F, const FImage& Rest, const FSignalReference& Now, const FSignalReference& Old, const FSignalReference& Later)
	{
		const auto Differ = [&](const FSignalReference& Was, size_t I) {
			return std::abs(double(Was.Mean.Pixels[I]) - double(Now.Mean.Pixels[I]));
		};
		double Swing = 0.0;
		const auto IsLeftOut = [&](size_t I) { return !Where.empty() && !Where[I / F.Channels]; };
		for (size_t I = 0; I < F.Pixels.size(); ++I) { Swing = std::max(Swing, IsLeftOut(I) ? 0.0 : Differ(Old, I)); }
		for (size_t I = 0; I < F.Pixels.size(); ++I)
		{
			if (IsLeftOut(I)) { continue; }
			if (Differ(Old, I) < 0.2 * Swing || Differ(Later, I) > 0.4 * Differ(Old, I) || !std::isfinite(F.Pixels[I])) { continue; }
			Kept += (double(F.Pixels[I]) - double(Rest.Pixels[I])) * (double(Old.Mean.Pixels[I]) - double(Now.Mean.Pixels[I]));
			All += (double(Old.A.Pixels[I]) - double(Now.A.Pixels[I])) * (double(Old.B.Pixels[I]) - double(Now.B.Pixels[I]));
		}
	}
};

/// Plays the sequence with other random numbers, 31 times more: the mean of all. Noise is no trail. With eight, that of highlights was 0.03 of
/// what had been there.
FRTStatus AverageRuns(FStabilityStage& Stage, const std::vector<FStabilityShot>& Shots, std::vector<FImage>& Frames)
{
	constexpr int Runs = 32;
	std::vector<std::vector<FImage>> All(Shots.size());
	for (size_t I = 0; I < Shots.size(); ++I) { All[I].push_back(Frames[I]); }
	for (int Run = 1; Run < Runs; ++Run)
	{
		if (FRTStatus S = Stage.Play(Shots, Frames, Run); !S) { return S; }
		for (size_t I = 0; I < Shots.size(); ++I) { All[I].push_back(Frames[I]); }
	}
	for (size_t I = 0; I < Shots.size(); ++I)
	{
		if (!Frames[I].IsEmpty()) { Frames[I] = MeanImage(All[I]); }
	}
	return FRTStatus::Success();
}

/// What the method shows of a moment when nothing moves: the mean of frames 40 to 55.
FRTStatus PlayStill(FStabilityStage& Stage, const FView& View, double Time, FImage& Out)
{
	std::vector<FStabilityShot> Shots = RepeatView(View, 56, 40);
	for (FStabilityShot& Shot : Shots) { Shot.Time = Time; }
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	Out = MeanImage({Frames.begin() + 40, Frames.end()});
	return FRTStatus::Success();
}
} // namespace

namespace
{
/// Where and when MeasureTrail looks.
struct FTrailRegion
{
	std::string Name;               ///< begins the names of its figures
	std::vector<uint8_t> Where;     ///< by pixel; empty: everywhere
	double Start;                   ///< seconds of animation; the four moments are 0.8 to 1 s later
	double YoungLimit;              ///< after 4 frames
	std::optional<double> OldLimit; ///< after 16 frames; nullopt: not measured
};

/// What a mover, its shadow or its light left in pixels that it uncovered 4 to 8 frames ago, and 16 to 20; each as a part
/// of what was there, against what the method makes of the same moment at rest. Four moments of its way are summed up, in
/// the mean of 32 runs. The scene is loaded.
FRTStatus MeasureTrail(FStabilityStage& Stage, const FTrailRegion& Region, std::vector<FStabilityFigure>& Out)
{
	constexpr int First = 28, Count = 61, Steps = 9, Step = 4; // references at frames First, First + 4, …
	const auto TimeOf = [&](int Frame) { return Region.Start + Frame * FrameSeconds; };
	const FView View = Stage.MakeView();
	std::vector<FStabilityShot> Shots(Count);
	for (int I = 0; I < Count; ++I)
	{
		Shots[I].View = View;
		Shots[I].Time = TimeOf(I);
		Shots[I].bKeep = I >= First && (I - First) % Step == 0;
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	const bool bKeeps = Stage.KeepsHistory();
	if (bKeeps)
	{
		if (FRTStatus S = AverageRuns(Stage, Shots, Frames); !S) { return S; }
	}
	std::vector<FSignalReference> References(Steps);
	for (int I = 0; I < Steps; ++I)
	{
		if (FRTStatus S = Stage.GetReference(View, TimeOf(First + Step * I), References[I]); !S) { return S; }
	}
	FTrail Young{Region.Where}, Old{Region.Where};
	for (int I = 5; I < Steps; ++I)
	{
		const FImage& F = Frames[First + Step * I];
		FImage Rest = References[I].Mean;
		if (bKeeps)
		{
			if (FRTStatus S = PlayStill(Stage, View, TimeOf(First + Step * I), Rest); !S) { return S; }
		}
		Young.Add(F, Rest, References[I], References[I - 2], References[I - 1]);
		Old.Add(F, Rest, References[I], References[I - 5], References[I - 4]);
		Stage.AddToStrip(F, References[I].Mean);
	}
	const auto Limit = [&](double Value) { return bKeeps ? std::optional<double>(Value) : std::nullopt; };
	Out.push_back({Region.Name + "after 4 frames", std::abs(Young.Kept / Young.All), Limit(Region.YoungLimit)});
	if (Region.OldLimit) { Out.push_back({Region.Name + "after 16 frames", std::abs(Old.Kept / Old.All), Limit(*Region.OldLimit)}); }
	return FRTStatus::Success();
}
} // namespace

/// A cube that crosses a striped wall.
FRTStatus MeasureGhost(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.LoadLit("stability-ghost"); !S) { return S; }
	return MeasureTrail(Stage, {"", {}, 0.2, 0.02, 0.005}, Out);
}

/// A cube that flies past a flat mirror and a round one. At time 0 it hides neither from the camera.
FRTStatus MeasureMirrorGhost(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-mirror"); !S) { return S; }
	const FSceneDescription& Scene = Stage.GetScene().GetDescription();
	const auto Seen = TracePicture(FCpuScene(Scene, 0.0), Stage.MakeView());
	const auto FindWhere = [&](const char* Node) {
		std::vector<uint8_t> Where;
		for (const auto& Hit : Seen) { Where.push_back(Hit && Scene.Nodes[static_cast<size_t>(Hit->Node)].Name == Node); }
		return Where;
	};
	const double InFlat = -0.47, InRound = 0.2; // when the moments are those in which it is seen there
	FRTStatus Status = MeasureTrail(Stage, {"flat, ", FindWhere("mirror"), InFlat, 0.01, std::nullopt}, Out);
	if (Status) { Status = MeasureTrail(Stage, {"round, ", FindWhere("convex mirror"), InRound, 0.05, std::nullopt}, Out); }
	return Status;
}

namespace
{
/// Where the light of a picture is, in pixels from the left.
double FindCentroid(const FImage& Image)
{
	double Sum = 0.0, Weighted = 0.0;
	for (uint32_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel)
	{
		const double Value = GetLuminance(Image, Pixel % Image.Width, Pixel / Image.Width);
		Sum += Value;
		Weighted += Value * (Pixel % Image.Width + 0.5);
	}
	return Weighted / Sum;
}
} // namespace

/// A glowing torch that is carried through a dark corridor: what its light leaves behind, by how many frames the light's centroid is late,
/// and how much light there is, over four moments. The fault: histories of a minute, told of nothing.
FRTStatus MeasureCarriedEmitter(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-torch"); !S) { return S; }
	constexpr int First = 52, Count = 81, Step = 8;
	const auto TimeOf = [](int Frame) { return 0.1 + Frame * FrameSeconds; };
	const FView View = Stage.MakeView();
	std::vector<FStabilityShot> Shots = RepeatView(View, Count, First);
	for (int I = 0; I < Count; ++I) { Shots[size_t(I)].Time = TimeOf(I); }
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	std::vector<double> Places; // of references
	double Late = 0.0, Light = 0.0, Right = 0.0;
	for (int I = First; I < Count; I += Step)
	{
		FSignalReference Reference;
		if (FRTStatus S = Stage.GetReference(View, TimeOf(I), Reference); !S) { return S; }
		Places.push_back(FindCentroid(Reference.Mean));
		Late += Places.back() - FindCentroid(Frames[size_t(I)]);
		Light += MeanOver(Frames[size_t(I)]);
		Right += MeanOver(Reference.Mean);
		Stage.AddToStrip(Frames[size_t(I)], Reference.Mean);
	}
	const double Moments = double(Places.size()), PixelsOfFrame = (Places.back() - Places.front()) / ((Moments - 1.0) * Step);
	// What a torch's own rays bring is never late, however long it stays.
	const bool bLate = Stage.KeepsHistory() && (Stage.GetSignal() == ESignal::DiffuseGI || !Stage.IsBroken());
	Out.push_back({"late by frames", std::abs(Late / Moments / PixelsOfFrame), bLate ? std::optional<double>(3.0) : std::nullopt});
	Out.push_back({"energy, off by", std::abs(Light / Right - 1.0), 0.05});
	return MeasureTrail(Stage, {"trail ", {}, 0.2, 0.02, std::nullopt}, Out);
}

namespace
{
/// What is lit all over: noise and highlights are above it in a tenth of the picture at most.
float FindLitLuminance(const FImage& Image)
{
	std::vector<float> Values(Image.GetPixelCount());
	for (uint32_t Y = 0; Y < Image.Height; ++Y)
	{
		for (uint32_t X = 0; X < Image.Width; ++X) { Values[static_cast<size_t>(Y) * Image.Width + X] = GetLuminance(Image, X, Y); }
	}
	const auto Tenth = Values.begin() + static_cast<ptrdiff_t>(Values.size() * 9 / 10);
	std::nth_element(Values.begin(), Tenth, Values.end());
	return *Tenth;
}
} // namespace

/// The fan's shadow, more than half dark: overlap with the reference's, and how many frames ago the reference fits best. The
/// fault: the fan is rendered where it was three frames ago. A lamp lights the floor all alike, since it is far.
FRTStatus MeasureShadowLag(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.LoadLit("stability-fan"); !S) { return S; }
	constexpr int Count = 32, Lags = 5;
	const FView View = Stage.MakeView();
	const auto TimeOf = [](int Frame) { return 0.1 + Frame * FrameSeconds; };
	std::vector<FStabilityShot> Shots(Count);
	for (int I = 0; I < Count; ++I)
	{
		Shots[I].View = View;
		Shots[I].Time = TimeOf(I - (Stage.IsFaulty() ? 3 : 0));
		Shots[I].bKeep = I + 1 == Count;
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	std::vector<uint8_t> Mask;
	float Half = 0.0f; // of what is lit
	double Best = -1.0, First = 0.0;
	int Lag = 0;
	for (int I = 0; I < Lags; ++I)
	{
		FSignalReference Reference;
		if (FRTStatus S = Stage.GetReference(View, TimeOf(Count - 1 - I), Reference); !S) { return S; }
		if (I == 0)
		{
			Half = 0.5f * FindLitLuminance(Reference.Mean);
			Mask = MakeLuminanceMask(Frames.back(), Half, true);
		}
		const double Overlap = ComputeMaskOverlap(Mask, MakeLuminanceMask(Reference.Mean, Half, true));
		if (I == 0)
		{
			First = Overlap;
			Stage.AddToStrip(Frames.back(), Reference.Mean);
		}
		if (Overlap > Best)
		{
			Best = Overlap;
			Lag = I;
		}
	}
	Out.push_back({"mask overlap", First, 0.9, true});
	Out.push_back({"lag, frames", double(Lag), 1.0});
	return FRTStatus::Success();
}

namespace
{
void MoveLid(FHostScene& Scene, bool bGone)
{
	for (size_t Instance = 0; Instance < Scene.GetInstanceCount(); ++Instance)
	{
		const int32_t Node = Scene.GetNode(Instance);
		if (Scene.GetDescription().Nodes[static_cast<size_t>(Node)].Name != "lid") { continue; }
		glm::dmat4 Transform = Scene.GetPose().World[static_cast<size_t>(Node)];
		Transform[3].y += bGone ? 500.0 : 0.0;
		Scene.SetTransform(Instance, Transform);
	}
}

/// Seconds after the lid is gone until 90 % of the change is seen, at so many frames a second. Between frames what is left
/// falls exponentially.
FRTStatus MeasureResponse(FStabilityStage& Stage, double Rate, const FPixelMask& Mask, double Before, double After, double& OutSeconds)
{
	const int Settle = int(std::lround(0.5 * Rate)), Frames = std::max(100, int(std::lround(1.5 * Rate)));
	std::vector<FStabilityShot> Shots(static_cast<size_t>(Settle + Frames));
	for (int I = 0; I < Settle + Frames; ++I)
	{
		FStabilityShot& Shot = Shots[static_cast<size_t>(I)];
		Shot.View = Stage.MakeView();
		Shot.View.DeltaSeconds = Stage.IsFaulty() ? float(FrameSeconds) : float(1.0 / Rate);
		Shot.bKeep = I >= Settle;
		Shot.Change = [bGone = I >= Settle](FHostScene& Scene) { MoveLid(Scene, bGone); };
	}
	std::vector<FImage> Pictures;
	if (FRTStatus S = Stage.Play(Shots, Pictures); !S) { return S; }
	double Left = 1.0;
	OutSeconds = std::numeric_limits<double>::quiet_NaN();
	for (int I = 0; I < Frames; ++I)
	{
		const double Now = std::max(1e-6, (MeanOver(Pictures[static_cast<size_t>(Settle + I)], Mask) - After) / (Before - After));
		if (Now <= 0.1)
		{
			OutSeconds = (I + std::log(Left / 0.1) / std::log(Left / Now)) / Rate;
			break;
		}
		Left = std::min(1.0, Now);
	}
	Stage.AddToStrip(Pictures[static_cast<size_t>(Settle)], Pictures.back());
	return FRTStatus::Success();
}

/// Time to 90 % at 30 and 144 frames a second against that at 60. A frame is as fast as it can be seen: that much is taken
/// off a difference, and shorter times count as one frame.
FRTStatus CompareRates(
    FStabilityStage& Stage, const char* What, const FPixelMask& Mask, double Before, double After, std::vector<FStabilityFigure>& Out)
{
	const double Rates[3] = {60.0, 30.0, 144.0};
	double Seconds[3] = {};
	for (int I = 0; I < 3; ++I)
	{
		if (FRTStatus S = MeasureResponse(Stage, Rates[I], Mask, Before, After, Seconds[I]); !S) { return S; }
	}
	const std::optional<double> Limit = Stage.KeepsHistory() ? std::optional<double>(0.15) : std::nullopt;
	Out.push_back({fmt::format("{}90 %, seconds at 60 fps", What), Seconds[0], std::nullopt});
	for (int I = 1; I < 3; ++I)
	{
		const double Frame = 1.0 / std::min(Rates[I], 60.0), Difference = std::abs(Seconds[I] - Seconds[0]) - Frame;
		Out.push_back({fmt::format("{}{} fps against 60", What, Rates[I]),
		    std::isfinite(Difference) ? std::max(0.0, Difference) / std::max(Seconds[0], FrameSeconds) : Difference, Limit});
	}
	return FRTStatus::Success();
}

/// Floor that is seen with the lid and without, and lies under it.
FPixelMask FindFloorUnderLid(const FSceneDescription& Scene, const FView& View)
{
	const auto Hits = TracePicture(FCpuScene(Scene, 0.0), View);
	FPixelMask Mask(Hits.size());
	for (size_t Pixel = 0; Pixel < Hits.size(); ++Pixel)
	{
		const bool bFloor = Hits[Pixel] && Scene.Nodes[static_cast<size_t>(Hits[Pixel]->Node)].Name == "ground";
		Mask[Pixel] = bFloor && std::abs(Hits[Pixel]->Position.x) < 1.4 && std::abs(Hits[Pixel]->Position.z) < 0.7 ? 1 : 0;
	}
	return Mask;
}
} // namespace

/// A lid over the floor is gone from one frame to the next: time to 90 % at several frame rates, as the method is, and
/// (where it accumulates) with nothing but accumulation. Means of pictures at rest are what it starts and ends at. The fault:
/// the host says 1/60 s whatever the rate, and changes are not looked for. Of methods that keep nothing: recorded without
/// a limit.
FRTStatus MeasureFrameRate(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.LoadLit("stability-lid"); !S) { return S; }
	const FView View = Stage.MakeView();
	const FPixelMask Mask = FindFloorUnderLid(Stage.GetScene().GetDescription(), View);
	double Means[2] = {};
	for (const bool bGone : {false, true})
	{
		MoveLid(Stage.GetScene(), bGone);
		FImage Rest;
		if (FRTStatus S = PlayStill(Stage, View, 0.0, Rest); !S) { return S; }
		Means[bGone] = MeanOver(Rest, Mask);
	}
	const std::vector<FMethodSetting> Alone = KnownSettings({{"r.RT.Debug.Denoise.Adapt", "0"}});
	{
		FMethodScope Broken;
		if (Stage.IsFaulty()) { (void)Broken.Apply(Alone); }
		if (FRTStatus S = CompareRates(Stage, "", Mask, Means[0], Means[1], Out); !S) { return S; }
	}
	if (!Stage.KeepsHistory()) { return FRTStatus::Success(); }
	FMethodScope Plain;
	(void)Plain.Apply(Alone);
	return CompareRates(Stage, "accumulation: ", Mask, Means[0], Means[1], Out);
}

} // namespace Lantern
