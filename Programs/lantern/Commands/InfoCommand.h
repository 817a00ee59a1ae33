// lantern info, lantern cvars and lantern render --list.
#pragma once

#include <string>

#include "Options.h"

namespace Lantern
{

int RunInfo(const std::string& Json);
/// Prints console variables as the settings leave them, and who set each.
int RunCvars(const FDeviceOptions& Settings, bool bMarkdown, const std::string& Json);
int RunListScenes();

} // namespace Lantern
