// The recorder of task traces: rings of events, one for each thread, and the file.
#include "LanternCore/Tasks/TaskTrace.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <mutex>

#include <nlohmann/json.hpp>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Process/ProcessId.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

TRTConsoleVariable<bool> CVarTrace("r.RT.Trace", false,
    "Records which task ran when and on which thread. Writes Chrome trace JSON, for "
    "ui.perfetto.dev, when it is switched off and at shutdown.");
TRTConsoleVariable<std::string> CVarTraceFile(
    "r.RT.Trace.File", "LanternTrace.json", "File that r.RT.Trace writes; relative to the output or cache folder.");
TRTConsoleVariable<int32_t> CVarTraceFrames("r.RT.Trace.Frames", 0,
    "Writes the file of r.RT.Trace every so many frames, each time with these "
    "frames alone, which costs some milliseconds. 0: only at the end.",
    {0, 1'000'000});
TRTConsoleVariable<bool> CVarTraceCalls("r.RT.Trace.Calls", false,
    "Shows each call of Vulkan in the trace as well. Read when a device is made; each call then costs the time of two readings "
    "of the clock.");

/// The events of one thread, a ring once it is full. If there are MaxBuffers already, further threads share the last one.
struct FBuffer
{
	std::mutex Mutex; // wanted by its thread alone but for Clear and reading
	std::vector<FTraceEvent> Events;
	size_t Oldest = 0;
	uint64_t Forgotten = 0;
};

constexpr size_t MaxBuffers = 256;
constexpr size_t MaxThreadNames = 4096;

uint64_t ReadClock() { return static_cast<uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count()); }

constexpr int64_t NoOffset = std::numeric_limits<int64_t>::min();

/// Never destroyed, as the log: threads may still end their scopes while the program ends.
struct FRecorder
{
	std::mutex Mutex; // of all but the buffers' contents
	std::vector<std::unique_ptr<FBuffer>> Buffers;
	std::vector<std::string> Names;
	std::string Folder;
	std::atomic<uint64_t> FramesSinceFile{0};
	std::atomic<bool> bUnwritten{false};
	std::atomic<uint64_t> StartNs{ReadClock()};
	std::atomic<size_t> EventCount{0};
	int64_t DeviceOffsetNs = NoOffset; // from a device's clock to GetNow
};

FRecorder& GetRecorder()
{
	static FRecorder* const Recorder = new FRecorder;
	return *Recorder;
}

/// Has no destructor, since a destructor would keep a library loaded at run time in memory until the thread ends.
struct FThread
{
	FBuffer* Buffer = nullptr;
	uint32_t Index = 0;
};
thread_local FThread ThisThread;

FThread& GetThread()
{
	if (!ThisThread.Buffer)
	{
		FRecorder& Recorder = GetRecorder();
		std::lock_guard Lock(Recorder.Mutex);
		if (Recorder.Buffers.size() < MaxBuffers) { Recorder.Buffers.push_back(std::make_unique<FBuffer>()); }
		if (Recorder.Names.size() < MaxThreadNames) { Recorder.Names.push_back(fmt::format("Worker {}", Recorder.Names.size())); }
		ThisThread = {Recorder.Buffers.back().get(), static_cast<uint32_t>(Recorder.Names.size() - 1)};
	}
	return ThisThread;
}

/// Cuts a long name at the border of a UTF-8 character.
size_t CopyName(char* Out, size_t Room, std::string_view Text)
{
	const size_t Length = FitCharacters(Text.data(), Text.size(), Room);
	std::memcpy(Out, Text.data(), Length);
	return Length;
}

std::string ToJsonText(std::string_view Text)
{
	return nlohmann::json(std::string(Text)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

FTraceEvent MakeEvent(std::string_view Name, uint64_t BeginNs, uint64_t EndNs, int64_t Frame)
{
	FTraceEvent Event;
	CopyName(Event.Name, FTraceEvent::MaxName, Name);
	Event.BeginNs = BeginNs;
	Event.EndNs = std::max(BeginNs, EndNs);
	Event.Frame = Frame;
	return Event;
}

void Store(const FTraceEvent& Event)
{
	FBuffer& Buffer = *GetThread().Buffer;
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Buffer.Mutex);
	if (Buffer.Events.size() < FTaskTrace::MaxEventsPerThread &&
	    Recorder.EventCount.load(std::memory_order_relaxed) < FTaskTrace::MaxEvents)
	{
		if (Buffer.Oldest != 0) // a ring that grows again must be in order first
		{
			std::rotate(Buffer.Events.begin(), Buffer.Events.begin() + static_cast<ptrdiff_t>(Buffer.Oldest), Buffer.Events.end());
			Buffer.Oldest = 0;
		}
		Buffer.Events.push_back(Event);
		++Recorder.EventCount;
		return;
	}
	++Buffer.Forgotten;
	if (!Buffer.Events.empty())
	{
		Buffer.Events[Buffer.Oldest] = Event;
		Buffer.Oldest = (Buffer.Oldest + 1) % Buffer.Events.size();
	}
}

/// Finds a queue among the names, which it joins if it is new.
uint32_t FindQueue(std::string_view Name)
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	const auto It = std::find(Recorder.Names.begin(), Recorder.Names.end(), Name);
	const auto Index = static_cast<uint32_t>(It - Recorder.Names.begin());
	if (Index == Recorder.Names.size()) { Recorder.Names.emplace_back(Name); }
	return Index;
}

std::string MakeFilePath()
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	std::error_code Ignored; // the write will tell
	if (!Recorder.Folder.empty()) { fs::create_directories(Recorder.Folder, Ignored); }
	return (fs::path(Recorder.Folder) / CVarTraceFile.Get()).string();
}
} // namespace

std::atomic<bool> FTaskTrace::bOn{false};
std::atomic<int64_t> FTaskTrace::CurrentFrame{FTraceEvent::NoFrame};

void FTaskTrace::Start()
{
	Clear();
	FRecorder& Recorder = GetRecorder();
	{
		std::lock_guard Lock(Recorder.Mutex);
		Recorder.DeviceOffsetNs = NoOffset;
	}
	Recorder.StartNs = ReadClock();
	bOn = true;
}

void FTaskTrace::Stop() { bOn = false; }

void FTaskTrace::Clear()
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	for (const auto& Buffer : Recorder.Buffers)
	{
		std::lock_guard BufferLock(Buffer->Mutex);
		Recorder.EventCount -= Buffer->Events.size();
		std::vector<FTraceEvent>().swap(Buffer->Events);
		Buffer->Oldest = 0;
		Buffer->Forgotten = 0;
	}
}

uint64_t FTaskTrace::GetNow()
{
	const uint64_t Now = ReadClock(), Start = GetRecorder().StartNs.load(std::memory_order_relaxed);
	return Now > Start ? Now - Start : 0;
}

void FTaskTrace::Record(std::string_view Name, uint64_t BeginNs, uint64_t EndNs, int64_t Frame)
{
	FTraceEvent Event = MakeEvent(Name, BeginNs, EndNs, Frame);
	Event.Thread = GetThread().Index;
	Store(Event);
}

void FTaskTrace::RecordOnDevice(std::string_view Queue, std::string_view Name, uint64_t BeginNs, uint64_t EndNs, int64_t Frame)
{
	FTraceEvent Event = MakeEvent(Name, BeginNs, EndNs, Frame);
	Event.Thread = FindQueue(Queue);
	Event.bDevice = true;
	Store(Event);
}

void FTaskTrace::AlignDevice(uint64_t DeviceNs, uint64_t NotBeforeNs)
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	Recorder.DeviceOffsetNs = std::max(Recorder.DeviceOffsetNs, static_cast<int64_t>(NotBeforeNs - DeviceNs));
}

void FTaskTrace::RecordCall(void*, const char* Name, uint64_t Nanoseconds)
{
	if (!IsOn()) { return; }
	const uint64_t End = GetNow();
	Record(Name, End - std::min(End, Nanoseconds), End, GetFrame());
}

bool FTaskTrace::WantsCalls() { return CVarTraceCalls.Get(); }

void FTaskTrace::NameThread(std::string_view Name)
{
	const uint32_t Index = GetThread().Index;
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	if (Recorder.Names[Index] != Name) { Recorder.Names[Index] = Name; }
}

std::vector<FTraceEvent> FTaskTrace::GetEvents()
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	std::vector<FTraceEvent> Events;
	for (const auto& Buffer : Recorder.Buffers)
	{
		std::lock_guard BufferLock(Buffer->Mutex);
		Events.insert(Events.end(), Buffer->Events.begin(), Buffer->Events.end());
	}
	for (FTraceEvent& Event : Events)
	{
		if (!Event.bDevice || Recorder.DeviceOffsetNs == NoOffset) { continue; }
		Event.BeginNs += static_cast<uint64_t>(Recorder.DeviceOffsetNs);
		Event.EndNs += static_cast<uint64_t>(Recorder.DeviceOffsetNs);
	}
	return Events;
}

std::vector<std::string> FTaskTrace::GetThreadNames()
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	return Recorder.Names;
}

uint64_t FTaskTrace::GetForgottenCount()
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	uint64_t Count = 0;
	for (const auto& Buffer : Recorder.Buffers)
	{
		std::lock_guard BufferLock(Buffer->Mutex);
		Count += Buffer->Forgotten;
	}
	return Count;
}

std::string FTaskTrace::ToJson()
{
	std::vector<FTraceEvent> Events = GetEvents();
	// Viewers nest events of equal beginning in the order of the file, so that the longest comes first.
	std::sort(Events.begin(), Events.end(),
	    [](const FTraceEvent& A, const FTraceEvent& B) { return A.BeginNs != B.BeginNs ? A.BeginNs < B.BeginNs : A.EndNs > B.EndNs; });
	std::string Json = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n"
	                   "{\"ph\":\"M\",\"pid\":1,\"name\":\"process_name\",\"args\":{\"name\":\"Lantern\"}}";
	const std::vector<std::string> Names = GetThreadNames();
	std::vector<bool> bUsed(Names.size());
	for (const FTraceEvent& Event : Events) { bUsed[Event.Thread] = true; }
	for (size_t Thread = 0; Thread < Names.size(); ++Thread)
	{
		if (!bUsed[Thread]) { continue; }
		Json += fmt::format(",\n{{\"ph\":\"M\",\"pid\":1,\"tid\":{},\"name\":\"thread_name\",\"args\":{{\"name\":{}}}}}", Thread,
		    ToJsonText(Names[Thread]));
	}
	for (const FTraceEvent& Event : Events)
	{
		Json += fmt::format(",\n{{\"ph\":\"X\",\"pid\":1,\"tid\":{},\"name\":{},\"ts\":{:.3f},\"dur\":{:.3f}", Event.Thread,
		    ToJsonText(Event.Name), double(Event.BeginNs) * 1e-3, double(Event.EndNs - Event.BeginNs) * 1e-3);
		Json += Event.Frame >= 0 ? fmt::format(",\"args\":{{\"frame\":{}}}}}", Event.Frame) : "}";
	}
	Json += fmt::format("\n],\"otherData\":{{\"forgotten\":{}}}}}\n", GetForgottenCount());
	return Json;
}

FRTStatus FTaskTrace::Write(const std::string& Path)
{
	const std::string Json = ToJson();
	const std::string Temporary = fmt::format("{}.{}.tmp", Path, GetProcessId());
	std::error_code Error;
	errno = 0;
	{
		std::ofstream File(Temporary, std::ios::binary);
		File.write(Json.data(), static_cast<std::streamsize>(Json.size()));
		File.close();
		if (!File) { Error = std::error_code(errno ? errno : EIO, std::generic_category()); }
	}
	if (!Error) { fs::rename(Temporary, Path, Error); }
	if (!Error) { return FRTStatus::Success(); }
	std::error_code Ignored;
	fs::remove(Temporary, Ignored);
	return FRTStatus::Error(ERTResult::IoError, "%s: %s", EscapePath(Path).c_str(), Error.message().c_str());
}

void FTaskTrace::SetFolder(std::string Folder)
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	Recorder.Folder = std::move(Folder);
}

bool FTaskTrace::HasFolder()
{
	FRecorder& Recorder = GetRecorder();
	std::lock_guard Lock(Recorder.Mutex);
	return !Recorder.Folder.empty();
}

void FTaskTrace::StartIfWanted()
{
	if (IsOn() || !CVarTrace.Get()) { return; }
	Start();
	GetRecorder().FramesSinceFile = 0;
	GetRecorder().bUnwritten = true;
	NameThread("Render thread");
}

void FTaskTrace::BeginFrame(uint64_t Frame)
{
	CurrentFrame.store(static_cast<int64_t>(Frame), std::memory_order_relaxed);
	const bool bWanted = CVarTrace.GetOnRenderThread();
	if (!bWanted && !IsOn()) { return; }
	FRecorder& Recorder = GetRecorder();
	if (!bWanted)
	{
		Stop();
		Flush();
		Clear();
		return;
	}
	StartIfWanted();
	Recorder.bUnwritten = true;
	const int32_t Frames = CVarTraceFrames.GetOnRenderThread();
	if (Frames > 0 && Recorder.FramesSinceFile >= static_cast<uint64_t>(Frames))
	{
		Flush();
		Clear();
		Recorder.bUnwritten = true;
	}
	++Recorder.FramesSinceFile;
}

void FTaskTrace::Flush()
{
	FRecorder& Recorder = GetRecorder();
	if (!Recorder.bUnwritten.exchange(false)) { return; }
	Recorder.FramesSinceFile = 0;
	const std::string Path = MakeFilePath();
	if (FRTStatus S = Write(Path); !S)
	{
		LogOnce(ERTLogLevel::Warning, fmt::format("r.RT.Trace: {}", S.Message));
		return;
	}
	LogOnce(ERTLogLevel::Info, fmt::format("r.RT.Trace: written to {}", EscapePath(Path)));
}

void FTraceScope::Begin(std::string_view InName, std::string_view Detail)
{
	bRecording = true;
	size_t Used = CopyName(Name, sizeof(Name), InName);
	if (!Detail.empty())
	{
		Used += CopyName(Name + Used, sizeof(Name) - Used, ": ");
		Used += CopyName(Name + Used, sizeof(Name) - Used, Detail);
	}
	Length = static_cast<uint8_t>(Used);
	Frame = FTaskTrace::GetFrame();
	BeginNs = FTaskTrace::GetNow();
}

void FTraceScope::End()
{
	// The trace may have been switched off meanwhile: what began within it still belongs to it.
	FTaskTrace::Record({Name, Length}, BeginNs, FTaskTrace::GetNow(), Frame);
}

} // namespace Lantern
