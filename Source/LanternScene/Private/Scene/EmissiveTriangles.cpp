// FEmissiveTriangles: the list is made on the CPU, from the positions that geometry keeps there.
#include "LanternScene/Scene/EmissiveTriangles.h"

#include <cstddef>
#include <utility>

#include "LanternScene/Scene/SceneMaterials.h"
#include "LanternScene/Scene/SceneObjects.h"

namespace Lantern
{

void FEmissiveTriangles::ListObjects(const FSceneObjects& Objects, const FSceneMaterials& Materials)
{
	EmissiveObjects.clear();
	for (uint32_t Slot = 0; Slot < Objects.GetSlotCount(); ++Slot)
	{
		if (Objects.Find(Slot) && Materials.GetSections().GetRange(Objects.GetRange(Slot)).bEmissive) { EmissiveObjects.push_back(Slot); }
	}
	bObjectsStale = false;
}

void FEmissiveTriangles::AddTriangles(uint32_t Index, const FSceneObjects& Objects, const FSceneMaterials& Materials, FList& Out)
{
	const FRTObjectInfo& Object = *Objects.Find(Index);
	const FRTGeometryInfo& Info = Object.Geometry->GetInfo();
	const FObjectData& Data = Objects.GetTable()[Index];
	const uint32_t FirstSection = Materials.GetSections().GetRange(Objects.GetRange(Index)).First;
	const glm::dvec3 Cell = CellCenter(Data.Cell);
	for (uint32_t Section = 0; Section < Info.Sections.size(); ++Section)
	{
		const FMaterialData& Material = Materials.GetTable()[Object.Materials[Section]];
		if ((Materials.GetSections().Get(FirstSection + Section).Flags & SECTION_LIGHT) == 0) { continue; }
		for (uint32_t Primitive = 0; Primitive < Info.Sections[Section].IndexCount / 3; ++Primitive)
		{
			glm::vec3 P[3];
			for (int Corner = 0; Corner < 3; ++Corner)
			{
				const uint32_t Vertex = Info.CpuIndices[Info.Sections[Section].FirstIndex + 3 * Primitive + Corner];
				P[Corner] = glm::vec3(glm::dvec3(Object.Transform * glm::dvec4(Info.CpuPositions[Vertex], 1.0)) - Cell);
			}
			const double Area = 0.5 * glm::length(glm::cross(glm::dvec3(P[1] - P[0]), glm::dvec3(P[2] - P[0])));
			if (!(Area > 0.0)) { continue; }
			Out.Power += Area * Material.EmissiveWeight;
			FEmissiveTriangle Triangle{};
			Triangle.P0 = P[0];
			Triangle.P1 = P[1];
			Triangle.P2 = P[2];
			Triangle.Object = Index;
			Triangle.Section = FirstSection + Section;
			Triangle.Primitive = Primitive;
			Triangle.Flags = Data.Flags & OBJECT_MIRRORED;
			Out.Triangles.push_back(Triangle);
			Out.Cumulative.push_back(Out.Power);
		}
	}
}

void FEmissiveTriangles::Update(const FSceneObjects& Objects, const FSceneMaterials& Materials)
{
	if (bObjectsStale) { ListObjects(Objects, Materials); }
	FList List;
	for (const uint32_t Object : EmissiveObjects) { AddTriangles(Object, Objects, Materials, List); }
	Power = static_cast<float>(List.Power);
	for (size_t I = 0; I < List.Triangles.size(); ++I)
	{
		List.Triangles[I].CumulativePower = static_cast<float>(List.Cumulative[I] / List.Power);
	}
	if (!List.Triangles.empty()) { List.Triangles.back().CumulativePower = 1.0f; } // rounding must leave no gap above it
	Table.Assign(std::move(List.Triangles));
	bStale = false;
}

} // namespace Lantern
