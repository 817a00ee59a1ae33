// FSceneObjects keeps the objects of a scene: a handle table of what the engine set, and what follows from it. That is
// FObjectData[] on the GPU, the store that instances are gathered from, the motions and the pivots.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Instances/InstanceStore.h"
#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Memory/Slots.h"
#include "LanternScene/Scene/CasterChanges.h"
#include "LanternScene/Scene/Object.h"
#include "LanternScene/Scene/ObjectMotion.h"
#include "LanternScene/Scene/ObjectPivots.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "SceneTypes.h"

namespace Lantern
{

class FEmissiveTriangles;

/// Threads: one at a time. The cost of a change does not depend on the number of objects.
class FSceneObjects
{
public:
	/// Takes section ranges from InSections. Tells InEmissive which objects come, go, move and have other materials. The arguments
	/// outlive this.
	FSceneObjects(FSectionTable& InSections, FEmissiveTriangles& InEmissive) : Sections(InSections), Emissive(InEmissive) {}
	FSceneObjects(const FSceneObjects&) = delete;
	FSceneObjects& operator=(const FSceneObjects&) = delete;

	/// Returns an invalid id, and logs that once, if there are MaxInstanceIndex + 1 objects already.
	FRTObjectId Add(FRTObjectInfo Info);
	/// Keeps the geometry until EndFrame was called for two submitted frames.
	void Remove(FRTObjectId Id);
	void SetTransform(FRTObjectId Id, const glm::dmat4& Transform);
	/// SectionMaterials holds one material for each section of the geometry.
	void SetMaterials(FRTObjectId Id, std::vector<uint32_t> SectionMaterials);
	/// See FRTScene::SetGeometry.
	void SetGeometry(FRTObjectId Id, FRTGeometryRef Geometry, std::vector<uint32_t> SectionMaterials);
	/// Changes nothing but who sees the object: its motion stays.
	void SetMask(FRTObjectId Id, uint8_t Mask);
	void SetChannels(FRTObjectId Id, uint8_t Channels);
	/// Null: light falls on the object as on any other.
	void SetToon(FRTObjectId Id, std::shared_ptr<const FToonStyle> Style);
	/// Notes that the shape of all objects with this geometry is another one in this frame.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// Notes that a material looks otherwise. O(objects that have it, up to FAppearanceChanges::MostObjects).
	void NoteAppearance(uint32_t Material, const FAppearanceChange& Change);
	/// See FRTScene::SetBounds.
	void SetBounds(const FRTGeometryRef& Geometry, const FBoundingSphere& Bounds);
	const FRTObjectInfo& Get(FRTObjectId Id) const { return Resolve(Id).Info; }
	/// Returns the index of the object's first section in FSectionData[].
	uint32_t GetFirstSection(FRTObjectId Id) const { return Sections.GetRange(Resolve(Id).Range).First; }

	/// Objects with FRTObjectInfo::bCharacter.
	uint32_t GetCharacterCount() const { return Characters; }
	/// Objects that are not of channel 0.
	uint32_t GetOffChannelCount() const { return OffChannel; }
	/// Slots of the handle table. FRTObjectId::Index is one of them.
	uint32_t GetSlotCount() const { return Objects.Num(); }
	/// Returns null if the slot is free. Slot < GetSlotCount().
	const FRTObjectInfo* Find(uint32_t Slot) const { return Objects.IsAlive(Slot) ? &Objects[Slot].Info : nullptr; }
	/// Returns the section range of the object in the slot, which must not be free.
	FSectionRangeId GetRange(uint32_t Slot) const { return Objects[Slot].Range; }

	/// Ends a frame of the motions. Releases the geometries of objects removed before it if the frame was submitted.
	void EndFrame(bool bSubmitted);

	/// FObjectData[], by slot.
	TGpuTable<FObjectData>& GetTable() { return Table; }
	const TGpuTable<FObjectData>& GetTable() const { return Table; }
	/// FSceneConstants::ObjectChannels; empty until some object has other channels than the default.
	TGpuTable<uint32_t>& GetChannels() { return ChannelTable; }
	const TGpuTable<uint32_t>& GetChannels() const { return ChannelTable; }
	FToonStyles& GetToons() { return Toons; }
	const FToonStyles& GetToons() const { return Toons; }
	FInstanceStore& GetInstances() { return Instances; }
	const FInstanceStore& GetInstances() const { return Instances; }
	FObjectMotions& GetMotions() { return Motions; }
	const FObjectMotions& GetMotions() const { return Motions; }
	/// Where shadows may have changed.
	FCasterChanges& GetCasterChanges() { return CasterChanges; }
	const FCasterChanges& GetCasterChanges() const { return CasterChanges; }
	/// How objects look otherwise than before, without any other shadow.
	const FAppearanceChanges& GetAppearanceChanges() const { return AppearanceChanges; }
	FObjectPivots& GetPivots() { return Pivots; }
	const FObjectPivots& GetPivots() const { return Pivots; }

private:
	struct FObject
	{
		FRTObjectInfo Info;
		FSectionRangeId Range = 0;
		uint32_t Member = 0; // place in DynamicUsers
		uint32_t NextOfRange = TSlots<FObject>::None, PreviousOfRange = TSlots<FObject>::None;
	};
	FObject& Resolve(FRTObjectId Id);
	const FObject& Resolve(FRTObjectId Id) const { return const_cast<FSceneObjects*>(this)->Resolve(Id); }
	void JoinRange(uint32_t Slot, FSectionRangeId Range);
	void LeaveRange(uint32_t Slot);
	void Place(uint32_t Slot);
	void Write(uint32_t Slot);
	void WriteCasterRadius(uint32_t Slot);
	float GetCasterRadius(uint32_t Slot) const;
	void JoinGeometry(uint32_t Slot);
	void LeaveGeometry(uint32_t Slot);
	void WriteChannels(uint32_t Slot);
	/// Changed: FCasterChange::Changed. Without it: by how far the object has moved.
	void NoteCaster(uint32_t Slot, const FInstanceRecord& Before, const FInstanceRecord& After, std::optional<double> Changed = {});
	void NoteCaster(uint32_t Slot, std::optional<double> Changed = {});

	FSectionTable& Sections;
	FEmissiveTriangles& Emissive;
	TSlots<FObject> Objects;
	uint32_t Characters = 0, OffChannel = 0;
	std::vector<FRTGeometryRef> Retired, RetiredBefore; // of objects removed since the last submitted frame, and before it
	std::unordered_map<const FRTGeometry*, std::vector<uint32_t>> DynamicUsers; // objects of dynamic geometries
	std::vector<uint32_t> FirstOfRange;                                         // by range: a list of objects through NextOfRange
	TGpuTable<FObjectData> Table{"Objects"};
	TGpuTable<uint32_t> ChannelTable{"ObjectChannels"};
	FToonStyles Toons;
	FObjectMotions Motions{Table};
	FCasterChanges CasterChanges;
	FAppearanceChanges AppearanceChanges;
	FObjectPivots Pivots;
	FInstanceStore Instances;
};

} // namespace Lantern
