// Everything that a port of the RHI is compiled with. Its debug information says how the compiler lays it out.
#include "LanternRHI/RTInterfaces.h"
