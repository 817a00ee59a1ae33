// Cases about caches of light: 3 nested votes, 16 hash overflow.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "LanternImage/ImageStatistics.h"
#include "LanternMeasure/Methods.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"

namespace Lantern
{

/// A chamber that the sun reaches by five bounces, behind walls as thin as cells. Light that comes otherwise is a leak. The fault: the
/// sun is brighter than it should be.
FRTStatus MeasureTemple(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-temple"); !S) { return S; }
	constexpr size_t Warm = 90, Count = 32;
	const FView View = Stage.MakeView();
	const FSunLight Sun = Stage.GetScene().GetScene().GetSun();
	FSunLight Shining = Sun;
	Shining.Irradiance *= Stage.IsFaulty() ? 1.2f : 1.0f;
	std::vector<FStabilityShot> Shots = RepeatView(View, Warm + Count, Warm);
	for (FStabilityShot& Shot : Shots)
	{
		Shot.Change = [Shining](FHostScene& Scene) { Scene.SetSun(Shining); };
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	Frames.erase(Frames.begin(), Frames.begin() + Warm);
	FSignalReference Reference;
	Stage.GetScene().SetSun(Sun);
	constexpr uint32_t Bounces = 64; // three quarters of the chamber's light come by more than 16
	if (FRTStatus S = Stage.GetReference(View, 0.0, Reference, Bounces); !S) { return S; }
	const FImage Mean = MeanImage(Frames);
	Stage.AddToStrip(Mean, Reference.Mean);
	const double Wall = double(Sun.Irradiance) * std::abs(glm::normalize(Sun.Direction).z) / std::numbers::pi;
	// The chamber is so dark that no fault of its light is a leak.
	const double Leak = QuarterError(Mean, Reference.Mean) * MeanOver(Reference.Mean) / Wall;
	Out.push_back({"leak over the sunlit wall", Leak, Stage.IsFaulty() ? std::nullopt : std::optional<double>(1e-3)});
	Out.push_back({"error of quarters", QuarterError(Mean, Reference.Mean), 0.10});
	return FRTStatus::Success();
}

namespace
{
/// Error of the last frames of a flight, against the reference at their end. Capacity: of the table of cells; null: the method's own.
FRTStatus FlyThroughStreet(FStabilityStage& Stage, const char* Capacity, double& OutError, uint64_t& OutBroken)
{
	constexpr int Frames = 60;
	constexpr double Start = 2.0;
	FMethodScope Table;
	if (Capacity && !Table.Apply({{"r.RT.GI.Cells.Capacity", Capacity, "hash overflow"}}).empty())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "a table of %s cells", Capacity);
	}
	std::vector<FStabilityShot> Shots(Frames);
	for (int I = 0; I < Frames; ++I)
	{
		Shots[size_t(I)].Time = Start + double(I) / 60.0;
		Shots[size_t(I)].View = Stage.MakeView();
		Shots[size_t(I)].View.Position.z = -200.0 * Shots[size_t(I)].Time;
		Shots[size_t(I)].bKeep = true;
	}
	std::vector<FImage> Pictures;
	if (FRTStatus S = Stage.Play(Shots, Pictures); !S) { return S; }
	FSignalReference Reference;
	if (FRTStatus S = Stage.GetReference(Shots.back().View, Shots.back().Time, Reference); !S) { return S; }
	for (const FImage& Picture : Pictures) { OutBroken += CountNonFinitePixels(Picture); }
	OutError = RelMseOver(Pictures.back(), Reference, MakeFullMask(Pictures.back()));
	Stage.AddToStrip(Pictures.back(), Reference.Mean);
	return FRTStatus::Success();
}
} // namespace

/// A flight of 200 m/s through a street of 2 km, with tables of cells that are far too small. The fault: paths that find no cell are
/// dark.
FRTStatus MeasureHashOverflow(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-hash"); !S) { return S; }
	double Whole = 0.0;
	uint64_t Broken = 0;
	if (FRTStatus S = FlyThroughStreet(Stage, nullptr, Whole, Broken); !S) { return S; }
	for (const char* Capacity : {"256", "4096"})
	{
		double Error = 0.0;
		if (FRTStatus S = FlyThroughStreet(Stage, Capacity, Error, Broken); !S) { return S; }
		Out.push_back({fmt::format("error with {} cells over that with all", Capacity), Error / Whole,
		    HasRadianceCells() ? std::optional<double>(1.5) : std::nullopt});
	}
	Out.push_back({"pixels that are not finite", double(Broken), Stage.IsBroken() ? std::nullopt : std::optional<double>(0.0)});
	return FRTStatus::Success();
}

} // namespace Lantern
