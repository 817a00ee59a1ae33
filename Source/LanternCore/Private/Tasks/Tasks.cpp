// Parallel loops and task groups over oneTBB.
#include "LanternCore/Tasks/Tasks.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

// The packaged libtbb is not built for the thread sanitizer. The sanitizer therefore does not see the memory order of starting
// and awaiting a task, nor the synchronisation of TBB's templates. Its build (LANTERN_TSAN, see CMakeLists.txt) does not
// instrument this file. Two marks then tell it the order of tasks, so that it still finds races between the bodies of tasks.
// In other builds the marks do nothing.
#ifdef LANTERN_TSAN
#include <sanitizer/tsan_interface.h>
#define LANTERN_MARK_ACQUIRE(Address) __tsan_acquire(const_cast<void*>(static_cast<const void*>(Address)))
#define LANTERN_MARK_RELEASE(Address) __tsan_release(const_cast<void*>(static_cast<const void*>(Address)))
#else
#define LANTERN_MARK_ACQUIRE(Address) ((void)(Address))
#define LANTERN_MARK_RELEASE(Address) ((void)(Address))
#endif

namespace Lantern
{

void ParallelFor(size_t Count, size_t Grain, const std::function<void(size_t, size_t)>& Body)
{
	if (Count == 0) return;
	Grain = std::max<size_t>(Grain, 1);
	if (Count / 2 < Grain)
	{
		Body(0, Count);
		return;
	}
	// A range is halved while it is longer than the limit, so that no half is shorter than Grain. An exception of a body is a
	// bug and ends the program where it is thrown.
	const tbb::blocked_range<size_t> Range(0, Count, 2 * Grain - 1);
	[[maybe_unused]] const char Fork = 0;
	LANTERN_MARK_RELEASE(&Fork);
	tbb::parallel_for(Range, [&](const tbb::blocked_range<size_t>& Chunk) noexcept {
		LANTERN_MARK_ACQUIRE(&Fork);
		Body(Chunk.begin(), Chunk.end());
		LANTERN_MARK_RELEASE(&Fork);
	});
	LANTERN_MARK_ACQUIRE(&Fork);
}

struct FTaskGroup::FImpl
{
	tbb::task_group Group;
};

FTaskGroup::FTaskGroup() : Impl(std::make_unique<FImpl>()) {}

FTaskGroup::~FTaskGroup() { Wait(); }

void FTaskGroup::Run(std::function<void()> Task)
{
	const FImpl* Order = Impl.get();
	// TBB may run a copy: one shared body serves callables that are costly to copy.
	auto Shared = std::make_shared<std::function<void()>>(std::move(Task));
	LANTERN_MARK_RELEASE(Order);
	Impl->Group.run([Order, Shared = std::move(Shared)]() noexcept // nothing of it is left behind for this thread to destroy
	    {
		LANTERN_MARK_ACQUIRE(Order);
		(*Shared)();
		*Shared = nullptr;
		LANTERN_MARK_RELEASE(Order);
	});
}

void FTaskGroup::Wait()
{
	Impl->Group.wait();
	LANTERN_MARK_ACQUIRE(Impl.get());
}

size_t GetWorkerCount() { return static_cast<size_t>(std::max(1, tbb::this_task_arena::max_concurrency())); }

void StartWorkers()
{
	FTaskGroup Tasks;
	for (size_t Worker = GetWorkerCount(); Worker > 0; --Worker)
	{
		Tasks.Run([] {});
	}
}

} // namespace Lantern
