// Task trace: what ran when and on which thread, as Chrome trace JSON that Perfetto (ui.perfetto.dev) opens.
//
//   FTraceScope Scope("Gather");                  // until the end of the block
//   FTraceScope Scope("Compile", Shader.Path);    // "Compile: Rays/AlphaTest.rahit"
//
// Off (the default) a scope costs one relaxed load. On, it takes two readings of the clock and a lock that nobody else
// wants. Switched by r.RT.Trace; r.RT.Trace.File names the file, r.RT.Trace.Frames writes it every so many frames.
// Everything here may be called from any thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "LanternRHI/RTStatus.h"

namespace Lantern
{

struct FTraceEvent
{
	static constexpr size_t MaxName = 55; ///< bytes; longer names are cut
	static constexpr int64_t NoFrame = -1;

	char Name[MaxName + 1] = {};
	uint64_t BeginNs = 0, EndNs = 0; ///< since the trace was switched on
	int64_t Frame = NoFrame;         ///< in which it began; NoFrame: before the first
	uint32_t Thread = 0;             ///< small number, see FTaskTrace::GetThreadNames
};

/// The recorder. Memory is bounded: a thread that has MaxEventsPerThread, or all of them together MaxEvents, forgets
/// its oldest for each new one.
class FTaskTrace
{
public:
	static constexpr size_t MaxEventsPerThread = 1u << 15;
	static constexpr size_t MaxEvents = 1u << 18;

	static bool IsOn() { return bOn.load(std::memory_order_relaxed); }
	/// Forgets what there was and records from now on.
	static void Start();
	/// What was recorded stays until Start or Clear.
	static void Stop();
	static void Clear();

	/// Begin, End: of GetNow().
	static void Record(std::string_view Name, uint64_t BeginNs, uint64_t EndNs, int64_t Frame);
	static uint64_t GetNow(); ///< nanoseconds since Start
	static int64_t GetFrame() { return CurrentFrame.load(std::memory_order_relaxed); }
	/// Of the calling thread; without one it is "Worker n". The newest name wins.
	static void NameThread(std::string_view Name);

	/// In no particular order. What runs at the moment is not in it.
	static std::vector<FTraceEvent> GetEvents();
	static std::vector<std::string> GetThreadNames(); ///< by FTraceEvent::Thread
	static uint64_t GetForgottenCount();
	/// Chrome trace format: one complete event ("X", microseconds) each, and the names of threads.
	static std::string ToJson();
	/// Appears whole or not at all.
	static FRTStatus Write(const std::string& Path);

	/// Where a relative r.RT.Trace.File lies; empty: the current folder.
	static void SetFolder(std::string Folder);
	static bool HasFolder();
	/// r.RT.Trace is followed from the first frame on. Whoever works before that (loads, compiles) calls this.
	static void StartIfWanted();
	/// At the start of a frame, on the render thread, after FConsoleVariables::BeginFrame: follows the console variables,
	/// and writes the file where one is due. A file that cannot be written is said once.
	static void BeginFrame(uint64_t Frame);
	/// Writes what was recorded since the last file. Whoever renders calls it before it goes.
	static void Flush();

private:
	static std::atomic<bool> bOn;
	static std::atomic<int64_t> CurrentFrame;
};

/// An event from construction to destruction.
class FTraceScope
{
public:
	explicit FTraceScope(std::string_view InName)
	{
		if (FTaskTrace::IsOn()) { Begin(InName, {}); }
	}
	/// "Name: Detail". Detail is read at once.
	FTraceScope(std::string_view InName, std::string_view Detail)
	{
		if (FTaskTrace::IsOn()) { Begin(InName, Detail); }
	}
	~FTraceScope()
	{
		if (bRecording) { End(); }
	}
	FTraceScope(const FTraceScope&) = delete;
	FTraceScope& operator=(const FTraceScope&) = delete;

private:
	void Begin(std::string_view InName, std::string_view Detail);
	void End();

	bool bRecording = false;
	uint8_t Length; // the rest is not even initialised unless the trace is on
	char Name[FTraceEvent::MaxName];
	uint64_t BeginNs;
	int64_t Frame;
};

} // namespace Lantern
