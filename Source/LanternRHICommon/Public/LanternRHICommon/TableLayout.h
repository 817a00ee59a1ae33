// Where the records of a shader binding table stand, and how a table grows.
#pragma once

#include "LanternRHI/RTTypes.h"

#include <array>

namespace Lantern
{

inline constexpr uint32_t RecordKindCount = 4;

/// Numbers of records, in the order of ERTRecordKind.
using FRecordCounts = std::array<uint32_t, RecordKindCount>;

FRecordCounts GetRecordCounts(const FRTShaderTableDesc& Desc);
void SetRecordCounts(FRTShaderTableDesc& Desc, const FRecordCounts& Counts);
/// What IRTShaderTable::Reserve grows a table of Has records to: no kind shrinks. Equal to Has if nothing grows.
FRecordCounts GrowRecordCounts(const FRecordCounts& Has, const uint32_t Wanted[RecordKindCount]);

/// Regions of one table, one behind the other in the order of ERTRecordKind. All sizes and offsets are in bytes.
struct FTableLayout
{
	FTableLayout() = default;
	/// Strides are multiples of the handle alignment, regions start at multiples of the base alignment. So does each ray
	/// generation record, since a dispatch names one of them as a region of its own.
	FTableLayout(const FRTCapabilities& Capabilities, const FRTShaderTableDesc& Desc);

	/// Arranges the regions for other numbers of records; strides stay.
	void SetCounts(const FRecordCounts& InCounts);
	/// Kind: an ERTRecordKind.
	uint64_t GetOffset(uint32_t Kind, uint32_t Index) const { return Offsets[Kind] + Strides[Kind] * Index; }
	uint64_t GetRegionBytes(uint32_t Kind) const { return Strides[Kind] * Counts[Kind]; }

	FRecordCounts Counts = {};
	std::array<uint64_t, RecordKindCount> Strides = {};
	std::array<uint64_t, RecordKindCount> Offsets = {};
	uint64_t Size = 0; ///< 0 for a table without records
	uint64_t BaseAlignment = 1;
};

} // namespace Lantern
