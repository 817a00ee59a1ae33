// The parts of a chart: reading, checking and merging their JSON.
#include "LanternMeasure/Chart/ChartParts.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>

#include "LanternCore/Text/Quote.h"
#include "LanternImage/AtomicFile.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

constexpr int PartVersion = 1;

bool IsKey(const std::string& Text) { return Text.size() == 32 && Text.find_first_not_of("0123456789abcdef") == std::string::npos; }

bool HasMembers(const FChartPart& Part)
{
	if (!Part.is_object() || Part.value("version", nlohmann::json()) != PartVersion) { return false; }
	const auto Is = [&](const char* Name, nlohmann::json::value_t Type) { return Part.contains(Name) && Part[Name].type() == Type; };
	using enum nlohmann::detail::value_t;
	const bool bCommon = Is("key", string) && Is("order", array) && Is("device", string) && Is("driver", string) && Is("is_cpu", boolean) &&
	                     Is("settings", object) && Is("scene", object);
	const bool bKind = Is("facts", array) || (Is("signal", object) && (Is("point", object) || Is("skipped", object)));
	return bCommon && bKind && Part["order"].size() == 4 && Part["scene"].contains("name") && Part["scene"]["name"].is_string();
}

FChartPart ParsePart(const fs::path& Path)
{
	std::ifstream File(Path, std::ios::binary);
	if (!File) { return nullptr; }
	FChartPart Part = FChartPart::parse(File, nullptr, false);
	return HasMembers(Part) ? Part : FChartPart(nullptr);
}

FRTStatus ReadFolder(const std::string& Folder, std::vector<FChartPart>& Out)
{
	const size_t Before = Out.size();
	std::error_code Error;
	for (fs::directory_iterator It(Folder, Error), End; !Error && It != End; It.increment(Error))
	{
		if (It->path().extension() != ".json" || !IsKey(It->path().stem().string())) { continue; }
		FChartPart Part = ParsePart(It->path());
		if (!Part.is_null()) { Out.push_back(std::move(Part)); }
	}
	if (Error) { return MakeFileError(ERTResult::IoError, Folder, Error.message()); }
	return Out.size() > Before ? FRTStatus::Success() : MakeFileError(ERTResult::InvalidArgument, Folder, "no part of a chart is in it");
}

/// What a point, a skipped one or facts say of themselves; equal for parts of the same item.
std::string GetIdentity(const FChartPart& Part)
{
	std::string Text = Part["scene"]["name"].get<std::string>();
	if (Part.contains("facts")) { return Text + ": facts"; }
	const nlohmann::json& Body = Part.contains("point") ? Part["point"] : Part["skipped"];
	for (const char* Name : {"signal", "method", "preset", "path"})
	{
		Text += (Name == std::string_view("signal") ? ": " : ", ") + Body.value(Name, std::string());
	}
	return Text;
}

/// One part for each key, in the order of the page.
std::vector<FChartPart> Unify(std::vector<FChartPart> Parts)
{
	std::map<std::string, FChartPart> ByKey;
	for (FChartPart& Part : Parts)
	{
		FChartPart& Mine = ByKey[Part["key"].get<std::string>()];
		// Two measurements of one key: any choice will do that does not hang on the order in which they come.
		const bool bBetter = Mine.is_null() || (Mine.contains("skipped") && !Part.contains("skipped")) ||
		                     (Mine.contains("skipped") == Part.contains("skipped") && Part.dump() < Mine.dump());
		if (bBetter) { Mine = std::move(Part); }
	}
	std::vector<FChartPart> Out;
	for (auto& [Key, Part] : ByKey) { Out.push_back(std::move(Part)); }
	std::stable_sort(Out.begin(), Out.end(), [](const FChartPart& A, const FChartPart& B) { return A["order"] < B["order"]; });
	return Out;
}

std::string ShowSettings(const FChartPart& Part)
{
	constexpr size_t MaxShown = 220; // two of them fit a status
	return EscapeText(Part["settings"].dump(), MaxShown);
}

FRTStatus CheckParts(const std::vector<FChartPart>& Parts)
{
	std::set<std::string> Seen;
	for (const FChartPart& Part : Parts)
	{
		if (Part["settings"] != Parts.front()["settings"])
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "%s",
			    fmt::format("parts of different settings: {} and {}", ShowSettings(Parts.front()), ShowSettings(Part)).c_str());
		}
		if (!Seen.insert(GetIdentity(Part)).second)
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "%s", fmt::format("two different measurements of {}", EscapeText(GetIdentity(Part))).c_str());
		}
	}
	return FRTStatus::Success();
}

std::string JoinNames(const std::vector<FChartPart>& Parts, const char* Member)
{
	std::set<std::string> Names;
	for (const FChartPart& Part : Parts) { Names.insert(Part[Member].get<std::string>()); }
	std::string Text;
	for (const std::string& Name : Names) { Text += (Text.empty() ? "" : ", ") + Name; }
	return Text;
}

nlohmann::json ListSignals(const std::vector<FChartPart>& Parts)
{
	std::map<size_t, nlohmann::json> ByOrder;
	for (const FChartPart& Part : Parts)
	{
		if (!Part.contains("signal")) { continue; }
		const auto Signal = FindSignal(Part["signal"].value("name", std::string()));
		// The whole frame last, and behind it what another version has measured.
		const size_t Order = !Signal ? SignalCount + 1 : *Signal == ESignal::Frame ? SignalCount : ToIndex(*Signal);
		ByOrder[Order] = Part["signal"];
	}
	nlohmann::json Out = nlohmann::json::array();
	for (auto& [Order, Signal] : ByOrder) { Out.push_back(std::move(Signal)); }
	return Out;
}
} // namespace

std::string GetPartFile(const std::string& Folder, const std::string& Key) { return Folder + '/' + Key + ".json"; }

FRTStatus WritePart(const std::string& Folder, const FChartPart& InPart)
{
	FChartPart Part = InPart;
	Part["version"] = PartVersion;
	return WriteFileAtomically(GetPartFile(Folder, Part["key"].get<std::string>()), Part.dump() + "\n");
}

FChartPart ReadPart(const std::string& Folder, const std::string& Key)
{
	FChartPart Part = ParsePart(GetPartFile(Folder, Key));
	return !Part.is_null() && Part["key"] == Key ? Part : FChartPart(nullptr);
}

FRTStatus ReadAllParts(const std::vector<std::string>& Places, std::vector<FChartPart>& Out)
{
	for (const std::string& Place : Places)
	{
		std::error_code Error;
		if (fs::is_directory(Place, Error))
		{
			if (FRTStatus S = ReadFolder(Place, Out); !S) { return S; }
			continue;
		}
		if (!fs::is_regular_file(Place, Error)) { return MakeFileError(ERTResult::IoError, Place, "no such file or folder"); }
		FChartPart Part = ParsePart(Place);
		if (Part.is_null()) { return MakeFileError(ERTResult::InvalidArgument, Place, "not a part of a chart"); }
		Out.push_back(std::move(Part));
	}
	return FRTStatus::Success();
}

FRTStatus MakeChartData(std::vector<FChartPart> InParts, nlohmann::json& Out)
{
	const std::vector<FChartPart> Parts = Unify(std::move(InParts));
	if (Parts.empty()) { return FRTStatus::Error(ERTResult::InvalidArgument, "no part of a chart is there"); }
	if (FRTStatus S = CheckParts(Parts); !S) { return S; }
	Out = {{"version", 1}, {"device", JoinNames(Parts, "device")}, {"driver", JoinNames(Parts, "driver")},
	    {"settings", Parts.front()["settings"]}, {"signals", ListSignals(Parts)}, {"scenes", nlohmann::json::array()},
	    {"images", nlohmann::json::object()}};
	Out["is_cpu"] = std::any_of(Parts.begin(), Parts.end(), [](const FChartPart& Part) { return Part["is_cpu"].get<bool>(); });
	std::map<std::string, size_t> SceneIndices;
	for (const FChartPart& Part : Parts)
	{
		nlohmann::json& Scenes = Out["scenes"];
		const auto [It, bNew] = SceneIndices.emplace(Part["scene"]["name"].get<std::string>(), Scenes.size());
		if (bNew)
		{
			nlohmann::json Scene = Part["scene"];
			for (const char* List : {"facts", "points", "skipped"}) { Scene[List] = nlohmann::json::array(); }
			Scenes.push_back(std::move(Scene));
		}
		nlohmann::json& Scene = Scenes[It->second];
		if (Part.contains("facts")) { Scene["facts"] = Part["facts"]; }
		else if (Part.contains("point")) { Scene["points"].push_back(Part["point"]); }
		else { Scene["skipped"].push_back(Part["skipped"]); }
		if (Part.contains("images")) { Out["images"].update(Part["images"]); }
	}
	return FRTStatus::Success();
}

nlohmann::json WithoutImages(const nlohmann::json& Data)
{
	nlohmann::json Out = Data;
	Out.erase("images");
	return Out;
}

} // namespace Lantern
