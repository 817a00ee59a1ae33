// Cases about a world that changes, and a camera that jumps in it: 28 door, 29 mirror room, 31 cut and resize, 32 streaming.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "LanternImage/ImageStatistics.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"

namespace Lantern
{

namespace
{
/// Number of the instance of a node.
size_t FindInstance(const FHostScene& Scene, const char* Node)
{
	for (size_t I = 0; I < Scene.GetInstanceCount(); ++I)
	{
		if (Scene.GetDescription().Nodes[static_cast<size_t>(Scene.GetNode(I))].Name == Node) { return I; }
	}
	assert(false);
	return 0;
}

/// Open: 0 to 1.
void SlideDoor(FHostScene& Scene, double Open)
{
	constexpr double Width = 1.5; // metres
	const size_t Door = FindInstance(Scene, "door");
	glm::dmat4 Transform = EvaluatePose(Scene.GetDescription(), 0.0).World[static_cast<size_t>(Scene.GetNode(Door))];
	Transform[3].x += Open * Width;
	Scene.SetTransform(Door, Transform);
}

/// What the door's light is in one view. Most: frames to 90 % of it.
FRTStatus MeasureDoorIn(FStabilityStage& Stage, const char* What, const FView& View, double Most, std::vector<FStabilityFigure>& Out)
{
	constexpr int Shut = 40, Slide = 6, Open = 84;
	const int Late = Stage.IsFaulty() ? 40 : 0;
	std::vector<FStabilityShot> Shots = RepeatView(View, Shut + 2 * (Slide + Open), 0);
	for (int I = 0; I < int(Shots.size()); ++I)
	{
		const int Since = I - Late - Shut + 1, SinceShut = Since - Slide - Open;
		const double Way = SinceShut > 0 ? 1.0 - double(SinceShut) / Slide : double(Since) / Slide;
		Shots[size_t(I)].Change = [Way](FHostScene& Scene) { SlideDoor(Scene, std::clamp(Way, 0.0, 1.0)); };
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	FSignalReference Reference;
	SlideDoor(Stage.GetScene(), 1.0);
	if (FRTStatus S = Stage.GetReference(View, 0.0, Reference); !S) { return S; }
	SlideDoor(Stage.GetScene(), 0.0);
	const double Whole = MeanOver(Reference.Mean);
	std::vector<double> Means;
	for (const FImage& Frame : Frames) { Means.push_back(MeanOver(Frame)); }
	constexpr size_t Opened = Shut + Slide - 1, Closed = Opened + Open + Slide;
	const auto FramesUntil = [&](size_t First, double Level, bool bRise) {
		const double Passed = CountFramesTo(Means, First, Level, bRise);
		return std::isnan(Passed) ? double(Open) : std::min(Passed, double(Open)); // it stays so for no longer
	};
	for (const size_t At : {Opened, Opened + 16, Opened + 60, Closed, Closed + 60}) { Stage.AddToStrip(Frames[At], Reference.Mean); }
	const bool bStale = Stage.IsBroken() && !Stage.IsFaulty();
	const bool bKeeps = Stage.KeepsHistory();
	const auto Limit = [&](double Value) { return bKeeps && !bStale ? std::optional<double>(Value) : std::nullopt; };
	Out.push_back({fmt::format("{}: frames to 90 %", What), FramesUntil(Opened, 0.9 * Whole, true), Most});
	Out.push_back({fmt::format("{}: frames to 10 %", What), FramesUntil(Closed, 0.1 * Whole, false), Limit(Most)});
	Out.push_back({fmt::format("{}: 60 frames after it is shut", What), Means[Closed + 60] / Whole, Limit(0.01)});
	return FRTStatus::Success();
}
} // namespace

/// A door opens in a tenth of a second and shuts again. The means of the picture say how soon the corridor is as bright as it should be,
/// where the wall faces the door, and where light of many bounces alone comes. The fault: histories of a minute that are told of nothing, or
/// a door that is 40 frames late.
FRTStatus MeasureDoor(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-door"); !S) { return S; }
	if (FRTStatus S = MeasureDoorIn(Stage, "before it", Stage.MakeView(), 16.0, Out); !S) { return S; }
	return MeasureDoorIn(Stage, "far from it", Stage.MakeView({0, 1.6, 0}, {4, 0.9, 0}, 70), 30.0, Out);
}

/// Three walls are mirrors: the mean of frames 64 to 95 against the path tracer's. The fault: the lamp is a tenth brighter.
FRTStatus MeasureMirrorRoom(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load(Stage.IsFaulty() ? "stability-mirrorroom:1.1" : "stability-mirrorroom:1"); !S) { return S; }
	const FView View = Stage.MakeView();
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(RepeatView(View, 96, 64), Frames); !S) { return S; }
	const FImage Mean = MeanImage(DropUnkept(std::move(Frames)));
	if (FRTStatus S = Stage.Load("stability-mirrorroom:1"); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(View, 0.0, Reference); !S) { return S; }
	Stage.AddToStrip(Mean, Reference.Mean);
	Out.push_back({"mean, off by", std::abs(MeanOver(Mean) / MeanOver(Reference.Mean) - 1.0), 0.03});
	Out.push_back({"error of quarters", QuarterError(Mean, Reference.Mean), std::nullopt});
	return FRTStatus::Success();
}

namespace
{
/// Error of the second frame after a jump to View, over that of the last eight. Before: what was shown until then.
FRTStatus MeasureJump(FStabilityStage& Stage, const char* What, const std::vector<FStabilityShot>& Before, FView View, bool bCut,
    std::vector<FStabilityFigure>& Out)
{
	constexpr size_t After = 64, LastFrames = 8;
	const size_t First = Before.size();
	std::vector<FStabilityShot> Shots = Before;
	for (FStabilityShot& Shot : RepeatView(View, After, 1)) { Shots.push_back(std::move(Shot)); }
	Shots[First].View.bCut = bCut && !Stage.IsBroken(); // the fault hides it
	for (FStabilityShot& Shot : Shots) { Shot.Time = 1.0; }
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(View, 1.0, Reference); !S) { return S; }
	const FImage& Second = Frames[First + 1];
	const FPixelMask All = MakeFullMask(Second);
	double Converged = 0.0;
	for (size_t I = Frames.size() - LastFrames; I < Frames.size(); ++I) { Converged += RelMseOver(Frames[I], Reference, All) / LastFrames; }
	Stage.AddToStrip(Second, Reference.Mean);
	Stage.AddToStrip(Frames.back(), Reference.Mean);
	const auto Limit = Stage.KeepsHistory() ? std::optional<double>(2.0) : std::nullopt;
	// As in case 9: an error below 1e-3 is not seen.
	Out.push_back({What, RelMseOver(Second, Reference, All) / std::max(Converged, 1e-3), Limit});
	return FRTStatus::Success();
}
} // namespace

/// A cut to where the camera has not been, back to where it was, and another size of the picture: error of the second frame over that of a
/// settled picture. Histories of the screen are lost; what the world keeps is not. The fault: nothing is validated, and cuts are not told.
FRTStatus MeasureCuts(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-switch:1000"); !S) { return S; } // its lamp shines all the time
	const FView Here = Stage.MakeView(), There = Stage.MakeView({-3.6, 1.6, 2.2}, {-1.5, 0.6, -1.5}, 70);
	FView Large = Here;
	Large.Width = Here.Width * 3 / 2;
	Large.Height = Here.Height * 3 / 2;
	const std::vector<FStabilityShot> Settled = RepeatView(Here, 48, 48);
	if (FRTStatus S = MeasureJump(Stage, "cut to a new place", Settled, There, true, Out); !S) { return S; }
	std::vector<FStabilityShot> Away = Settled;
	for (FStabilityShot& Shot : RepeatView(There, 16, 16)) { Away.push_back(std::move(Shot)); }
	Away[Settled.size()].View.bCut = true;
	if (FRTStatus S = MeasureJump(Stage, "cut back", Away, Here, true, Out); !S) { return S; }
	return MeasureJump(Stage, "another size", Settled, Large, false, Out);
}

namespace
{
constexpr int Lanterns = 1000;

/// Copies of one object by number, of which a range is there.
class FStream
{
public:
	/// bAround: behind the camera, which their light reaches. Else they hang along the street.
	explicit FStream(bool bInAround) : bAround(bInAround) {}

	/// Shows those from First up to End: adds what is missing, and removes all others.
	void Show(FHostScene& Scene, int First, int End)
	{
		FRTScene& Rays = Scene.GetScene();
		std::erase_if(Shown, [&](const auto& Object) {
			const bool bGoes = Object.first < First || Object.first >= End;
			if (bGoes) { Rays.RemoveObject(Object.second); }
			return bGoes;
		});
		const FRTObjectInfo Model = Rays.GetObject(Scene.GetObject(FindInstance(Scene, "lantern")));
		for (int I = First; I < End; ++I)
		{
			if (Shown.contains(I)) { continue; }
			const double Row = double(I / 10), Column = double(I % 10) - 4.5;
			FRTObjectInfo Copy = Model;
			Copy.Transform = glm::dmat4(1.0);
			Copy.Transform[3] = bAround ? glm::dvec4(Column, 1.0 + 0.03 * Row, 13.0 + 0.05 * Row, 1) : glm::dvec4(Column, 5, -3.6 * Row, 1);
			Shown[I] = Rays.AddObject(std::move(Copy));
		}
	}

private:
	bool bAround;
	std::map<int, FRTObjectId> Shown;
};

/// 1,000 objects light the street for 40 frames and are then removed.
FRTStatus MeasureGoneLight(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	constexpr int Dark = 30, Lit = 40, After = 64;
	FStream Stream(true);
	const FView View = Stage.MakeView();
	std::vector<FStabilityShot> Shots = RepeatView(View, Dark + Lit + After, Dark - 8);
	Shots[Dark].Change = [&](FHostScene& Scene) { Stream.Show(Scene, 0, Lanterns); };
	if (!Stage.IsFaulty()) // else they stay
	{
		Shots[Dark + Lit].Change = [&](FHostScene& Scene) { Stream.Show(Scene, 0, 0); };
	}
	std::vector<FImage> Frames;
	const FRTStatus Status = Stage.Play(Shots, Frames);
	Stream.Show(Stage.GetScene(), 0, 0);
	if (!Status) { return Status; }
	std::vector<double> Means;
	for (const FImage& Frame : Frames) { Means.push_back(Frame.IsEmpty() ? 0.0 : MeanOver(Frame)); }
	double Before = 0.0, With = 0.0;
	for (int I = 0; I < 8; ++I)
	{
		Before += Means[size_t(Dark - 8 + I)] / 8.0;
		With += Means[size_t(Dark + Lit - 8 + I)] / 8.0;
	}
	for (const int At : {Dark - 1, Dark + Lit - 1, Dark + Lit + 3, Dark + Lit + 60}) { Stage.AddToStrip(Frames[size_t(At)], {}); }
	if (With < 2.0 * Before) { return FRTStatus::Error(ERTResult::InvalidArgument, "streaming: what comes does not light the picture"); }
	std::vector<double> Rest;
	for (size_t I = Dark + Lit; I < Means.size(); ++I) { Rest.push_back((Means[I] - Before) / (With - Before)); }
	const bool bKeeps = Stage.KeepsHistory();
	const auto Limit = [&](double Value) { return bKeeps ? std::optional<double>(Value) : std::nullopt; };
	const double Frames10 = CountFramesTo(Rest, 0, 0.1, false);
	Out.push_back({"frames to 10 % of light that has gone", std::isnan(Frames10) ? double(After) : Frames10, Limit(16.0)});
	double Left = 0.0;
	for (int I = 0; I < 4; ++I) { Left += Rest[Rest.size() - 1 - size_t(I)] / 4.0; }
	Out.push_back({"60 frames after it has gone", std::abs(Left), Limit(0.01)});
	return FRTStatus::Success();
}

/// Plays shots, and counts the radiance cells behind them.
FRTStatus CountCells(FStabilityStage& Stage, const std::vector<FStabilityShot>& Shots, double& OutLive)
{
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	FRenderer& Renderer = Stage.GetEngine().GetRenderer();
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	OutLive = double(Renderer.GetRadianceCells().Live);
	return OutLive > 0.0 ? FRTStatus::Success() : FRTStatus::Error(ERTResult::InvalidArgument, "streaming: no radiance cells are counted");
}

/// A flight of 200 m/s while objects stream in and out, and two seconds at its start again: radiance cells over those before. The fault: they
/// are counted where the flight ends.
FRTStatus MeasureStreamedCells(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	constexpr int Rest = 60, Flight = 90, Ahead = 300, PerFrame = 12;
	const int After = Stage.IsBroken() ? 1 : 120;
	FMethodScope Counting;
	if (!Counting.Apply({{"r.RT.GI.Cells.Count", "1", "streaming"}}).empty())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "radiance cells cannot be counted");
	}
	const auto Stay = [&](int Frames) { return RepeatView(Stage.MakeView(), size_t(Frames), size_t(Frames)); };
	double Before = 0.0, Live = 0.0;
	if (FRTStatus S = CountCells(Stage, Stay(Rest), Before); !S) { return S; }
	FStream Stream(false);
	std::vector<FStabilityShot> Shots = Stay(Rest + Flight + After);
	for (int I = 0; I < Flight; ++I)
	{
		FStabilityShot& Shot = Shots[size_t(Rest + I)];
		Shot.View.Position.z -= 200.0 / 60.0 * I;
		const int First = std::min(PerFrame * I, Lanterns), End = std::min(First + Ahead, Lanterns);
		Shot.Change = [&Stream, First, End](FHostScene& Scene) { Stream.Show(Scene, First, End); };
	}
	Shots[size_t(Rest + Flight)].Change = [&Stream](FHostScene& Scene) { Stream.Show(Scene, 0, 0); };
	Shots[size_t(Rest + Flight)].View.bCut = true;
	const FRTStatus Status = CountCells(Stage, Shots, Live);
	Stream.Show(Stage.GetScene(), 0, 0);
	if (!Status) { return Status; }
	Out.push_back({"cells 2 s after a flight, over those before", Live / Before, 1.1});
	return FRTStatus::Success();
}
} // namespace

/// 1,000 glowing objects come and go: what is left of their light, and of the cells that a flight among them has made. The fault: histories
/// of a minute that are told of nothing, or objects that stay.
FRTStatus MeasureStreaming(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-streaming"); !S) { return S; }
	if (FRTStatus S = MeasureGoneLight(Stage, Out); !S) { return S; }
	return HasRadianceCells() ? MeasureStreamedCells(Stage, Out) : FRTStatus::Success();
}

} // namespace Lantern
