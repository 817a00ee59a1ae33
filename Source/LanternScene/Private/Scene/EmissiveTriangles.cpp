// FEmissiveTriangles: the list is made on the CPU, from the positions that geometry keeps there.
#include "LanternScene/Scene/EmissiveTriangles.h"

#include <algorithm>
#include <cmath>
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

void FEmissiveTriangles::MarkMoved(uint32_t Object)
{
	// Where no light is sampled, nobody takes them.
	constexpr size_t Most = 4096;
	if (bStale) { return; }
	if (Moved.size() < Most) { return Moved.push_back(Object); }
	Moved.clear();
	bStale = true;
}

bool FEmissiveTriangles::UpdateMoved(const FSceneObjects& Objects, const FSceneMaterials& Materials)
{
	constexpr double LeastChange = 1e-5; // of the power: a rotation rounds areas
	std::sort(Moved.begin(), Moved.end());
	Moved.erase(std::unique(Moved.begin(), Moved.end()), Moved.end());
	for (const uint32_t Object : Moved)
	{
		const auto Found = std::lower_bound(
		    Sources.begin(), Sources.end(), Object, [](const FSource& Source, uint32_t Key) { return Source.Object < Key; });
		if (Found == Sources.end() || Found->Object != Object) { continue; }
		FList List;
		AddTriangles(Object, Objects, Materials, List);
		Visited += static_cast<uint32_t>(List.Triangles.size());
		const bool bSamePower = std::abs(List.Power - Found->Power) <= LeastChange * Found->Power;
		if (List.Triangles.size() != Found->Count || !bSamePower) { return false; }
		for (uint32_t I = 0; I < Found->Count; ++I)
		{
			const FEmissiveTriangle& Old = Table[Found->First + I];
			List.Triangles[I].CumulativePower = Old.CumulativePower;
			List.Triangles[I].Cluster = Old.Cluster;
			List.Triangles[I].ClusterShare = Old.ClusterShare;
			Table.Set(Found->First + I, List.Triangles[I]);
		}
	}
	return true;
}

namespace
{
/// Whether two triangles lie in one plane and face the same way, as those of a rectangle do.
bool AreCoplanar(const FEmissiveTriangle& A, const FEmissiveTriangle& B)
{
	const glm::dvec3 Across = glm::cross(glm::dvec3(A.P1 - A.P0), glm::dvec3(A.P2 - A.P0));
	const glm::dvec3 Other = glm::cross(glm::dvec3(B.P1 - B.P0), glm::dvec3(B.P2 - B.P0));
	const double Length = glm::length(Across), Size = std::sqrt(Length);
	const double Away = std::abs(glm::dot(Across, glm::dvec3(B.P0 - A.P0))) / Length;
	return glm::dot(Across, Other) >= (1.0 - 1e-7) * Length * glm::length(Other) && Away <= 1e-4 * Size;
}
} // namespace

/// Few triangles have clusters of their own, or one for a flat part, which then has a side that it shines to. Many are cut in pieces.
uint32_t FEmissiveTriangles::FindClusterEnd(const FList& List, uint32_t First, const FSource& Source, uint32_t Size)
{
	constexpr uint32_t MostFlat = 8;
	const uint32_t End = Source.First + Source.Count;
	if (Size > 1)
	{
		const uint32_t Pieces = (Source.Count + Size - 1) / Size;
		const uint32_t Even = (Source.Count + Pieces - 1) / Pieces; // the last one may be smaller
		return std::min(First + Even, End);
	}
	uint32_t Next = First + 1;
	while (Next < End && Next < First + MostFlat && AreCoplanar(List.Triangles[First], List.Triangles[Next])) { ++Next; }
	return Next;
}

void FEmissiveTriangles::MakeClusters(FList& InOut)
{
	std::vector<FEmissiveCluster> All;
	const auto Total = static_cast<uint32_t>(InOut.Triangles.size());
	const uint32_t Size = std::max((Total + EMISSIVE_CLUSTERS - 1) / EMISSIVE_CLUSTERS, 1u);
	for (const FSource& Source : Sources)
	{
		for (uint32_t First = Source.First, End; First < Source.First + Source.Count; First = End)
		{
			End = FindClusterEnd(InOut, First, Source, Size);
			const double Before = First > 0 ? InOut.Cumulative[First - 1] : 0.0, Whole = InOut.Cumulative[End - 1] - Before;
			for (uint32_t I = First; I < End; ++I)
			{
				InOut.Triangles[I].Cluster = static_cast<uint32_t>(All.size());
				InOut.Triangles[I].ClusterShare = I + 1 < End ? static_cast<float>((InOut.Cumulative[I] - Before) / Whole) : 1.0f;
			}
			All.push_back({First, End - First, static_cast<float>(Whole), 0});
		}
	}
	Clusters.Assign(All);
}

void FEmissiveTriangles::Update(const FSceneObjects& Objects, const FSceneMaterials& Materials)
{
	Visited = 0;
	const bool bDone = !bStale && UpdateMoved(Objects, Materials);
	Moved.clear();
	if (bDone) { return; }
	if (bObjectsStale) { ListObjects(Objects, Materials); }
	FList List;
	Sources.clear();
	for (const uint32_t Object : EmissiveObjects)
	{
		const auto First = static_cast<uint32_t>(List.Triangles.size());
		const double Before = List.Power;
		AddTriangles(Object, Objects, Materials, List);
		Sources.push_back({Object, First, static_cast<uint32_t>(List.Triangles.size()) - First, List.Power - Before});
	}
	Visited += static_cast<uint32_t>(List.Triangles.size());
	Power = static_cast<float>(List.Power);
	for (size_t I = 0; I < List.Triangles.size(); ++I)
	{
		List.Triangles[I].CumulativePower = static_cast<float>(List.Cumulative[I] / List.Power);
	}
	if (!List.Triangles.empty()) { List.Triangles.back().CumulativePower = 1.0f; } // rounding must leave no gap above it
	MakeClusters(List);
	Table.Assign(std::move(List.Triangles));
	bStale = false;
}

} // namespace Lantern
