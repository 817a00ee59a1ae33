// lantern bench growth: frames of scenes that grow, and the exponents of their times.
#include "Bench/BenchGrowth.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchFrameWorld.h"
#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"
#include "Bench/GrowthScenes.h"
#include "Chart/ChartPage.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternImage/AtomicFile.h"
#include "LanternMeasure/GeneratedMaterials.h"

namespace Lantern
{

namespace
{
constexpr uint32_t WarmUp = 3;
constexpr uint64_t ProgramSalt = 1; // one set of programs, so that runs can be compared

struct FGrowthPoint
{
	uint64_t Value = 0;
	FBenchTimes CpuMs, GpuMs; ///< GPU: without values on the mock
};

struct FGrowthResult
{
	EGrowthLine Line = EGrowthLine::Objects;
	std::vector<FGrowthPoint> Points;
};

/// Slope of the straight line through the logarithms, by least squares; none without two usable points.
std::optional<double> FitExponent(const std::vector<FGrowthPoint>& Points, FBenchTimes FGrowthPoint::*Times)
{
	double Count = 0, X = 0, Y = 0, XX = 0, XY = 0;
	for (const FGrowthPoint& Point : Points)
	{
		const double Ms = (Point.*Times).GetMedian();
		if (!(Ms > 0.0)) { continue; }
		const double LogX = std::log(double(Point.Value)), LogY = std::log(Ms);
		Count += 1;
		X += LogX;
		Y += LogY;
		XX += LogX * LogX;
		XY += LogX * LogY;
	}
	const double Spread = Count * XX - X * X;
	return Count >= 2 && Spread > 0.0 ? std::optional((Count * XY - X * Y) / Spread) : std::nullopt;
}

nlohmann::json ToJson(const std::optional<double>& Figure) { return Figure ? nlohmann::json(*Figure) : nlohmann::json(nullptr); }

FRTStatus MeasurePoint(FSampleEngine& Engine, EGrowthLine Line, const FBenchGrowthOptions& Options, FGrowthPoint& Out)
{
	const bool bIsCpu = Options.bMock || Engine.GetRenderer().GetDevice().GetCapabilities().bIsCpu;
	FGrowthScene Growth = MakeGrowthScene(Line, Out.Value, bIsCpu);
	std::vector<FHostNode> Movers;
	for (const uint32_t Mover : Growth.Movers) { Movers.push_back(Growth.Scene.Nodes[Mover]); }
	if (FRTStatus S = Engine.Load(std::move(Growth.Scene)); !S) { return S; }
	FHostScene& Host = Engine.GetScene();
	for (uint32_t Material = 0; Line == EGrowthLine::Programs && Material < Out.Value; ++Material)
	{
		FMaterialPrograms& Programs = Engine.GetRenderer().GetPrograms();
		Host.GetScene().SetMaterialProgram(Material, Programs.FindOrAdd(MakeBenchProgram(Material, ProgramSalt)));
	}
	FSunLight Sun;
	Sun.Direction = {0.3, -1, 0.4};
	Sun.Irradiance = 4.0f;
	Sun.AngularDiameter = 0.0093f;
	Host.SetSun(Sun);
	Host.GetScene().SetSky(glm::vec3(0.4f, 0.6f, 1.0f));
	Engine.bPresent = true;
	for (uint32_t Frame = 0; Frame < WarmUp + Options.Frames; ++Frame)
	{
		Engine.bRealTime = Frame > 0; // the first one builds and compiles everything
		const auto Start = FBenchClock::now();
		for (size_t I = 0; I < Movers.size(); ++I)
		{
			Host.SetTransform(Growth.Movers[I], MoveObject(Movers[I], static_cast<uint32_t>(I), Frame));
		}
		if (FRTStatus S = Engine.RenderFrame(Growth.View, 0.0, {}, nullptr); !S) { return S; }
		const double CpuMs = GetMsSince(Start);
		if (FRTStatus S = Engine.GetRenderer().WaitForAll(); !S) { return S; }
		if (Frame < WarmUp) { continue; }
		Out.CpuMs.Add(CpuMs);
		double GpuMs = 0.0;
		for (const FPassTiming& Pass : Engine.GetRenderer().GetGraphResources().GetTimings()) { GpuMs += Pass.GpuMs; }
		if (!Options.bMock) { Out.GpuMs.Add(GpuMs); }
	}
	return FRTStatus::Success();
}

void PrintPoint(const char* Line, const FGrowthPoint& Point)
{
	const std::string Gpu = Point.GpuMs.GetCount() > 0 ? fmt::format("{:.3f}", Point.GpuMs.GetMedian()) : "-";
	fmt::print("{:<10} {:>10} {:>12.3f} {:>12}\n", Line, Point.Value, Point.CpuMs.GetMedian(), Gpu);
	std::fflush(stdout);
}

void PrintExponents(const FGrowthResult& Result)
{
	const auto Show = [](const std::optional<double>& Exponent) { return Exponent ? fmt::format("{:.2f}", *Exponent) : std::string("-"); };
	fmt::print("{:<10} {:>10} {:>12} {:>12}\n", GetGrowthLine(Result.Line).Name, "exponent",
	    Show(FitExponent(Result.Points, &FGrowthPoint::CpuMs)), Show(FitExponent(Result.Points, &FGrowthPoint::GpuMs)));
	std::fflush(stdout);
}

nlohmann::json MakeJson(const FGrowthResult& Result)
{
	nlohmann::json Points = nlohmann::json::array();
	for (const FGrowthPoint& Point : Result.Points)
	{
		const bool bGpu = Point.GpuMs.GetCount() > 0;
		Points.push_back({{"value", Point.Value}, {"cpu_ms", Point.CpuMs.GetMedian()},
		    {"gpu_ms", bGpu ? nlohmann::json(Point.GpuMs.GetMedian()) : nlohmann::json(nullptr)}, {"cpu", Point.CpuMs.ToJson()},
		    {"gpu", Point.GpuMs.ToJson()}});
	}
	const FGrowthLineInfo& Info = GetGrowthLine(Result.Line);
	return {{"name", Info.Name}, {"held", Info.Held}, {"points", Points},
	    {"cpu_exponent", ToJson(FitExponent(Result.Points, &FGrowthPoint::CpuMs))},
	    {"gpu_exponent", ToJson(FitExponent(Result.Points, &FGrowthPoint::GpuMs))}};
}

std::vector<EGrowthLine> ChooseLines(const FBenchGrowthOptions& Options)
{
	std::vector<EGrowthLine> Out;
	for (size_t I = 0; I < static_cast<size_t>(EGrowthLine::Count); ++I)
	{
		const auto Line = static_cast<EGrowthLine>(I);
		if (Options.Line.empty() || Options.Line == GetGrowthLine(Line).Name) { Out.push_back(Line); }
	}
	return Out;
}

int Measure(FSampleEngine& Engine, const FBenchGrowthOptions& Options, nlohmann::json& Figures)
{
	const FRTCapabilities& Capabilities = Engine.GetRenderer().GetDevice().GetCapabilities();
	Figures = DescribeBenchDevice(Capabilities);
	Figures["lines"] = nlohmann::json::array();
	const bool bIsCpu = Options.bMock || Capabilities.bIsCpu;
	const auto GetWork = [](uint64_t Value) { return std::sqrt(double(Value)); }; // part of a frame does not grow
	double Work = 0.0;
	for (const EGrowthLine Line : ChooseLines(Options))
	{
		for (const uint64_t Value : ListGrowthPoints(Line, bIsCpu, Options.bQuick)) { Work += GetWork(Value); }
	}
	FBenchProgress Progress("growth", Work);
	fmt::print("{:<10} {:>10} {:>12} {:>12}\n", "line", "number", "CPU ms", "GPU ms");
	for (const EGrowthLine Line : ChooseLines(Options))
	{
		FGrowthResult Result{Line, {}};
		for (const uint64_t Value : ListGrowthPoints(Line, bIsCpu, Options.bQuick))
		{
			Progress.Begin(fmt::format("{} {}", Value, GetGrowthLine(Line).Name), GetWork(Value));
			FGrowthPoint& Point = Result.Points.emplace_back();
			Point.Value = Value;
			if (FRTStatus S = MeasurePoint(Engine, Line, Options, Point); !S) { return ReportStatus(S, "bench growth"); }
			Progress.Clear();
			PrintPoint(GetGrowthLine(Line).Name, Point);
		}
		PrintExponents(Result);
		Figures["lines"].push_back(MakeJson(Result));
	}
	return ExitDone;
}

int WritePage(const std::string& Output, const nlohmann::json& Figures)
{
	if (Output.empty()) { return ExitDone; }
	const FRTStatus Status = WriteFileAtomically(Output, MakeGrowthPage(Figures));
	return Status ? ExitDone : (ReportStatus(Status, "-o"), ExitBadInput);
}
} // namespace

void FBenchGrowthOptions::AddTo(CLI::App& App)
{
	AddBenchQuick(App, [this] {
		bQuick = true;
		Frames = 3;
	});
	Device.AddTo(App);
	App.add_flag("--mock", bMock, "On the mock device: the plugin's own work alone");
	App.add_option("--line", Line, "objects, triangles, materials, programs or pixels. Without it: all")
	    ->check([](const std::string& Text) {
		    FBenchGrowthOptions Named;
		    Named.Line = Text;
		    return !Text.empty() && !ChooseLines(Named).empty()
		               ? std::string()
		               : Quote(Text) + " is none of objects, triangles, materials, programs, pixels";
	    });
	App.add_option("--frames", Frames, "Measured frames of each point")->check(CLI::Range(1, 100'000));
	App.add_option("-o,--output", Output, "A page with the chart, .html")->check([](const std::string& Text) {
		return std::filesystem::path(Text).extension() == ".html" ? std::string() : Quote(Text) + " does not end in .html";
	});
	AddBenchJson(App, Json);
}

int RunBenchGrowth(const FBenchGrowthOptions& Options)
{
	if (!Options.Output.empty())
	{
		if (FRTStatus S = CheckOutputPath(Options.Output); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	}
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		const auto OnEngine = [&](FSampleEngine& Engine) {
			const int Status = Measure(Engine, Options, Figures);
			return Status == ExitDone ? WritePage(Options.Output, Figures) : Status;
		};
		if (!Options.bMock)
		{
			return RunInBenchSession(Options.Device, [&](FSession& Session) { return OnEngine(Session.GetEngine()); });
		}
		return RunOnBenchMock(Options.Device, [&](IRTDevice& Device) {
			FSampleEngine Engine(Device, FindPluginFolders().DescribeRenderer());
			return OnEngine(Engine);
		});
	});
}

} // namespace Lantern
