// FCoarserLevel: quadric error simplification (Garland & Heckbert, "Surface Simplification Using Quadric Error Metrics",
// SIGGRAPH 1997). Vertex clustering follows where seams and borders stop it short of the target. meshoptimizer has them.
#include "Geometry/CoarserLevel.h"

#include <algorithm>
#include <new>

#include <meshoptimizer.h>

namespace Lantern
{

namespace
{
constexpr float AnyError = 1e4f; // relative to the extents: memory decides, not looks
constexpr float ClusterError = 1.0f;

/// Appends a coarser version of the Count indices at First.
void SimplifySection(const FRTGeometryInfo& Info, uint32_t First, uint32_t Count, size_t Target, std::vector<uint32_t>& Out)
{
	const uint32_t* const Source = Info.CpuIndices + First;
	const float* const Positions = &Info.CpuPositions[0].x;
	std::vector<uint32_t> Result(Count);
	size_t Length =
	    meshopt_simplify(Result.data(), Source, Count, Positions, Info.VertexCount, sizeof(glm::vec3), Target, AnyError, 0, nullptr);
	if (Length > Target)
	{
		std::vector<uint32_t> Clustered(Count);
		const size_t Fewer = meshopt_simplifySloppy(
		    Clustered.data(), Source, Count, Positions, Info.VertexCount, sizeof(glm::vec3), Target, ClusterError, nullptr);
		if (Fewer > 0 && Fewer < Length)
		{
			Result = std::move(Clustered);
			Length = Fewer;
		}
	}
	if (Length == 0) { Length = std::copy_n(Source, 3, Result.begin()) - Result.begin(); } // no section may be empty
	Out.insert(Out.end(), Result.begin(), Result.begin() + static_cast<ptrdiff_t>(Length));
}
} // namespace

FCoarserLevel::FCoarserLevel(const FRTGeometryInfo& Info, double Share)
{
	Task.Run([this, &Info, Share] {
		try
		{
			Make(Info, Share);
		}
		catch (const std::bad_alloc&) // a task must not throw, and no geometry is worth the program
		{
			Indices.clear();
		}
		bDone.store(true, std::memory_order_release);
	});
}

void FCoarserLevel::Make(const FRTGeometryInfo& Info, double Share)
{
	for (uint32_t Section = 0; Section < Info.Sections.size(); ++Section)
	{
		if (bCancel) { return Indices.clear(); }
		const FRTSectionInfo& From = Info.Sections[Section];
		const size_t Target = std::max<size_t>(1, static_cast<size_t>(From.IndexCount / 3 * Share)) * 3;
		const uint32_t First = static_cast<uint32_t>(Indices.size());
		SimplifySection(Info, From.FirstIndex, From.IndexCount, Target, Indices);
		Parts.push_back({First, static_cast<uint32_t>(Indices.size()) - First, Section, From.bOpaque});
	}
}

} // namespace Lantern
