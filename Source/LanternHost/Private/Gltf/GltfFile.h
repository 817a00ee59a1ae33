// Bytes: files, the GLB container, data URIs, and the buffers and accessors that look into them. Everything is checked
// in 64 bits before it is read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Gltf/GltfJson.h"

namespace Lantern::Gltf
{

using FBytes = std::span<const uint8_t>;

/// Reads a regular file. Throws FError without a place ("is a directory").
std::vector<uint8_t> ReadFile(const std::filesystem::path& Path, uint64_t MaxBytes);

bool IsGlb(FBytes Data);
struct FGlb
{
	std::string_view Json;
	FBytes Binary; ///< empty where there is none
};
FGlb SplitGlb(FBytes Data);

/// A buffer's or image's bytes: owned, or a view of what lives as long as the document.
struct FBlob
{
	FBlob() = default;
	FBlob(FBlob&&) noexcept = default; // a copy's Bytes would look into the original
	FBlob& operator=(FBlob&&) noexcept = default;

	std::vector<uint8_t> Owned;
	FBytes Bytes;

	void Own(std::vector<uint8_t>&& Data)
	{
		Owned = std::move(Data);
		Bytes = Owned;
	}
};

bool IsDataUri(std::string_view Uri);
std::vector<uint8_t> DecodeDataUri(const FJson& Place, std::string_view Uri);

/// The path of a file beside the asset. Refused with a message: absolute paths, other schemes, paths that leave the
/// asset's folder; and everything if Folder is empty (an asset in memory).
std::filesystem::path ResolveUri(const FJson& Place, std::string_view Uri, const std::filesystem::path& Folder);

} // namespace Lantern::Gltf
