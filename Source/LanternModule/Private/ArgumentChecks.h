// What an engine hands over, checked before anything is done with it. Each: Ok, or InvalidArgument saying what is wrong.
#pragma once

#include "LanternModule/Module.h"

namespace Lantern
{

FRTStatus CheckFrame(const FRTModuleFrame& Frame);
FRTStatus CheckSun(const FRTModuleSun& Sun);
FRTStatus CheckTransform(const double Transform[12]);
FRTStatus CheckMaterial(const FRTModuleMaterial& Material);

} // namespace Lantern
