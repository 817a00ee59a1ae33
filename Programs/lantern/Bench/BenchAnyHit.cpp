// lantern bench anyhit: counts alpha tests with classified triangles and without, and compares the pictures.
#include "Bench/BenchAnyHit.h"

#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRun.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternHost/ReferenceRenderer.h"

namespace Lantern
{

namespace
{
constexpr uint32_t SoftSamples = 16;
constexpr uint32_t ReferenceSamples = 1, ReferenceBounces = 4;
// Of steps, roughly in seconds on two cores.
constexpr double LoadWork = 6, HardWork = 2, SoftWork = 8, ReferenceWork = 8;
constexpr uint32_t CountedFrame = 7; // whichever: random numbers follow it, so that both pictures draw the same

// Paths of the reference: where two triangles of a mesh lie in the same place, either may be the nearest, and the edges of
// pieces round otherwise than those of triangles, which sends a path in a million elsewhere. Shadows are to be the same.
constexpr double PathTolerance = 1e-3; // for all but …
constexpr double MostPathsElsewhere = 1e-4;

struct FAnyHitCase
{
	std::string Name;
	uint64_t Plain = 0, Classified = 0;
	double Difference = 0.0;      // largest, of any channel of any pixel
	uint64_t Pixels = 0;          // that differ
	uint64_t PixelsElsewhere = 0; // by more than PathTolerance
	bool bPaths = false;
	uint64_t AllPixels = 0;
	double GetRatio() const { return Plain > 0 ? double(Classified) / double(Plain) : 1.0; }
};

void Set(const char* Name, const std::string& Value) { FConsoleVariables::Get().Set(Name, Value, ERTSetBy::CommandLine, "bench anyhit"); }

void Compare(const FImage& A, const FImage& B, FAnyHitCase& Case)
{
	const size_t Channels = A.Channels;
	for (size_t Pixel = 0; Pixel < A.Pixels.size() / Channels; ++Pixel)
	{
		bool bDiffers = false, bElsewhere = false;
		for (size_t I = Pixel * Channels; I < (Pixel + 1) * Channels; ++I)
		{
			const double Difference = std::abs(double(A.Pixels[I]) - double(B.Pixels[I]));
			bDiffers |= !(Difference == 0.0);
			bElsewhere |= !(Difference <= PathTolerance);
			Case.Difference = std::isfinite(Difference) ? std::max(Case.Difference, Difference) : HUGE_VAL;
		}
		Case.Pixels += bDiffers ? 1 : 0;
		Case.PixelsElsewhere += bElsewhere ? 1 : 0;
		++Case.AllPixels;
	}
}

class FAnyHitBench
{
public:
	FAnyHitBench(FSession& InSession, const FBenchScene& InScene, const FPictureOptions& Picture)
	    : Session(InSession),
	      Scene(InScene),
	      View(InSession.MakeView(Picture))
	{}

	FRTStatus RunShadow(bool bPipeline, bool bSoft, FAnyHitCase& Case)
	{
		Case.Name = Scene.Name + (bPipeline ? "/pipeline" : "/query") + (bSoft ? "/soft16" : "/hard");
		Set("r.RT.Shadow.Path", bPipeline ? "1" : "2");
		Set("r.RT.Shadow.Soft", bSoft ? "1" : "0");
		Set("r.RT.Shadow.Denoise", "0"); // what is compared is what the rays saw
		Set("r.RT.AO", "0");
		Set("r.RT.Shadow.Samples", bSoft ? std::to_string(SoftSamples) : "1");
		return RunBoth(Case, [&](FImage& Out) { return RenderShadow(Out); });
	}

	FRTStatus RunReference(FAnyHitCase& Case)
	{
		Case.Name = Scene.Name + "/pipeline/reference";
		Case.bPaths = true;
		return RunBoth(Case, [&](FImage& Out) {
			FReferenceSettings Settings;
			Settings.View = View;
			Settings.Samples = ReferenceSamples;
			Settings.Bounces = ReferenceBounces;
			FReferenceResult Result;
			const FRTStatus Status = RenderReference(Session.GetEngine(), Settings, Result);
			Out = std::move(Result.Radiance);
			return Status;
		});
	}

private:
	FRTStatus RenderShadow(FImage& Out)
	{
		FSampleEngine& Engine = Session.GetEngine();
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::SunShadow);
		FCapturedFrame Frame;
		Engine.SetFrameIndex(CountedFrame);
		const FRTStatus Status = Engine.RenderFrame(View, 0.0, Capture, &Frame);
		Out = std::move(Frame.Get(ESignal::SunShadow));
		return Status;
	}

	/// Counts what Render adds. The frame before it builds and compiles.
	template <class FRender>
	FRTStatus Count(bool bClassified, FRender Render, uint64_t& OutCalls, FImage& Out)
	{
		FRenderer& Renderer = Session.GetEngine().GetRenderer();
		Set("r.RT.Opacity.Classify", bClassified ? "1" : "0");
		Set("r.RT.Opacity.Count", "1");
		if (FRTStatus S = RenderShadow(Out); !S) { return S; }
		const uint64_t Before = Renderer.GetAnyHits().Total;
		if (FRTStatus S = Render(Out); !S) { return S; }
		if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
		OutCalls = Renderer.GetAnyHits().Total - Before;
		return FRTStatus::Success();
	}

	template <class FRender>
	FRTStatus RunBoth(FAnyHitCase& Case, FRender Render)
	{
		FImage Plain, Classified;
		if (FRTStatus S = Count(false, Render, Case.Plain, Plain); !S) { return S; }
		if (FRTStatus S = Count(true, Render, Case.Classified, Classified); !S) { return S; }
		if (Plain.IsEmpty() || Plain.Pixels.size() != Classified.Pixels.size())
		{
			return FRTStatus::Error(ERTResult::Unsupported, "no picture: the device traces no such rays");
		}
		Compare(Classified, Plain, Case);
		return FRTStatus::Success();
	}

	FSession& Session;
	const FBenchScene& Scene;
	const FView View;
};

nlohmann::json MakeJson(const FAnyHitCase& Case, const FSceneOpacity& Opacity)
{
	return {{"name", Case.Name}, {"any_hit_plain", Case.Plain}, {"any_hit_classified", Case.Classified}, {"ratio", Case.GetRatio()},
	    {"classes", {{"opaque", Opacity.Counts.Opaque}, {"transparent", Opacity.Counts.Transparent}, {"mixed", Opacity.Counts.Mixed}}},
	    {"pieces", Opacity.Pieces}, {"image_difference", Case.Difference}, {"pixels_different", Case.Pixels}};
}

int ReportCase(const FAnyHitCase& Case, const FSceneOpacity& Opacity, nlohmann::json& Cases)
{
	fmt::print("{:<34} {:>14} {:>14} {:>7.3f} {:>8} {:>12} {:>8} {:>8} {:>12g} {:>8}\n", Case.Name, Case.Plain, Case.Classified,
	    Case.GetRatio(), Opacity.Counts.Opaque, Opacity.Counts.Transparent, Opacity.Counts.Mixed, Opacity.Pieces, Case.Difference,
	    Case.Pixels);
	std::fflush(stdout);
	Cases.push_back(MakeJson(Case, Opacity));
	const uint64_t Most = static_cast<uint64_t>(MostPathsElsewhere * double(Case.AllPixels));
	if (Case.bPaths ? Case.PixelsElsewhere <= Most : Case.Pixels == 0) { return ExitDone; }
	LogError("{}: {} pixels differ, by up to {}: classified geometry must give the same picture", Case.Name, Case.Pixels, Case.Difference);
	return ExitCheckFailed;
}

int MeasureScene(
    FSession& Session, const FBenchScene& Scene, const FBenchAnyHitOptions& Options, FBenchProgress& Progress, nlohmann::json& Cases)
{
	Progress.Begin(Scene.Name + ": load", LoadWork);
	const FRTCapabilities& Capabilities = Session.GetDevice().GetCapabilities();
	FPictureOptions Picture;
	if (const int Status = MakeBenchPicture(Scene, Options.View, Options.Size, Capabilities.bIsCpu, Picture); Status != ExitDone)
	{
		return Status;
	}
	if (const int Status = Session.LoadScene(Picture); Status != ExitDone) { return Status; }
	FAnyHitBench Bench(Session, Scene, Picture);
	const FSceneOpacity& Opacity = Session.GetEngine().GetScene().GetOpacity();
	int Exit = ExitDone;
	const auto Add = [&](const FRTStatus& Status, const FAnyHitCase& Case) {
		Progress.Clear();
		const int Result = Status ? ReportCase(Case, Opacity, Cases) : ReportStatus(Status, Case.Name.c_str());
		Exit = Exit == ExitDone ? Result : Exit;
	};
	for (const bool bPipeline : {true, false})
	{
		if (!HasRayPath(Capabilities, bPipeline, Scene)) { continue; }
		for (const bool bSoft : {false, true})
		{
			Progress.Begin(fmt::format("{}, {}, {}", Scene.Name, bPipeline ? "pipeline" : "query", bSoft ? "soft" : "hard"),
			    bSoft ? SoftWork : HardWork);
			FAnyHitCase Case;
			const FRTStatus Status = Bench.RunShadow(bPipeline, bSoft, Case);
			Add(Status, Case);
		}
	}
	if (Capabilities.bRayTracingPipeline)
	{
		Progress.Begin(Scene.Name + ", reference", ReferenceWork);
		FAnyHitCase Case;
		const FRTStatus Status = Bench.RunReference(Case);
		Add(Status, Case);
	}
	return Exit;
}

std::vector<FBenchScene> ChooseScenes(const FBenchAnyHitOptions& Options)
{
	std::vector<FBenchScene> Scenes;
	for (const std::string& File : Options.Scenes) { Scenes.push_back(MakeBenchScene(File)); }
	if (!Options.Scenes.empty()) { return Scenes; }
	if (Options.bQuick) { return {MakeBenchScene("courtyard")}; }
	if (const std::optional<FBenchScene> Forest = FindBenchScene("black_forest/black_forest.gltf", "bench anyhit"))
	{
		Scenes.push_back(*Forest);
	}
	Scenes.push_back(MakeBenchScene("courtyard"));
	return Scenes;
}
} // namespace

void FBenchAnyHitOptions::AddTo(CLI::App& App)
{
	AddBenchQuick(App, [this] {
		Size = "160x90";
		bQuick = true;
	});
	AddSceneOptions(App, "Scenes; without any, black_forest of LANTERN_SCENES and the courtyard");
	AddBenchJson(App, Json);
}

int RunBenchAnyHit(const FBenchAnyHitOptions& Options)
{
	FSceneBench Bench;
	Bench.Name = "anyhit";
	Bench.SceneWork = LoadWork + 2.0 * (HardWork + SoftWork) + ReferenceWork;
	Bench.PrintHeader = [] {
		fmt::print("{:<34} {:>14} {:>14} {:>7} {:>8} {:>12} {:>8} {:>8} {:>12} {:>8}\n", "case", "plain", "classified", "ratio", "opaque",
		    "transparent", "mixed", "pieces", "difference", "differ");
	};
	Bench.ChooseScenes = [&] { return ChooseScenes(Options); };
	Bench.Measure = [&](FSession& Session, const FBenchScene& Scene, FBenchProgress& Progress, nlohmann::json& Cases) {
		return MeasureScene(Session, Scene, Options, Progress, Cases);
	};
	return RunSceneBench(Options, Bench);
}

} // namespace Lantern
