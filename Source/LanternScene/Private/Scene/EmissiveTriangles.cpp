// FEmissiveTriangles: lists of objects, sections and clusters. No vertex is read, but those of the few triangles of small scenes.
#include "LanternScene/Scene/EmissiveTriangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternScene/Scene/SceneMaterials.h"
#include "LanternScene/Scene/SceneObjects.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarFollow("r.RT.Debug.Lights.EmissiveFollow", true,
    "Planted fault. Off: emissive triangles stay where the first frame found them when a mesh deforms.");

// Where no light is sampled, nobody takes what is marked.
constexpr size_t MostMarked = 4096;

} // namespace

void FEmissiveTriangles::Mark(std::vector<uint32_t>& List, uint32_t Index)
{
	if (bStale || (bAllWanted && !bGiven)) { return; }
	if (List.size() >= MostMarked) { return MarkLists(); }
	List.push_back(Index);
}

void FEmissiveTriangles::MarkDeformed(uint32_t Object)
{
	if (CVarFollow.GetOnRenderThread()) { MarkMoved(Object); }
}

// ---------------------------------------------------------------------------------------------------- lists

void FEmissiveTriangles::ListObjects(const FSceneObjects& InObjects, const FSceneMaterials& InMaterials)
{
	EmissiveObjects.clear();
	for (uint32_t Slot = 0; Slot < InObjects.GetSlotCount(); ++Slot)
	{
		if (InObjects.Find(Slot) && InMaterials.GetSections().GetRange(InObjects.GetRange(Slot)).bEmissive)
		{
			EmissiveObjects.push_back(Slot);
		}
	}
	bObjectsStale = false;
}

void FEmissiveTriangles::ListRanges(const FSceneObjects& InObjects, const FSceneMaterials& InMaterials)
{
	std::vector<FEmissiveRange> All;
	Sources.clear();
	TriangleCount = 0;
	for (const uint32_t Object : EmissiveObjects)
	{
		FSource Source{Object, static_cast<uint32_t>(All.size()), 0, TriangleCount, 0, 0, 0};
		const std::vector<FRTSectionInfo>& Sections = InObjects.Find(Object)->Geometry->GetInfo().Sections;
		const uint32_t FirstSection = InMaterials.GetSections().GetRange(InObjects.GetRange(Object)).First;
		for (uint32_t Section = 0; Section < Sections.size(); ++Section)
		{
			if ((InMaterials.GetSections().Get(FirstSection + Section).Flags & SECTION_LIGHT) == 0) { continue; }
			All.push_back({TriangleCount, FirstSection + Section});
			TriangleCount += Sections[Section].IndexCount / 3;
		}
		Source.RangeCount = static_cast<uint32_t>(All.size()) - Source.FirstRange;
		Source.Count = TriangleCount - Source.First;
		if (Source.Count > 0) { Sources.push_back(Source); }
	}
	if (!All.empty()) { All.push_back({TriangleCount, 0}); }
	Ranges.Assign(All);
}

namespace
{
/// The triangles of an object that the CPU knows, in its own space.
struct FShape
{
	const FRTGeometryInfo& Info;
	uint32_t FirstSection = 0; // of the object

	/// Whether two triangles lie in one plane and face the same way, as those of a rectangle do.
	bool AreCoplanar(const FEmissiveRange& RangeA, uint32_t A, const FEmissiveRange& RangeB, uint32_t B) const
	{
		if (Info.bDynamic || !Info.CpuPositions) { return false; }
		const glm::dvec3 Origin = GetCorner(RangeA, A, 0);
		const glm::dvec3 Across = glm::cross(GetCorner(RangeA, A, 1) - Origin, GetCorner(RangeA, A, 2) - Origin);
		const glm::dvec3 OtherOrigin = GetCorner(RangeB, B, 0);
		const glm::dvec3 Other = glm::cross(GetCorner(RangeB, B, 1) - OtherOrigin, GetCorner(RangeB, B, 2) - OtherOrigin);
		const double Length = glm::length(Across);
		if (!(Length > 0.0)) { return false; }
		const double Away = std::abs(glm::dot(Across, OtherOrigin - Origin)) / Length;
		return glm::dot(Across, Other) >= (1.0 - 1e-7) * Length * glm::length(Other) && Away <= 1e-4 * std::sqrt(Length);
	}

private:
	glm::dvec3 GetCorner(const FEmissiveRange& Range, uint32_t Triangle, uint32_t Corner) const
	{
		const uint32_t First = Info.Sections[Range.Section - FirstSection].FirstIndex;
		return glm::dvec3(Info.CpuPositions[Info.CpuIndices[First + 3 * (Triangle - Range.First) + Corner]]);
	}
};
} // namespace

/// Few triangles have clusters of their own, or one for a flat part, which then has a side that it shines to. Many are cut in pieces.
void FEmissiveTriangles::ListClusters(const FSceneObjects& InObjects)
{
	constexpr uint32_t MostFlat = 8;
	std::vector<FEmissiveCluster> All;
	const uint32_t Size = std::max((TriangleCount + EMISSIVE_CLUSTERS - 1) / EMISSIVE_CLUSTERS, 1u);
	for (FSource& Source : Sources)
	{
		const FShape Shape{InObjects.Find(Source.Object)->Geometry->GetInfo(), InObjects.GetTable()[Source.Object].FirstSection};
		const uint32_t End = Source.First + Source.Count, Pieces = (Source.Count + Size - 1) / Size;
		const uint32_t Even = (Source.Count + Pieces - 1) / Pieces; // the last one may be smaller
		uint32_t Range = Source.FirstRange;
		const auto FindRange = [&](uint32_t From, uint32_t Triangle) {
			while (Ranges[From + 1].First <= Triangle) { ++From; }
			return From;
		};
		Source.FirstCluster = static_cast<uint32_t>(All.size());
		for (uint32_t First = Source.First, Next; First < End; First = Next)
		{
			Range = FindRange(Range, First);
			Next = std::min(First + Even, End);
			if (Size == 1)
			{
				const auto IsBeside = [&](uint32_t Other) {
					return Shape.AreCoplanar(Ranges[Range], First, Ranges[FindRange(Range, Other)], Other);
				};
				while (Next < End && Next < First + MostFlat && IsBeside(Next)) { ++Next; }
			}
			All.push_back({First, Next - First, Source.Object, Range});
		}
		Source.ClusterCount = static_cast<uint32_t>(All.size()) - Source.FirstCluster;
	}
	Clusters.Assign(All);
}

// ---------------------------------------------------------------------------------------------------- a frame

void FEmissiveTriangles::WantClusters(const FSource& Source)
{
	for (uint32_t I = 0; I < Source.ClusterCount; ++I) { Wanted.push_back(Source.FirstCluster + I); }
}

void FEmissiveTriangles::WantMarked(const FSceneObjects& InObjects)
{
	if (!Materials.empty())
	{
		std::sort(Materials.begin(), Materials.end());
		const auto IsMarked = [&](uint32_t Material) { return std::binary_search(Materials.begin(), Materials.end(), Material); };
		for (const FSource& Source : Sources)
		{
			const std::vector<uint32_t>& Used = InObjects.Find(Source.Object)->Materials;
			if (std::any_of(Used.begin(), Used.end(), IsMarked)) { WantClusters(Source); }
		}
	}
	for (const uint32_t Object : Objects)
	{
		const auto Found = std::lower_bound(
		    Sources.begin(), Sources.end(), Object, [](const FSource& Source, uint32_t Key) { return Source.Object < Key; });
		if (Found != Sources.end() && Found->Object == Object) { WantClusters(*Found); }
	}
	std::sort(Wanted.begin(), Wanted.end());
	Wanted.erase(std::unique(Wanted.begin(), Wanted.end()), Wanted.end());
}

FRTStatus FEmissiveTriangles::Reserve(IRTDevice& Device)
{
	const auto Grow = [&](TRTRef<IRTBuffer>& Buffer, uint64_t Needed, const char* Name) {
		const uint64_t Size = Buffer ? Buffer->GetDesc().Size : 0;
		if (Size >= Needed && Size / 4 <= std::max<uint64_t>(Needed, 4096)) { return FRTStatus::Success(); }
		Buffer = {};
		if (Needed == 0) { return FRTStatus::Success(); }
		const uint64_t NewSize = Needed + Needed / 2;
		return Device.CreateBuffer({NewSize, ERTBufferUsage::Storage, ERTMemory::Device, Name}, Buffer.ReleaseAndGetAddress());
	};
	if (FRTStatus S = Grow(Triangles, uint64_t(TriangleCount) * sizeof(FEmissiveTriangle), "EmissiveTriangles"); !S) { return S; }
	const uint64_t PowerBytes = Clusters.Num() > 0 ? sizeof(FEmissivePowerHeader) + Clusters.Num() * sizeof(FEmissivePower) : 0;
	return Grow(Powers, PowerBytes, "EmissivePowers");
}

FRTStatus FEmissiveTriangles::Update(IRTDevice& Device, const FSceneObjects& InObjects, const FSceneMaterials& InMaterials)
{
	bGiven = true;
	if (bStale)
	{
		if (bObjectsStale) { ListObjects(InObjects, InMaterials); }
		ListRanges(InObjects, InMaterials);
		ListClusters(InObjects);
		bAllWanted = true;
		if (FRTStatus S = Reserve(Device); !S)
		{
			TriangleCount = 0;
			return S;
		}
		bStale = false;
	}
	else if (!bAllWanted) { WantMarked(InObjects); }
	Objects.clear();
	Materials.clear();
	if (bAllWanted) { Wanted.clear(); }
	bAllWanted &= Clusters.Num() > 0;
	return FRTStatus::Success();
}

FEmissiveWork FEmissiveTriangles::GetWork() const
{
	const uint32_t Count = bAllWanted ? Clusters.Num() : static_cast<uint32_t>(Wanted.size());
	return bGiven && Count > 0 ? FEmissiveWork{Triangles.Get(), Powers.Get(), &Wanted, Count} : FEmissiveWork{};
}

void FEmissiveTriangles::EndFrame(bool bSubmitted)
{
	if (bGiven && bSubmitted)
	{
		bAllWanted = false;
		Wanted.clear();
	}
	bGiven = false;
}

void FEmissiveTriangles::FillConstants(FSceneConstants& Out) const
{
	Out.EmissiveTriangles = Triangles ? Triangles->GetDeviceAddress() : 0;
	Out.EmissiveTriangleCount = TriangleCount;
	Out.EmissiveClusters = Clusters.GetAddress();
	Out.EmissiveClusterCount = Clusters.Num();
	Out.EmissiveRanges = Ranges.GetAddress();
	Out.EmissivePowers = Powers ? Powers->GetDeviceAddress() : 0;
}

} // namespace Lantern
