// FRangeBindings derives the FInstanceBinding of each section range: geometry address, first hit record and flags.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/Instances/InstanceStore.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

/// Threads: one at a time.
class FRangeBindings
{
public:
	/// Sets how many hit records each section has.
	void SetRayTypes(uint32_t Count);
	/// Objects with a section of one of these programs get no binding, so that rays do not see them.
	void SetMissingPrograms(std::vector<FHitProgram> Programs);
	/// Tells whether Update would do anything.
	bool NeedsUpdate(const FSectionTable& Sections) const { return bBindAll || Sections.HasChangedRanges(); }
	/// Takes the changed ranges of Sections and writes their bindings to Instances. O(changed ranges), or O(all ranges) after
	/// one of the setters above changed something. Returns whether rays see objects that they did not see before, or the reverse.
	bool Update(FSectionTable& Sections, const FGeometryStore& Geometries, FInstanceStore& Instances);
	/// Unsupported: an instance cannot name the first hit record of every section with its 24 bits.
	FRTStatus CheckLimits(const FSectionTable& Sections) const;

private:
	FInstanceBinding Make(const FSectionTable& Sections, const FSectionRange& Range, const FGeometryStore& Geometries) const;
	bool IsProgramMissing(const FSectionTable& Sections, const FSectionRange& Range) const;

	std::vector<FHitProgram> MissingPrograms; // sorted
	uint32_t RayTypes = 1;
	bool bBindAll = false;
};

} // namespace Lantern
