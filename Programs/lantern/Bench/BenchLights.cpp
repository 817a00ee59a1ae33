// lantern bench lights: frames in which nothing changes, some lights move, and some go while others come.
#include "Bench/BenchLights.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"
#include "LanternScene/Scene/Scene.h"

namespace Lantern
{

namespace
{
/// A lamp in a town of lamps, 10 m from one another.
FSceneLight MakeLamp(uint32_t Index, uint32_t Frame)
{
	FSceneLight Lamp;
	Lamp.Type = Index % 4 == 0 ? LIGHT_RECTANGLE : LIGHT_POINT;
	Lamp.Size = {0.5f, 0.2f};
	Lamp.Position = {10.0 * (Index % 1000), 3.0 + 0.01 * (Frame % 100), 10.0 * (Index / 1000)};
	Lamp.Color = glm::vec3(40);
	Lamp.Range = 12.0f;
	return Lamp;
}

class FTown
{
public:
	FTown(IRTDevice& InDevice, uint32_t Count) : Device(InDevice), Uploads(InDevice), Scene(InDevice)
	{
		for (uint32_t Index = 0; Index < Count; ++Index) { Ids.push_back(Scene.AddLight(MakeLamp(Index, 0))); }
	}

	/// Changes Count lights, others in each frame. bReplace: they go, and others come.
	void Change(uint32_t Count, uint32_t Frame, bool bReplace)
	{
		const uint32_t Stride = std::max<uint32_t>(1, static_cast<uint32_t>(Ids.size()) / std::max(1u, Count));
		for (uint32_t I = 0; I < Count; ++I)
		{
			const uint32_t Index = (I * Stride + Frame) % static_cast<uint32_t>(Ids.size());
			if (!bReplace) { Scene.SetLight(Ids[Index], MakeLamp(Index, Frame)); }
			else
			{
				Scene.RemoveLight(Ids[Index]);
				Ids[Index] = Scene.AddLight(MakeLamp(Index, Frame));
			}
		}
	}
	/// Takes the changes over into tables of the device.
	FRTStatus Update()
	{
		FSceneUse Use;
		Use.bRays = false;
		if (!List)
		{
			if (FRTStatus S = Device.CreateCommandList("Lights", List.ReleaseAndGetAddress()); !S) { return S; }
		}
		if (FRTStatus S = List->Begin(); !S) { return S; }
		const auto Start = FBenchClock::now();
		const FRTStatus Status = Scene.Update(*List, Uploads, {}, Use);
		UpdateUs = 1000.0 * GetMsSince(Start);
		if (!Status) { return Status; }
		if (FRTStatus S = List->End(); !S) { return S; }
		FRTFence Fence = 0;
		IRTCommandList* const Lists[] = {List.Get()};
		if (FRTStatus S = Device.Submit(Lists, 1, &Fence); !S) { return S; }
		if (FRTStatus S = Device.WaitFor(Fence, ~0ull); !S) { return S; }
		Uploads.EndFrame(Fence);
		Scene.EndFrame(true, Fence);
		return FRTStatus::Success();
	}

	double UpdateUs = 0.0; ///< of the last Update, without the list's own begin, end and submission

private:
	IRTDevice& Device;
	FFrameUploads Uploads;
	FRTScene Scene;
	TRTRef<IRTCommandList> List;
	std::vector<FLightId> Ids;
};

struct FCase
{
	const char* Name;
	bool bChanges, bReplace;
};
constexpr FCase Cases[] = {{"nothing", false, false}, {"moved", true, false}, {"replaced", true, true}};

FRTStatus MeasureCase(FTown& Town, const FCase& Case, const FBenchLightsOptions& Options, FBenchTimes& Out)
{
	for (uint32_t Frame = 0; Frame < Options.Frames; ++Frame)
	{
		const auto Start = FBenchClock::now();
		if (Case.bChanges) { Town.Change(Options.Moved, Frame, Case.bReplace); }
		const double ChangeUs = 1000.0 * GetMsSince(Start);
		if (FRTStatus S = Town.Update(); !S) { return S; }
		Out.Add(ChangeUs + Town.UpdateUs);
	}
	return FRTStatus::Success();
}

int MeasureSizes(const FBenchLightsOptions& Options, nlohmann::json& Json)
{
	TRTRef<IRTDevice> Device;
	FRTStatus Status = CreateBenchMock(Device);
	Json = {{"changed", Options.Moved}, {"sizes", nlohmann::json::array()}};
	fmt::print(
	    "{} lights change in a frame; medians [minima] of {} frames, us of the render thread on the mock\n", Options.Moved, Options.Frames);
	fmt::print("{:>9}", "lights");
	for (const FCase& Case : Cases) { fmt::print(" {:>17}", Case.Name); }
	fmt::print("\n");
	for (const uint32_t Size : Options.Sizes)
	{
		if (!Status) { break; }
		FTown Town(*Device, Size);
		Status = Town.Update();
		nlohmann::json Row = {{"lights", Size}};
		fmt::print("{:>9}", Size);
		for (const FCase& Case : Cases)
		{
			FBenchTimes Times;
			if (Status) { Status = MeasureCase(Town, Case, Options, Times); }
			Row[std::string(Case.Name) + "_us"] = Times.ToJson();
			fmt::print(" {:>17}", fmt::format("{:.2f} [{:.2f}]", Times.GetMedian(), Times.GetMin()));
		}
		fmt::print("\n");
		Json["sizes"].push_back(Row);
	}
	return Status ? ExitDone : ReportStatus(Status, "bench lights");
}
} // namespace

void FBenchLightsOptions::AddTo(CLI::App& App)
{
	App.add_option("--lights", Sizes, "Lights in the scene; may be given several times")->check(CLI::Range(1, 16'000'000));
	App.add_option("--changed", Moved, "Lights that change in a frame")->check(CLI::Range(1, 1'000'000));
	App.add_option("--frames", Frames, "Frames of each measurement")->check(CLI::Range(8, 1'000'000));
	App.add_flag("--pictures", bPictures, "Measures frames of the built-in scene lamps on the device instead, with few and many lamps");
	App.add_option("--lamps", Pictures.Lamps, "Lamps of --pictures; may be given several times")->check(CLI::Range(1, 10'000));
	App.add_option("--rounds", Pictures.Rounds, "Rounds of --pictures")->check(CLI::Range(1, 1000));
	Pictures.Device.AddTo(App);
	AddBenchSize(App, Pictures.Size, "--pictures: 1280x720; on a CPU device 640x360");
	AddBenchJson(App, Json);
}

int RunBenchLights(const FBenchLightsOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		return Options.bPictures ? RunBenchLightFrames(Options.Pictures, Figures) : MeasureSizes(Options, Figures);
	});
}

} // namespace Lantern
