// The id of this process, from the operating system.
#include "Process/ProcessId.h"

#if defined(_WIN32)
#include <process.h>
#else
#include <cerrno>
#include <csignal>

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

bool IsProcessAlive(int Id)
{
#if defined(_WIN32)
	(void)Id;
	return true;
#else
	return Id > 0 && (kill(Id, 0) == 0 || errno != ESRCH);
#endif
}

} // namespace Lantern
