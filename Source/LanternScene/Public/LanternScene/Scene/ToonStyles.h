// FToonStyles keeps how indirect light falls on objects of a stylised look.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Memory/Slots.h"
#include "SceneTypes.h"

namespace Lantern
{

/// How diffuse indirect light falls on an object of a stylised look. The signal of rough specular lobes has its normals as well. Direct
/// light, and what the object sends to others, stay as they are.
/// The light of a pixel is taken in these steps:
/// - its normal turns to that of the sphere, then to the camera;
/// - light is gathered about that normal;
/// - saturation and value of the light are limited, its hue is kept;
/// - the tint colours it, without a change of its luminance.
struct FToonStyle
{
	glm::vec3 Center{0}; ///< of the sphere, in the object's space. An object that deforms may move it in each frame
	/// 0: the object's own normals; 1: those of the sphere. Above 0, objects with a sphere, such as faces and hair, hide no light from it.
	float SphereWeight = 0.0f;
	float Bend = 0.35f;         ///< towards the camera: 0 not at all, 1 all faces the camera
	float MaxSaturation = 0.5f; ///< of the light: 1 - least / greatest component; 1: not limited
	float MaxValue = 0.8f;      ///< greatest component on a white surface, in which the picture's white is 1; 0: not limited
	float Occlusion = 0.0f;     ///< 0 to 1: by how much ambient occlusion darkens the light once more, as a layer that artists set
	glm::vec3 Tint{1};          ///< such as (1, 0.93, 0.88) for skin; not black
	/// 1 to 255: texels of FGBuffer::ToonNumbers name the style by it. The object that was given the number last has it. 0: none.
	uint8_t Number = 0;
	friend bool operator==(const FToonStyle&, const FToonStyle&) = default;
};

/// Threads: one at a time. The cost of a change does not depend on the number of objects.
class FToonStyles
{
public:
	/// Sets the style of the object in a slot; null: it has none. SlotCount: of the object table.
	void Set(uint32_t Object, const FToonStyle* Style, uint32_t SlotCount);
	/// Forgets objects from SlotCount on, which have no styles.
	void Truncate(uint32_t SlotCount) { ObjectTable.Truncate(SlotCount); }

	uint32_t GetCount() const { return static_cast<uint32_t>(OfObject.size()); }
	/// Styles with an Occlusion above 0.
	uint32_t GetOccludedCount() const { return Occluded; }

	/// Sets the addresses of the tables; 0 if there is no style.
	void FillConstants(FSceneConstants& Out) const;
	/// Calls Visit(table) for all tables.
	template <class TVisit>
	void VisitTables(TVisit& Visit)
	{
		Visit(StyleTable);
		Visit(ObjectTable);
		Visit(NumberTable);
	}

private:
	void Cover(uint32_t SlotCount);
	void Take(uint32_t Object, uint32_t Slot, const FToonStyle& Style);
	void Drop(uint32_t Object);
	void GiveNumber(uint32_t Slot, uint8_t Number);
	void LoseNumber(uint32_t Slot);
	void WriteNumber(uint8_t Number);

	std::unordered_map<uint32_t, uint32_t> OfObject; // slot of its style
	TSlots<FToonStyle> Styles;
	std::array<std::vector<uint32_t>, 256> Holders; // by number: slots of styles, the last one that got it at the end
	uint32_t Occluded = 0;
	TGpuTable<FToonData> StyleTable{"ToonStyles"};
	TGpuTable<uint32_t> ObjectTable{"ObjectToons"};
	TGpuTable<uint32_t> NumberTable{"ToonNumbers"};
};

} // namespace Lantern
