// lantern info, lantern cvars, lantern render --list
#pragma once

#include <string>

namespace Lantern
{

int RunInfo(const std::string& Json);
int RunCvars(bool bMarkdown, const std::string& Json);
int RunListScenes();

} // namespace Lantern
