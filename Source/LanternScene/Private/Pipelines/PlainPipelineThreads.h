// The threads that compile plain pipelines.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "LanternScene/Pipelines/PlainPipelines.h"

namespace Lantern
{

/// One compile. The render thread writes Source and Name before it hands the job over, a compile thread the rest until IsDone.
struct FPlainJob
{
	std::variant<FShaderSource, FRasterSource> Source;
	std::string Name;
	TRTRef<IRTPipeline> Pipeline; ///< null on an error
	FRTStatus Status;
	std::atomic<bool> bDone{false};
	/// True: Pipeline and Status may be read, and change no more.
	bool IsDone() const { return bDone.load(std::memory_order_acquire); }
};
using FPlainJobRef = std::shared_ptr<FPlainJob>;

/// They are no tasks of LanternCore: a driver blocks for as long as it likes, and a frame's tasks must not wait behind it.
/// Threads: the render thread, one call at a time.
class FPlainPipelineThreads
{
public:
	/// Starts the first thread, which starts others as they are needed: a frame starts none. The references must outlive it.
	FPlainPipelineThreads(IRTDevice& InDevice, FShaderCompiler& InCompiler);
	/// Waits for what is in the driver. What has not been started is forgotten.
	~FPlainPipelineThreads();
	FPlainPipelineThreads(const FPlainPipelineThreads&) = delete;
	FPlainPipelineThreads& operator=(const FPlainPipelineThreads&) = delete;

	/// Has a thread compile Job, after HandOver. MostThreads: that there may be; those that run stay.
	void Add(FPlainJobRef Job, uint32_t MostThreads);
	/// Has a thread destroy Job, which calls the driver, after HandOver.
	void Discard(FPlainJobRef Job) { NewDoomed.push_back(std::move(Job)); }
	/// Hands over what was added and discarded. bWait: waits for the lock. Otherwise what a taken lock keeps back is handed over by
	/// a later call, since a thread of low priority may have been stopped while it had the lock.
	void HandOver(bool bWait);
	/// Waits until Job, which was handed over, is done.
	void Wait(const FPlainJob& Job);

private:
	void Run(uint32_t Index);
	void StartNext();
	void Compile(FPlainJob& Job) const;
	FRTStatus Make(const FShaderSource& Source, FPlainJob& Job) const;
	FRTStatus Make(const FRasterSource& Source, FPlainJob& Job) const;

	IRTDevice& Device;
	FShaderCompiler& Compiler;
	std::vector<FPlainJobRef> NewJobs, NewDoomed; ///< the render thread's, not handed over yet
	uint32_t NewMost = 1;                         ///< the render thread's, as are they
	std::mutex Mutex;                             ///< never held during a call of the driver, of glslang, or of the file system
	std::condition_variable WorkAdded, JobDone;
	std::deque<FPlainJobRef> Queue;   ///< guarded by Mutex
	std::vector<FPlainJobRef> Doomed; ///< guarded by Mutex
	uint32_t Most = 1;                ///< guarded by Mutex
	uint32_t Working = 0;             ///< guarded by Mutex
	bool bStop = false;               ///< guarded by Mutex
	std::vector<std::thread> Threads; ///< guarded by Mutex until bStop
};

} // namespace Lantern
