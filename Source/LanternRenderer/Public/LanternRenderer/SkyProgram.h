// The sky as a program of the host (FRTScene::SetSkyProgram).
#pragma once

#include <string>

#include "LanternCore/Shaders/ShaderCompiler.h"

namespace Lantern
{

/// Returns the header by which a host's own file takes the place of Sky/SkyProgram.glsl, for FRendererDesc::ShaderHeaders. Path:
/// absolute, or relative to FRendererDesc::ShaderFolders, and none called Sky/SkyProgram.glsl. It defines
/// vec3 EvaluateSky(vec3 Direction, FSkyData Sky): nits, without the sun's disk. What is negative, not finite or above 1e30 counts as 0. A file
/// that does not compile is logged, and the sky is then as if there were no program.
FShaderHeader MakeSkyProgramHeader(const std::string& Path);

} // namespace Lantern
