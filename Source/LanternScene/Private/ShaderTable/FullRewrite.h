// The baseline of the shader table: every hit record is written anew, whatever changed. `lantern bench sbt` measures
// against it; r.RT.SBT.Mode=0 selects it.
#pragma once

#include <cstdint>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

class FRTPSO;
class FSectionTable;

/// Writes the records of every range of Sections, one by one, and returns their number. Table has room for all of them.
uint32_t RewriteHitRecords(IRTShaderTable& Table, const FRTPSO& Pipeline, const FSectionTable& Sections);

} // namespace Lantern
