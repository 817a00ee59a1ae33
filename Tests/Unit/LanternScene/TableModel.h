// What a ray must reach, said without FSectionTable, FShaderTable and FRTPSO: each object keeps its materials, and
// each pipeline the names of what was put into it.
#pragma once

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "LanternScene/Pipelines/RTPSO.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

/// Names of a hit group's shaders, as the mock tells them.
struct FGroupNames
{
	std::string ClosestHit, AnyHit, Intersection;
	friend bool operator==(const FGroupNames&, const FGroupNames&) = default;
};

struct FModelPipeline
{
	std::string Name; ///< no two have the same
	uint32_t RayTypes = 1;
	std::set<FHitProgram> Ready;
	std::array<bool, HitClassCount> HasStandIn = {};
	FRTPSO Pipeline;

	/// What a hit of this program runs.
	FGroupNames Expect(FHitProgram Program, uint32_t RayType) const;
	/// Groups in an order of their own. Number: of the pipeline.
	static std::shared_ptr<FModelPipeline> Make(IRTDevice& Device, uint32_t Number, uint32_t RayTypes, uint32_t Random);
};

struct FModelMaterial
{
	bool bMasked = false, bDoubleSided = false, bSecondUV = false;
	uint32_t Program = 0;
	FMaterialData ToData() const;
};

/// What the record of a part must hold.
struct FModelSection
{
	FSectionData Data{};
	FHitProgram Program;
};
FModelSection ExpectSection(
    const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t MaterialIndex, const FModelMaterial& Material, bool bAlphaTest);

} // namespace Lantern
