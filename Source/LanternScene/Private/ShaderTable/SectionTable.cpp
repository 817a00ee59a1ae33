// FSectionTable: ranges are found by a hash table, and filled from geometry and materials.
#include "LanternScene/ShaderTable/SectionTable.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <utility>

#include "LanternScene/Opacity/OpacityClassifier.h"
#include "Opacity/OpacityUse.h"
#include "Scene/EmissiveNits.h"
#include "ShaderTable/SectionData.h"

namespace Lantern
{

namespace
{
constexpr size_t FewestBuckets = 64;
std::atomic<uint64_t> NewestIdentity = 0;

uint64_t Mix(uint64_t Value)
{
	// The finalizer of Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
	Value = (Value ^ (Value >> 30)) * 0xbf58476d1ce4e5b9ull;
	Value = (Value ^ (Value >> 27)) * 0x94d049bb133111ebull;
	return Value ^ (Value >> 31);
}

uint64_t HashRange(const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials)
{
	uint64_t Hash = Mix(reinterpret_cast<uintptr_t>(&Geometry));
	for (const uint32_t Material : Materials) { Hash = Mix(Hash + Material + 0x9e3779b97f4a7c15ull); }
	return Hash;
}
} // namespace

FSectionTable::FSectionTable(const FSectionContext& InContext) : Context(InContext), Identity(++NewestIdentity) {}

FSectionRangeId FSectionTable::Acquire(const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials)
{
	assert(Materials.size() == Geometry.GetSectionCount());
	const uint64_t Hash = HashRange(Geometry, Materials);
	if (const FSectionRangeId Found = Find(Hash, Geometry, Materials); Found != None)
	{
		++Ranges[Found].References;
		return Found;
	}
	const FSectionRangeId Id = AddRange();
	FSectionRange& Range = Ranges[Id];
	Range.Geometry = &Geometry;
	Range.Materials = Materials;
	Range.Count = Geometry.GetPartCapacity();
	Range.First = Allocator.Allocate(Range.Count);
	Range.References = 1;
	if (Allocator.GetCapacity() > Table.Num())
	{
		Table.Set(Allocator.GetCapacity() - 1, FSectionData{});
		HitPrograms.Resize(Table.Num());
	}
	Links[Id].Hash = Hash;
	LinkHash(Id);
	LinkUses(Id);
	FillRange(Id);
	MarkRange(Id);
	return Id;
}

void FSectionTable::Release(FSectionRangeId Id)
{
	FSectionRange& Range = Ranges[Id];
	assert(Range.References > 0);
	if (--Range.References > 0) { return; }
	UnlinkUses(Id);
	UnlinkHash(Id);
	SetFlags(Id, {});
	for (uint32_t Part = 0; Part < Range.Count; ++Part) { HitPrograms.Clear(Range.First + Part); }
	Allocator.Free(Range.First, Range.Count);
	Range.Geometry = nullptr;
	Range.Materials.clear();
	FreeIds.push_back(Id);
	--RangeCount;
}

FSectionRangeId FSectionTable::AddRange()
{
	++RangeCount;
	if (RangeCount > Buckets.size()) { Rehash(); }
	if (!FreeIds.empty())
	{
		const FSectionRangeId Id = FreeIds.back();
		FreeIds.pop_back();
		return Id;
	}
	Ranges.emplace_back();
	Links.emplace_back();
	return GetRangeCapacity() - 1;
}

// ------------------------------------------------------------------------------------------------ finding ranges

FSectionRangeId FSectionTable::Find(uint64_t Hash, const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials) const
{
	if (Buckets.empty()) { return None; }
	for (FSectionRangeId Id = Buckets[Hash & (Buckets.size() - 1)]; Id != None; Id = Links[Id].NextInBucket)
	{
		if (Links[Id].Hash == Hash && Ranges[Id].Geometry == &Geometry && Ranges[Id].Materials == Materials) { return Id; }
	}
	return None;
}

void FSectionTable::LinkHash(FSectionRangeId Id)
{
	FSectionRangeId& Head = Buckets[Links[Id].Hash & (Buckets.size() - 1)];
	Links[Id].NextInBucket = std::exchange(Head, Id);
}

void FSectionTable::UnlinkHash(FSectionRangeId Id)
{
	FSectionRangeId* At = &Buckets[Links[Id].Hash & (Buckets.size() - 1)];
	while (*At != Id) { At = &Links[*At].NextInBucket; }
	*At = Links[Id].NextInBucket;
}

void FSectionTable::Rehash()
{
	Buckets.assign(std::max(FewestBuckets, 2 * Buckets.size()), None);
	for (FSectionRangeId Id = 0; Id < Ranges.size(); ++Id)
	{
		if (Ranges[Id].Geometry) { LinkHash(Id); }
	}
}

void FSectionTable::LinkUses(FSectionRangeId Id)
{
	const FSectionRange& Range = Ranges[Id];
	FRangeLinks& Link = Links[Id];
	const uint32_t Slot = Range.Geometry->GetSlot();
	if (Slot >= RangesOfGeometry.size()) { RangesOfGeometry.resize(Slot + 1); }
	std::vector<FSectionRangeId>& OfGeometry = RangesOfGeometry[Slot];
	Link.GeometryPlace = static_cast<uint32_t>(OfGeometry.size());
	OfGeometry.push_back(Id);
	Link.MaterialPlaces.resize(Range.Materials.size());
	for (uint32_t Section = 0; Section < Range.Materials.size(); ++Section)
	{
		const uint32_t Material = Range.Materials[Section];
		assert(Material < Context.Materials.Num());
		if (Material >= UsesOfMaterial.size()) { UsesOfMaterial.resize(Context.Materials.Num()); }
		Link.MaterialPlaces[Section] = static_cast<uint32_t>(UsesOfMaterial[Material].size());
		UsesOfMaterial[Material].push_back({Id, Section});
	}
}

void FSectionTable::UnlinkUses(FSectionRangeId Id)
{
	const FSectionRange& Range = Ranges[Id];
	const FRangeLinks& Link = Links[Id];
	std::vector<FSectionRangeId>& OfGeometry = RangesOfGeometry[Range.Geometry->GetSlot()];
	const FSectionRangeId Last = OfGeometry.back();
	OfGeometry[Link.GeometryPlace] = Last;
	Links[Last].GeometryPlace = Link.GeometryPlace;
	OfGeometry.pop_back();
	for (uint32_t Section = 0; Section < Range.Materials.size(); ++Section)
	{
		std::vector<FMaterialUse>& Uses = UsesOfMaterial[Range.Materials[Section]];
		const FMaterialUse LastUse = Uses.back();
		const uint32_t Place = Link.MaterialPlaces[Section];
		Uses[Place] = LastUse;
		Links[LastUse.Range].MaterialPlaces[LastUse.Section] = Place;
		Uses.pop_back();
	}
}

// ------------------------------------------------------------------------------------------------ what they hold

bool FSectionTable::AffectsSections(const FMaterialData& Old, const FMaterialData& New)
{
	const auto Emits = [](const FMaterialData& Data) { return Data.EmissiveWeight > 0.0f || Data.Emissive != glm::vec3(0); };
	const auto HasOwnLight = [](const FMaterialData& Data) { return Data.LightEmissive != Data.Emissive; };
	const auto HasBack = [](const FMaterialData& Data) { return Data.DiffuseTransmission > 0.0f; };
	return Old.Flags != New.Flags || LightShinesThrough(Old) != LightShinesThrough(New) || Old.EmissiveWeight != New.EmissiveWeight ||
	       Emits(Old) != Emits(New) || HasOwnLight(Old) != HasOwnLight(New) || HasBack(Old) != HasBack(New) || Old.UVSets != New.UVSets ||
	       Old.UVTransform[TEXTURE_BASE_COLOR] != New.UVTransform[TEXTURE_BASE_COLOR] ||
	       Old.UVOffset[TEXTURE_BASE_COLOR] != New.UVOffset[TEXTURE_BASE_COLOR] || MakeOpacityKey(Old) != MakeOpacityKey(New);
}

bool FSectionTable::AffectsShape(const FMaterialData& Old, const FMaterialData& New)
{
	const bool bMasked = ((Old.Flags | New.Flags) & MATERIAL_MASKED) != 0;
	return Old.Flags != New.Flags || LightShinesThrough(Old) != LightShinesThrough(New) ||
	       (bMasked && MakeOpacityKey(Old) != MakeOpacityKey(New));
}

void FSectionTable::MaterialChanged(uint32_t Material)
{
	for (const FMaterialUse& Use : GetUses(Material))
	{
		const FSectionRange& Range = Ranges[Use.Range];
		const std::vector<FRTGeometryPart>& Parts = Range.Geometry->GetParts();
		for (uint32_t Part = 0; Part < Parts.size(); ++Part)
		{
			if (Parts[Part].Section == Use.Section) { FillPart(Use.Range, Part); }
		}
		UpdateFlags(Use.Range);
	}
}

double FSectionTable::GetPart(FSectionRangeId Id, uint32_t Section) const
{
	const std::vector<FRTSectionInfo>& Sections = Ranges[Id].Geometry->GetInfo().Sections;
	uint64_t All = 0;
	for (const FRTSectionInfo& Info : Sections) { All += Info.IndexCount; }
	return double(Sections[Section].IndexCount) / double(All);
}

double FSectionTable::GetMeanEmission(FSectionRangeId Id) const
{
	const FSectionRange& Range = Ranges[Id];
	if (!Range.bEmissive) { return 0.0; }
	const std::vector<FRTSectionInfo>& Sections = Range.Geometry->GetInfo().Sections;
	double Sum = 0.0, All = 0.0;
	for (uint32_t Section = 0; Section < Range.Materials.size(); ++Section)
	{
		Sum += double(Context.Materials[Range.Materials[Section]].EmissiveWeight) * Sections[Section].IndexCount;
		All += Sections[Section].IndexCount;
	}
	return NitsPerEmissiveWeight * Sum / All;
}

void FSectionTable::GeometryChanged(const FRTGeometry& Geometry)
{
	if (Geometry.GetSlot() >= RangesOfGeometry.size()) { return; }
	for (const FSectionRangeId Id : RangesOfGeometry[Geometry.GetSlot()])
	{
		FillRange(Id);
		MarkRange(Id);
	}
}

void FSectionTable::RefillAll()
{
	for (FSectionRangeId Id = 0; Id < Ranges.size(); ++Id)
	{
		if (Ranges[Id].Geometry) { FillRange(Id); }
	}
}

void FSectionTable::FillRange(FSectionRangeId Id)
{
	const FSectionRange& Range = Ranges[Id];
	const uint32_t Parts = static_cast<uint32_t>(Range.Geometry->GetParts().size());
	assert(Parts <= Range.Count);
	for (uint32_t Part = 0; Part < Parts; ++Part) { FillPart(Id, Part); }
	for (uint32_t Part = Parts; Part < Range.Count; ++Part) { HitPrograms.Clear(Range.First + Part); }
	UpdateFlags(Id);
}

void FSectionTable::FillPart(FSectionRangeId Id, uint32_t Part)
{
	const FSectionRange& Range = Ranges[Id];
	const FRTGeometryPart& Where = Range.Geometry->GetParts()[Part];
	const uint32_t Material = Range.Materials[Where.Section];
	const FHitProgram Program = ChooseHitProgram(Context, *Range.Geometry, Where, Material);
	if (Write(Range.First + Part, MakeSection(Context, *Range.Geometry, Where, Material), Program))
	{
		MarkRange(Id); // the new program's shaders may be missing
	}
}

void FSectionTable::UpdateFlags(FSectionRangeId Id)
{
	const FSectionRange& Range = Ranges[Id];
	bool bMasked = false, bDoubleSided = true, bEmissive = false, bLightEmission = false, bTransmissive = false;
	bool bDiffuseTransmission = false, bScattering = false;
	for (const uint32_t Material : Range.Materials)
	{
		bDoubleSided &= (Context.Materials[Material].Flags & MATERIAL_DOUBLE_SIDED) != 0;
		const FMaterialData& Data = Context.Materials[Material];
		bEmissive |= Data.EmissiveWeight > 0.0f || Data.Emissive != glm::vec3(0);
		bLightEmission |= Data.LightEmissive != Data.Emissive;
		bTransmissive |= IsTransmissive(Context, Data);
		bDiffuseTransmission |= Context.Override == 0 && Data.DiffuseTransmission > 0.0f;
		bScattering |= IsScattering(Context, Data);
	}
	bool bOpaqueGlass = false;
	const std::vector<FRTGeometryPart>& Parts = Range.Geometry->GetParts();
	for (uint32_t Part = 0; Part < Parts.size(); ++Part)
	{
		const FSectionData& Section = Table[Range.First + Part];
		bMasked |= (Section.Flags & SECTION_MASKED) != 0;
		bOpaqueGlass |= Parts[Part].bOpaque && IsTransmissive(Context, Context.Materials[Section.Material]);
	}
	SetFlags(Id, {bMasked, bDoubleSided, bEmissive, bLightEmission, bTransmissive, bOpaqueGlass, bDiffuseTransmission, bScattering});
	if (!HasClassifiedMaterials(Context, *Range.Geometry, Range.Materials))
	{
		RefutedGeometries.push_back(Range.Geometry->weak_from_this());
	}
}

void FSectionTable::SetFlags(FSectionRangeId Id, const FRangeFlags& New)
{
	FRangeFlags& Flags = Ranges[Id];
	if (Flags == New) { return; }
	MaskedRangeCount += uint32_t(New.bMasked) - uint32_t(Flags.bMasked);
	EmissiveRangeCount += uint32_t(New.bEmissive) - uint32_t(Flags.bEmissive);
	TransmissiveRangeCount += uint32_t(New.bTransmissive) - uint32_t(Flags.bTransmissive);
	DiffuseTransmissionRangeCount += uint32_t(New.bDiffuseTransmission) - uint32_t(Flags.bDiffuseTransmission);
	ScatteringRangeCount += uint32_t(New.bScattering) - uint32_t(Flags.bScattering);
	LightEmissionRangeCount += uint32_t(New.bLightEmission) - uint32_t(Flags.bLightEmission);
	Flags = New;
	MarkRange(Id);
}

void FSectionTable::MarkRange(FSectionRangeId Id)
{
	if (!std::exchange(Links[Id].bChanged, true)) { ChangedRanges.push_back(Id); }
}

bool FSectionTable::Write(uint32_t Section, const FSectionData& Data, FHitProgram Program)
{
	const bool bOtherData = std::memcmp(&Data, &Table[Section], sizeof(Data)) != 0;
	if (bOtherData) { Table.Set(Section, Data); }
	const bool bOtherProgram = HitPrograms.Set(Section, Program);
	if (!bOtherData && !bOtherProgram) { return false; }
	Changes.Add(Section);
	return bOtherProgram;
}

std::vector<FSectionRangeId> FSectionTable::TakeChangedRanges()
{
	for (const FSectionRangeId Id : ChangedRanges) { Links[Id].bChanged = false; }
	return std::exchange(ChangedRanges, {});
}

} // namespace Lantern
