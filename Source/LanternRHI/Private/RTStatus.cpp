// FRTStatus: formats and cuts messages.
#include "LanternRHI/RTStatus.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "LanternRHI/RTText.h"

namespace Lantern
{

FRTStatus FRTStatus::Error(ERTResult InCode, const char* Format, ...)
{
	FRTStatus Status;
	Status.Code = InCode;
	// Room for a character that begins where the message is full: half of it would count as broken.
	char Raw[sizeof(Status.Message) + 4] = {};
	va_list Args;
	va_start(Args, Format);
	std::vsnprintf(Raw, sizeof(Raw), Format, Args);
	va_end(Args);
	ShowText(Status.Message, sizeof(Status.Message), Raw, std::strlen(Raw), ERTTextKind::Lines, "...");
	return Status;
}

} // namespace Lantern
