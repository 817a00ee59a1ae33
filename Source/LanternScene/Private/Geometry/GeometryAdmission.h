// Decides for each build that is due: it starts, it waits for memory, its geometry is made coarser, or it is refused.
#pragma once

#include <cstdint>

#include "Geometry/GeometryBuilder.h"
#include "Geometry/GeometryCoarsener.h"
#include "Geometry/GeometryCompactor.h"
#include "Geometry/GeometryContext.h"
#include "Geometry/GeometryRefusals.h"

namespace Lantern
{

/// Threads: render thread.
class FGeometryAdmission
{
public:
	/// Frames for which a geometry that does not fit merely waits: others may release memory meanwhile.
	static constexpr uint32_t PatienceFrames = 8;
	/// Frames for which a geometry that the next release could make room for holds others back.
	static constexpr uint32_t MostWaitFrames = 32;

	FGeometryAdmission(FGeometryContext& Context, FGeometryBuilder& Builder, FGeometryCompactor& Compactor, FGeometryCoarsener& Coarsener,
	    FGeometryRefusals& Refusals);

	/// Share: bytes that the build may take at most.
	/// With bBuildAll nothing waits: a geometry that does not fit is made coarser at once, or is refused.
	/// Sets bOutStop if builds behind this one must not take the memory that it waits for. The entry stays Pending if it
	/// waits. Out of device memory counts as not fitting, except with bBuildAll.
	FRTStatus Admit(FGeometryEntry& Entry, bool bBuildAll, uint64_t Share, bool& bOutStop);

private:
	bool IsMemoryComing() const { return Context.Memory.IsReleasing() || Compactor.IsBusy(); }
	/// Room: bytes that the geometry could have.
	FRTStatus OnMisfit(FGeometryEntry& Entry, bool bBuildAll, uint64_t Room);

	FGeometryContext& Context;
	FGeometryBuilder& Builder;
	FGeometryCompactor& Compactor;
	FGeometryCoarsener& Coarsener;
	FGeometryRefusals& Refusals;
};

} // namespace Lantern
