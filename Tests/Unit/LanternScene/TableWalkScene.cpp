#include "TableWalkScene.h"

#include <random>
#include <utility>

namespace Lantern
{

/// What only the geometry store may change.
struct FGeometryTestAccess
{
	static void SetIndices(FRTGeometry& Geometry, TRTRef<IRTBuffer> Indices, uint64_t Offset, ERTIndexType Type)
	{
		Geometry.Indices = std::move(Indices);
		Geometry.IndicesOffset = Offset;
		Geometry.IndexType = Type;
	}
	static void SetParts(FRTGeometry& Geometry, std::vector<FRTGeometryPart> Parts) { Geometry.Parts = std::move(Parts); }
};

namespace
{
constexpr uint32_t MaterialCount = 7, GeometryCount = 8, MostObjects = 160;
} // namespace

FWalkScene::FWalkScene(IRTDevice& InDevice) : Device(InDevice), ModelMaterials(MaterialCount), Programs(MaterialCount, StandardProgram)
{
	for (const FModelMaterial& Material : ModelMaterials) { Materials.Add(Material.ToData()); }
	MakeGeometries();
}

TRTRef<IRTBuffer> FWalkScene::MakeBuffer(uint64_t Size)
{
	TRTRef<IRTBuffer> Buffer;
	const FRTBufferDesc Desc{Size, ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Device, "Geometry"};
	if (FRTStatus S = Device.CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()); !S) { Failure = S.Message; }
	return Buffer;
}

void FWalkScene::MakeGeometries()
{
	for (uint32_t Number = 0; Number < GeometryCount; ++Number)
	{
		FRTGeometryInfo Info;
		Info.Name = "G" + std::to_string(Number);
		Info.Positions = MakeBuffer(1024);
		Info.Attributes = MakeBuffer(1024);
		Info.Indices = MakeBuffer(4096);
		Info.Aabbs = MakeBuffer(1024);
		Info.IndexType = Number % 3 ? ERTIndexType::UInt32 : ERTIndexType::UInt16;
		for (uint32_t Section = 0; Section < 1 + Number * 2 / 3; ++Section)
		{
			FRTSectionInfo& Made = Info.Sections.emplace_back();
			Made.FirstIndex = 15 * Section;
			Made.IndexCount = 15;
			Made.bOpaque = Number == 1;
			Made.bProcedural = Number == 5 && Section == 1;
			if (Number % 2 == 0 && Section % 2 == 0)
			{
				Made.OpaqueIndexCount = 6; // classified: an opaque part of its own
			}
		}
		Geometries.push_back(std::make_unique<FRTGeometry>(std::move(Info)));
	}
}

std::vector<uint32_t> FWalkScene::DrawMaterials(uint32_t Geometry, uint32_t Random) const
{
	std::minstd_rand Draw(Random | 1u);
	std::vector<uint32_t> Drawn(Geometries[Geometry]->GetSectionCount());
	for (uint32_t& Material : Drawn) { Material = Draw() % MaterialCount; }
	return Drawn;
}

void FWalkScene::Add(uint32_t Geometry, uint32_t Random)
{
	if (Objects.size() >= MostObjects) { return; }
	FWalkObject& Object = Objects.emplace_back();
	Object.Geometry = Geometry % GeometryCount;
	Object.Materials = DrawMaterials(Object.Geometry, Random);
	Object.Range = Sections.Acquire(*Geometries[Object.Geometry], Object.Materials);
}

void FWalkScene::Remove(uint32_t Index)
{
	Sections.Release(Objects[Index].Range);
	Objects[Index] = Objects.back();
	Objects.pop_back();
}

void FWalkScene::SetMaterials(FWalkObject& Object, uint32_t Random)
{
	Object.Materials = DrawMaterials(Object.Geometry, Random);
	const FSectionRangeId Range = Sections.Acquire(*Geometries[Object.Geometry], Object.Materials);
	Sections.Release(std::exchange(Object.Range, Range));
}

void FWalkScene::EditMaterial(const FWalkStep& Step)
{
	const uint32_t Index = Step.A % MaterialCount;
	FModelMaterial& Material = ModelMaterials[Index];
	Material.bMasked = Step.B & 1;
	Material.bDoubleSided = Step.B & 2;
	Material.bSecondUV = Step.B & 4;
	Material.Program = Step.C % 6; // one more than any pipeline has
	Materials.Set(Index, Material.ToData());
	Programs[Index] = Material.Program;
	Sections.MaterialChanged(Index);
}

void FWalkScene::ChangeGeometry(const FWalkStep& Step)
{
	FRTGeometry& Geometry = *Geometries[Step.A % GeometryCount];
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	if (Step.B % 2)
	{
		FGeometryTestAccess::SetIndices(
		    Geometry, MakeBuffer(4096), 2 * (Step.C % 7), Step.C % 2 ? ERTIndexType::UInt16 : ERTIndexType::UInt32);
	}
	else { FGeometryTestAccess::SetParts(Geometry, MakeGeometryParts(Info, Step.C % 2)); }
	Sections.GeometryChanged(Geometry);
}

void FWalkScene::Do(const FWalkStep& Step)
{
	const auto Chosen = [&](uint32_t Random) { return Random % static_cast<uint32_t>(Objects.size()); };
	const bool bAny = !Objects.empty();
	switch (Step.Kind)
	{
	case EWalkStep::AddObject: return Add(Step.A, Step.B);
	case EWalkStep::EditMaterial: return EditMaterial(Step);
	case EWalkStep::ChangeGeometry: return ChangeGeometry(Step);
	case EWalkStep::ToggleAlphaTest: Context.bAlphaTest = !Context.bAlphaTest; return Sections.RefillAll();
	case EWalkStep::Burst:
		for (uint32_t I = 0; I < 24; ++I) { Add(Step.A + I, Step.B + I * 977); }
		return;
	case EWalkStep::RemoveObject: return bAny ? Remove(Chosen(Step.A)) : void();
	case EWalkStep::SetMaterials: return bAny ? SetMaterials(Objects[Chosen(Step.A)], Step.B) : void();
	case EWalkStep::MoveObject: return bAny ? std::swap(Objects[Chosen(Step.A)], Objects[Chosen(Step.B)]) : void();
	case EWalkStep::Purge:
		while (Objects.size() > 1 + Step.A % 4) { Remove(Chosen(Step.B)); }
		return;
	default: return;
	}
}

std::vector<FExpectation> FWalkScene::MakeExpectations() const
{
	std::vector<FExpectation> All;
	for (const FWalkObject& Object : Objects)
	{
		const FRTGeometry& Geometry = *Geometries[Object.Geometry];
		const uint32_t First = Sections.GetRange(Object.Range).First;
		for (uint32_t Part = 0; Part < Geometry.GetParts().size(); ++Part)
		{
			const FRTGeometryPart& Where = Geometry.GetParts()[Part];
			const uint32_t Material = Object.Materials[Where.Section];
			All.push_back({First + Part, ExpectSection(Geometry, Where, Material, ModelMaterials[Material], Context.bAlphaTest)});
		}
	}
	return All;
}

} // namespace Lantern
