// Files of the plugin that a host may replace by its own.
#pragma once

#include <string>

#include "LanternCore/Shaders/ShaderCompiler.h"

namespace Lantern
{

/// Returns the header by which includes of Replaced, relative to the shader folders, get the file at Path.
inline FShaderHeader MakeShaderReplacement(const char* Replaced, const std::string& Path)
{
	return {Replaced, "#include \"" + Path + "\"\n", Replaced};
}

} // namespace Lantern
