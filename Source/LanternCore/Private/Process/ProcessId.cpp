// The id of this process, from the operating system.
#include "Process/ProcessId.h"

#if defined(_WIN32)
#include <process.h>
#else
#include <unistd.h>
#endif

namespace Lantern
{

int GetProcessId()
{
#if defined(_WIN32)
	return _getpid();
#else
	return static_cast<int>(getpid());
#endif
}

} // namespace Lantern
