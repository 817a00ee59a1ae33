// What an access means to the frame graph: does it write, which layout does it ask of a texture, which usage of
// a resource.
#pragma once

#include <string>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

constexpr ERTAccess WriteAccesses =
    ERTAccess::StorageWrite | ERTAccess::RenderTarget | ERTAccess::DepthWrite | ERTAccess::CopyWrite | ERTAccess::BuildWrite;

constexpr bool IsWrite(ERTAccess Access) { return HasAny(Access, WriteAccesses); }
constexpr ERTAccess Without(ERTAccess Access, ERTAccess Bits)
{
	return static_cast<ERTAccess>(static_cast<uint32_t>(Access) & ~static_cast<uint32_t>(Bits));
}
constexpr bool Contains(ERTAccess Access, ERTAccess Bits) { return (Access & Bits) == Bits; }
constexpr bool IsSingle(ERTAccess Access)
{
	const uint32_t Bits = static_cast<uint32_t>(Access);
	return Bits != 0 && (Bits & (Bits - 1)) == 0;
}

/// A write stands alone, but for reading what StorageWrite writes (see ERTAccess).
constexpr bool CanCombine(ERTAccess Access)
{
	const ERTAccess Rest = Without(Access, ERTAccess::ShaderRead | ERTAccess::StorageRead);
	return !IsWrite(Access) || Rest == ERTAccess::StorageWrite || (IsSingle(Access) && IsSingle(Rest));
}

/// Two accesses of a texture share a layout if and only if this is equal: storage and mixed reads need the general
/// one, every other access has its own.
constexpr ERTAccess GetLayoutClass(ERTAccess Access)
{
	const bool bGeneral = HasAny(Access, ERTAccess::StorageRead | ERTAccess::StorageWrite) || !IsSingle(Access);
	return Access != ERTAccess::None && bGeneral ? ERTAccess::StorageRead : Access;
}

ERTTextureUsage GetTextureUsage(ERTAccess Access);
ERTBufferUsage GetBufferUsage(ERTAccess Access);

/// Accesses that a texture cannot have.
constexpr ERTAccess BufferOnlyAccesses = ERTAccess::IndexRead | ERTAccess::IndirectRead | ERTAccess::GeometryInput | ERTAccess::BuildRead |
                                         ERTAccess::BuildWrite | ERTAccess::TraceRead | ERTAccess::HostRead;
constexpr ERTAccess TextureOnlyAccesses = ERTAccess::RenderTarget | ERTAccess::DepthWrite;

/// "ShaderRead|CopyRead".
std::string ToString(ERTAccess Access);
const char* ToString(ERTFormat Format);

} // namespace Lantern
