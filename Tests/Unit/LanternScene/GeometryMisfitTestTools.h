// The parts of FGeometryStore that deal with geometry that does not fit into memory.
#pragma once

#include "Geometry/CoarserLevel.h"
#include "Geometry/GeometryAdmission.h"
#include "Geometry/GeometryCoarsener.h"
#include "Geometry/GeometryRefusals.h"
#include "GeometryContextTestTools.h"

namespace Lantern
{

class FGeometryMisfitTest : public FGeometryContextTest
{
protected:
	void SetUp() override
	{
		FGeometryContextTest::SetUp();
		Refusals = std::make_unique<FGeometryRefusals>(*Context);
		Coarsener = std::make_unique<FGeometryCoarsener>(*Context, *Refusals);
		Admission = std::make_unique<FGeometryAdmission>(*Context, *Builder, *Compactor, *Coarsener, *Refusals);
	}
	void TearDown() override
	{
		Admission.reset();
		Coarsener.reset();
		Refusals.reset();
		FGeometryContextTest::TearDown();
	}
	/// A terrain of 3,200 triangles with data on the CPU.
	FRTGeometryRef AddTerrain(const std::string& Name) { return Add(MakeTerrain(Name, 40)); }
	uint64_t GetBuildBytes(const FRTGeometryRef& Geometry) { return Context->Scratch.GetBuildBytes(Entry(Geometry).Sizes); }

	std::unique_ptr<FGeometryRefusals> Refusals;
	std::unique_ptr<FGeometryCoarsener> Coarsener;
	std::unique_ptr<FGeometryAdmission> Admission;
};

} // namespace Lantern
