// lantern info, lantern cvars and the list of scenes.
#include "Commands/InfoCommand.h"

#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "JsonFile.h"
#include "LanternCore/Config/Config.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/BuiltinScenes.h"
#include "LanternRHIVulkan/VulkanDevice.h"
#include "Session.h"

namespace Lantern
{

namespace
{
const char* RungName(ERTRung Rung)
{
	switch (Rung)
	{
	case ERTRung::None: return "none";
	case ERTRung::RayQuery: return "ray query";
	case ERTRung::Pipeline: return "ray-tracing pipeline";
	case ERTRung::Reorder: return "ray-tracing pipeline + reordering";
	case ERTRung::Micromap: return "ray-tracing pipeline + reordering + micromaps";
	}
	return "?";
}

nlohmann::json Feature(const char* Name, bool bRuns, const std::string& Why) { return {{"name", Name}, {"runs", bRuns}, {"why", Why}}; }

nlohmann::json MakeFeatures(const FRTVulkanDeviceInfo& Info)
{
	const bool bAny = Info.bRayQuery || Info.bRayTracingPipeline;
	nlohmann::json Features = nlohmann::json::array();
	Features.push_back(Feature("sun shadows, ray query", Info.bUsable && Info.bRayQuery, Info.bRayQuery ? "" : "no VK_KHR_ray_query"));
	Features.push_back(Feature("sun shadows, pipeline", Info.bUsable && Info.bRayTracingPipeline,
	    Info.bRayTracingPipeline ? "" : "no VK_KHR_ray_tracing_pipeline"));
	Features.push_back(Feature("reference path tracer", Info.bUsable && Info.bRayTracingPipeline,
	    Info.bRayTracingPipeline ? "" : "no VK_KHR_ray_tracing_pipeline"));
	Features.push_back(
	    Feature("raster and direct lighting", Info.bUsable && bAny, bAny ? "" : "the program asks for a device that traces rays"));
	return Features;
}

void PrintDevice(size_t Index, const FRTVulkanDeviceInfo& Info)
{
	fmt::print("device {}: {} ({})\n  driver  {}\n  rung    {}{}\n", Index, Info.Name, Info.Type, Info.Driver, RungName(Info.Rung),
	    Info.bUsable ? "" : " (not usable)");
	for (const auto& Item : MakeFeatures(Info))
	{
		const std::string Why = Item["why"];
		fmt::print("  {:<28} {}{}\n", Item["name"].get<std::string>(), Item["runs"].get<bool>() ? "runs" : "does not run",
		    Why.empty() ? "" : ": " + Why);
	}
	if (Info.Missing[0]) { fmt::print("  missing:\n{}\n", Info.Missing); }
	if (Info.Quirks[0]) { fmt::print("  driver faults worked around:\n{}\n", Info.Quirks); }
}
} // namespace

int RunInfo(const std::string& Json)
{
	uint32_t Count = 0;
	if (FRTStatus S = ListVulkanDevices(nullptr, 0, &Count); !S)
	{
		LogError("{}", S.Message);
		return ExitNoDevice;
	}
	std::vector<FRTVulkanDeviceInfo> Devices(Count);
	if (FRTStatus S = ListVulkanDevices(Devices.data(), Count, &Count); !S)
	{
		LogError("{}", S.Message);
		return ExitNoDevice;
	}
	nlohmann::json Out = {{"devices", nlohmann::json::array()}};
	bool bSome = false;
	for (size_t I = 0; I < Devices.size(); ++I)
	{
		const FRTVulkanDeviceInfo& D = Devices[I];
		PrintDevice(I, D);
		bSome |= D.bUsable && D.Rung != ERTRung::None;
		Out["devices"].push_back({{"index", I}, {"device", D.Name}, {"driver", D.Driver}, {"type", D.Type}, {"usable", D.bUsable},
		    {"rung", RungName(D.Rung)}, {"features", MakeFeatures(D)}, {"missing", D.Missing}, {"quirks", D.Quirks}});
	}
	if (const int Status = WriteJsonFile(Json, Out.dump(2) + "\n"); Status != ExitDone) { return Status; }
	if (bSome) { return ExitDone; }
	LogError("no device that traces rays was found");
	return ExitNoDevice;
}

int RunCvars(const FDeviceOptions& Settings, bool bMarkdown, const std::string& Json)
{
	const std::string Folder = FindPluginFolders().Config;
	LoadAliases({Folder});
	const FConsoleVariables& Variables = FConsoleVariables::Get();
	if (bMarkdown) // the defaults of the code, whatever the settings say
	{
		fmt::print("{}", Variables.ToMarkdown());
		return ExitDone;
	}
	if (const int Status = LoadSettings(Folder, Settings); Status != ExitDone) { return Status; }
	if (!Json.empty()) { return WriteJsonFile(Json, Variables.ToJson()); }
	fmt::print("{:<34} {:<10} {:<14} {}\n", "name", "value", "set by", "help");
	for (const FRTConsoleVariable* Variable : Variables.GetAll())
	{
		fmt::print("{:<34} {:<10} {:<14} {}\n", Variable->GetName(), EscapeText(FConsoleVariables::ToString(Variable->GetValue())),
		    ToString(Variable->GetSetBy()), Variable->GetHelp());
	}
	return ExitDone;
}

int RunListScenes()
{
	for (const FBuiltinSceneInfo& Scene : GetBuiltinScenes())
	{
		fmt::print("{:<14} {:<24} {}\n", Scene.Name, Scene.Parameters, Scene.Description);
	}
	return ExitDone;
}

} // namespace Lantern
