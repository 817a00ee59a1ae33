// Which sections exist: one range of FSectionData per (geometry, material set), shared by all objects that
// have both, so that 100,000 instances of one tree have one range. The hit records of the shader table follow
// the same numbering: record = section · ray types + ray type.
//
// A range has an entry for each part of its geometry; the first ones are the geometry's sections, in their order.
#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Pipelines/MaterialPrograms.h"
#include "LanternScene/Scene/Object.h"
#include "LanternScene/ShaderTable/HitProgramIndex.h"
#include "LanternScene/ShaderTable/SectionAllocator.h"
#include "SceneTypes.h"

namespace Lantern
{

/// Names a range; below FSectionTable::GetRangeCapacity. Constant over the range's life, then used again.
using FSectionRangeId = uint32_t;

struct FSectionRange
{
	const FRTGeometry* Geometry = nullptr; ///< null: no range has this id
	std::vector<uint32_t> Materials;       ///< per section
	uint32_t First = 0;                    ///< section number of its first entry
	uint32_t Count = 0;                    ///< entries, the geometry's part capacity
	uint32_t References = 0;
	bool bMasked = false;      ///< alpha tests run on some part
	bool bDoubleSided = false; ///< all materials are
	bool bEmissive = false;    ///< some material is
};

/// What sections are made from; owned by the scene. Who changes it tells the table.
struct FSectionContext
{
	const TGpuTable<FMaterialData>& Materials;
	const std::vector<uint32_t>& Programs; ///< of materials; those behind its end have StandardProgram
	bool bAlphaTest = true;
	uint32_t Override = 0; ///< as FRTScene::SetMaterialOverride
};

/// Threads: one at a time; those that only read may be several.
class FSectionTable
{
public:
	/// Context outlives the table.
	explicit FSectionTable(const FSectionContext& InContext);
	FSectionTable(const FSectionTable&) = delete;
	FSectionTable& operator=(const FSectionTable&) = delete;

	/// Differs for every table that was ever made, unlike its address.
	uint64_t GetIdentity() const { return Identity; }
	/// The range of this geometry and these materials, one for each section; takes a reference. Constant time, amortised.
	/// The geometry outlives the range.
	FSectionRangeId Acquire(const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials);
	void Release(FSectionRangeId Id);
	const FSectionRange& GetRange(FSectionRangeId Id) const { return Ranges[Id]; }
	uint32_t GetRangeCapacity() const { return static_cast<uint32_t>(Ranges.size()); }
	uint32_t GetRangeCount() const { return RangeCount; } ///< in use
	uint32_t GetMaskedRangeCount() const { return MaskedRangeCount; }
	uint32_t GetEmissiveRangeCount() const { return EmissiveRangeCount; }

	/// Whether MaterialChanged has anything to do: not for an animated colour.
	static bool AffectsSections(const FMaterialData& Old, const FMaterialData& New);
	/// The material or its program is another now: O(sections that use it).
	void MaterialChanged(uint32_t Material);
	bool IsMaterialUsed(uint32_t Material) const { return Material < UsesOfMaterial.size() && !UsesOfMaterial[Material].empty(); }
	/// Its address, parts or index buffer are others now: O(ranges of it).
	void GeometryChanged(const FRTGeometry& Geometry);
	/// The context's other members changed.
	void RefillAll();

	/// Ranges that are new, or of which a flag, a hit program or the geometry changed, since the last call, each once. Some may have been
	/// released meanwhile.
	std::vector<FSectionRangeId> TakeChangedRanges();
	bool HasChangedRanges() const { return !ChangedRanges.empty(); }
	/// Sections written since the last call, each once, for whoever keeps hit records. Some may have been released
	/// meanwhile.
	std::vector<uint32_t> TakeChanged();
	/// Slots of geometries that were given another alpha test than they were classified for, since the last call. Some may
	/// come twice, or have been released meanwhile.
	std::vector<uint32_t> TakeRefutedGeometries() { return std::exchange(RefutedGeometries, {}); }
	bool HasRefutedGeometries() const { return !RefutedGeometries.empty(); }
	bool HasChanged() const { return !Changed.empty(); } ///< whether TakeChanged would return any

	const FSectionData& Get(uint32_t Section) const { return Table[Section]; }
	uint32_t GetCapacity() const { return Table.Num(); } ///< one past the last section that was ever in use
	TGpuTable<FSectionData>& GetTable() { return Table; }
	const TGpuTable<FSectionData>& GetTable() const { return Table; }

	FHitProgram GetHitProgram(uint32_t Section) const { return HitPrograms.GetProgram(Section); }
	/// All hit programs in use, sorted.
	const std::vector<FHitProgram>& GetHitPrograms() { return HitPrograms.GetInUse(); }
	/// Changes whenever GetHitPrograms would return something else.
	uint64_t GetHitProgramsRevision() { return HitPrograms.GetInUseRevision(); }
	/// Numbers of the sections' hit programs.
	const FHitProgramIndex& GetHitProgramIndex() const { return HitPrograms; }

private:
	static constexpr uint32_t None = ~0u;

	// How a range is found, and found again when it goes.
	struct FRangeLinks
	{
		uint64_t Hash = 0;
		uint32_t NextInBucket = None;
		uint32_t GeometryPlace = 0;           // in RangesOfGeometry
		std::vector<uint32_t> MaterialPlaces; // of each section, in UsesOfMaterial
		bool bChanged = false;
	};
	struct FMaterialUse
	{
		FSectionRangeId Range;
		uint32_t Section; // of the geometry
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
	void SetFlags(FSectionRangeId Id, bool bMasked, bool bDoubleSided, bool bEmissive);
	void MarkRange(FSectionRangeId Id);
	/// Whether the hit program was another.
	bool Write(uint32_t Section, const FSectionData& Data, FHitProgram Program);

	const FSectionContext& Context;
	const uint64_t Identity;
	FSectionAllocator Allocator;
	TGpuTable<FSectionData> Table{"Sections"};
	std::vector<FSectionRange> Ranges;
	std::vector<FRangeLinks> Links;
	std::vector<FSectionRangeId> FreeIds;
	std::vector<FSectionRangeId> Buckets; // a power of two
	uint32_t RangeCount = 0, MaskedRangeCount = 0, EmissiveRangeCount = 0;
	std::unordered_map<const FRTGeometry*, std::vector<FSectionRangeId>> RangesOfGeometry;
	std::vector<std::vector<FMaterialUse>> UsesOfMaterial;

	std::vector<FSectionRangeId> ChangedRanges;
	std::vector<uint32_t> RefutedGeometries;
	std::vector<uint32_t> Changed;
	std::vector<bool> IsChanged; // per section: nobody may take changes for a long time, and the list must not grow
	FHitProgramIndex HitPrograms;
};

} // namespace Lantern
