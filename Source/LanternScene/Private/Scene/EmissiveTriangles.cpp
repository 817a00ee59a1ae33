// FEmissiveTriangles: lists of objects, sections and clusters. No vertex is read, but those of the few triangles of small scenes.
#include "LanternScene/Scene/EmissiveTriangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternScene/Scene/SceneMaterials.h"
#include "LanternScene/Scene/SceneObjects.h"
#include "ShaderTable/SectionData.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarFollow("r.RT.Debug.Lights.EmissiveFollow", true,
    "Planted fault. Off: emissive triangles stay where the first frame found them when a mesh deforms.");

TRTConsoleVariable<int32_t> CVarTriangles("r.RT.Lights.EmissiveTriangles", FEmissiveTriangles::MostTriangles,
    "Most emissive triangles that shine as local lights, which take 64 bytes each. Objects that have no room beside those before them, in "
    "the order in which the scene keeps them, bring no light. A warning names the first of them.",
    {1, FEmissiveTriangles::MostTriangles});

// Where no light is sampled, nobody takes what is marked.
constexpr size_t MostMarked = 4096;

/// What lists have no room for.
struct FLeftOut
{
	const FRTGeometryInfo* First = nullptr; ///< of the first object

	void Add(const FRTGeometryInfo& Geometry) { First = First ? First : &Geometry; }
	void Report(uint32_t Most) const
	{
		if (!First) { return; }
		LogOnce(ERTLogLevel::Warning,
		    fmt::format("the scene has more than {} emissive triangles (r.RT.Lights.EmissiveTriangles); the object with geometry {}, and "
		                "those behind it that have no room, bring no light",
		        Most, Quote(First->Name)));
	}
};

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

// ---------------------------------------------------------------------------------------------------- objects

bool FEmissiveTriangles::HasEmitter(const std::vector<uint32_t>& OfSections) const
{
	return std::any_of(OfSections.begin(), OfSections.end(), [this](uint32_t Material) { return HasEmitted(Material); });
}

void FEmissiveTriangles::SetObject(uint32_t Object, const std::vector<uint32_t>& OfSections)
{
	RemoveObject(Object);
	if (!HasEmitter(OfSections)) { return; }
	EmissiveObjects.insert(EmissiveObjects.end(), Object);
	bStale = true;
}

void FEmissiveTriangles::RemoveObject(uint32_t Object)
{
	if (EmissiveObjects.erase(Object) > 0) { bStale = true; }
}

void FEmissiveTriangles::AddMaterial(uint32_t Material, bool bEmits)
{
	if (Material >= Emitted.size()) { Emitted.resize(Material + 1); }
	Emitted[Material] = bEmits;
}

void FEmissiveTriangles::ChangeMaterial(uint32_t Material, bool bEmits, bool bUsed)
{
	if (HasEmitted(Material)) { return Mark(Materials, Material); }
	if (!bEmits) { return; }
	AddMaterial(Material, true);
	if (bUsed) { bStale = bObjectsStale = true; } // once in its life
}

void FEmissiveTriangles::ListObjects(const FSceneObjects& InObjects)
{
	EmissiveObjects.clear();
	for (uint32_t Slot = 0; Slot < InObjects.GetSlotCount(); ++Slot)
	{
		const FRTObjectInfo* const Object = InObjects.Find(Slot);
		if (Object && HasEmitter(Object->Materials)) { EmissiveObjects.insert(EmissiveObjects.end(), Slot); }
	}
	bObjectsStale = false;
}

// ---------------------------------------------------------------------------------------------------- lists

void FEmissiveTriangles::ListRanges(const FSceneObjects& InObjects, const FSceneMaterials& InMaterials)
{
	const auto Most = static_cast<uint32_t>(CVarTriangles.GetOnRenderThread());
	std::vector<FEmissiveRange> All;
	FLeftOut LeftOut;
	Sources.clear();
	Users.clear();
	TriangleCount = 0;
	for (const uint32_t Object : EmissiveObjects)
	{
		const FRTObjectInfo& Info = *InObjects.Find(Object);
		const std::vector<FRTSectionInfo>& Sections = Info.Geometry->GetInfo().Sections;
		const uint32_t FirstSection = InMaterials.GetSections().GetRange(InObjects.GetRange(Object)).First;
		FSource Source{Object, static_cast<uint32_t>(All.size()), TriangleCount, 0, 0, 0};
		for (uint32_t Section = 0; Section < Sections.size(); ++Section)
		{
			if (!HasEmitted(Info.Materials[Section]) || !MayListEmissive(*Info.Geometry, Section)) { continue; }
			All.push_back({TriangleCount + Source.Count, FirstSection + Section});
			Users.emplace_back(Info.Materials[Section], static_cast<uint32_t>(Sources.size()));
			Source.Count += Sections[Section].IndexCount / 3;
		}
		if (Source.Count > Most - TriangleCount)
		{
			LeftOut.Add(Info.Geometry->GetInfo());
			Users.resize(Users.size() - (All.size() - Source.FirstRange));
			All.resize(Source.FirstRange);
			continue;
		}
		TriangleCount += Source.Count;
		if (Source.Count > 0) { Sources.push_back(Source); }
	}
	LeftOut.Report(Most);
	std::sort(Users.begin(), Users.end());
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

void FEmissiveTriangles::WantMarked()
{
	for (const uint32_t Material : Materials)
	{
		auto User = std::lower_bound(Users.begin(), Users.end(), std::pair(Material, 0u));
		for (; User != Users.end() && User->first == Material; ++User) { WantClusters(Sources[User->second]); }
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
	if (FRTStatus S = Grow(Powers, PowerBytes, "EmissivePowers"); !S) { return S; }
	return Grow(Bounds, Clusters.Num() * sizeof(FEmitterCluster), "EmissiveBounds");
}

FRTStatus FEmissiveTriangles::Update(IRTDevice& Device, const FSceneObjects& InObjects, const FSceneMaterials& InMaterials)
{
	bGiven = true;
	if (bStale)
	{
		if (bObjectsStale) { ListObjects(InObjects); }
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
	else if (!bAllWanted) { WantMarked(); }
	Objects.clear();
	Materials.clear();
	if (bAllWanted) { Wanted.clear(); }
	bAllWanted &= Clusters.Num() > 0;
	if (bAllWanted || !Wanted.empty()) { ++ChangeCount; }
	return FRTStatus::Success();
}

FEmissiveWork FEmissiveTriangles::GetWork() const
{
	const uint32_t Count = bAllWanted ? Clusters.Num() : static_cast<uint32_t>(Wanted.size());
	return bGiven && Count > 0 ? FEmissiveWork{Triangles.Get(), Powers.Get(), Bounds.Get(), &Wanted, Count} : FEmissiveWork{};
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
	if (!IsUsable()) { return; }
	Out.EmissiveTriangles = Triangles ? Triangles->GetDeviceAddress() : 0;
	Out.EmissiveTriangleCount = TriangleCount;
	Out.EmissiveClusters = Clusters.GetAddress();
	Out.EmissiveClusterCount = Clusters.Num();
	Out.EmissiveRanges = Ranges.GetAddress();
	Out.EmissiveBounds = Bounds ? Bounds->GetDeviceAddress() : 0;
	Out.EmissivePowers = Powers ? Powers->GetDeviceAddress() : 0;
}

} // namespace Lantern
