// Properties of accesses for the frame graph: whether they write, their texture layout, and the usage that they need.
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

/// A write excludes all other accesses, except reads combined with StorageWrite (see ERTAccess).
constexpr bool CanCombine(ERTAccess Access)
{
	const ERTAccess Rest = Without(Access, ERTAccess::ShaderRead | ERTAccess::StorageRead);
	return !IsWrite(Access) || Rest == ERTAccess::StorageWrite || (IsSingle(Access) && IsSingle(Rest));
}

/// Two accesses of a texture share a layout if and only if their classes are equal. Storage accesses and mixed reads need the
/// general layout; every other access has its own.
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

/// Returns "ShaderRead|CopyRead".
std::string ToString(ERTAccess Access);
const char* ToString(ERTFormat Format);

} // namespace Lantern
