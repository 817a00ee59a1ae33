// The identity of this process, for names of temporary files that no other process uses.
#pragma once

namespace Lantern
{

int GetProcessId();

} // namespace Lantern
