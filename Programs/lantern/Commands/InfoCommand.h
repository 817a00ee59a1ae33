// lantern info, lantern cvars, lantern render --list
#pragma once

#include <string>

#include "Options.h"

namespace Lantern
{

int RunInfo(const std::string& Json);
/// Values and who set them, as the settings leave them.
int RunCvars(const FDeviceOptions& Settings, bool bMarkdown, const std::string& Json);
int RunListScenes();

} // namespace Lantern
