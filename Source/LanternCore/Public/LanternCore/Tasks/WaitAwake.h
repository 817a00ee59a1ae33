// A wait that keeps its processor.
#pragma once

#include <functional>

namespace Lantern
{

/// Asks IsDone again and again, without sleep, for at most LimitMs milliseconds. Asks once at least. Returns what it answered
/// last. A thread that sleeps while others keep every core busy gets a core back as late as the next timer tick, 4 ms on many
/// kernels; this one does not give its core away. The caller falls back to a wait that sleeps.
/// Threads: any.
bool WaitAwake(const std::function<bool()>& IsDone, double LimitMs);

} // namespace Lantern
