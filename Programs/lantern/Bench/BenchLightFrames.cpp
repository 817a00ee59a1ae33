// Measures frames of the built-in scene lamps, with light cells and without, in turn.
#include "Bench/BenchLightFrames.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
struct FLampCase
{
	uint32_t Lamps = 0;
	FBenchTimes First;           ///< ms of the GPU for the passes of light cells in the first frame, which fills them
	FBenchTimes Cells, Lighting; ///< ms of the GPU in later frames: those passes, and direct lighting
	FBenchTimes Frame;           ///< ms of the GPU for all passes, direct lighting without shadows
	FBenchTimes Shadowed;        ///< ms of the GPU for all passes, with shadowed local lights (r.RT.Lights)
	FBenchTimes Moved;           ///< ms of the passes of light cells in frames in which 100 lamps move
	FBenchTimes WalkLighting;    ///< ms of direct lighting that visits all lights
};

constexpr double WakeUpMs = 300.0;

void Set(const char* Name, const char* Value) { FConsoleVariables::Get().Set(Name, Value, ERTSetBy::CommandLine, "bench lights"); }

bool BeginsWith(const std::string& Name, const char* Start) { return Name.rfind(Start, 0) == 0; }

class FLampBench
{
public:
	FLampBench(FSession& InSession, const FPictureOptions& InPicture, uint32_t InFrames)
	    : Session(InSession),
	      Picture(InPicture),
	      Frames(InFrames)
	{}

	FRTStatus Measure(FLampCase& Case)
	{
		Picture.Scene = fmt::format("lamps:{}", Case.Lamps);
		if (Session.LoadScene(Picture) != ExitDone) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Picture.Scene.c_str()); }
		View = Session.MakeView(Picture);
		Set("r.RT.Lights", "0"); // direct lighting then visits lights itself
		Set("r.RT.Lights.Cells", "0");
		FRTStatus Status = Render(nullptr); // what the driver compiles at first use is not measured
		if (Status)
		{
			Status = Render([&] { Case.WalkLighting.Add(GetGpuMs("DirectLighting")); });
		}
		Status = Status ? WakeUp() : Status;
		Set("r.RT.Lights.Cells", "1");
		if (Status)
		{
			Status = Render([&] { Case.First.Add(GetGpuMs("LightCells")); });
		}
		for (uint32_t Frame = 0; Frame < Frames && Status; ++Frame)
		{
			Status = Render([&] {
				Case.Cells.Add(GetGpuMs("LightCells"));
				Case.Lighting.Add(GetGpuMs("DirectLighting"));
				Case.Frame.Add(GetGpuMs(""));
			});
		}
		Set("r.RT.Lights", "1");
		Status = Status ? Render(nullptr) : Status; // compiles
		for (uint32_t Frame = 0; Frame < Frames && Status; ++Frame)
		{
			Status = Render([&] { Case.Shadowed.Add(GetGpuMs("")); });
		}
		Set("r.RT.Lights", "0");
		for (uint32_t Frame = 0; Frame < Frames && Status; ++Frame)
		{
			Move(Frame);
			Status = Render([&] { Case.Moved.Add(GetGpuMs("LightCells")); });
		}
		return Status;
	}

private:
	/// Moves 100 lamps, or all if there are fewer.
	void Move(uint32_t Frame)
	{
		FRTScene& Scene = Session.GetEngine().GetScene().GetScene();
		if (Frame == 0)
		{
			// Lamps of our own, in the places of others: the scene's keep their ids to themselves.
			Moving.clear();
			const uint32_t Count = Scene.GetLights().GetSlotCount(), Most = std::min(100u, Count);
			for (uint32_t I = 0; I < Most; ++I) { Moving.push_back(Scene.AddLight(*Scene.GetLights().Find(I * Count / Most))); }
		}
		for (const FLightId Id : Moving)
		{
			FSceneLight Light = Scene.GetLights().Get(Id);
			Light.Position.y += Frame % 2 == 0 ? 0.05 : -0.05;
			Scene.SetLight(Id, Light);
		}
	}
	/// Renders a frame, waits for it, and calls Take, which may be empty.
	FRTStatus Render(const std::function<void()>& Take)
	{
		FFrameCapture Capture;
		Capture.bLighting = true;
		FRTStatus Status = Session.GetEngine().RenderFrame(View, 0.0, Capture, nullptr);
		Status = Status ? Session.GetEngine().GetRenderer().WaitForAll() : Status;
		if (Status && Take) { Take(); }
		return Status;
	}
	/// Keeps a GPU at work until it has its full clock, which it loses where it waits.
	FRTStatus WakeUp()
	{
		if (Session.GetDevice().GetCapabilities().bIsCpu) { return FRTStatus::Success(); }
		FRTStatus Status;
		for (const auto Start = FBenchClock::now(); Status && GetMsSince(Start) < WakeUpMs;) { Status = Render(nullptr); }
		return Status;
	}
	/// Of the passes of the last frame whose names begin so.
	double GetGpuMs(const char* Start)
	{
		double Sum = 0.0;
		for (const FPassTiming& Pass : Session.GetEngine().GetRenderer().GetGraphResources().GetTimings())
		{
			Sum += BeginsWith(Pass.Name, Start) ? std::max(Pass.GpuMs, 0.0) : 0.0;
		}
		return Sum;
	}

	FSession& Session;
	FPictureOptions Picture;
	uint32_t Frames;
	FView View;
	std::vector<FLightId> Moving;
};

void Print(const std::vector<FLampCase>& Cases, nlohmann::json& Json)
{
	fmt::print("{:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>12} {:>12} {:>12} {:>12}\n", "lamps", "frame", "ratio", "shadowed", "ratio",
	    "lighting", "visiting all", "cells", "100 moved", "first");
	Json["lamps"] = nlohmann::json::array();
	for (const FLampCase& Case : Cases)
	{
		const double Ratio = Case.Frame.GetMedian() / std::max(Cases.front().Frame.GetMedian(), 1e-9);
		const double ShadowedRatio = Case.Shadowed.GetMedian() / std::max(Cases.front().Shadowed.GetMedian(), 1e-9);
		fmt::print("{:>7} {:>9.2f} {:>8.2f}x {:>9.2f} {:>8.2f}x {:>9.2f} {:>12.2f} {:>12.3f} {:>12.3f} {:>12.2f}\n", Case.Lamps,
		    Case.Frame.GetMedian(), Ratio, Case.Shadowed.GetMedian(), ShadowedRatio, Case.Lighting.GetMedian(),
		    Case.WalkLighting.GetMedian(), Case.Cells.GetMedian(), Case.Moved.GetMedian(), Case.First.GetMedian());
		Json["lamps"].push_back({{"lamps", Case.Lamps}, {"frame_ms", Case.Frame.ToJson()}, {"ratio", Ratio},
		    {"shadowed_ms", Case.Shadowed.ToJson()}, {"shadowed_ratio", ShadowedRatio}, {"lighting_ms", Case.Lighting.ToJson()},
		    {"lighting_visiting_all_ms", Case.WalkLighting.ToJson()}, {"cells_ms", Case.Cells.ToJson()},
		    {"cells_100_moved_ms", Case.Moved.ToJson()}, {"cells_first_ms", Case.First.ToJson()}});
	}
}
} // namespace

int RunBenchLightFrames(const FBenchLightFramesOptions& Options, nlohmann::json& Json)
{
	return RunInBenchSession(Options.Device, [&](FSession& Session) {
		FPictureOptions Picture;
		const FRTCapabilities& Capabilities = Session.GetDevice().GetCapabilities();
		if (const int Status = MakeBenchPicture({"lamps", "lamps"}, "", Options.Size, Capabilities.bIsCpu, Picture); Status != ExitDone)
		{
			return Status;
		}
		std::vector<FLampCase> Cases;
		for (const uint32_t Lamps : Options.Lamps) { Cases.emplace_back().Lamps = Lamps; }
		FLampBench Bench(Session, Picture, Options.Frames);
		for (uint32_t Round = 0; Round < Options.Rounds; ++Round)
		{
			for (FLampCase& Case : Cases)
			{
				if (FRTStatus S = Bench.Measure(Case); !S) { return ReportStatus(S, "bench lights --pictures"); }
			}
		}
		Json = DescribeBenchDevice(Capabilities);
		fmt::print("{} x {}, medians of {} rounds, ms of the GPU\n", Picture.Width, Picture.Height, Options.Rounds);
		Print(Cases, Json);
		return ExitDone;
	});
}

} // namespace Lantern
