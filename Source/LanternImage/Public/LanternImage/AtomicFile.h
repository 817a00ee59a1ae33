// Files that appear whole or not at all.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Lets Write fill a temporary file beside Path, then renames it over Path. If anything fails, the temporary file
/// is removed, Path stays as it was, and the status names Path (never the temporary) and the reason. A symbolic
/// link is followed. Write must close what it opens.
FRTStatus WriteFileAtomically(const std::string& Path, const std::function<FRTStatus(const std::string& TemporaryPath)>& Write);

/// The same for bytes at hand.
FRTStatus WriteFileAtomically(const std::string& Path, std::string_view Bytes);

/// Whether Path could be written now: its folder exists and may be written to, and it is not itself a folder or a
/// device. Lets long work fail before it starts; the write may still fail later.
FRTStatus CheckOutputPath(const std::string& Path);

/// "Path: Reason" on one line, both escaped, with the middle of an overlong path left out in favour of the reason.
FRTStatus MakeFileError(ERTResult Code, const std::string& Path, const std::string& Reason);

} // namespace Lantern
