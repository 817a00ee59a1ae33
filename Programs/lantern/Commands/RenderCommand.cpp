// lantern render and lantern reference: frames through the plugin, and the path tracer.
#include "Commands/RenderCommand.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>

#include <nlohmann/json.hpp>

#include "Commands/Explain.h"
#include "JsonFile.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/FrameGraph/History.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "LanternHost/ReferenceRenderer.h"
#include "LanternImage/ImageIO.h"
#include "LanternImage/ToneMap.h"
#include "LanternMeasure/MeasurePaths.h"
#include "LanternMeasure/MeasureSequence.h"
#include "LanternMeasure/Settling.h"
#include "Progress.h"
#include "Session.h"

namespace Lantern
{

namespace
{
double Median(std::vector<double> Values)
{
	if (Values.empty()) { return 0.0; }
	std::nth_element(Values.begin(), Values.begin() + Values.size() / 2, Values.end());
	return Values[Values.size() / 2];
}

/// Timings of the newest frames, passes in the order of their first appearance. A pass that a frame lacks costs it nothing, so that what
/// runs now and then does not count as if it always did.
class FFigures
{
public:
	void Add(const std::vector<FPassTiming>& Timings)
	{
		Frames.emplace_back();
		for (const FPassTiming& Timing : Timings)
		{
			if (std::ranges::find(Order, Timing.Name) == Order.end()) { Order.push_back(Timing.Name); }
			FPassTiming& Sum = Frames.back()[Timing.Name];
			Sum.GpuMs += Timing.GpuMs;
			Sum.CpuMs += Timing.CpuMs;
			Sum.Rays += Timing.Rays;
		}
		if (Frames.size() > MostFrames) { Frames.pop_front(); }
	}
	/// Of those frames.
	nlohmann::json PassesToJson() const
	{
		nlohmann::json Out = nlohmann::json::array();
		for (const std::string& Name : Order)
		{
			const auto GetMedian = [&](auto FPassTiming::*Member) {
				std::vector<double> Values;
				for (const FFrame& Frame : Frames) { Values.push_back(Frame.contains(Name) ? double(Frame.at(Name).*Member) : 0.0); }
				return Median(std::move(Values));
			};
			Out.push_back({{"name", Name}, {"gpu_ms", GetMedian(&FPassTiming::GpuMs)}, {"cpu_ms", GetMedian(&FPassTiming::CpuMs)},
			    {"rays", uint64_t(GetMedian(&FPassTiming::Rays))}});
		}
		return Out;
	}
	/// Median of what whole frames took, and their greatest.
	std::pair<double, double> GetFrames(double FPassTiming::*Member) const
	{
		std::vector<double> Sums;
		for (const FFrame& Frame : Frames)
		{
			double Sum = 0.0;
			for (const auto& [Name, Timing] : Frame) { Sum += Timing.*Member; }
			Sums.push_back(Sum);
		}
		return {Median(Sums), Sums.empty() ? 0.0 : std::ranges::max(Sums)};
	}

private:
	static constexpr size_t MostFrames = 32;
	using FFrame = std::map<std::string, FPassTiming>;
	std::vector<std::string> Order;
	std::deque<FFrame> Frames;
};

/// Settled: whether the frames did, if they were asked to.
nlohmann::json MakeJson(FSession& Session, const FRenderOptions& Options, const FFigures& Figures, std::optional<bool> Settled)
{
	const FRTCapabilities& Capabilities = Session.GetDevice().GetCapabilities();
	const FRTMemoryStats Memory = Session.GetDevice().GetMemoryStats();
	FRenderer& Renderer = Session.GetEngine().GetRenderer();
	nlohmann::json Json;
	Json["device"] = Capabilities.DeviceName;
	Json["driver"] = Capabilities.DriverName;
	Json["width"] = Options.Picture.Width;
	Json["height"] = Options.Picture.Height;
	Json["view"] = DescribeView(Options.Picture);
	Json["frames"] = Options.Frames;
	Json["settled"] = Settled ? nlohmann::json(*Settled) : nlohmann::json(nullptr);
	Json["passes"] = Figures.PassesToJson();
	uint64_t Rays = 0;
	for (const auto& Pass : Json["passes"]) { Rays += Pass["rays"].get<uint64_t>(); }
	const auto [Gpu, WorstGpu] = Figures.GetFrames(&FPassTiming::GpuMs);
	const auto [Cpu, WorstCpu] = Figures.GetFrames(&FPassTiming::CpuMs);
	Json["frame_gpu_ms"] = Gpu;
	Json["frame_cpu_ms"] = Cpu;
	Json["worst_frame_gpu_ms"] = WorstGpu;
	Json["worst_frame_cpu_ms"] = WorstCpu;
	Json["rays"] = Rays;
	nlohmann::json KeptParts = nlohmann::json::object();
	for (const auto& [Name, Bytes] : Renderer.GetHistoryParts()) { KeptParts[Name] = Bytes; }
	Json["memory"] = {{"blas", Memory.Geometry}, {"tlas", Memory.Scene}, {"sbt", Memory.ShaderTable}, {"textures", Memory.Texture},
	    {"peak", Memory.Peak}, {"kept", Renderer.GetHistoryBytes()}, {"kept_parts", KeptParts}};
	const FRTPSO* Pipeline = Renderer.GetRayPipeline();
	const uint32_t Groups = Pipeline ? Pipeline->GetHitGroupCount() : 0;
	const uint32_t Missing = Pipeline ? Pipeline->GetMissingCount() : 0;
	const double LinkMs = Pipeline ? Renderer.GetRayCompiler().GetStats().LastLinkMs : 0.0;
	Json["rtpso"] = {{"hit_groups", Groups}, {"compiled", Groups - Missing}, {"missing", Missing}, {"link_ms", LinkMs}};
	if (const FAnyHitCounts& AnyHits = Renderer.GetAnyHits(); AnyHits.Frames > 0) { Json["any_hit"] = AnyHits.LastFrame; }
	if (const FRadianceCellCounts& Cells = Renderer.GetRadianceCells(); Cells.Frames > 0)
	{
		Json["radiance_cells"] = {{"live", Cells.Live}, {"young", Cells.Young}, {"updated", Cells.Updated}, {"full", Cells.Full},
		    {"found", Cells.Found}, {"coarse", Cells.Coarse}, {"missed", Cells.Missed}};
	}
	if (const FReflectionCounts& Counts = Renderer.GetReflectionCounts(); Counts.Frames > 0)
	{
		Json["path_ends"] = {{"mirrors", Counts.Mirrors}, {"sharp", Counts.Sharp}, {"wide", Counts.Wide}, {"further", Counts.Further},
		    {"hit_lit", Counts.Lit}, {"sky", Counts.Sky}, {"cache", Counts.Cells}, {"stand_in", Counts.StandIns}, {"dark", Counts.Dark},
		    {"none", Counts.None}};
	}
	if (const FPathRayCounts& Counts = Renderer.GetPathRayCounts(); Counts.Frames > 0)
	{
		Json["path_rays"] = {{"surfaces", Counts.Surfaces}, {"lights", Counts.Lights}, {"checks", Counts.Checks}};
	}
	Json["load_seconds"] = Session.GetLoadSeconds();
	return Json;
}

nlohmann::json AuditToJson(const FRadianceAuditSums& Sums)
{
	nlohmann::json Json{{"paths", Sums.Paths}, {"answered", Sums.Answered}, {"followed", Sums.Followed}};
	const bool bKnown = Sums.Paths >= 2.0 && Sums.Answered > 0.0;
	Json["ratio"] = bKnown ? nlohmann::json(Sums.GetRatio()) : nlohmann::json(nullptr);
	Json["standard_error"] = bKnown ? nlohmann::json(Sums.GetStandardError()) : nlohmann::json(nullptr);
	return Json;
}

void ReportAudit(const FRadianceAudit& Audit, nlohmann::json& InOut)
{
	const FRadianceAuditSums All = Audit.GetAll();
	if (All.Paths < 2.0)
	{
		LogWarning("r.RT.GI.Residual: {}", "no path of r.RT.GI 3 was followed");
		return;
	}
	fmt::print("radiance cells: followed paths have {:.4f} of their light, standard error {:.4f}, {:.0f} paths\n", All.GetRatio(),
	    All.GetStandardError(), All.Paths);
	InOut["radiance_audit"] = {{"frames", Audit.Frames}, {"all", AuditToJson(All)}, {"cells", AuditToJson(Audit.Cells)},
	    {"leaves", AuditToJson(Audit.Leaves)}, {"coarse", AuditToJson(Audit.Coarse)}, {"lost", AuditToJson(Audit.Lost)}};
}

void PrintTable(const nlohmann::json& Json)
{
	fmt::print("{:<16} {:>10} {:>10} {:>12}\n", "pass", "GPU ms", "CPU ms", "rays");
	for (const auto& Pass : Json["passes"])
	{
		fmt::print("{:<16} {:>10.3f} {:>10.3f} {:>12}\n", Pass["name"].get<std::string>(), Pass["gpu_ms"].get<double>(),
		    Pass["cpu_ms"].get<double>(), Pass["rays"].get<uint64_t>());
	}
	fmt::print("{:<16} {:>10.3f} {:>10.3f} {:>12}\n", "frame", Json["frame_gpu_ms"].get<double>(), Json["frame_cpu_ms"].get<double>(),
	    Json["rays"].get<uint64_t>());
	fmt::print(
	    "{:<16} {:>10.3f} {:>10.3f}\n", "worst frame", Json["worst_frame_gpu_ms"].get<double>(), Json["worst_frame_cpu_ms"].get<double>());
	const nlohmann::json& Settled = Json["settled"];
	const char* const End = Settled.is_null() ? "" : Settled.get<bool>() ? ", settled" : ", not settled yet";
	fmt::print("frames: {}{}\n", Json["frames"].get<uint32_t>(), End);
}

bool IsDisplayOutput(const std::string& Path) { return Path.size() > 4 && Path.compare(Path.size() - 4, 4, ".png") == 0; }

/// Before any work: can what was asked for be written, and is the view there?
int PreparePicture(FPictureOptions& Picture)
{
	if (!Picture.Output.empty())
	{
		if (FRTStatus S = CheckImageOutput(Picture.Output); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	}
	if (const int Status = CheckJsonFile(Picture.Json); Status != ExitDone) { return Status; }
	return ResolveView(Picture);
}

int WriteOutputs(const FPictureOptions& Picture, const FImage& Image, const nlohmann::json& Json)
{
	if (!Picture.Output.empty())
	{
		if (FRTStatus S = SaveImageFile(Picture.Output, Image); !S) { return ReportStatus(S, "-o"), ExitBadInput; }
	}
	return WriteJsonFile(Picture.Json, Json.dump(2) + "\n");
}

constexpr uint32_t FewestPathFrames = FPathScript::SettleFrames + 2; // a path's script ends with those that settle

/// Returns the frames in which the camera comes to the view along a path of lantern chart.
FScript MakeWay(FSession& Session, const FRenderOptions& Options)
{
	const FSceneDescription& Scene = Session.GetEngine().GetScene().GetDescription();
	const FScenePose Pose = EvaluatePose(Scene, Options.Picture.Time);
	FPathSettings Settings;
	Settings.Frames = FPathScript::SettleFrames + 1;
	Settings.WarmUp = Options.Frames - Settings.Frames;
	Settings.Time = Options.Picture.Time;
	const FMeasureViews Views = FindMeasureViews(Scene, Pose, Session.MakeView(Options.Picture));
	FScript Way = MakePathScript(FindPath(Options.Path).value_or(EMeasurePath::Still), Views, Settings, nullptr).Script;
	Way.resize(Options.Frames);
	return Way;
}

/// Renders frames of one view, a given number of them or until they have settled.
class FFrameLoop
{
public:
	FFrameLoop(FSession& InSession, const FRenderOptions& InOptions)
	    : Session(InSession),
	      Options(InOptions),
	      View(InSession.MakeView(InOptions.Picture)),
	      Way(InOptions.Path.empty() ? FScript() : MakeWay(InSession, InOptions)),
	      Most(InOptions.Frames > 0 ? InOptions.Frames : MostFramesToSettle)
	{}

	int Run()
	{
		FProgressLine Progress;
		while (Done < Most && !Settled.value_or(false))
		{
			if (FRTStatus S = RenderOne(); !S) { return ReportStatus(S, "frame"); }
			Progress.Show("frames", double(Done) / Most);
		}
		return ExitDone;
	}
	uint32_t GetFrameCount() const { return Done; }
	std::optional<bool> IsSettled() const { return Settled; }
	const FSettling& GetSettling() const { return Settling; }
	const FFigures& GetFigures() const { return Figures; }
	/// Returns that of about the second half of the frames: cells were new in the first.
	FRadianceAudit GetAudit() const
	{
		FRadianceAudit Audit = Audits.back();
		return Audit -= Audits[Audits.size() / 2];
	}
	const FCapturedFrame& GetFrame() const { return Frame; }
	const FImage& GetPicture() const { return Frame.Display.IsEmpty() ? Frame.Lighting : Frame.Display; }

private:
	static constexpr uint32_t MostFramesToSettle = 64;

	FRTStatus RenderOne()
	{
		const bool bSettle = Options.Frames == 0; // any frame may then be the last
		const bool bPicture = bSettle || Done + 1 == Most;
		FFrameCapture Capture;
		Capture.bDisplay = bPicture && IsDisplayOutput(Options.Picture.Output);
		Capture.bLighting = bSettle || (bPicture && !Capture.bDisplay);
		if (bPicture && !Options.Explain.empty()) { Capture.Signals = GetExplainedSignals(); }
		FSampleEngine& Engine = Session.GetEngine();
		const FView& At = Way.empty() ? View : Way[Done].View;
		const double Time = Way.empty() ? Options.Picture.Time : Way[Done].Time;
		if (FRTStatus S = Engine.RenderFrame(At, Time, Capture, bPicture ? &Frame : nullptr); !S) { return S; }
		if (bSettle)
		{
			const bool bAccumulates = Engine.GetRenderer().GetHistoryBytes() > 0;
			Settled = Settling.Add(Frame.Lighting) || !bAccumulates;
		}
		// The first frame of several builds and compiles: it is not what a frame costs. Timings are those of up to two frames before.
		if (Done <= 3 && Done + 1 < Most) { Figures = {}; }
		Figures.Add(GetTimings(Engine.GetRenderer()));
		Audits.push_back(Engine.GetRenderer().GetRadianceAudit());
		++Done;
		return FRTStatus::Success();
	}

	FSession& Session;
	const FRenderOptions& Options;
	const FView View;
	const FScript Way; // empty: all frames are at View
	const uint32_t Most;
	uint32_t Done = 0;
	FCapturedFrame Frame; // the newest that is captured
	FFigures Figures;
	std::vector<FRadianceAudit> Audits{{}}; // of what had arrived behind each frame, and before the first
	FSettling Settling;
	std::optional<bool> Settled; // absent: nobody asked
};
} // namespace

int RunRender(FRenderOptions Options)
{
	const auto Start = std::chrono::steady_clock::now();
	if (!Options.Path.empty() && Options.Frames < FewestPathFrames)
	{
		LogError("--path needs --frames of {} or more", FewestPathFrames);
		return ExitUsage;
	}
	const std::optional<glm::uvec2> Pixel = ParsePixel(Options.Explain);
	if (Pixel && (Pixel->x >= Options.Picture.Width || Pixel->y >= Options.Picture.Height))
	{
		LogError(
		    "--explain: {} lies outside of the picture, which is {}x{}", Options.Explain, Options.Picture.Width, Options.Picture.Height);
		return ExitUsage;
	}
	if (const double Least = Options.Frames * double(FPathSettings().DeltaSeconds); !Options.Path.empty() && Options.Picture.Time < Least)
	{
		LogInfo("--path: the last frame is at --time {:.2f}, so that the first is not before 0", Least);
		Options.Picture.Time = Least;
	}
	if (const int Status = PreparePicture(Options.Picture); Status != ExitDone) { return Status; }
	FTaskTrace::SetFolder(std::filesystem::path(Options.Picture.Output).parent_path().string());
	FSession Session;
	if (const int Status = Session.OpenDevice(Options.Device); Status != ExitDone) { return Session.Close(Status); }
	if (const int Status = Session.LoadScene(Options.Picture); Status != ExitDone) { return Session.Close(Status); }
	Session.GetEngine().GetRenderer().SetGraphDump(Options.bDumpGraph);
	Session.GetEngine().bPresent = true; // what accumulates over frames needs them all, and their times are what is reported
	FFrameCapture Precached;
	if (Pixel)
	{
		Precached.Signals = GetExplainedSignals();
		FConsoleVariables::Get().Set("r.RT.Debug.Explain", Options.Explain, ERTSetBy::CommandLine, "--explain");
	}
	FConsoleVariables::Get().BeginFrame();
	FProgressLine Compiling;
	const auto ShowProgress = [&](float Fraction) { Compiling.Show("shaders", Fraction); };
	if (FRTStatus S = Session.GetEngine().Precache(Precached, ShowProgress); !S) { return Session.Close(ReportStatus(S, "shaders")); }
	Compiling.Clear();
	FFrameLoop Loop(Session, Options);
	int Status = Loop.Run();
	if (Status == ExitDone)
	{
		Options.Frames = Loop.GetFrameCount();
		nlohmann::json Json = MakeJson(Session, Options, Loop.GetFigures(), Loop.IsSettled());
		PrintTable(Json);
		if (const FRadianceAudit Audit = Loop.GetAudit(); Audit.Frames > 0) { ReportAudit(Audit, Json); }
		if (Pixel)
		{
			FRenderer& Renderer = Session.GetEngine().GetRenderer();
			if (FRTStatus S = Renderer.WaitForAll(); !S) { return Session.Close(ReportStatus(S, "--explain")); }
			Json["explanation"] = ExplanationToJson(*Pixel, Loop.GetFrame(), Renderer.GetPixelExplanation());
			PrintExplanation(Json["explanation"]);
		}
		if (Options.bDumpGraph) { fmt::print("{}", Session.GetEngine().GetRenderer().DumpGraph()); }
		Status = WriteOutputs(Options.Picture, Loop.GetPicture(), Json);
		const double Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - Start).count();
		LogInfo("loaded in {:.2f} s, {:.2f} s in all", Session.GetLoadSeconds(), Seconds);
	}
	return Session.Close(Status);
}

int RunReference(FReferenceOptions Options)
{
	if (const int Status = PreparePicture(Options.Picture); Status != ExitDone) { return Status; }
	if (Options.bResume && Options.Picture.Output.empty())
	{
		LogError("--resume needs -o: the state is kept beside the picture");
		return ExitUsage;
	}
	FSession Session;
	if (const int Status = Session.OpenDevice(Options.Device); Status != ExitDone) { return Session.Close(Status); }
	if (const int Status = Session.LoadScene(Options.Picture); Status != ExitDone) { return Session.Close(Status); }
	FProgressLine Progress;
	FReferenceSettings Settings;
	FConsoleVariables::Get().BeginFrame();
	Settings.View = Session.MakeView(Options.Picture);
	Settings.Time = Options.Picture.Time;
	Settings.Samples = Options.Samples;
	Settings.Bounces = Options.Bounces;
	Settings.Signal = FindSignal(Options.Signal).value_or(ESignal::Frame);
	Settings.bPixelCenters = Options.bPixelCenters;
	Settings.bRasterSurfaces = Options.bRasterSurfaces;
	Settings.StateFile = Options.bResume ? Options.Picture.Output + ".state" : "";
	Settings.bResume = Options.bResume;
	Settings.StateSeconds = Options.SaveSeconds;
	Settings.SceneKey = Session.MakeSceneKey(Options.Picture, Settings.Signal);
	Settings.Progress = [&](double Done, uint32_t Total, double Left) {
		Progress.Show("reference", Done / Total, fmt::format("{:.1f} of {} samples, {} left", Done, Total, FormatSeconds(Left)));
	};
	FReferenceResult Result;
	if (FRTStatus S = RenderReference(Session.GetEngine(), Settings, Result); !S) { return Session.Close(ReportStatus(S, "reference")); }
	Progress.Clear();
	const double MPaths = Result.Seconds > 0.0 ? Result.Paths / Result.Seconds * 1e-6 : 0.0;
	fmt::print("{} samples ({} resumed) in {:.1f} s, {:.2f} Mpaths/s\n", Result.Samples, Result.ResumedSamples, Result.Seconds, MPaths);
	const FRTCapabilities& Capabilities = Session.GetDevice().GetCapabilities();
	const nlohmann::json Json = {{"device", Capabilities.DeviceName}, {"driver", Capabilities.DriverName}, {"width", Options.Picture.Width},
	    {"height", Options.Picture.Height}, {"view", DescribeView(Options.Picture)}, {"spp", Result.Samples},
	    {"resumed_spp", Result.ResumedSamples}, {"bounces", Options.Bounces}, {"seconds", Result.Seconds}, {"paths", Result.Paths}};
	const bool bDisplay = IsDisplayOutput(Options.Picture.Output);
	return Session.Close(
	    WriteOutputs(Options.Picture, bDisplay ? ToneMapImage(Result.Radiance, Settings.View.Exposure) : Result.Radiance, Json));
}

} // namespace Lantern
