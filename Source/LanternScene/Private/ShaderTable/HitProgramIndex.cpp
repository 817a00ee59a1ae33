// FHitProgramIndex: numbers of hit programs are counted by the sections that use them, and used again.
#include "LanternScene/ShaderTable/HitProgramIndex.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

bool FHitProgramIndex::Set(uint32_t Section, FHitProgram Program)
{
	const uint32_t Old = OfSections[Section];
	if (Old != NoProgram && Programs[Old].Program == Program) { return false; }
	SetIndex(Section, FindIndex(Program));
	return true;
}

uint32_t FHitProgramIndex::FindIndex(FHitProgram Program)
{
	const auto [Found, bNew] = IndexOfProgram.try_emplace(Program, GetCount());
	if (!bNew) { return Found->second; }
	++IndicesRevision;
	if (FreeIndices.empty())
	{
		Programs.push_back({Program, 0});
		return Found->second;
	}
	Found->second = FreeIndices.back();
	FreeIndices.pop_back();
	Programs[Found->second] = {Program, 0};
	return Found->second;
}

void FHitProgramIndex::SetIndex(uint32_t Section, uint32_t Index)
{
	const uint32_t Old = std::exchange(OfSections[Section], Index);
	if (Old == Index) { return; }
	if (Index != NoProgram && Programs[Index].Sections++ == 0) { bInUseStale = true; }
	if (Old != NoProgram && --Programs[Old].Sections == 0)
	{
		IndexOfProgram.erase(Programs[Old].Program);
		FreeIndices.push_back(Old);
		bInUseStale = true;
	}
}

const std::vector<FHitProgram>& FHitProgramIndex::GetInUse()
{
	if (!std::exchange(bInUseStale, false)) { return InUse; }
	InUse.clear();
	for (const auto& [Program, Index] : IndexOfProgram) { InUse.push_back(Program); }
	std::sort(InUse.begin(), InUse.end());
	return InUse;
}

} // namespace Lantern
