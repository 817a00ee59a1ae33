#include "LanternScene/Scene/Scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>

#include "Geometry/MergeAdvice.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
/// An upper bound of how much a transform stretches, exact where its axes stay at right angles: the largest row sum of
/// MᵀM bounds the square of its largest singular value (Gershgorin).
uint32_t PackTranslationRest(const glm::dmat4& Transform, const FObjectData& Data)
{
	uint32_t Packed = 0;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const double Rest = Transform[3][Axis] - CellCenter(Data.Cell)[Axis] - double(Data.ObjectToWorld[Axis].w);
		// What is no number, or too far away for cells, is left as it is.
		const double Steps = std::abs(Rest) < 1e-3 ? std::clamp(std::round(Rest * 33'554'432.0), -512.0, 511.0) : 0.0;
		Packed |= (static_cast<uint32_t>(static_cast<int32_t>(Steps)) & 1023u) << (2 + 10 * Axis);
	}
	return Packed;
}

double GetStretch(const glm::dmat4& Transform)
{
	const glm::dmat3 Linear(Transform);
	const glm::dmat3 Gram = glm::transpose(Linear) * Linear;
	double Largest = 0.0;
	for (int Row = 0; Row < 3; ++Row)
	{
		Largest = std::max(Largest, std::abs(Gram[0][Row]) + std::abs(Gram[1][Row]) + std::abs(Gram[2][Row]));
	}
	return std::sqrt(Largest);
}
/// From so many objects less, merging is worth a line in the log.
constexpr uint32_t LeastMergeSaving = 64;
} // namespace

FRTScene::FRTScene(IRTDevice& InDevice) : Device(InDevice) {}
FRTScene::~FRTScene() { GatherTasks.Wait(); }

FRTStatus FRTScene::CreateGeometry(FRTGeometryInfo Info, FRTGeometryRef& Out) { return Geometries.Create(std::move(Info), Out); }

void FRTScene::MarkDeformed(const FRTGeometryRef& Geometry)
{
	Geometries.MarkDeformed(Geometry);
	Motions.MarkDeformed(Geometry);
}

// ---------------------------------------------------------------------------------------------------- materials

uint32_t FRTScene::AddMaterial(const FMaterialData& Material, uint32_t Program)
{
	if (!FreeMaterials.empty())
	{
		const uint32_t Index = FreeMaterials.back();
		FreeMaterials.pop_back();
		Materials.Set(Index, Material);
		MaterialPrograms[Index] = Program;
		return Index;
	}
	MaterialPrograms.push_back(Program);
	return Materials.Add(Material);
}

void FRTScene::RemoveMaterial(uint32_t Index)
{
	assert(Index < Materials.Num() && !Sections.IsMaterialUsed(Index));
	FreeMaterials.push_back(Index);
}

void FRTScene::SetMaterial(uint32_t Index, const FMaterialData& Material)
{
	assert(Index < Materials.Num());
	const FMaterialData Old = Materials[Index];
	if (Old.EmissiveWeight != Material.EmissiveWeight) { bEmissiveChanged = bEmissiveObjectsChanged = true; }
	Materials.Set(Index, Material);
	// An animated colour or roughness goes no further.
	if (FSectionTable::AffectsSections(Old, Material)) { Sections.MaterialChanged(Index); }
}

void FRTScene::SetMaterialProgram(uint32_t Index, uint32_t Program)
{
	assert(Index < Materials.Num());
	if (std::exchange(MaterialPrograms[Index], Program) == Program) { return; }
	Sections.MaterialChanged(Index);
}

void FRTScene::SetMaterialOverride(uint32_t Override)
{
	if (std::exchange(SectionContext.Override, Override) != Override) { Sections.RefillAll(); }
}

void FRTScene::SetAlphaTest(bool bEnabled)
{
	if (std::exchange(SectionContext.bAlphaTest, bEnabled) != bEnabled) { Sections.RefillAll(); }
}

void FRTScene::SetRayTypes(uint32_t Count) { bBindAll |= std::exchange(RayTypes, Count) != Count; }

void FRTScene::SetMissingPrograms(std::vector<FHitProgram> Programs)
{
	std::sort(Programs.begin(), Programs.end());
	if (Programs == MissingPrograms) { return; }
	MissingPrograms = std::move(Programs);
	bBindAll = true;
}

// ---------------------------------------------------------------------------------------------------- objects

/// ~0: none is left.
uint32_t FRTScene::TakeObjectSlot()
{
	if (!FreeObjects.empty() && FreeObjects.front() < Objects.size())
	{
		std::pop_heap(FreeObjects.begin(), FreeObjects.end(), std::greater());
		const uint32_t Index = FreeObjects.back();
		FreeObjects.pop_back();
		return Index;
	}
	FreeObjects.clear(); // all of them are behind the end
	const auto Index = static_cast<uint32_t>(Objects.size());
	if (Index > MaxInstanceIndex) { return ~0u; }
	Objects.emplace_back().Generation = GenerationFloor;
	return Index;
}

void FRTScene::FreeObjectSlot(uint32_t Index)
{
	Objects[Index].Info = {};
	Objects[Index].bAlive = false;
	++Objects[Index].Generation;
	FreeObjects.push_back(Index);
	std::push_heap(FreeObjects.begin(), FreeObjects.end(), std::greater());
	while (!Objects.empty() && !Objects.back().bAlive)
	{
		GenerationFloor = std::max(GenerationFloor, Objects.back().Generation);
		Objects.pop_back();
	}
	ObjectData.Truncate(static_cast<uint32_t>(Objects.size()));
	Motions.Truncate(static_cast<uint32_t>(Objects.size()));
	if (Objects.capacity() / 4 > Objects.size() + 64) { Objects.shrink_to_fit(); }
}

FRTObjectId FRTScene::AddObject(FRTObjectInfo Info)
{
	assert(Info.Geometry && Info.Materials.size() == Info.Geometry->GetSectionCount());
	const uint32_t Index = TakeObjectSlot();
	if (Index == ~0u)
	{
		LogOnce(ERTLogLevel::Error, "the scene has 2^24 objects; an instance cannot name more, and further ones are left out");
		return {};
	}
	FObject& Object = Objects[Index];
	Object.Info = std::move(Info);
	Object.bAlive = true;
	Object.Range = Sections.Acquire(*Object.Info.Geometry, Object.Info.Materials);
	Motions.Add(Index, *Object.Info.Geometry);
	WriteObject(Index);
	MarkEmissive(Object.Range);
	return {Index, Object.Generation};
}

void FRTScene::RemoveObject(FRTObjectId Id)
{
	FObject& Object = Resolve(Id);
	MarkEmissive(Object.Range);
	Instances.Remove(Id.Index);
	Motions.Remove(Id.Index);
	Pivots.Remove(Id.Index);
	Sections.Release(Object.Range);
	Retired.push_back(std::move(Object.Info.Geometry));
	FreeObjectSlot(Id.Index);
}

FRTScene::FObject& FRTScene::Resolve(FRTObjectId Id)
{
	assert(Id.Index < Objects.size() && Objects[Id.Index].bAlive && Objects[Id.Index].Generation == Id.Generation);
	return Objects[Id.Index];
}

const FRTScene::FObject& FRTScene::Resolve(FRTObjectId Id) const { return const_cast<FRTScene*>(this)->Resolve(Id); }

void FRTScene::SetTransform(FRTObjectId Id, const glm::dmat4& Transform)
{
	FObject& Object = Resolve(Id);
	Motions.BeforeMove(Id.Index);
	Object.Info.Transform = Transform;
	WriteObject(Id.Index);
	bEmissiveChanged |= Sections.GetRange(Object.Range).bEmissive;
}

void FRTScene::SetMaterials(FRTObjectId Id, std::vector<uint32_t> SectionMaterials)
{
	FObject& Object = Resolve(Id);
	const FSectionRangeId Range = Sections.Acquire(*Object.Info.Geometry, SectionMaterials);
	MarkEmissive(Object.Range);
	MarkEmissive(Range);
	Sections.Release(std::exchange(Object.Range, Range));
	Object.Info.Materials = std::move(SectionMaterials);
	WriteObject(Id.Index);
}

const FRTObjectInfo& FRTScene::GetObject(FRTObjectId Id) const { return Resolve(Id).Info; }
uint32_t FRTScene::GetFirstSection(FRTObjectId Id) const { return FirstSectionOf(Resolve(Id)); }

void FRTScene::MarkEmissive(FSectionRangeId Range)
{
	if (Sections.GetRange(Range).bEmissive) { bEmissiveChanged = bEmissiveObjectsChanged = true; }
}

void FRTScene::WriteObject(uint32_t Index)
{
	const FObject& Object = Objects[Index];
	const glm::dmat4& Transform = Object.Info.Transform;
	const FRTGeometryInfo& Geometry = Object.Info.Geometry->GetInfo();
	FInstancePlacement Placement;
	Placement.Transform = Transform;
	if (Geometry.BoundsRadius >= 0.0f)
	{
		Placement.Center = glm::dvec3(Transform * glm::dvec4(Geometry.BoundsCenter, 1.0));
		Placement.Radius = GetStretch(Transform) * double(Geometry.BoundsRadius);
	}
	Pivots.Set(Index, glm::dvec3(Transform[3]), Placement.Center, Placement.Radius);
	Placement.Range = Object.Range;
	Placement.Group = Object.Info.Group;
	Placement.Mask = Object.Info.Mask;
	Instances.Set(Index, Placement);

	FObjectData Data{};
	std::memcpy(Data.ObjectToWorld, Instances.GetTransform(Index), sizeof(Data.ObjectToWorld));
	Data.FirstSection = FirstSectionOf(Object);
	Data.Cell = Instances.GetRecord(Index).Cell;
	Data.Flags = (glm::determinant(glm::dmat3(Transform)) < 0.0 ? OBJECT_MIRRORED : 0u) | PackTranslationRest(Transform, Data);
	Data.Motion = Motions.GetEntry(Index);
	ObjectData.Set(Index, Data);
}

// ---------------------------------------------------------------------------------------------------- facts

const FSceneFacts& FRTScene::RefreshFacts()
{
	UpdateOpacity(); // which hit programs there are depends on it
	Facts.Objects = Instances.GetCount();
	Facts.DynamicGeometries = Geometries.GetDynamicCount();
	Facts.Lights = static_cast<uint32_t>(Lights.size());
	Facts.EmissiveTriangles = EmissiveTriangles.Num();
	Facts.bMasked = Sections.GetMaskedRangeCount() > 0;
	Facts.bOwnShapes = std::any_of(Sections.GetHitPrograms().begin(), Sections.GetHitPrograms().end(), [](FHitProgram Program) {
		return Program.Class == ERTHitClass::Procedural || (Program.Class == ERTHitClass::Masked && Program.Program != StandardProgram);
	});
	Facts.bEmissive = Sections.GetEmissiveRangeCount() > 0;
	Facts.bSun = Sun.Irradiance > 0.0f;
	Facts.bSky = glm::any(glm::greaterThan(Sky, glm::vec3(0)));
	return Facts;
}

void FRTScene::AdviseMerging()
{
	bAdvised = true;
	const FMergeAdvice Advice = FindMergeable([this](const std::function<void(const FRTObjectInfo&)>& Visit) {
		for (const FObject& Object : Objects)
		{
			if (Object.bAlive) { Visit(Object.Info); }
		}
	});
	if (Advice.Objects - Advice.Materials < LeastMergeSaving) { return; }
	LogInfo(
	    "Scene: {} of {} objects are meshes of one section below {} triangles, used once, that share their material with others. Merged "
	    "by material they would be {}: {} acceleration structures and instances fewer.",
	    Advice.Objects, Instances.GetCount(), FMergeAdvice::SmallTriangles, Advice.Materials, Advice.Objects - Advice.Materials);
}

} // namespace Lantern
