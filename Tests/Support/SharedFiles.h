// Files that tests read but the project does not hold. Where they are missing, the test is skipped.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "Support/TemporaryFolder.h"

namespace Lantern
{

/// LANTERN_SHARED, or the folder `shared` beside the project.
inline std::filesystem::path GetSharedFolder()
{
	const char* Folder = std::getenv("LANTERN_SHARED");
	return Folder ? std::filesystem::path(Folder) : std::filesystem::path(LANTERN_SOURCE_DIR).parent_path() / "shared";
}

} // namespace Lantern
