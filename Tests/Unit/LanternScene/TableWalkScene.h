// What a walk changes: objects, materials and geometries over a table of sections, and what their records must hold.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "LanternScene/ShaderTable/SectionTable.h"
#include "TableModel.h"
#include "TableWalk.h"

namespace Lantern
{

struct FWalkObject
{
	uint32_t Geometry = 0;
	std::vector<uint32_t> Materials;
	FSectionRangeId Range = 0;
};

struct FExpectation
{
	uint32_t Section = 0; ///< number, as the instance names it
	FModelSection Has;
};

class FWalkScene
{
public:
	explicit FWalkScene(IRTDevice& Device);
	/// Steps that change the scene; others do nothing.
	void Do(const FWalkStep& Step);
	/// Of everything that a ray can reach.
	std::vector<FExpectation> MakeExpectations() const;
	FSectionTable& GetSections() { return Sections; }
	const std::vector<FWalkObject>& GetObjects() const { return Objects; }
	const std::string& GetFailure() const { return Failure; } ///< empty: none

private:
	void Add(uint32_t Geometry, uint32_t Random);
	void Remove(uint32_t Index);
	void SetMaterials(FWalkObject& Object, uint32_t Random);
	void EditMaterial(const FWalkStep& Step);
	void ChangeGeometry(const FWalkStep& Step);
	std::vector<uint32_t> DrawMaterials(uint32_t Geometry, uint32_t Random) const;
	void MakeGeometries();
	TRTRef<IRTBuffer> MakeBuffer(uint64_t Size);

	IRTDevice& Device;
	std::vector<FModelMaterial> ModelMaterials;
	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> Programs;
	FSectionContext Context{Materials, Programs};
	FSectionTable Sections{Context};
	std::vector<std::unique_ptr<FRTGeometry>> Geometries;
	std::vector<FWalkObject> Objects;
	std::string Failure;
};

} // namespace Lantern
