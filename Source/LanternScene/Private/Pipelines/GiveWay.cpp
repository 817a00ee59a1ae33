// The priority of threads that compile, as the operating system knows it.
#include "Pipelines/GiveWay.h"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace Lantern
{

void GiveWayToFrames()
{
#ifdef __linux__
	// Linux gives each thread a nice value of its own.
	constexpr int Nice = 10;
	(void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), Nice);
#endif
}

} // namespace Lantern
