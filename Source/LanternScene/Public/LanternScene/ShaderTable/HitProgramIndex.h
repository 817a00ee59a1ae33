// FHitProgramIndex gives each hit program in use a small number, and keeps that of each section. What is looked up for a
// program, such as its shader groups, can then be kept in an array.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "LanternScene/Pipelines/MaterialPrograms.h"

namespace Lantern
{

/// Threads: one at a time; functions that only read may run on several.
class FHitProgramIndex
{
public:
	/// Makes room for sections below Count. New ones have no program.
	void Resize(uint32_t SectionCount) { OfSections.resize(SectionCount, NoProgram); }
	/// Returns whether the section had another program, or none.
	bool Set(uint32_t Section, FHitProgram Program);
	/// Takes the program from the section.
	void Clear(uint32_t Section) { SetIndex(Section, NoProgram); }

	/// Returns the number of the section's program, < GetCount(). It is 0 for sections without a program.
	uint32_t GetIndex(uint32_t Section) const { return OfSections[Section]; }
	FHitProgram GetProgram(uint32_t Section) const { return Programs[OfSections[Section]].Program; }
	uint32_t GetCount() const { return static_cast<uint32_t>(Programs.size()); }
	FHitProgram GetProgramAt(uint32_t Index) const { return Programs[Index].Program; }
	/// Changes whenever GetProgramAt would answer something else.
	uint64_t GetIndicesRevision() const { return IndicesRevision; }
	/// Returns all programs in use, sorted.
	const std::vector<FHitProgram>& GetInUse();

private:
	static constexpr uint32_t NoProgram = 0;
	struct FProgramUse
	{
		FHitProgram Program;
		uint32_t Sections = 0;
	};
	uint32_t FindIndex(FHitProgram Program);
	void SetIndex(uint32_t Section, uint32_t Index);

	std::vector<uint32_t> OfSections;
	std::vector<FProgramUse> Programs{FProgramUse{}};
	std::unordered_map<FHitProgram, uint32_t> IndexOfProgram; // in use only
	std::vector<uint32_t> FreeIndices;
	std::vector<FHitProgram> InUse; // sorted; as of the last GetInUse
	uint64_t IndicesRevision = 0;
	bool bInUseStale = false;
};

} // namespace Lantern
