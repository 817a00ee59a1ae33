#include "TableModel.h"

#include <algorithm>
#include <deque>
#include <numeric>
#include <random>

namespace Lantern
{

namespace
{
FGroupNames MakeNames(const std::string& Stem, ERTHitClass Class, uint32_t RayType)
{
	const std::string Name = Stem + ".t" + std::to_string(RayType);
	return {Name + ".hit", IsMasked(Class) ? Name + ".any" : "", Class == ERTHitClass::Procedural ? Name + ".int" : ""};
}

std::string StemOf(FHitProgram Program)
{
	return "p" + std::to_string(Program.Program) + "." + std::to_string(static_cast<int>(Program.Class));
}

std::string StandInStem(size_t Class) { return "standin." + std::to_string(Class); }

/// Shaders and groups of a pipeline in the making.
struct FMaker
{
	const uint32_t Word = 0;
	std::deque<std::string> Names;
	std::vector<FRTShaderCode> Codes;
	std::vector<FRTShaderGroup> Groups;

	uint32_t AddShader(const std::string& Name, ERTShaderStage Stage)
	{
		if (Name.empty()) { return NoShader; }
		Names.push_back(Name);
		Codes.push_back({&Word, 1, Stage, Names.back().c_str()});
		return static_cast<uint32_t>(Codes.size() - 1);
	}
	uint32_t AddGeneral(const std::string& Name, ERTShaderStage Stage)
	{
		Groups.push_back({ERTGroupKind::General, AddShader(Name, Stage)});
		return static_cast<uint32_t>(Groups.size() - 1);
	}
	uint32_t AddHit(const FGroupNames& Of)
	{
		FRTShaderGroup Group{Of.Intersection.empty() ? ERTGroupKind::Triangles : ERTGroupKind::Procedural};
		Group.ClosestHit = AddShader(Of.ClosestHit, ERTShaderStage::ClosestHit);
		Group.AnyHit = AddShader(Of.AnyHit, ERTShaderStage::AnyHit);
		Group.Intersection = AddShader(Of.Intersection, ERTShaderStage::Intersection);
		Groups.push_back(Group);
		return static_cast<uint32_t>(Groups.size() - 1);
	}
	/// Turns the order around, in part: group numbers must not be what they were in the pipeline before.
	std::vector<uint32_t> Shuffle(std::mt19937& Random)
	{
		std::vector<uint32_t> NewOf(Groups.size());
		std::iota(NewOf.begin(), NewOf.end(), 0u);
		std::shuffle(NewOf.begin(), NewOf.end(), Random);
		std::vector<FRTShaderGroup> Moved(Groups.size());
		for (size_t Old = 0; Old < Groups.size(); ++Old) { Moved[NewOf[Old]] = Groups[Old]; }
		Groups = Moved;
		return NewOf;
	}
};

/// Of each program and class the hit groups, but for some; of each class a stand-in, or none.
void AddHits(FMaker& Maker, FModelPipeline& Model, FRTPSOLayout& Layout, std::mt19937& Random)
{
	const auto Add = [&](const std::string& Stem, ERTHitClass Class) {
		std::vector<uint32_t> Groups;
		for (uint32_t Type = 0; Type < Model.RayTypes; ++Type) { Groups.push_back(Maker.AddHit(MakeNames(Stem, Class, Type))); }
		return Groups;
	};
	for (uint32_t Class = 0; Class < HitClassCount; ++Class)
	{
		Model.HasStandIn[Class] = Random() % 4 != 0;
		if (Model.HasStandIn[Class]) { Layout.StandIns[Class] = Add(StandInStem(Class), static_cast<ERTHitClass>(Class)); }
		for (uint32_t Program = 0; Program < 5; ++Program)
		{
			if (Random() % 3 == 0) { continue; }
			const FHitProgram Hit{Program, static_cast<ERTHitClass>(Class)};
			Model.Ready.insert(Hit);
			Layout.Hits.push_back({Hit, ERTHitState::Ready, Add(StemOf(Hit), Hit.Class)});
		}
	}
}

void Renumber(FRTPSOLayout& Layout, const std::vector<uint32_t>& NewOf)
{
	const auto All = [&](std::vector<uint32_t>& Groups) {
		for (uint32_t& Group : Groups) { Group = NewOf[Group]; }
	};
	All(Layout.RayGenGroups);
	All(Layout.MissGroups);
	All(Layout.CallableGroups);
	for (FRTPSOLayout::FHit& Hit : Layout.Hits) { All(Hit.Groups); }
	for (std::vector<uint32_t>& Groups : Layout.StandIns) { All(Groups); }
	Layout.EmptyHitGroup = NewOf[Layout.EmptyHitGroup];
}
} // namespace

FGroupNames FModelPipeline::Expect(FHitProgram Program, uint32_t RayType) const
{
	if (Ready.count(Program)) { return MakeNames(StemOf(Program), Program.Class, RayType); }
	const size_t Class = static_cast<size_t>(Program.Class);
	return HasStandIn[Class] ? MakeNames(StandInStem(Class), Program.Class, RayType) : FGroupNames{};
}

std::shared_ptr<FModelPipeline> FModelPipeline::Make(IRTDevice& Device, uint32_t Number, uint32_t RayTypes, uint32_t RandomSeed)
{
	std::mt19937 Random(RandomSeed);
	auto Model = std::make_shared<FModelPipeline>();
	Model->Name = "Pipeline" + std::to_string(Number);
	Model->RayTypes = RayTypes;
	FMaker Maker;
	FRTPSOLayout Layout;
	Layout.EmptyHitGroup = Maker.AddHit({});
	for (uint32_t I = 0; I < 1 + Random() % 2; ++I)
	{
		Layout.RayGens.emplace_back();
		Layout.RayGenGroups.push_back(Maker.AddGeneral("gen" + std::to_string(I), ERTShaderStage::RayGen));
	}
	for (uint32_t Type = 0; Type < RayTypes; ++Type)
	{
		Layout.MissGroups.push_back(Maker.AddGeneral("miss" + std::to_string(Type), ERTShaderStage::Miss));
	}
	for (uint32_t I = 0; I < Random() % 3; ++I)
	{
		Layout.CallableGroups.push_back(Maker.AddGeneral("call" + std::to_string(I), ERTShaderStage::Callable));
	}
	AddHits(Maker, *Model, Layout, Random);
	Renumber(Layout, Maker.Shuffle(Random));
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = Maker.Codes.data();
	Desc.ShaderCount = static_cast<uint32_t>(Maker.Codes.size());
	Desc.Groups = Maker.Groups.data();
	Desc.GroupCount = static_cast<uint32_t>(Maker.Groups.size());
	Desc.Name = Model->Name.c_str();
	TRTRef<IRTPipeline> Pipeline;
	if (!Device.CreateRayTracingPipeline(Desc, Pipeline.ReleaseAndGetAddress())) { return nullptr; }
	Model->Pipeline = FRTPSO(std::move(Pipeline), std::move(Layout));
	return Model;
}

FMaterialData FModelMaterial::ToData() const
{
	FMaterialData Data{};
	Data.Flags = (bMasked ? MATERIAL_MASKED : 0u) | (bDoubleSided ? MATERIAL_DOUBLE_SIDED : 0u);
	Data.UVSets = bSecondUV ? 1u << TEXTURE_BASE_COLOR : 0u;
	return Data;
}

FModelSection ExpectSection(
    const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t MaterialIndex, const FModelMaterial& Material, bool bAlphaTest)
{
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	FModelSection Section;
	FSectionData& Data = Section.Data;
	Section.Program.Program = Material.Program;
	if (Info.Sections[Part.Section].bProcedural)
	{
		Section.Program.Class = ERTHitClass::Procedural;
		Data.Positions = Info.Aabbs->GetDeviceAddress() + Info.AabbsOffset + 24 * Part.FirstIndex;
	}
	else
	{
		const bool bShort = Geometry.GetIndexType() == ERTIndexType::UInt16;
		const uint64_t Indices =
		    Geometry.GetIndices()->GetDeviceAddress() + Geometry.GetIndicesOffset() + (bShort ? 2u : 4u) * Part.FirstIndex;
		Data.Positions = Info.Positions->GetDeviceAddress() + Info.PositionsOffset;
		Data.Attributes = Info.Attributes->GetDeviceAddress() + Info.AttributesOffset;
		Data.Indices = Indices / 4 * 4;
		Data.Flags = (bShort ? SECTION_INDEX_16 : 0u) | (Indices % 4 ? SECTION_INDEX_ODD : 0u);
		const bool bMasked = bAlphaTest && Material.bMasked && !Part.bOpaque;
		Section.Program.Class = bMasked ? ERTHitClass::Masked : ERTHitClass::Opaque;
		Data.Flags |= bMasked ? SECTION_MASKED : 0u;
	}
	Data.Material = MaterialIndex;
	Data.Flags |= (Material.bDoubleSided ? SECTION_DOUBLE_SIDED : 0u) | (Material.bSecondUV ? SECTION_OPACITY_UV1 : 0u);
	return Section;
}

} // namespace Lantern
