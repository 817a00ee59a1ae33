// FSectionTable keeps the sections of a scene: a range of FSectionData for each pair of geometry and material set. All objects
// that have both share the range: 100,000 instances of one tree have one. Hit records of the shader table are numbered
// alike: record = section · ray types + ray type.
//
// A range has an entry for each part of its geometry. The first entries are the geometry's sections, in their order.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Pipelines/MaterialPrograms.h"
#include "LanternScene/Scene/Object.h"
#include "LanternScene/ShaderTable/ChangeJournal.h"
#include "LanternScene/ShaderTable/HitProgramIndex.h"
#include "LanternScene/ShaderTable/SectionAllocator.h"
#include "SceneTypes.h"

namespace Lantern
{

/// Names a range; less than FSectionTable::GetRangeCapacity(). Constant over the range's life, then used again.
using FSectionRangeId = uint32_t;

/// What of a range's sections counts for the whole.
struct FRangeFlags
{
	bool bMasked = false;              ///< alpha tests run on some part
	bool bDoubleSided = false;         ///< all materials are double-sided
	bool bEmissive = false;            ///< some material emits
	bool bLightEmission = false;       ///< some material lights otherwise than it looks: FMaterialData::LightEmissive
	bool bTransmissive = false;        ///< light shines through some material
	bool bOpaqueGlass = false;         ///< and that of a part which the acceleration structure holds as opaque
	bool bDiffuseTransmission = false; ///< some material scatters light through to its other side
	bool bScattering = false;          ///< light is scattered within some solid
	friend bool operator==(const FRangeFlags&, const FRangeFlags&) = default;
};

struct FSectionRange : FRangeFlags
{
	const FRTGeometry* Geometry = nullptr; ///< null if no range has this id
	std::vector<uint32_t> Materials;       ///< per section
	uint32_t First = 0;                    ///< section number of its first entry
	uint32_t Count = 0;                    ///< number of entries: the geometry's part capacity
	uint32_t References = 0;
};

/// What sections are made from beside geometry; owned by FSceneMaterials, which tells the table of changes.
struct FSectionContext
{
	const TGpuTable<FMaterialData>& Materials;
	const std::vector<uint32_t>& Programs; ///< by material; materials behind the end have StandardProgram
	bool bAlphaTest = true, bTransmission = true;
	uint32_t Override = 0; ///< as FRTScene::SetMaterialOverride
};

/// A section that has a material.
struct FMaterialUse
{
	FSectionRangeId Range;
	uint32_t Section; ///< of the geometry
};

/// Threads: one at a time; functions that only read may run on several.
class FSectionTable
{
public:
	/// InContext outlives the table.
	explicit FSectionTable(const FSectionContext& InContext);
	FSectionTable(const FSectionTable&) = delete;
	FSectionTable& operator=(const FSectionTable&) = delete;

	/// Returns a number that no other table of this process ever has, unlike its address.
	uint64_t GetIdentity() const { return Identity; }
	/// Returns the range of this geometry and these materials, one for each section, and takes a reference. Takes amortised
	/// constant time. The geometry must outlive the range.
	FSectionRangeId Acquire(const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials);
	void Release(FSectionRangeId Id);
	const FSectionRange& GetRange(FSectionRangeId Id) const { return Ranges[Id]; }
	uint32_t GetRangeCapacity() const { return static_cast<uint32_t>(Ranges.size()); }
	uint32_t GetRangeCount() const { return RangeCount; } ///< in use
	uint32_t GetMaskedRangeCount() const { return MaskedRangeCount; }
	uint32_t GetLightEmissionRangeCount() const { return LightEmissionRangeCount; }
	uint32_t GetTransmissiveRangeCount() const { return TransmissiveRangeCount; }
	uint32_t GetDiffuseTransmissionRangeCount() const { return DiffuseTransmissionRangeCount; }
	uint32_t GetScatteringRangeCount() const { return ScatteringRangeCount; }
	uint32_t GetEmissiveRangeCount() const { return EmissiveRangeCount; }

	/// Returns the part of a range's surface that a section has, by its triangles: 0 to 1.
	double GetPart(FSectionRangeId Id, uint32_t Section) const;
	/// Returns the mean luminance of what a range emits, nits. O(sections).
	double GetMeanEmission(FSectionRangeId Id) const;

	/// Tells whether MaterialChanged would do anything. False for an animated colour, for example.
	static bool AffectsSections(const FMaterialData& Old, const FMaterialData& New);
	/// Tells whether rays may meet other surfaces: an alpha test or a facing changed. False for a lamp that flickers.
	static bool AffectsShape(const FMaterialData& Old, const FMaterialData& New);
	/// Rewrites the sections of a material that changed or has another program. O(sections that use it).
	void MaterialChanged(uint32_t Material);
	bool IsMaterialUsed(uint32_t Material) const { return !GetUses(Material).empty(); }
	/// Returns the sections that have the material, in no order. Valid until ranges come or go.
	std::span<const FMaterialUse> GetUses(uint32_t Material) const
	{
		return Material < UsesOfMaterial.size() ? std::span<const FMaterialUse>(UsesOfMaterial[Material]) : std::span<const FMaterialUse>();
	}
	/// Rewrites the ranges of a geometry whose address, parts or index buffer changed. O(ranges of it).
	void GeometryChanged(const FRTGeometry& Geometry);
	/// Rewrites all sections: bAlphaTest or Override of the context changed.
	void RefillAll();

	/// Returns the ranges that are new, or whose flags, hit programs or geometry changed since the last call, each once.
	/// Some may have been released meanwhile.
	std::vector<FSectionRangeId> TakeChangedRanges();
	bool HasChangedRanges() const { return !ChangedRanges.empty(); }
	/// Returns the sections written since Seen, each once, for a writer of hit records, and moves Seen. Each writer has a cursor of
	/// its own. Some sections may have been released meanwhile.
	std::vector<uint32_t> TakeChanged(FChangeCursor& Seen) const { return Changes.Take(Seen); }
	/// Returns the geometries that objects use with another alpha test than that of their classification, since the last call.
	/// Some may come twice. Those that are gone meanwhile have expired, whoever has their slot now.
	std::vector<std::weak_ptr<const FRTGeometry>> TakeRefutedGeometries() { return std::exchange(RefutedGeometries, {}); }
	bool HasRefutedGeometries() const { return !RefutedGeometries.empty(); }
	bool HasChanged(FChangeCursor Seen) const { return Changes.HasChangedSince(Seen); } ///< TakeChanged would return some

	const FSectionData& Get(uint32_t Section) const { return Table[Section]; }
	uint32_t GetCapacity() const { return Table.Num(); } ///< one past the greatest section that was ever in use
	TGpuTable<FSectionData>& GetTable() { return Table; }
	const TGpuTable<FSectionData>& GetTable() const { return Table; }

	FHitProgram GetHitProgram(uint32_t Section) const { return HitPrograms.GetProgram(Section); }
	/// Returns all hit programs in use, sorted.
	const std::vector<FHitProgram>& GetHitPrograms() { return HitPrograms.GetInUse(); }
	/// Returns the numbers of the sections' hit programs.
	const FHitProgramIndex& GetHitProgramIndex() const { return HitPrograms; }

private:
	static constexpr uint32_t None = ~0u;

	// Where a range is linked, so that its links are found in constant time when it goes.
	struct FRangeLinks
	{
		uint64_t Hash = 0;
		uint32_t NextInBucket = None;
		uint32_t GeometryPlace = 0;           // in RangesOfGeometry
		std::vector<uint32_t> MaterialPlaces; // of each section, in UsesOfMaterial
		bool bChanged = false;
	};

	FSectionRangeId Find(uint64_t Hash, const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials) const;
	FSectionRangeId AddRange();
	void LinkHash(FSectionRangeId Id);
	void UnlinkHash(FSectionRangeId Id);
	void Rehash();
	void LinkUses(FSectionRangeId Id);
	void UnlinkUses(FSectionRangeId Id);
	void FillPart(FSectionRangeId Id, uint32_t Part);
	void FillRange(FSectionRangeId Id);
	void UpdateFlags(FSectionRangeId Id);
	void SetFlags(FSectionRangeId Id, const FRangeFlags& New);
	void MarkRange(FSectionRangeId Id);
	/// Returns whether the hit program was another.
	bool Write(uint32_t Section, const FSectionData& Data, FHitProgram Program);

	const FSectionContext& Context;
	const uint64_t Identity;
	FSectionAllocator Allocator;
	TGpuTable<FSectionData> Table{"Sections"};
	std::deque<FSectionRange> Ranges; // grow without moving what is there
	std::deque<FRangeLinks> Links;
	std::vector<FSectionRangeId> FreeIds;
	std::vector<FSectionRangeId> Buckets; // a power of two
	uint32_t RangeCount = 0, MaskedRangeCount = 0, EmissiveRangeCount = 0, LightEmissionRangeCount = 0, TransmissiveRangeCount = 0;
	uint32_t DiffuseTransmissionRangeCount = 0;
	uint32_t ScatteringRangeCount = 0;
	std::deque<std::vector<FSectionRangeId>> RangesOfGeometry; // by its slot
	std::vector<std::vector<FMaterialUse>> UsesOfMaterial;

	std::vector<FSectionRangeId> ChangedRanges;
	std::vector<std::weak_ptr<const FRTGeometry>> RefutedGeometries;
	FChangeJournal Changes; // of sections
	FHitProgramIndex HitPrograms;
};

} // namespace Lantern
