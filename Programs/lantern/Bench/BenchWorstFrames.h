// The longest frames of a benchmark, and what the threads did in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "LanternCore/Tasks/TaskTrace.h"

namespace Lantern
{

/// Takes what a trace shows of the longest frames, before it is forgotten. Does nothing if the trace is off.
/// Threads: the one that makes the frames.
class FWorstFrames
{
public:
	void Begin() { BeginNs = FTaskTrace::GetNow(); }
	/// Ends the frame of the newest Begin, which took Ms. Takes time after a frame that is among the longest so far.
	void End(size_t Frame, double Ms);
	/// Adds what other threads did meanwhile, once that has ended.
	void AddOthers();
	/// Prints the longest events of each frame: those of its own thread, then those of other threads at the same time.
	void Print() const;
	/// [{"frame", "ms", "events": [{"name", "thread", "ms"}]}]; longest frame first.
	nlohmann::json ToJson() const;

private:
	static constexpr size_t Kept = 5;       // frames
	static constexpr size_t KeptEvents = 8; // of a frame's thread, and of all others
	struct FEvent
	{
		std::string Name, Thread;
		double Ms = 0.0;
		bool bOwn = false; // of the frame's thread
	};
	struct FFrame
	{
		size_t Index = 0;
		double Ms = 0.0;
		uint64_t BeginNs = 0, EndNs = 0;
		uint32_t Thread = 0;
		std::vector<FEvent> Events;
	};
	/// bOwn: of the frame's thread, or of all others.
	static void AddEvents(FFrame& Frame, const std::vector<FTraceEvent>& All, bool bOwn);

	uint64_t BeginNs = 0;
	std::vector<FFrame> Frames; // longest first
};

} // namespace Lantern
