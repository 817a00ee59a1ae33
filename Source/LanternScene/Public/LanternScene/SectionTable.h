// Which sections exist: one range of FSectionData per (geometry, material set), shared by all objects that
// have both, so that 100,000 instances of one tree have one range. The hit records of the shader table follow
// the same numbering: record = section · ray types + ray type.
#pragma once

#include <map>
#include <vector>

#include "LanternScene/GpuTable.h"
#include "LanternScene/Object.h"
#include "SceneTypes.h"

namespace Lantern
{

class FSectionTable
{
public:
	/// First section of the range; takes a reference. Fill is called for a new range only.
	template <class FFill>
	uint32_t Acquire(const FRTGeometry* Geometry, const std::vector<uint32_t>& Materials, FFill Fill)
	{
		const FKey Key{Geometry, Materials};
		const auto Found = Ranges.find(Key);
		if (Found != Ranges.end())
		{
			++Found->second.References;
			return Found->second.First;
		}
		const uint32_t Count = Geometry->GetSectionCount();
		const uint32_t First = Allocate(Count);
		for (uint32_t Section = 0; Section < Count; ++Section) { Write(First + Section, Fill(Section)); }
		Ranges.emplace(Key, FRange{First, Count, 1});
		return First;
	}
	void Release(const FRTGeometry* Geometry, const std::vector<uint32_t>& Materials);
	/// Rewrites every section that Update changes (a material became masked, an override was set).
	template <class FUpdate>
	void ForEach(FUpdate Update)
	{
		for (const auto& [Key, Range] : Ranges)
		{
			for (uint32_t I = 0; I < Range.Count; ++I)
			{
				const FSectionData Data = Update(*Key.first, I, Key.second[I], Table[Range.First + I]);
				if (std::memcmp(&Data, &Table[Range.First + I], sizeof(Data)) != 0) { Write(Range.First + I, Data); }
			}
		}
	}

	const FSectionData& Get(uint32_t Section) const { return Table[Section]; }
	uint32_t GetCapacity() const { return Table.Num(); } ///< one past the last section that was ever in use
	uint32_t GetRangeCount() const { return static_cast<uint32_t>(Ranges.size()); }
	TGpuTable<FSectionData>& GetTable() { return Table; }
	const TGpuTable<FSectionData>& GetTable() const { return Table; }
	/// Sections written since the last call, each once, for whoever keeps hit records.
	std::vector<uint32_t> TakeChanged();

private:
	using FKey = std::pair<const FRTGeometry*, std::vector<uint32_t>>;
	struct FRange
	{
		uint32_t First, Count, References;
	};
	uint32_t Allocate(uint32_t Count);
	void Free(uint32_t First, uint32_t Count);
	void Write(uint32_t Section, const FSectionData& Data);

	std::map<FKey, FRange> Ranges;
	std::map<uint32_t, uint32_t> FreeRanges; // first → count, never adjacent
	TGpuTable<FSectionData> Table{"Sections"};
	std::vector<uint32_t> Changed;
	std::vector<bool> IsChanged; // per section: nobody may take changes for a long time, and the list must not grow
};

} // namespace Lantern
