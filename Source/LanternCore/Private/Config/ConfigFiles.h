// Shared by the loaders of the Config folder's files.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "LanternCore/Config/Config.h"
#include "LanternCore/Config/IniFile.h"

namespace Lantern
{

/// Logs a warning and keeps it.
void Report(FConfigProblems& Problems, std::string Text);
/// Loads a file and reports its problems.
FIniFile LoadIni(const std::string& Path, FConfigProblems& Problems);
void SetVariables(const std::vector<FIniValue>& Values, ERTSetBy By, FConfigProblems& Problems);
std::vector<FIniValue> ResolveSection(const FIniFile& File, const FIniSection& Section);

/// Whether this is the key of a device profile's variables, "CVars".
bool IsProfileVariableKey(std::string_view Key);
/// Splits "name=value" into two trimmed parts; without '=' the second is empty.
std::pair<std::string, std::string> SplitAssignment(std::string_view Text);

} // namespace Lantern
