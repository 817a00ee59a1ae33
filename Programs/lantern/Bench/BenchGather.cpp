// lantern bench gather: the world, the plain loop, and the times of either way.
#include "Bench/BenchGather.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <random>

#include <glm/gtc/constants.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternCore/Text/Log.h"
#include "LanternScene/Instances/GatherBaseline.h"

namespace Lantern
{

namespace
{
constexpr double HalfWorld = 16'000.0; // metres
constexpr uint32_t Kinds = 400;        // of geometry with materials: section ranges

struct FSize
{
	double Radius[2]; ///< smallest and largest, metres
	double Share;
};
/// A wooded country: bushes and rocks, trees, huts, buildings.
constexpr FSize SizesOfObjects[] = {{{0.5, 2}, 0.60}, {{3, 9}, 0.35}, {{8, 20}, 0.045}, {{20, 60}, 0.005}};

template <class FWork>
double Measure(FWork Work)
{
	const auto Start = std::chrono::steady_clock::now();
	Work();
	return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - Start).count();
}

/// Memory as mapped memory is: written, and not in the cache when the next frame writes it again.
class FOutput
{
public:
	explicit FOutput(size_t Count) : Items(new (std::align_val_t(64)) FRTInstance[std::max<size_t>(1, Count)])
	{
		std::memset(static_cast<void*>(Items.get()), 0, Count * sizeof(FRTInstance));
	}
	FRTInstance* Get() { return Items.get(); }

private:
	struct FFree
	{
		void operator()(FRTInstance* Pointer) const { operator delete[](Pointer, std::align_val_t(64)); }
	};
	std::unique_ptr<FRTInstance[], FFree> Items;
};

class FWorld
{
public:
	explicit FWorld(uint32_t Count);
	/// 1 % of the objects, others in each step, go to and fro by up to a metre.
	void MoveSome(uint32_t Step);
	FInstanceStore Store;
	TPagedArray<FObjectData> Table;

private:
	void Set(uint32_t Object, const FInstancePlacement& Placement);
	std::vector<FInstancePlacement> Placements;
};

FWorld::FWorld(uint32_t Count) : Placements(Count)
{
	Table.Resize(Count);
	std::mt19937_64 Random(20'260'101);
	const auto Uniform = [&](double Low, double High) { return std::uniform_real_distribution<double>(Low, High)(Random); };
	for (uint32_t Kind = 0; Kind < Kinds; ++Kind) { Store.SetBinding(Kind, {0x10'000ull * (Kind + 1), Kind * 4, Kind}); }
	for (uint32_t Object = 0; Object < Count; ++Object)
	{
		// Density falls off with distance r from the middle as exp(−r / 2 km): the radial density r · exp(−r / s) is that of
		// the sum of two exponential variables.
		glm::dvec3 At;
		do {
			const double Distance = -2000.0 * std::log(Uniform(1e-12, 1.0) * Uniform(1e-12, 1.0)),
			             Angle = Uniform(0, 2 * glm::pi<double>());
			At = {Distance * std::cos(Angle), 30.0 * std::sin(Distance / 700.0), Distance * std::sin(Angle)};
		}
		while (std::max(std::abs(At.x), std::abs(At.z)) > HalfWorld);
		double Choice = Uniform(0, 1);
		const FSize* Size = SizesOfObjects;
		for (; Size + 1 < std::end(SizesOfObjects) && Choice > Size->Share; ++Size) { Choice -= Size->Share; }
		FInstancePlacement& Placement = Placements[Object];
		const double Turn = Uniform(0, 2 * glm::pi<double>());
		Placement.Transform[0] = {std::cos(Turn), 0, -std::sin(Turn), 0};
		Placement.Transform[2] = {std::sin(Turn), 0, std::cos(Turn), 0};
		Placement.Transform[3] = glm::dvec4(At, 1);
		Placement.Radius = Uniform(Size->Radius[0], Size->Radius[1]);
		Placement.Center = At + glm::dvec3(0, 0.7 * Placement.Radius, 0);
		Placement.Range = static_cast<uint32_t>(Random() % Kinds);
		Set(Object, Placement);
	}
	Store.Refresh();
}

void FWorld::Set(uint32_t Object, const FInstancePlacement& Placement)
{
	Store.Set(Object, Placement);
	FObjectData& Data = Table[Object];
	std::memcpy(Data.ObjectToWorld, Store.GetTransform(Object), sizeof(Data.ObjectToWorld));
	Data.Cell = Store.GetRecord(Object).Cell;
}

void FWorld::MoveSome(uint32_t Step)
{
	for (uint32_t Object = Step % 100; Object < Placements.size(); Object += 100)
	{
		FInstancePlacement Moved = Placements[Object];
		const glm::dvec3 By(std::sin(0.1 * Step + Object), 0, std::cos(0.1 * Step + Object));
		Moved.Transform[3] += glm::dvec4(By, 0);
		Moved.Center += By;
		Set(Object, Moved);
	}
	Store.Refresh();
}

/// A camera that drives at 30 m/s and turns, at 60 frames a second.
FGatherView MakeView(uint32_t Frame)
{
	const double Time = Frame / 60.0;
	FGatherView View({300.0 + 30.0 * Time, 12.0, -200.0 + 10.0 * Time}, {}, glm::radians(60.0f), 1440);
	View.Forward = {std::sin(0.4f * static_cast<float>(Time)), 0, -std::cos(0.4f * static_cast<float>(Time))};
	return View;
}

bool IsSameSet(FRTInstance* A, FRTInstance* B, uint32_t Count)
{
	for (FRTInstance* const First : {A, B})
	{
		std::sort(First, First + Count, [](const FRTInstance& L, const FRTInstance& R) {
			return (L.CustomIndexAndMask & 0xffffff) < (R.CustomIndexAndMask & 0xffffff);
		});
	}
	return std::memcmp(static_cast<const void*>(A), static_cast<const void*>(B), Count * sizeof(FRTInstance)) == 0;
}

struct FResult
{
	uint32_t Kept = 0;
	bool bSame = true;
	FBenchTimes Naive, NaiveAll, Fast, Count, Moving, MovingChanges, All;
	double StillUs = 0.0;
};

/// Both ways in turn, with the camera moving: the kept set changes in each frame.
void MeasureMoving(FWorld& World, uint32_t Frames, FResult& Out)
{
	FOutput First(World.Store.GetCount()), Second(World.Store.GetCount()), Plain(World.Store.GetCount());
	FInstanceGather Gather;
	const glm::dvec3 Origin(0);
	for (uint32_t Frame = 0; Frame < Frames; ++Frame)
	{
		const FCullingRule Rule(MakeView(Frame), {});
		FRTInstance* const Target = Frame % 2 == 0 ? First.Get() : Second.Get();
		double CountMs = 0.0;
		Out.Fast.Add(Measure([&] {
			CountMs = Measure([&] { Gather.Count(World.Store, Rule); });
			Gather.Write(World.Store, Origin, Target);
		}));
		Out.Count.Add(CountMs);
		Out.Kept = Gather.GetCount();
		if (Frame % 8 != 0) { continue; }
		uint32_t Kept = 0;
		Out.Naive.Add(Measure([&] { Kept = GatherStraightforward(World.Store, World.Table, Rule, Origin, Plain.Get()); }));
		if (Frame % 80 == 0) { Out.bSame &= Kept == Out.Kept && IsSameSet(Target, Plain.Get(), Kept); }
	}
}

void MeasureOthers(FWorld& World, uint32_t Frames, FResult& Out)
{
	FOutput Target(World.Store.GetCount());
	FInstanceGather Gather;
	const glm::dvec3 Origin(0);
	FCullingSettings Off;
	Off.bEnabled = false;
	const FCullingRule All(MakeView(0), Off), Still(MakeView(0), {});
	for (uint32_t Frame = 0; Frame < std::max(8u, Frames / 8); ++Frame)
	{
		Out.All.Add(Measure([&] {
			Gather.Count(World.Store, All);
			Gather.Write(World.Store, Origin, Target.Get());
		}));
		Out.NaiveAll.Add(Measure([&] { GatherStraightforward(World.Store, World.Table, All, Origin, Target.Get()); }));
	}
	FBenchTimes Times;
	for (uint32_t Frame = 0; Frame < Frames; ++Frame)
	{
		Times.Add(Measure([&] { Gather.Count(World.Store, Still); }));
	}
	Out.StillUs = 1000.0 * Times.GetMedian();
	for (uint32_t Frame = 0; Frame < Frames; ++Frame)
	{
		Out.MovingChanges.Add(Measure([&] { World.MoveSome(Frame); }));
		Out.Moving.Add(Measure([&] {
			Gather.Count(World.Store, Still);
			Gather.Write(World.Store, Origin, Target.Get());
		}));
	}
}

nlohmann::json MakeJson(uint32_t Instances, const FWorld& World, const FResult& R)
{
	return {{"instances", Instances}, {"kept", R.Kept}, {"naive_ms", R.Naive.GetMedian()}, {"ms", R.Fast.GetMedian()},
	    {"ratio", R.Naive.GetMedian() / R.Fast.GetMedian()}, {"buckets", World.Store.GetBucketCount()}, {"naive", R.Naive.ToJson()},
	    {"gather", R.Fast.ToJson()}, {"count", R.Count.ToJson()}, {"same_set_counted_again_us", R.StillUs},
	    {"moving_1pct", {{"changes", R.MovingChanges.ToJson()}, {"gather", R.Moving.ToJson()}}},
	    {"no_culling", {{"naive", R.NaiveAll.ToJson()}, {"gather", R.All.ToJson()}}}};
}

int MeasureSizes(const FBenchGatherOptions& Options, nlohmann::json& Json)
{
	Json = {{"workers", GetWorkerCount()}, {"sizes", nlohmann::json::array()}};
	fmt::print("32 x 32 km, {} workers, medians [minima] of {} frames, ms\n", GetWorkerCount(), Options.Frames);
	fmt::print("{:>9} {:>8} {:>8} {:>17} {:>17} {:>6} {:>17} {:>19} {:>19}\n", "objects", "buckets", "kept", "naive", "gather", "ratio",
	    "1 % moves", "naive, all kept", "gather, all kept");
	int Exit = ExitDone;
	FBenchProgress Progress("gather", 3.0 * std::accumulate(Options.Sizes.begin(), Options.Sizes.end(), 0.0));
	for (const uint32_t Instances : Options.Sizes)
	{
		Progress.Begin(fmt::format("{} objects: the world", Instances), Instances);
		FWorld World(Instances);
		FResult R;
		Progress.Begin(fmt::format("{} objects: the camera moves", Instances), Instances);
		MeasureMoving(World, Options.Frames, R);
		Progress.Begin(fmt::format("{} objects: other cases", Instances), Instances);
		MeasureOthers(World, Options.Frames, R);
		Progress.Clear();
		const auto Text = [](const FBenchTimes& T) { return fmt::format("{:.3f} [{:.3f}]", T.GetMedian(), T.GetMin()); };
		fmt::print("{:>9} {:>8} {:>8} {:>17} {:>17} {:>6.1f} {:>17} {:>19} {:>19}\n", Instances, World.Store.GetBucketCount(), R.Kept,
		    Text(R.Naive), Text(R.Fast), R.Naive.GetMedian() / R.Fast.GetMedian(), Text(R.Moving), Text(R.NaiveAll), Text(R.All));
		std::fflush(stdout);
		Json["sizes"].push_back(MakeJson(Instances, World, R));
		if (!R.bSame)
		{
			LogError("{} objects: the two ways do not find the same instances", Instances);
			Exit = ExitCheckFailed;
		}
	}
	return Exit;
}
} // namespace

void FBenchGatherOptions::AddTo(CLI::App& App)
{
	AddBenchQuick(App, [this] {
		Sizes = {10'000, 100'000};
		Frames = 80;
	});
	App.add_option("--instances", Sizes, "Objects in the world; may be given several times")->check(CLI::Range(1, 16'000'000));
	App.add_option("--frames", Frames, "Frames of each measurement")->check(CLI::Range(8, 1'000'000));
	AddBenchJson(App, Json);
}

int RunBenchGather(const FBenchGatherOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) { return MeasureSizes(Options, Figures); });
}

} // namespace Lantern
