// A thread of the engine that does what others post, in order.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

#include "Example/ForkError.h"

namespace Fork
{

class FForkThread
{
public:
	FForkThread();
	~FForkThread(); ///< does all that was posted first
	FForkThread(const FForkThread&) = delete;
	/// The result is there once Work has run.
	std::future<FError> Post(std::function<FError()> Work);

private:
	void Run();

	std::mutex Mutex; ///< of the next two
	std::deque<std::packaged_task<FError()>> Tasks;
	bool bStop = false;
	std::condition_variable Wake;
	std::thread Thread;
};

} // namespace Fork
