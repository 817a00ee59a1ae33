// What is logged when units or links fail.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// True: out of memory or descriptors, which may pass; false: success, or an error that stays.
bool IsShortage(const FRTStatus& Status);

/// Logs each failure once.
/// Threads: the caller holds the lock of the RTPSO compiler.
class FRTPSOFailureLog
{
public:
	/// Name and Version: of the unit. bHasOlder: an older version is compiled, and stays in use.
	void ReportUnit(const std::string& Name, uint64_t Version, bool bHasOlder, const FRTStatus& Status);
	void ReportLink(const FRTStatus& Status);

private:
	std::set<std::string> Reported;
};

} // namespace Lantern
