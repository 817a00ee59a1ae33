// The file that --json names.
#pragma once

#include <string>

namespace Lantern
{

/// Checks before any work whether File can be written. An empty File is fine. Returns an exit status, after logging an error.
int CheckJsonFile(const std::string& File);

/// Writes Text, unless File is empty. Returns an exit status, after logging an error.
int WriteJsonFile(const std::string& File, const std::string& Text);

} // namespace Lantern
