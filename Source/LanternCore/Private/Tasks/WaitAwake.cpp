// A wait that keeps its processor.
#include "LanternCore/Tasks/WaitAwake.h"

#include <chrono>

#if defined(__x86_64__) || defined(_M_X64)
#include <immintrin.h>
#endif

namespace Lantern
{

namespace
{
/// Lets the other hardware thread of the core go first for a moment.
void PauseProcessor()
{
#if defined(__x86_64__) || defined(_M_X64)
	_mm_pause();
#elif defined(__aarch64__)
	__asm__ volatile("yield");
#endif
}
} // namespace

bool WaitAwake(const std::function<bool()>& IsDone, double LimitMs)
{
	using FClock = std::chrono::steady_clock;
	constexpr int PausesBetween = 32; // about a microsecond, which is what a driver takes to answer
	const FClock::time_point Start = FClock::now();
	while (!IsDone())
	{
		if (std::chrono::duration<double, std::milli>(FClock::now() - Start).count() >= LimitMs) { return false; }
		for (int I = 0; I < PausesBetween; ++I) { PauseProcessor(); }
	}
	return true;
}

} // namespace Lantern
