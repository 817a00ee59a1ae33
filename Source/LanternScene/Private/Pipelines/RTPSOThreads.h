// The threads of the RTPSO compiler. They are no tasks of LanternCore: a driver blocks for as long as it likes, and a frame's
// tasks must not wait behind it.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "Pipelines/RTPSOScheduler.h"

namespace Lantern
{

/// Compile threads and one background thread, which do what the scheduler hands out. They hold the mutex while they call the
/// scheduler. They never hold it during a compile, a link, a look for edits, or the destruction of discarded objects.
/// Threads: SetCount and WaitForResult are for the render thread, Wake is for any. The caller of each holds the mutex.
class FRTPSOThreads
{
public:
	/// Starts the background thread, which starts the others: a frame starts none. Mutex guards Scheduler. All references must
	/// outlive it.
	FRTPSOThreads(std::mutex& InMutex, FRTPSOScheduler& InScheduler, const FUnitCompiler& InCompiler, IRTDevice& InDevice);
	/// Waits for what is in the driver. What has not been started is forgotten. The caller does not hold the mutex.
	~FRTPSOThreads();
	FRTPSOThreads(const FRTPSOThreads&) = delete;
	FRTPSOThreads& operator=(const FRTPSOThreads&) = delete;

	/// The number of compile threads that may work, at least 1. Missing ones are started beside the caller; surplus ones sleep.
	void SetCount(uint32_t InCount);
	/// The scheduler has something new to do.
	void Wake() { WorkAdded.notify_all(); }
	/// Waits until IsOver, which is asked with the mutex held, at first and after each result.
	void WaitForResult(std::unique_lock<std::mutex>& Lock, const std::function<bool()>& IsOver) { ResultStored.wait(Lock, IsOver); }

private:
	void RunCompiler(uint32_t Index);
	void RunBackground();
	bool IsCompilerMissing() const { return Threads.size() < size_t(Count) + 1; }
	void StartNext();
	void CompileNext(std::unique_lock<std::mutex>& Lock);
	void LinkNext(std::unique_lock<std::mutex>& Lock);
	void FindEdits(std::unique_lock<std::mutex>& Lock);
	void EmptyTrash(std::unique_lock<std::mutex>& Lock);

	std::mutex& Mutex;
	FRTPSOScheduler& Scheduler; ///< guarded by Mutex
	const FUnitCompiler& Compiler;
	IRTDevice& Device;
	std::condition_variable WorkAdded, ResultStored;
	bool bStop = false;               ///< guarded by Mutex
	uint32_t Count = 0;               ///< guarded by Mutex
	std::vector<std::thread> Threads; ///< guarded by Mutex until bStop; the first is the background thread
};

} // namespace Lantern
