// The identity of this process, for names of temporary files that no other process uses.
#pragma once

namespace Lantern
{

int GetProcessId();
/// Whether a process of this machine has the id now. True where the system does not say.
bool IsProcessAlive(int Id);

} // namespace Lantern
