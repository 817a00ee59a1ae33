// The engine's thread for posted work.
#include "Example/ForkThread.h"

#include <utility>

namespace Fork
{

FForkThread::FForkThread() : Thread([this] { Run(); }) {}

FForkThread::~FForkThread()
{
	{
		std::lock_guard Lock(Mutex);
		bStop = true;
	}
	Wake.notify_one();
	Thread.join();
}

std::future<FError> FForkThread::Post(std::function<FError()> Work)
{
	std::packaged_task<FError()> Task(std::move(Work));
	std::future<FError> Result = Task.get_future();
	{
		std::lock_guard Lock(Mutex);
		Tasks.push_back(std::move(Task));
	}
	Wake.notify_one();
	return Result;
}

void FForkThread::Run()
{
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		Wake.wait(Lock, [this] { return bStop || !Tasks.empty(); });
		if (Tasks.empty()) { return; }
		std::packaged_task<FError()> Task = std::move(Tasks.front());
		Tasks.pop_front();
		Lock.unlock();
		Task();
		Lock.lock();
	}
}

} // namespace Fork
