// CheckGeometry: sections, their buffers and the number of primitives.
#include "Geometry/GeometryCheck.h"

#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{
/// Null: Section is right.
const char* FindFault(const FRTGeometryInfo& Info, const FRTSectionInfo& Section)
{
	if (Section.bProcedural)
	{
		if (Section.IndexCount == 0) { return "no boxes"; }
		return Info.Aabbs ? nullptr : "boxes, but no buffer of them";
	}
	if (Section.IndexCount < 3) { return "no triangles"; }
	if (Section.IndexCount % 3 != 0) { return "the number of indices is not a multiple of 3"; }
	if (!Info.Positions || !Info.Attributes || !Info.Indices) { return "a buffer is missing"; }
	const bool bBase = Section.FirstVertex > 0;
	if (bBase && (!Info.bStreams || Section.FirstVertex >= Info.VertexCount))
	{
		return "FirstVertex without streams, or behind all vertices";
	}
	const uint64_t Classified = uint64_t(Section.OpaqueIndexCount) + Section.TransparentIndexCount;
	return Classified > Section.IndexCount ? "more classified triangles than triangles" : nullptr;
}
} // namespace

FRTStatus CheckGeometry(const FRTGeometryInfo& Info, uint64_t MaxPrimitives)
{
	if (Info.Sections.empty())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "geometry \"%s\" has no section", FRTShown(Info.Name.c_str()).Text);
	}
	uint64_t Primitives = 0;
	for (size_t Index = 0; Index < Info.Sections.size(); ++Index)
	{
		const FRTSectionInfo& Section = Info.Sections[Index];
		if (const char* const Fault = FindFault(Info, Section))
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "geometry \"%s\", section %zu: %s", FRTShown(Info.Name.c_str()).Text, Index, Fault);
		}
		Primitives += Section.bProcedural ? Section.IndexCount : Section.IndexCount / 3;
	}
	if (Primitives > MaxPrimitives)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s has %llu triangles; the device allows %llu", FRTShown(Info.Name.c_str()).Text,
		    static_cast<unsigned long long>(Primitives), static_cast<unsigned long long>(MaxPrimitives));
	}
	return FRTStatus::Success();
}

} // namespace Lantern
