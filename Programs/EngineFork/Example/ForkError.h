// Errors of the example engine, and text that is safe to print.
#pragma once

#include <string>

#include "LanternRHI/RTStatus.h"
#include "LanternRHI/RTText.h"

namespace Fork
{

/// Says in words what the engine could not do. Empty means success.
using FError = std::string;

/// Empty if Status is Ok, otherwise What and the message of Status.
inline FError ToError(const Lantern::FRTStatus& Status, const char* What)
{
	return Status.IsOk() ? FError() : FError(What) + ": " + Status.Message;
}

/// Text for a terminal. Files, drivers and the command line may put any bytes into Text; those that cannot be shown are escaped.
inline std::string Show(const std::string& Text)
{
	std::string Out;
	Lantern::ShowText(
	    Text.data(), Text.size(), Lantern::ERTTextKind::Lines, [&](const char* Bytes, size_t Count) { Out.append(Bytes, Count); });
	return Out;
}

} // namespace Fork
