// FTableLayout: strides, regions and growth of a shader binding table.
#include "LanternRHICommon/TableLayout.h"

#include "LanternRHICommon/Arithmetic.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

FRecordCounts GetRecordCounts(const FRTShaderTableDesc& Desc)
{
	return {Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount};
}

void SetRecordCounts(FRTShaderTableDesc& Desc, const FRecordCounts& Counts)
{
	Desc.RayGenCount = Counts[static_cast<uint32_t>(ERTRecordKind::RayGen)];
	Desc.MissCount = Counts[static_cast<uint32_t>(ERTRecordKind::Miss)];
	Desc.HitCount = Counts[static_cast<uint32_t>(ERTRecordKind::Hit)];
	Desc.CallableCount = Counts[static_cast<uint32_t>(ERTRecordKind::Callable)];
}

FRecordCounts GrowRecordCounts(const FRecordCounts& Has, const uint32_t Wanted[RecordKindCount])
{
	FRecordCounts Grown = Has;
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind) { Grown[Kind] = std::max(Grown[Kind], Wanted[Kind]); }
	return Grown;
}

FTableLayout::FTableLayout(const FRTCapabilities& Capabilities, const FRTShaderTableDesc& Desc)
    : BaseAlignment(Capabilities.ShaderGroupBaseAlignment)
{
	assert(Desc.RecordDataBytes <= MaxRecordDataBytes);
	const uint64_t HandleSize = Capabilities.ShaderGroupHandleSize, HandleAlignment = Capabilities.ShaderGroupHandleAlignment;
	const uint64_t Plain = AlignUp(HandleSize, HandleAlignment);
	Strides = {AlignUp(HandleSize, std::max(BaseAlignment, HandleAlignment)), Plain,
	    AlignUp(HandleSize + Desc.RecordDataBytes, HandleAlignment), Plain};
	SetCounts(GetRecordCounts(Desc));
}

void FTableLayout::SetCounts(const FRecordCounts& InCounts)
{
	Counts = InCounts;
	Size = 0;
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		Offsets[Kind] = AlignUp(Size, BaseAlignment);
		Size = Offsets[Kind] + GetRegionBytes(Kind);
	}
}

} // namespace Lantern
