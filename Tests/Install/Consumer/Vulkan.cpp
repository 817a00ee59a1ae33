// Compiles the part of the interface that an engine with a VkDevice of its own includes.
#include "LanternModule/ModuleVulkan.h"
