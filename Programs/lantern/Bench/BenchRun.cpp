// The head that benchmarks share: --json, --size, the device or the mock, the loop over scenes.
#include "Bench/BenchRun.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "JsonFile.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

void AddBenchQuick(CLI::App& App, const std::function<void()>& SetQuick)
{
	App.add_flag_callback("--quick", SetQuick, "Less of everything, to see whether it runs: seconds instead of minutes");
}

void AddBenchJson(CLI::App& App, std::string& Json) { App.add_option("--json", Json, "Write the figures to this file"); }

void AddBenchSize(CLI::App& App, std::string& Text, const char* Defaults)
{
	App.add_option("--size", Text, std::string("WIDTHxHEIGHT, pixels (") + Defaults + ")")->check([](const std::string& Size) {
		FPictureOptions Unused;
		ParseSize(Size, Unused);
		return std::string();
	});
}

int RunBench(const std::string& File, const std::function<int(nlohmann::json& Figures)>& Body)
{
	if (const int Status = CheckJsonFile(File); Status != ExitDone) { return Status; }
	nlohmann::json Figures;
	const int Exit = Body(Figures);
	if ((Exit != ExitDone && Exit != ExitCheckFailed) || Figures.is_null()) { return Exit; }
	const int Written = WriteJsonFile(File, Figures.dump(2) + "\n");
	return Written == ExitDone ? Exit : Written;
}

namespace
{
/// Benchmarks are of parts. Indirect light, which the project's defaults turn on, would be beside each; --quality and --set may.
void LeaveOutIndirectLight()
{
	for (const char* const Name : {"r.RT.GI", "r.RT.Reflections", "r.RT.Transmission"})
	{
		FConsoleVariables::Get().Set(Name, "0", ERTSetBy::Ini, "bench");
	}
}
} // namespace

int RunInBenchSession(const FDeviceOptions& Options, const std::function<int(FSession&)>& Body)
{
	FSession Session;
	const int Opened = Session.OpenDevice(Options);
	LeaveOutIndirectLight();
	return Session.Close(Opened == ExitDone ? Body(Session) : Opened);
}

int RunOnBenchMock(const FDeviceOptions& Options, const std::function<int(IRTDevice&)>& Body)
{
	if (const int Status = LoadSettings(FindPluginFolders().Config, Options); Status != ExitDone) { return Status; }
	LeaveOutIndirectLight();
	TRTRef<IRTDevice> Device;
	if (FRTStatus S = CreateBenchMock(Device); !S) { return ReportStatus(S, "--mock"); }
	return Body(*Device);
}

FRTStatus CreateBenchMock(TRTRef<IRTDevice>& Out)
{
	const FRTStatus Status = CreateMockDevice({}, Out.ReleaseAndGetAddress());
	if (Status) { GetMock(Out.Get()).SetCallRecording(false); }
	return Status;
}

nlohmann::json DescribeBenchDevice(const FRTCapabilities& Capabilities)
{
	return {{"device", Capabilities.DeviceName}, {"driver", Capabilities.DriverName}};
}

bool HasRayPath(const FRTCapabilities& Capabilities, bool bPipeline, const FBenchScene& Scene)
{
	if (bPipeline ? Capabilities.bRayTracingPipeline : Capabilities.bRayQuery) { return true; }
	LogInfo("{}: the device has no {}", Scene.Name, bPipeline ? "ray-tracing pipelines" : "ray queries");
	return false;
}

void FSceneBenchOptions::AddSceneOptions(CLI::App& App, const char* ScenesHelp)
{
	Device.AddTo(App);
	App.add_option("SCENE", Scenes, ScenesHelp);
	AddViewOption(App, View);
	AddBenchSize(App, Size, "1280x720; on a CPU device 640x360");
}

int RunSceneBench(const FSceneBenchOptions& Options, const FSceneBench& Bench)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		return RunInBenchSession(Options.Device, [&](FSession& Session) {
			Figures = DescribeBenchDevice(Session.GetDevice().GetCapabilities());
			nlohmann::json& Cases = Figures["cases"] = nlohmann::json::array();
			Bench.PrintHeader();
			int Exit = ExitDone;
			const std::vector<FBenchScene> Scenes = Bench.ChooseScenes();
			FBenchProgress Progress(Bench.Name, Bench.SceneWork * double(Scenes.size()));
			for (const FBenchScene& Scene : Scenes)
			{
				const int Status = Bench.Measure(Session, Scene, Progress, Cases);
				Exit = Exit == ExitDone ? Status : Exit;
			}
			return Exit;
		});
	});
}

} // namespace Lantern
