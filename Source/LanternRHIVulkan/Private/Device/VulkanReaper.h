// Destroys what a driver takes long to destroy.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace Lantern
{

/// An object that nobody holds, and how to delete it.
struct FVulkanGarbage
{
	void* Object = nullptr;
	void (*Delete)(void*) = nullptr;
	bool bSlow = false; ///< its destruction may take a driver milliseconds
};

/// Deletes objects on a thread of its own, which starts with the first one. A frame that submits must not destroy pipelines.
/// Threads: any. Drain and the destructor are not for deletions.
class FVulkanReaper
{
public:
	FVulkanReaper() = default;
	~FVulkanReaper();
	FVulkanReaper(const FVulkanReaper&) = delete;
	FVulkanReaper& operator=(const FVulkanReaper&) = delete;

	void Add(const FVulkanGarbage& Item);
	/// Waits until all that was added is deleted.
	void Drain();

private:
	void Run();

	std::mutex Mutex;
	std::condition_variable Added, Idle;
	std::vector<FVulkanGarbage> Items; ///< guarded by Mutex
	bool bBusy = false;                ///< guarded by Mutex
	bool bStop = false;                ///< guarded by Mutex
	std::thread Thread;                ///< guarded by Mutex until bStop
};

} // namespace Lantern
