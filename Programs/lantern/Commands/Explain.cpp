// What is known of the light of one pixel, as JSON and as text.
#include "Commands/Explain.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace Lantern
{

namespace
{
nlohmann::json ToJson(glm::vec3 V) { return {V.x, V.y, V.z}; }

template <class T>
nlohmann::json OrNull(const std::optional<T>& Value)
{
	return Value ? nlohmann::json(*Value) : nlohmann::json(nullptr);
}

nlohmann::json CellToJson(const FExplainedRadianceCell& Cell)
{
	return {{"slot", Cell.Slot}, {"key", fmt::format("{:08x}", Cell.Key)}, {"size_m", Cell.Size}, {"updates", Cell.Updates},
	    {"frames_since_update", Cell.SinceUpdate}, {"frames_since_look_up", Cell.SinceLookUp}, {"light", ToJson(Cell.Light)},
	    {"place_m", ToJson(Cell.Place)}};
}

std::string Show(const nlohmann::json& Numbers)
{
	std::string Text;
	for (const auto& Number : Numbers) { Text += fmt::format("{}{:.4g}", Text.empty() ? "" : " ", Number.get<double>()); }
	return Text;
}

void PrintCell(const nlohmann::json& Link)
{
	const nlohmann::json& Cell = Link["cell"];
	const std::string Name = Link["name"].get<std::string>() + (Link["used"].get<bool>() ? " *" : "");
	if (Cell.is_null())
	{
		fmt::print("  {:<16} none\n", Name);
		return;
	}
	fmt::print("  {:<16} {} of {:.4g} m, slot {}, light {}: {} updates, the last {} frames ago, asked for {} frames ago; at {}\n", Name,
	    Cell["key"].get<std::string>(), Cell["size_m"].get<double>(), Cell["slot"].get<uint32_t>(), Show(Cell["light"]),
	    Cell["updates"].get<uint32_t>(), Cell["frames_since_update"].get<uint32_t>(), Cell["frames_since_look_up"].get<uint32_t>(),
	    Show(Cell["place_m"]));
}
} // namespace

FSignalSet GetExplainedSignals()
{
	FSignalSet Signals;
	for (const FSignalInfo& Info : SignalInfos)
	{
		if (Info.Signal != ESignal::Frame) { Signals.Add(Info.Signal); }
	}
	return Signals;
}

nlohmann::json ExplanationToJson(glm::uvec2 Pixel, const FCapturedFrame& Frame, const FPixelExplanation& Explanation)
{
	nlohmann::json Json;
	Json["pixel"] = {Pixel.x, Pixel.y};
	Json["signals"] = nlohmann::json::object();
	for (const FSignalInfo& Info : SignalInfos)
	{
		const FImage& Image = Frame.Get(Info.Signal);
		if (Pixel.x >= Image.Width || Pixel.y >= Image.Height) { continue; } // the frame has no such signal
		nlohmann::json& Values = Json["signals"][Info.Name] = nlohmann::json::array();
		for (uint32_t Channel = 0; Channel < Image.Channels; ++Channel) { Values.push_back(Image.At(Pixel.x, Pixel.y, Channel)); }
	}
	Json["explained"] = Explanation.Frames > 0;
	Json["surface"] = Explanation.bSurface;
	if (!Explanation.bSurface) { return Json; }
	Json["position_m"] = ToJson(Explanation.Position);
	Json["normal"] = ToJson(Explanation.Normal);
	Json["light_cell"] = {{"index", OrNull(Explanation.LightCell)}, {"lights", OrNull(Explanation.ListedLights)}};
	for (uint32_t I = 0; I < Explanation.Cells.size(); ++I)
	{
		const auto& Cell = Explanation.Cells[I];
		Json["radiance_cells"].push_back({{"name", FPixelExplanation::CellNames[I]}, {"used", Explanation.Used == I},
		    {"cell", Cell ? CellToJson(*Cell) : nlohmann::json(nullptr)}});
	}
	return Json;
}

void PrintExplanation(const nlohmann::json& Json)
{
	fmt::print("pixel {},{}\n", Json["pixel"][0].get<uint32_t>(), Json["pixel"][1].get<uint32_t>());
	for (const auto& [Name, Values] : Json["signals"].items()) { fmt::print("  {:<16} {}\n", Name, Show(Values)); }
	if (!Json["explained"].get<bool>())
	{
		fmt::print("  No frame was explained: its indirect light does not end in radiance cells (r.RT.GI=3).\n");
		return;
	}
	if (!Json["surface"].get<bool>())
	{
		fmt::print("  It shows no surface.\n");
		return;
	}
	fmt::print(
	    "  {:<16} {} m from the camera's place\n  {:<16} {}\n", "position", Show(Json["position_m"]), "normal", Show(Json["normal"]));
	const nlohmann::json& Lights = Json["light_cell"];
	if (Lights["index"].is_null()) { fmt::print("  {:<16} none: all lights are visited\n", "light cell"); }
	else if (Lights["lights"].is_null())
	{
		fmt::print("  {:<16} {}, without a list: all are visited\n", "light cell", Lights["index"].get<uint32_t>());
	}
	else { fmt::print("  {:<16} {}, lists {}\n", "light cell", Lights["index"].get<uint32_t>(), Lights["lights"].get<uint32_t>()); }
	fmt::print("  radiance cells in the order in which a path's end tries them; * is the one that it takes:\n");
	for (const nlohmann::json& Link : Json["radiance_cells"]) { PrintCell(Link); }
}

} // namespace Lantern
