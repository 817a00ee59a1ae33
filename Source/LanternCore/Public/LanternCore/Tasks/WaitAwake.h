// A wait that keeps its processor.
#pragma once

#include <functional>

namespace Lantern
{

/// Asks IsDone again and again, without sleep, for at most LimitMs milliseconds. Asks once at least. Returns what it answered
/// last. The caller falls back to a wait that sleeps. If others keep every core busy, a thread that sleeps gets a core back as
/// late as the next timer tick. A tick takes 4 ms on many kernels. This one does not give its core away.
/// Threads: any.
bool WaitAwake(const std::function<bool()>& IsDone, double LimitMs);

} // namespace Lantern
