// Task trace: records what ran when and on which thread, as Chrome trace JSON that Perfetto (ui.perfetto.dev) opens.
//
//   FTraceScope Scope("Gather");                  // until the end of the block
//   FTraceScope Scope("Compile", Shader.Path);    // "Compile: Rays/AlphaTest.rahit"
//
// If the trace is off (the default), a scope costs one relaxed load. If it is on, a scope reads the clock twice and takes an
// uncontended lock. r.RT.Trace switches it, r.RT.Trace.File names the file, and r.RT.Trace.Frames writes it every so many
// frames. All functions may be called from any thread.
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
	uint64_t BeginNs = 0, EndNs = 0; ///< since the trace was switched on; of a device: by its clock, until GetEvents
	int64_t Frame = NoFrame;         ///< frame in which it began; NoFrame: before the first
	uint32_t Thread = 0;             ///< index into FTaskTrace::GetThreadNames, which names queues of devices as well
	bool bDevice = false;            ///< ran on a queue
};

/// The recorder. Its memory is bounded: beyond MaxEventsPerThread, or MaxEvents over all threads, a new event replaces the
/// oldest one of its thread.
class FTaskTrace
{
public:
	static constexpr size_t MaxEventsPerThread = 1u << 15;
	static constexpr size_t MaxEvents = 1u << 18;

	static bool IsOn() { return bOn.load(std::memory_order_relaxed); }
	/// Discards all events and starts to record.
	static void Start();
	/// Stops recording. The events stay until Start or Clear.
	static void Stop();
	static void Clear();

	/// BeginNs, EndNs: from GetNow().
	static void Record(std::string_view Name, uint64_t BeginNs, uint64_t EndNs, int64_t Frame);
	/// Records what a device's queue ran. Times are the device's own, in nanoseconds; AlignDevice places them on the CPU's clock.
	/// There is one such clock. Passes of several devices are right in themselves, and not beside each other.
	static void RecordOnDevice(std::string_view Queue, std::string_view Name, uint64_t BeginNs, uint64_t EndNs, int64_t Frame);
	/// Says that the device's time DeviceNs was not before NotBeforeNs of GetNow(). The latest such time decides. A frame thus
	/// never begins on the device before it was recorded. It begins too early by the shortest way to the device at most.
	static void AlignDevice(uint64_t DeviceNs, uint64_t NotBeforeNs);
	/// Records a call that has just ended on this thread. Made for FRTVulkanCallSink::Call.
	static void RecordCall(void* User, const char* Name, uint64_t Nanoseconds);
	/// Whether a new device is to be given RecordCall (r.RT.Trace.Calls).
	static bool WantsCalls();
	static uint64_t GetNow(); ///< nanoseconds since Start
	static int64_t GetFrame() { return CurrentFrame.load(std::memory_order_relaxed); }
	/// Names the calling thread; the default is "Worker n". The newest name wins.
	static void NameThread(std::string_view Name);

	/// Returns finished events, in no particular order.
	static std::vector<FTraceEvent> GetEvents();
	static std::vector<std::string> GetThreadNames(); ///< by FTraceEvent::Thread
	static uint64_t GetForgottenCount();
	/// Returns Chrome trace JSON: one complete event ("X", microseconds) each, and the names of threads.
	static std::string ToJson();
	/// Writes ToJson to a file, atomically.
	static FRTStatus Write(const std::string& Path);

	/// Sets the folder that a relative r.RT.Trace.File lies in; empty: the current folder.
	static void SetFolder(std::string Folder);
	static bool HasFolder();
	/// Starts if r.RT.Trace is on. For work before the first BeginFrame (loading, compiling).
	static void StartIfWanted();
	/// Follows the console variables, and writes the file if it is due. Call at the start of a frame, on the render thread,
	/// after FConsoleVariables::BeginFrame. A file that cannot be written is logged once.
	static void BeginFrame(uint64_t Frame);
	/// Writes what was recorded since the last file. Whoever renders calls it at shutdown.
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
	/// Records "Name: Detail". Detail is copied at once.
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
	uint8_t Length; // this and what follows are initialised only if the trace is on
	char Name[FTraceEvent::MaxName];
	uint64_t BeginNs;
	int64_t Frame;
};

} // namespace Lantern
