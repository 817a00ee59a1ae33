// Log lines about shaders that do not compile, each once.
#include "Pipelines/RTPSOFailureLog.h"

#include <string_view>

#include "LanternCore/Text/Log.h"

namespace Lantern
{

bool IsShortage(const FRTStatus& Status)
{
	return Status.Code == ERTResult::OutOfDeviceMemory || Status.Code == ERTResult::OutOfHostMemory ||
	       Status.Code == ERTResult::OutOfDescriptors;
}

void FRTPSOFailureLog::ReportUnit(const std::string& Name, uint64_t Version, bool bHasOlder, const FRTStatus& Status)
{
	// Several units are made from one text. Their messages differ only behind the first line.
	constexpr size_t MostReported = 1000;
	if (Reported.size() > MostReported) { Reported.clear(); }
	const std::string_view Text = Status.Message;
	if (!Reported.insert(std::to_string(Version) + std::string(Text.substr(0, Text.find('\n')))).second) { return; }
	LogError("{} does not compile{}:\n{}", Name, bHasOlder ? "; the version before stays" : "", Status.Message);
}

void FRTPSOFailureLog::ReportLink(const FRTStatus& Status)
{
	if (Reported.insert(Status.Message).second) { LogError("RTPSO: the link fails; the one before stays: {}", Status.Message); }
}

} // namespace Lantern
