// FGeometryEntry: how the store changes a geometry.
#include "Geometry/GeometryEntry.h"

#include <utility>

#include "Geometry/CoarserLevel.h"
#include "Geometry/GeometryCompactor.h"

namespace Lantern
{

void FGeometryEntry::Bind(const std::shared_ptr<FRTGeometry>& NewGeometry, uint32_t NewSlot)
{
	NewGeometry->Slot = Slot = NewSlot;
	Owner = NewGeometry;
	Geometry = NewGeometry.get();
}

void FGeometryEntry::SetStructure(TRTRef<IRTGeometry> Structure) { Geometry->Structure = std::move(Structure); }

void FGeometryEntry::SetBuilt(bool bBuilt) { Geometry->bBuilt = bBuilt; }

void FGeometryEntry::SetFilled() { Geometry->Info.bWaitsForData = false; }

void FGeometryEntry::SetClassified(bool bClassified)
{
	Geometry->bClassified = bClassified;
	Geometry->Parts = MakeGeometryParts(Geometry->Info, bClassified);
}

void FGeometryEntry::SetCoarserLevel(std::unique_ptr<FCoarserLevel> Level) { Geometry->Coarser = std::move(Level); }

FCoarserLevel* FGeometryEntry::GetCoarserLevel() const { return Geometry->Coarser.get(); }

void FGeometryEntry::UseCoarserLevel(TRTRef<IRTBuffer> Indices)
{
	Geometry->Indices = std::move(Indices);
	Geometry->IndicesOffset = 0;
	Geometry->IndexType = ERTIndexType::UInt32;
	Geometry->Parts = Geometry->Coarser->GetParts();
	Geometry->bCoarse = true;
	Geometry->Coarser = nullptr;
}

FRTGeometryDesc FGeometryEntry::MakeDesc(const std::vector<FRTGeometrySection>& Sections) const
{
	const FRTGeometryInfo& Info = Geometry->Info;
	FRTGeometryDesc Desc;
	Desc.Sections = Sections.data();
	Desc.SectionCount = static_cast<uint32_t>(Sections.size());
	Desc.bAllowUpdate = Info.bDynamic;
	Desc.bFastBuild = Info.bDynamic;
	Desc.bAllowCompaction = Geometry->Structure ? bCompactable : !Info.bDynamic && FGeometryCompactor::IsOn();
	Desc.Name = Info.Name.c_str();
	return Desc;
}

void FGeometryEntry::UpdateSizes(IRTDevice& Device)
{
	const std::vector<FRTGeometrySection> Sections = MakeStructureSections(*Geometry);
	Sizes = Device.GetGeometrySizes(MakeDesc(Sections));
	Triangles = Geometry->GetPrimitiveCount();
}

} // namespace Lantern
