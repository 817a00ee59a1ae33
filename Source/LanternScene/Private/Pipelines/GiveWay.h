// The priority of threads that compile.
#pragma once

namespace Lantern
{

/// Lets frames go before the calling thread on a machine with fewer cores than threads.
void GiveWayToFrames();

} // namespace Lantern
