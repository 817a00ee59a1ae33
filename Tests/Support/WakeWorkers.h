// For tests in which the calling thread waits until a worker has begun a task.
#pragma once

#include "LanternCore/Tasks/Tasks.h"
#include "Support/WaitTools.h"

namespace Lantern
{

/// A step of WaitUntil that gives the workers another task. TBB leaves out the memory fence that would show each new task to a
/// worker about to sleep: it promises progress and no parallelism. A thread that waits for a worker, and takes no task itself,
/// could wait for ever. The destructor waits for the tasks, and may run others meanwhile.
class FWakeWorkers
{
public:
	void operator()()
	{
		Group.Run([] {});
		GiveWay();
	}

private:
	FTaskGroup Group;
};

} // namespace Lantern
