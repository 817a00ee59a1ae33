// Files that appear whole or not at all.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Lets Write fill a temporary file beside Path, then renames it over Path. If anything fails, the temporary file is removed and Path
/// stays as it was. The status then names the reason and Path, never the temporary file. A symbolic link is followed. Write must close
/// what it opens.
FRTStatus WriteFileAtomically(const std::string& Path, const std::function<FRTStatus(const std::string& TemporaryPath)>& Write);

/// Writes Bytes in this way.
FRTStatus WriteFileAtomically(const std::string& Path, std::string_view Bytes);

/// Checks whether Path could be written now. Its folder must exist and be writable, and Path must not be a folder or a device. Long work
/// can fail before it starts; the write may still fail later.
FRTStatus CheckOutputPath(const std::string& Path);

/// "Path: Reason" on one line, with control characters escaped. The middle of an overlong path is left out, so that the reason fits.
FRTStatus MakeFileError(ERTResult Code, const std::string& Path, const std::string& Reason);

} // namespace Lantern
