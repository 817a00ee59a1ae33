// Rows of ModuleCalls.cpp for meshes in the engine's buffers, landscapes, levels of detail and the sky's map.
#pragma once

#include "ModulePlay.h"

namespace Lantern
{

FRTStatus AddStreamedMesh(FModulePlay& Play);
FRTStatus AddLandscape(FModulePlay& Play);
FRTStatus SetLandscapeHeights(FModulePlay& Play);
FRTStatus SetObjectMesh(FModulePlay& Play);
FRTStatus SetSkyMap(FModulePlay& Play);
FRTStatus SetSkyProgram(FModulePlay& Play);

} // namespace Lantern
