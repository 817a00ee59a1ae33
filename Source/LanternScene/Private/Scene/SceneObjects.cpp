// FSceneObjects: the handle table, and the entries of an object in all that follows from it.
#include "LanternScene/Scene/SceneObjects.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "LanternCore/Text/Log.h"
#include "LanternScene/Scene/EmissiveTriangles.h"

namespace Lantern
{

namespace
{
/// Packs what rounding to fp32 took from the translation: three signed fields of 10 bits, in steps of 2⁻²⁵ m.
uint32_t PackTranslationRest(const glm::dmat4& Transform, const FObjectData& Data)
{
	uint32_t Packed = 0;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const double Rest = Transform[3][Axis] - CellCenter(Data.Cell)[Axis] - double(Data.ObjectToWorld[Axis].w);
		// What is no number, or too far away for cells, is left as it is.
		const double Steps = std::abs(Rest) < 1e-3 ? std::clamp(std::round(Rest * 33'554'432.0), -512.0, 511.0) : 0.0;
		Packed |= (static_cast<uint32_t>(static_cast<int32_t>(Steps)) & 1023u) << (2 + 10 * Axis);
	}
	return Packed;
}

/// Returns an upper bound of how much a transform stretches. It is exact where the transform's axes stay at right angles.
/// The largest row sum of MᵀM bounds the square of the largest singular value of M (Gershgorin).
double GetStretch(const glm::dmat4& Transform)
{
	const glm::dmat3 Linear(Transform);
	const glm::dmat3 Gram = glm::transpose(Linear) * Linear;
	double Largest = 0.0;
	for (int Row = 0; Row < 3; ++Row)
	{
		Largest = std::max(Largest, std::abs(Gram[0][Row]) + std::abs(Gram[1][Row]) + std::abs(Gram[2][Row]));
	}
	return std::sqrt(Largest);
}

/// Whether light about the normals of one style may stand for that about those of the other. Null: there is none.
bool GathersAlike(const FToonStyle* A, const FToonStyle* B)
{
	return A && B ? A->SphereWeight == B->SphereWeight && A->Bend == B->Bend : A == B;
}

bool HasSphere(const FRTObjectInfo& Info) { return Info.Toon && Info.Toon->SphereWeight > 0.0f; }

uint32_t IsOffChannel(uint8_t Channels) { return (Channels & CHANNELS_DEFAULT) == 0 ? 1 : 0; }
} // namespace

FSceneObjects::FObject& FSceneObjects::Resolve(FRTObjectId Id)
{
	assert(Objects.IsCurrent(Id.Index, Id.Generation));
	return Objects[Id.Index];
}

// ---------------------------------------------------------------------------------------------------- changes

FRTObjectId FSceneObjects::Add(FRTObjectInfo Info)
{
	assert(Info.Geometry && Info.Materials.size() == Info.Geometry->GetSectionCount());
	const uint32_t Slot = Objects.Take(MaxInstanceIndex + 1);
	if (Slot == TSlots<FObject>::None)
	{
		LogOnce(ERTLogLevel::Error, "the scene has 2^24 objects; an instance cannot name more, and further ones are left out");
		return {};
	}
	FObject& Object = Objects[Slot];
	Object.Info = std::move(Info);
	Characters += Object.Info.bCharacter ? 1 : 0;
	OffChannel += IsOffChannel(Object.Info.Channels);
	WriteChannels(Slot);
	Toons.Set(Slot, Object.Info.Toon.get(), GetSlotCount());
	JoinRange(Slot, Sections.Acquire(*Object.Info.Geometry, Object.Info.Materials));
	Motions.Add(Slot, *Object.Info.Geometry);
	JoinGeometry(Slot);
	Write(Slot);
	NoteCaster(Slot, 1.0);
	Emissive.SetObject(Slot, Object.Info.Materials);
	return {Slot, Objects.GetGeneration(Slot)};
}

void FSceneObjects::Remove(FRTObjectId Id)
{
	FObject& Object = Resolve(Id);
	Emissive.RemoveObject(Id.Index);
	Characters -= Object.Info.bCharacter ? 1 : 0;
	OffChannel -= IsOffChannel(Object.Info.Channels);
	NoteCaster(Id.Index, 1.0);
	Toons.Set(Id.Index, nullptr, GetSlotCount());
	Instances.Remove(Id.Index);
	Motions.Remove(Id.Index);
	Pivots.Remove(Id.Index);
	LeaveGeometry(Id.Index);
	LeaveRange(Id.Index);
	Retired.push_back(std::move(Object.Info.Geometry));
	Objects.Free(Id.Index);
	Table.Truncate(GetSlotCount());
	ChannelTable.Truncate(GetSlotCount());
	Toons.Truncate(GetSlotCount());
	Motions.Truncate(GetSlotCount());
}

void FSceneObjects::SetTransform(FRTObjectId Id, const glm::dmat4& Transform)
{
	FObject& Object = Resolve(Id);
	Motions.BeforeMove(Id.Index);
	const FInstanceRecord Before = Instances.GetRecord(Id.Index);
	const bool bMoved = std::exchange(Object.Info.Transform, Transform) != Transform; // engines may set all transforms in each frame
	Write(Id.Index);
	if (!bMoved) { return; }
	NoteCaster(Id.Index, Before, Instances.GetRecord(Id.Index));
	if (Sections.GetRange(Object.Range).bEmissive) { Emissive.MarkMoved(Id.Index); }
}

void FSceneObjects::SetMaterials(FRTObjectId Id, std::vector<uint32_t> SectionMaterials)
{
	FObject& Object = Resolve(Id);
	if (Sections.GetRange(Object.Range).bEmissive) { NoteCaster(Id.Index, 1.0); } // while it shines
	const FSectionRangeId Range = Sections.Acquire(*Object.Info.Geometry, SectionMaterials);
	Emissive.SetObject(Id.Index, SectionMaterials);
	LeaveRange(Id.Index);
	JoinRange(Id.Index, Range);
	Object.Info.Materials = std::move(SectionMaterials);
	Write(Id.Index);
	NoteCaster(Id.Index, 1.0);
}

void FSceneObjects::SetGeometry(FRTObjectId Id, FRTGeometryRef Geometry, std::vector<uint32_t> SectionMaterials)
{
	assert(Geometry && SectionMaterials.size() == Geometry->GetSectionCount());
	FObject& Object = Resolve(Id);
	if (Sections.GetRange(Object.Range).bEmissive) { NoteCaster(Id.Index, 1.0); } // while it shines
	const FInstanceRecord Before = Instances.GetRecord(Id.Index);
	const FSectionRangeId Range = Sections.Acquire(*Geometry, SectionMaterials);
	Emissive.SetObject(Id.Index, SectionMaterials);
	LeaveGeometry(Id.Index);
	LeaveRange(Id.Index);
	JoinRange(Id.Index, Range);
	Retired.push_back(std::exchange(Object.Info.Geometry, std::move(Geometry)));
	Object.Info.Materials = std::move(SectionMaterials);
	Motions.SetGeometry(Id.Index, *Object.Info.Geometry);
	JoinGeometry(Id.Index);
	Write(Id.Index);
	NoteCaster(Id.Index, Before, Instances.GetRecord(Id.Index), 1.0);
}

void FSceneObjects::SetMask(FRTObjectId Id, uint8_t Mask)
{
	if (std::exchange(Resolve(Id).Info.Mask, Mask) == Mask) { return; }
	const FInstanceRecord Before = Instances.GetRecord(Id.Index);
	Place(Id.Index);
	WriteCasterRadius(Id.Index);
	NoteCaster(Id.Index, Before, Instances.GetRecord(Id.Index), 1.0);
}

void FSceneObjects::SetChannels(FRTObjectId Id, uint8_t Channels)
{
	const uint8_t Before = std::exchange(Resolve(Id).Info.Channels, Channels);
	if (Before == Channels) { return; }
	OffChannel += IsOffChannel(Channels) - IsOffChannel(Before);
	WriteChannels(Id.Index);
	CasterChanges.AddAnywhere(); // filters look whether their light is still right
}

void FSceneObjects::SetToon(FRTObjectId Id, std::shared_ptr<const FToonStyle> Style)
{
	FObject& Object = Resolve(Id);
	const bool bSphere = HasSphere(Object.Info);
	const std::shared_ptr<const FToonStyle> Before = std::exchange(Object.Info.Toon, std::move(Style));
	Toons.Set(Id.Index, Object.Info.Toon.get(), GetSlotCount());
	if (HasSphere(Object.Info) != bSphere) { Place(Id.Index); } // another mask
	// The centre may follow a bone in each frame, and limits act behind the filter.
	if (!GathersAlike(Before.get(), Object.Info.Toon.get())) { NoteCaster(Id.Index, 1.0); }
}

/// The table begins with the first object that needs it. It has all objects then: shaders look up any.
void FSceneObjects::WriteChannels(uint32_t Slot)
{
	const uint32_t Value = Objects[Slot].Info.Channels ^ CHANNELS_DEFAULT;
	if (ChannelTable.Num() == 0 && Value == 0) { return; }
	if (ChannelTable.Num() < GetSlotCount()) { ChannelTable.Set(GetSlotCount() - 1, 0); }
	ChannelTable.Set(Slot, Value);
}

void FSceneObjects::SetBounds(const FRTGeometryRef& Geometry, const FBoundingSphere& Bounds)
{
	assert(Geometry->GetInfo().bDynamic);
	Geometry->Info.BoundsCenter = Bounds.Center;
	Geometry->Info.BoundsRadius = Bounds.Radius;
	const auto Found = DynamicUsers.find(Geometry.get());
	if (Found == DynamicUsers.end()) { return; }
	for (const uint32_t Slot : Found->second)
	{
		const FInstanceRecord Before = Instances.GetRecord(Slot);
		Place(Slot);
		WriteCasterRadius(Slot);
		NoteCaster(Slot, Before, Instances.GetRecord(Slot));
	}
}

void FSceneObjects::MarkDeformed(const FRTGeometryRef& Geometry)
{
	Motions.MarkDeformed(Geometry);
	const auto Found = DynamicUsers.find(Geometry.get());
	if (Found == DynamicUsers.end()) { return; }
	for (const uint32_t Slot : Found->second)
	{
		NoteCaster(Slot);
		if (Sections.GetRange(Objects[Slot].Range).bEmissive) { Emissive.MarkDeformed(Slot); }
	}
}

namespace
{
/// What turns in its place, or is deformed, mostly hides what it hid before.
constexpr double LittleChanged = 1.0 / 64.0;

double GetMovedPart(const FInstanceRecord& Before, const FInstanceRecord& After, double Radius)
{
	return std::clamp(glm::length(After.Center - Before.Center) / std::max(2.0 * Radius, 1.0e-6), LittleChanged, 1.0);
}
} // namespace

void FSceneObjects::NoteCaster(uint32_t Slot, const FInstanceRecord& Before, const FInstanceRecord& After, std::optional<double> Changed)
{
	if (((Before.Mask | After.Mask) & MASK_CASTERS) == 0) { return; }
	const double Radius = std::max(Before.Radius, After.Radius);
	if (Radius >= UnboundedRadius) { return CasterChanges.AddAnywhere(); }
	CasterChanges.Add({Before.Center, After.Center, Radius, Changed.value_or(GetMovedPart(Before, After, Radius)), Slot,
	    Sections.GetMeanEmission(Objects[Slot].Range)});
}

void FSceneObjects::NoteCaster(uint32_t Slot, std::optional<double> Changed)
{
	NoteCaster(Slot, Instances.GetRecord(Slot), Instances.GetRecord(Slot), Changed);
}

void FSceneObjects::JoinRange(uint32_t Slot, FSectionRangeId Range)
{
	constexpr uint32_t None = TSlots<FObject>::None;
	if (FirstOfRange.size() <= Range) { FirstOfRange.resize(size_t(Range) + 1, None); }
	FObject& Object = Objects[Slot];
	Object.Range = Range;
	Object.PreviousOfRange = None;
	Object.NextOfRange = std::exchange(FirstOfRange[Range], Slot);
	if (Object.NextOfRange != None) { Objects[Object.NextOfRange].PreviousOfRange = Slot; }
}

/// Releases the range as well.
void FSceneObjects::LeaveRange(uint32_t Slot)
{
	constexpr uint32_t None = TSlots<FObject>::None;
	const FObject& Object = Objects[Slot];
	if (Object.NextOfRange != None) { Objects[Object.NextOfRange].PreviousOfRange = Object.PreviousOfRange; }
	if (Object.PreviousOfRange != None) { Objects[Object.PreviousOfRange].NextOfRange = Object.NextOfRange; }
	else { FirstOfRange[Object.Range] = Object.NextOfRange; }
	Sections.Release(Object.Range);
}

void FSceneObjects::NoteAppearance(uint32_t Material, const FAppearanceChange& Change)
{
	std::vector<FCasterChange> Changes;
	for (const FMaterialUse& Use : Sections.GetUses(Material))
	{
		const double Part = Change.Part * Sections.GetPart(Use.Range, Use.Section);
		// What shines counts by what it emits. What it hides or reflects is about as it was.
		const bool bShines = Change.Emission > 0.0;
		const double Changed = bShines ? LittleChanged : Part, Emission = bShines ? Change.Emission * Part / LittleChanged : 0.0;
		for (uint32_t Slot = FirstOfRange[Use.Range]; Slot != TSlots<FObject>::None; Slot = Objects[Slot].NextOfRange)
		{
			const FInstanceRecord& Record = Instances.GetRecord(Slot);
			if ((Record.Mask & MASK_CASTERS) == 0 || !std::isfinite(Record.Radius + glm::dot(Record.Center, Record.Center))) { continue; }
			if (Changes.size() == FAppearanceChanges::MostObjects || Record.Radius >= UnboundedRadius)
			{
				if (Change.Part > LittleChanged) { AppearanceChanges.AddEverywhere(Change.Part); } // what scrolls is as bright
				return;
			}
			Changes.push_back({Record.Center, Record.Center, Record.Radius, Changed, Slot, Emission});
		}
	}
	for (const FCasterChange& Of : Changes) { AppearanceChanges.Add(Of); }
}

void FSceneObjects::JoinGeometry(uint32_t Slot)
{
	FObject& Object = Objects[Slot];
	if (!Object.Info.Geometry->GetInfo().bDynamic) { return; }
	std::vector<uint32_t>& Users = DynamicUsers[Object.Info.Geometry.get()];
	Object.Member = static_cast<uint32_t>(Users.size());
	Users.push_back(Slot);
}

void FSceneObjects::LeaveGeometry(uint32_t Slot)
{
	const FObject& Object = Objects[Slot];
	if (!Object.Info.Geometry->GetInfo().bDynamic) { return; }
	const auto Found = DynamicUsers.find(Object.Info.Geometry.get());
	std::vector<uint32_t>& Users = Found->second;
	Objects[Users.back()].Member = Object.Member;
	Users[Object.Member] = Users.back();
	Users.pop_back();
	if (Users.empty()) { DynamicUsers.erase(Found); }
}

/// Writes what gathering and the reach of rays know of the object.
void FSceneObjects::Place(uint32_t Slot)
{
	const FObject& Object = Objects[Slot];
	const glm::dmat4& Transform = Object.Info.Transform;
	const FRTGeometryInfo& Geometry = Object.Info.Geometry->GetInfo();
	FInstancePlacement Placement;
	Placement.Transform = Transform;
	if (Geometry.BoundsRadius >= 0.0f)
	{
		Placement.Center = glm::dvec3(Transform * glm::dvec4(Geometry.BoundsCenter, 1.0));
		Placement.Radius = GetStretch(Transform) * double(Geometry.BoundsRadius);
	}
	Pivots.Set(Slot, glm::dvec3(Transform[3]), Placement.Center, Placement.Radius);
	Placement.Range = Object.Range;
	Placement.Group = Object.Info.Group;
	Placement.Mask = HasSphere(Object.Info) ? static_cast<uint8_t>(Object.Info.Mask & ~MASK_OUTSIDE_SPHERES) : Object.Info.Mask;
	Instances.Set(Slot, Placement);
}

float FSceneObjects::GetCasterRadius(uint32_t Slot) const
{
	const FInstanceRecord& Record = Instances.GetRecord(Slot);
	return static_cast<float>((Record.Mask & MASK_SUN_CASTERS) != 0 ? Record.Radius : UnboundedRadius);
}

/// After a change of mask or bounds alone.
void FSceneObjects::WriteCasterRadius(uint32_t Slot)
{
	FObjectData Data = Table[Slot];
	const float Radius = GetCasterRadius(Slot);
	if (std::exchange(Data.CasterRadius, Radius) != Radius) { Table.Set(Slot, Data); }
}

void FSceneObjects::Write(uint32_t Slot)
{
	Place(Slot);
	const FObject& Object = Objects[Slot];
	const glm::dmat4& Transform = Object.Info.Transform;
	FObjectData Data{};
	std::memcpy(Data.ObjectToWorld, Instances.GetTransform(Slot), sizeof(Data.ObjectToWorld));
	Data.FirstSection = Sections.GetRange(Object.Range).First;
	Data.Cell = Instances.GetRecord(Slot).Cell;
	Data.Flags = (glm::determinant(glm::dmat3(Transform)) < 0.0 ? OBJECT_MIRRORED : 0u) | (Object.Info.bCharacter ? OBJECT_CHARACTER : 0u) |
	             PackTranslationRest(Transform, Data);
	Data.Motion = Motions.GetEntry(Slot);
	Data.CasterRadius = GetCasterRadius(Slot);
	Table.Set(Slot, Data);
}

// ---------------------------------------------------------------------------------------------------- a frame

void FSceneObjects::EndFrame(bool bSubmitted)
{
	Motions.EndFrame(bSubmitted);
	if (!bSubmitted) { return; }
	RetiredBefore = std::move(Retired);
	Retired.clear();
}

} // namespace Lantern
