// Random regions for copies between two buffers, and on the CPU what such a copy does.
#pragma once

#include "LanternRHI/RTInterfaces.h"

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

namespace Lantern
{

inline std::vector<uint8_t> MakeRandomBytes(uint32_t Seed, uint64_t Count)
{
	std::mt19937 Random(Seed);
	std::vector<uint8_t> Bytes(Count);
	for (uint8_t& Byte : Bytes) { Byte = static_cast<uint8_t>(Random() >> 24); }
	return Bytes;
}

/// Regions in random order that do not overlap in the destination. Sources are random, and may overlap. Everything is a multiple
/// of 4 bytes, but for those of AddUnaligned.
class FRandomRegions
{
public:
	FRandomRegions(uint32_t Seed, uint64_t InSourceBytes) : Random(Seed), SourceBytes(InSourceBytes) {}
	/// Adds Count regions, most of them small.
	void AddSmall(uint32_t Count)
	{
		static constexpr uint32_t Most[] = {16, 16, 16, 16, 16, 16, 256, 256, 256, 2048}; // words
		for (uint32_t I = 0; I < Count; ++I) { Add(4 * (1 + Random() % Most[Random() % std::size(Most)])); }
	}
	void Add(uint64_t Bytes)
	{
		DestBytes = (DestBytes + 3) / 4 * 4 + 4 * (Random() % 5);
		Items.push_back({DestBytes, Random() % ((SourceBytes - Bytes) / 4 + 1) * 4, Bytes});
		DestBytes += Bytes;
	}
	/// Adds Count regions with an offset or a size that is no multiple of 4.
	void AddUnaligned(uint32_t Count)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			Add(4 * (1 + Random() % 16));
			FRTBufferRegion& Region = Items.back();
			(I % 3 == 0 ? Region.DestOffset : I % 3 == 1 ? Region.SourceOffset : Region.Size) += 1 + Random() % 3;
			Region.SourceOffset = std::min(Region.SourceOffset, SourceBytes - Region.Size);
			DestBytes += 3;
		}
	}
	/// Shuffles what was added.
	const std::vector<FRTBufferRegion>& Finish()
	{
		for (size_t I = Items.size(); I > 1; --I) { std::swap(Items[I - 1], Items[Random() % I]); }
		return Items;
	}
	const std::vector<FRTBufferRegion>& Get() const { return Items; }
	uint32_t Num() const { return static_cast<uint32_t>(Items.size()); }
	uint64_t GetDestBytes() const { return DestBytes; }
	void Apply(std::vector<uint8_t>& Dest, const std::vector<uint8_t>& Source) const
	{
		for (const FRTBufferRegion& Item : Items)
		{
			std::memcpy(Dest.data() + Item.DestOffset, Source.data() + Item.SourceOffset, Item.Size);
		}
	}

private:
	std::mt19937 Random;
	uint64_t SourceBytes;
	uint64_t DestBytes = 0;
	std::vector<FRTBufferRegion> Items;
};

} // namespace Lantern
