// Bytes of an asset: files, the GLB container and data URIs, and the buffers and accessors that look into them. Sizes are checked in 64
// bits before anything is read.
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

/// Bytes of a buffer or an image. They are owned, or a view of bytes that live as long as the document.
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

/// The path of a file beside the asset. Absolute paths, other schemes and paths that leave the asset's folder are refused with a message.
/// If Folder is empty (an asset in memory), every path is refused.
std::filesystem::path ResolveUri(const FJson& Place, std::string_view Uri, const std::filesystem::path& Folder);

} // namespace Lantern::Gltf
