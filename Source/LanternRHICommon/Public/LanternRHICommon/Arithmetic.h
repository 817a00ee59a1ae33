// Arithmetic of offsets and sizes that implementations of the RHI need.
#pragma once

#include <cstdint>

namespace Lantern
{

/// Smallest multiple of Alignment that is at least Value. Alignment > 0 need not be a power of two.
constexpr uint64_t AlignUp(uint64_t Value, uint64_t Alignment) { return (Value + Alignment - 1) / Alignment * Alignment; }

/// Says whether Offset + Size lies within Whole, without overflow.
constexpr bool IsInside(uint64_t Offset, uint64_t Size, uint64_t Whole) { return Offset <= Whole && Size <= Whole - Offset; }

} // namespace Lantern
