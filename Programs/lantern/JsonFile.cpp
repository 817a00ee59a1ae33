// Checks and writes the file that --json names.
#include "JsonFile.h"

#include "LanternImage/AtomicFile.h"
#include "Session.h"

namespace Lantern
{

namespace
{
int ToExit(const FRTStatus& Status) { return Status ? ExitDone : (ReportStatus(Status, "--json"), ExitBadInput); }
} // namespace

int CheckJsonFile(const std::string& File) { return File.empty() ? ExitDone : ToExit(CheckOutputPath(File)); }

int WriteJsonFile(const std::string& File, const std::string& Text)
{
	return File.empty() ? ExitDone : ToExit(WriteFileAtomically(File, Text));
}

} // namespace Lantern
