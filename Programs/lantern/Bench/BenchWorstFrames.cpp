// What a trace shows of a benchmark's longest frames.
#include "Bench/BenchWorstFrames.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace Lantern
{

namespace
{
constexpr const char* FrameMark = "Frame of the benchmark";
} // namespace

void FWorstFrames::End(size_t Frame, double Ms)
{
	if (!FTaskTrace::IsOn() || (Frames.size() == Kept && Ms <= Frames.back().Ms)) { return; }
	const uint64_t EndNs = BeginNs + static_cast<uint64_t>(1e6 * Ms);
	FTaskTrace::Record(FrameMark, BeginNs, EndNs, FTaskTrace::GetFrame());
	const std::vector<FTraceEvent> All = FTaskTrace::GetEvents();
	const auto Mark = std::find_if(
	    All.begin(), All.end(), [&](const FTraceEvent& Event) { return Event.Name == std::string(FrameMark) && Event.BeginNs == BeginNs; });
	if (Mark == All.end()) { return; }
	FFrame New{Frame, Ms, BeginNs, EndNs, Mark->Thread, {}};
	AddEvents(New, All, true);
	const auto Place = std::find_if(Frames.begin(), Frames.end(), [&](const FFrame& Other) { return Other.Ms < Ms; });
	Frames.insert(Place, std::move(New));
	if (Frames.size() > Kept) { Frames.pop_back(); }
}

void FWorstFrames::AddOthers()
{
	const std::vector<FTraceEvent> All = FTaskTrace::GetEvents();
	for (FFrame& Frame : Frames) { AddEvents(Frame, All, false); }
}

void FWorstFrames::AddEvents(FFrame& Frame, const std::vector<FTraceEvent>& All, bool bOwn)
{
	const std::vector<std::string> Threads = FTaskTrace::GetThreadNames();
	std::vector<FEvent> Events;
	for (const FTraceEvent& Event : All)
	{
		const bool bOverlaps = Event.EndNs > Frame.BeginNs && Event.BeginNs < Frame.EndNs;
		if (!bOverlaps || (Event.Thread == Frame.Thread) != bOwn || Event.Name == std::string(FrameMark)) { continue; }
		Events.push_back({Event.Name, Threads[Event.Thread], 1e-6 * static_cast<double>(Event.EndNs - Event.BeginNs), bOwn});
	}
	std::sort(Events.begin(), Events.end(), [](const FEvent& A, const FEvent& B) { return A.Ms > B.Ms; });
	Events.resize(std::min(Events.size(), KeptEvents));
	Frame.Events.insert(Frame.Events.end(), Events.begin(), Events.end());
}

void FWorstFrames::Print() const
{
	for (const FFrame& Frame : Frames)
	{
		fmt::print("frame {}: {:.3f} ms\n", Frame.Index, Frame.Ms);
		for (const bool bOwn : {true, false})
		{
			for (const FEvent& Event : Frame.Events)
			{
				if (Event.bOwn != bOwn) { continue; }
				fmt::print("  {:>9.3f} ms  {}{}{}\n", Event.Ms, bOwn ? "" : Event.Thread, bOwn ? "" : ", meanwhile: ", Event.Name);
			}
		}
	}
}

nlohmann::json FWorstFrames::ToJson() const
{
	nlohmann::json Json = nlohmann::json::array();
	for (const FFrame& Frame : Frames)
	{
		nlohmann::json Events = nlohmann::json::array();
		for (const FEvent& Event : Frame.Events) { Events.push_back({{"name", Event.Name}, {"thread", Event.Thread}, {"ms", Event.Ms}}); }
		Json.push_back({{"frame", Frame.Index}, {"ms", Frame.Ms}, {"events", std::move(Events)}});
	}
	return Json;
}

} // namespace Lantern
