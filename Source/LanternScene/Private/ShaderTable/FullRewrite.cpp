// The full rewrite of the shader table, a baseline: no batches, no tasks, nothing looked up in advance.
#include "ShaderTable/FullRewrite.h"

#include "LanternScene/Pipelines/RTPSO.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

uint32_t RewriteHitRecords(IRTShaderTable& Table, const FRTPSO& Pipeline, const FSectionTable& Sections)
{
	const uint32_t RayTypes = Pipeline.GetRayTypeCount();
	uint32_t Written = 0;
	for (FSectionRangeId Id = 0; Id < Sections.GetRangeCapacity(); ++Id)
	{
		const FSectionRange& Range = Sections.GetRange(Id);
		if (!Range.Geometry) { continue; }
		for (uint32_t Section = Range.First; Section < Range.First + Range.Count; ++Section)
		{
			const FSectionData& Data = Sections.Get(Section);
			const FHitProgram Program = Sections.GetHitProgram(Section);
			for (uint32_t Type = 0; Type < RayTypes; ++Type)
			{
				Table.SetRecord(ERTRecordKind::Hit, Section * RayTypes + Type, Pipeline.HitGroup(Type, Program), &Data, sizeof(Data));
			}
		}
		Written += Range.Count * RayTypes;
	}
	return Written;
}

} // namespace Lantern
