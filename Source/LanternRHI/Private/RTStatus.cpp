#include "LanternRHI/RTStatus.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace Lantern
{

FRTStatus FRTStatus::Error(ERTResult InCode, const char* Format, ...)
{
	FRTStatus Status;
	Status.Code = InCode;
	va_list Args;
	va_start(Args, Format);
	const int Length = std::vsnprintf(Status.Message, sizeof(Status.Message), Format, Args);
	va_end(Args);
	if (Length >= static_cast<int>(sizeof(Status.Message)))
	{
		std::memcpy(Status.Message + sizeof(Status.Message) - 4, "...", 4);
	}
	return Status;
}

} // namespace Lantern
