// Task scheduling over oneTBB, narrowed to what the plugin needs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace Lantern
{

/// Runs Body(Begin, End) over [0, Count) in chunks of at least Grain, on all workers. Returns when all are done. Body must not
/// throw; an exception ends the program.
void ParallelFor(size_t Count, size_t Grain, const std::function<void(size_t, size_t)>& Body);

/// A set of tasks that can be waited for. The destructor waits. Tasks must not throw; an exception ends the program. Run may be
/// called from any thread, also by a task of the group; Wait only by the owner.
class FTaskGroup
{
public:
	FTaskGroup();
	~FTaskGroup();
	FTaskGroup(const FTaskGroup&) = delete;
	FTaskGroup& operator=(const FTaskGroup&) = delete;
	void Run(std::function<void()> Task);
	void Wait();

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

size_t GetWorkerCount();

/// Starts the workers and makes the calling thread known to them. The first task of a thread does so otherwise, which takes
/// milliseconds on the main thread of a process. Any thread.
void StartWorkers();

} // namespace Lantern
