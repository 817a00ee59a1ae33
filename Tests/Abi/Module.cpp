// Everything that an engine is compiled with. Its debug information says how the compiler lays it out.
#include "LanternModule/ModuleVulkan.h"
