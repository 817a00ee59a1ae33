// FRangeBindings: from a range of sections to what all instances of the range share.
#include "Scene/RangeBindings.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

void FRangeBindings::SetRayTypes(uint32_t Count) { bBindAll |= std::exchange(RayTypes, Count) != Count; }

void FRangeBindings::SetMissingPrograms(std::vector<FHitProgram> Programs)
{
	std::sort(Programs.begin(), Programs.end());
	if (Programs == MissingPrograms) { return; }
	MissingPrograms = std::move(Programs);
	bBindAll = true;
}

bool FRangeBindings::IsProgramMissing(const FSectionTable& Sections, const FSectionRange& Range) const
{
	if (MissingPrograms.empty()) { return false; }
	for (size_t Part = 0; Part < Range.Geometry->GetParts().size(); ++Part)
	{
		const FHitProgram Program = Sections.GetHitProgram(Range.First + static_cast<uint32_t>(Part));
		if (std::binary_search(MissingPrograms.begin(), MissingPrograms.end(), Program)) { return true; }
	}
	return false;
}

FInstanceBinding FRangeBindings::Make(const FSectionTable& Sections, const FSectionRange& Range, const FGeometryStore& Geometries) const
{
	// A binding without a geometry slot: shaders are missing, and building the geometry sooner would not help.
	if (!Range.Geometry || IsProgramMissing(Sections, Range)) { return {}; }
	// Rays that look for glass cull what is opaque.
	const uint32_t Opacity = Range.bOpaqueGlass ? InstanceForceNoOpaque : Range.bMasked || Range.bTransmissive ? 0u : InstanceForceOpaque;
	// Facing can be switched off for instances, not for sections: mixed objects are culled.
	const uint32_t Flags = Opacity | (Range.bDoubleSided ? InstanceCullDisable : 0u);
	FInstanceBinding Binding;
	Binding.TableOffsetAndFlags = ((Range.First * RayTypes) & 0xffffffu) | (Flags << 24);
	if (!Range.bTransmissive) { Binding.MaskBits &= ~(uint32_t(MASK_TRANSMISSIVE) << 24); }
	Binding.GeometrySlot = Range.Geometry->GetSlot();
	Binding.GeometryAddress = Geometries.GetAddress(Binding.GeometrySlot);
	return Binding;
}

bool FRangeBindings::Update(FSectionTable& Sections, const FGeometryStore& Geometries, FInstanceStore& Instances)
{
	bool bOthersSeen = false;
	const auto Bind = [&](FSectionRangeId Id) {
		bOthersSeen |= Instances.SetBinding(Id, Make(Sections, Sections.GetRange(Id), Geometries));
	};
	const std::vector<FSectionRangeId> Changed = Sections.TakeChangedRanges();
	if (std::exchange(bBindAll, false))
	{
		for (FSectionRangeId Id = 0; Id < Sections.GetRangeCapacity(); ++Id) { Bind(Id); }
		return bOthersSeen;
	}
	for (const FSectionRangeId Id : Changed) { Bind(Id); }
	return bOthersSeen;
}

FRTStatus FRangeBindings::CheckLimits(const FSectionTable& Sections) const
{
	if (uint64_t(Sections.GetCapacity()) * RayTypes <= MaxInstanceIndex) { return FRTStatus::Success(); }
	return FRTStatus::Error(ERTResult::Unsupported, "the scene has %u sections; %u ray types allow %u", Sections.GetCapacity(), RayTypes,
	    MaxInstanceIndex / RayTypes);
}

} // namespace Lantern
