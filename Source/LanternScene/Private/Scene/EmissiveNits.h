// What FMaterialData::EmissiveWeight is in nits: hosts divide by this, so that bright lights stay in the range of fp16.
#pragma once

namespace Lantern
{

constexpr double NitsPerEmissiveWeight = 64.0;

} // namespace Lantern
