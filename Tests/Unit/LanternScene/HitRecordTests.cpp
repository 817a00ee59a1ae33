// The record that a ray reaches for (instance, section, ray type), by the mock's shader-table arithmetic, against what
// the scene's contents say it must be. For devices of different alignments and after random changes.
#include <map>
#include <random>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

FShaderSource MakeShader(const std::string& Name)
{
	FShaderSource Source;
	Source.Path = Name;
	Source.Text = "#version 460\n#extension GL_EXT_ray_tracing : require\nvoid main() {}\n";
	return Source;
}

FRTPSODesc MakePrograms(uint32_t RayTypes, bool bMasked)
{
	FRTPSODesc Desc;
	Desc.HitPrograms.push_back({StandardProgram, ERTHitClass::Opaque});
	if (bMasked)
	{
		Desc.HitPrograms.push_back({StandardProgram, ERTHitClass::Masked});
		Desc.HitPrograms.push_back({StandardProgram, ERTHitClass::MaskedPlain});
	}
	Desc.RayGens = {MakeShader("Generate")};
	for (uint32_t Type = 0; Type < RayTypes; ++Type)
	{
		const std::string Name = "TYPE" + std::to_string(Type);
		FRayType& Ray = Desc.RayTypes.emplace_back();
		Ray.Name = Name;
		Ray.Miss = MakeShader(Name + ".miss");
		if (Type > 0) { Ray.ClosestHit = MakeShader(Name + ".hit"); } // the first is a shadow ray
		Ray.MaskedAnyHit = MakeShader(Name + ".any");
		Ray.PayloadBytes = 4;
	}
	return Desc;
}

struct FObjectModel
{
	FRTGeometryRef Geometry;
	std::vector<uint32_t> Materials;
	glm::dvec3 Position;
};

struct FAlignments
{
	uint32_t HandleSize, HandleAlignment, BaseAlignment;
	friend void PrintTo(const FAlignments& A, std::ostream* Out)
	{
		*Out << A.HandleSize << "/" << A.HandleAlignment << "/" << A.BaseAlignment;
	}
};

class FHitRecordTest : public FSceneTest, public ::testing::WithParamInterface<FAlignments>
{
protected:
	void SetUp() override
	{
		FRTMockDesc Desc;
		Desc.HandleSize = GetParam().HandleSize;
		Desc.HandleAlignment = GetParam().HandleAlignment;
		Desc.BaseAlignment = GetParam().BaseAlignment;
		Open(Desc);
		Bindings = std::make_unique<FShaderTable>(*Device);
	}
	void TearDown() override
	{
		FSceneTest::TearDown();
		Bindings.reset();
		Pipelines.clear();
	}
	const FRTPSO& GetPipeline(uint32_t RayTypes, bool bMasked)
	{
		const auto [It, bNew] = Pipelines.try_emplace({RayTypes, bMasked});
		if (bNew)
		{
			const FMaterialPrograms Programs;
			FRTPSOCompiler Maker(*Device, Compiler, Programs);
			const FRTStatus Status = Maker.Finish(MakePrograms(RayTypes, bMasked));
			EXPECT_TRUE(Status) << Status.Message;
			It->second = *Maker.GetCurrent();
		}
		return It->second;
	}
	void Render(uint32_t RayTypes)
	{
		Current = &GetPipeline(RayTypes, Scene->RefreshFacts().bMasked);
		Scene->SetRayTypes(RayTypes);
		Frame({}, {}, {Bindings.get(), Current});
	}
	FSectionData ExpectSection(const FObjectModel& Object, uint32_t Section)
	{
		const FRTGeometryInfo& Info = Object.Geometry->GetInfo();
		const FMaterialData& Material = Scene->GetMaterials()[Object.Materials[Section]];
		const bool bShort = Info.IndexType == ERTIndexType::UInt16;
		const bool bPlain = Material.UVTransform[TEXTURE_BASE_COLOR] == glm::vec4(1, 0, 0, 1);
		FSectionData Data{};
		Data.Positions = Info.Positions->GetDeviceAddress() + Info.PositionsOffset;
		Data.Attributes = Info.Attributes->GetDeviceAddress() + Info.AttributesOffset;
		const uint64_t Indices =
		    Info.Indices->GetDeviceAddress() + Info.IndicesOffset + uint64_t(Info.Sections[Section].FirstIndex) * (bShort ? 2 : 4);
		Data.Indices = Indices / 4 * 4;
		Data.Material = Object.Materials[Section];
		Data.Flags = (bShort ? SECTION_INDEX_16 : 0u) | (Indices % 4 ? SECTION_INDEX_ODD : 0u) |
		             (Info.bHasTangents ? SECTION_TANGENTS : 0u) | (IsMasked(Object.Materials[Section]) ? SECTION_MASKED : 0u) |
		             (Material.Flags & MATERIAL_DOUBLE_SIDED ? SECTION_DOUBLE_SIDED : 0u) |
		             (Material.UVSets & (1u << TEXTURE_BASE_COLOR) ? SECTION_OPACITY_UV1 : 0u) |
		             (Info.bOpaqueVertices && bPlain ? SECTION_PLAIN_OPACITY : 0u);
		return Data;
	}
	bool IsMasked(uint32_t Material) const { return bAlphaTest && (Scene->GetMaterials()[Material].Flags & MATERIAL_MASKED) != 0; }
	void ExpectRecord(const FObjectModel& Object, const FRTMockInstance& Item, uint32_t Section, uint32_t Type)
	{
		const FRTMockRecord Record = Mock().ResolveHit(Bindings->GetTable(), Item.Instance, Section, Type, Current->GetRayTypeCount());
		ASSERT_TRUE(Record.IsGood()) << Record.Error;
		const std::string Name = "TYPE" + std::to_string(Type);
		ASSERT_EQ(Record.ClosestHit, Type > 0 ? Name + ".hit" : "");
		ASSERT_EQ(Record.AnyHit, IsMasked(Object.Materials[Section]) ? Name + ".any" : "");
		const FSectionData Expected = ExpectSection(Object, Section);
		ASSERT_EQ(Record.Data.size(), sizeof(Expected));
		ASSERT_EQ(std::memcmp(Record.Data.data(), &Expected, sizeof(Expected)), 0) << "record data";
		const uint32_t Index = Read<FObjectData>(Scene->GetConstants().Objects, GetIndex(Item)).FirstSection + Section;
		const FSectionData Inline = Read<FSectionData>(Scene->GetConstants().Sections, Index);
		ASSERT_EQ(std::memcmp(&Inline, &Expected, sizeof(Expected)), 0) << "what inline ray queries read";
	}
	static uint32_t GetIndex(const FRTMockInstance& Item) { return Item.Instance.CustomIndexAndMask & MaxInstanceIndex; }

	FShaderCompiler Compiler{FShaderCompilerDesc{}};
	std::map<std::pair<uint32_t, bool>, FRTPSO> Pipelines;
	std::unique_ptr<FShaderTable> Bindings;
	const FRTPSO* Current = nullptr;
	bool bAlphaTest = true;
};

/// Random changes of a scene, and what they must have led to.
class FHitRecordWalkTest : public FHitRecordTest
{
protected:
	void SetUp() override
	{
		FHitRecordTest::SetUp();
		Random.seed(GetParam().BaseAlignment + GetParam().HandleAlignment);
		for (int I = 0; I < 6; ++I) { Scene->AddMaterial(RandomMaterial()); }
	}
	uint32_t Below(size_t Count) { return static_cast<uint32_t>(Random() % Count); }
	FMaterialData RandomMaterial()
	{
		FMaterialData Data = MakeMaterial(Below(4));
		Data.UVSets = Below(2) << TEXTURE_BASE_COLOR;
		Data.UVTransform[TEXTURE_BASE_COLOR] = glm::vec4(1, 0, 0, 1 + Below(2));
		return Data;
	}
	std::vector<uint32_t> RandomMaterials(const FRTGeometryRef& Geometry)
	{
		std::vector<uint32_t> Materials(Geometry->GetSectionCount());
		for (uint32_t& Material : Materials) { Material = Below(Scene->GetMaterials().Num()); }
		return Materials;
	}
	void AddOne()
	{
		if (Geometries.size() < 3 || Below(10) == 0)
		{
			FGeometryOptions Options;
			Options.bOpaque = false;
			Options.bTangents = Below(2);
			Options.bOpaqueVertices = Below(2);
			Options.IndexType = Below(2) ? ERTIndexType::UInt16 : ERTIndexType::UInt32;
			Geometries.push_back(MakeGeometry("G" + std::to_string(Geometries.size()), 1 + Below(5), Options));
		}
		FObjectModel Object{Geometries[Below(Geometries.size())], {}, glm::dvec3(Below(1000), 0, 0)};
		Object.Materials = RandomMaterials(Object.Geometry);
		const FRTObjectId Id = Add(Object.Geometry, Object.Materials, Object.Position);
		ASSERT_EQ(Model.count(Id.Index), 0u);
		Model[Id.Index] = {Id, std::move(Object)};
	}
	void Change()
	{
		const uint32_t Choice = Below(100);
		if (Model.empty() || Choice < 35) { return AddOne(); }
		const auto It = std::next(Model.begin(), Below(Model.size()));
		auto& [Id, Object] = It->second;
		if (Choice < 60)
		{
			Scene->RemoveObject(Id);
			Model.erase(It);
		}
		else if (Choice < 80)
		{
			Object.Materials = RandomMaterials(Object.Geometry);
			Scene->SetMaterials(Id, Object.Materials);
		}
		else if (Choice < 90)
		{
			Object.Position.y = Below(1000);
			glm::dmat4 Transform(1.0);
			Transform[3] = glm::dvec4(Object.Position, 1.0);
			Scene->SetTransform(Id, Transform);
		}
		else if (Choice < 97) { Scene->SetMaterial(Below(6), RandomMaterial()); }
		else
		{
			bAlphaTest = !bAlphaTest;
			Scene->SetAlphaTest(bAlphaTest);
		}
	}
	void ExpectInstance(const FRTMockInstance& Item)
	{
		ASSERT_TRUE(Model.count(GetIndex(Item)));
		const auto& [Id, Object] = Model[GetIndex(Item)];
		ASSERT_EQ(Item.Geometry, Object.Geometry->GetStructure());
		ASSERT_EQ(Item.Instance.Transform[3], static_cast<float>(Object.Position.x));
		ASSERT_EQ(Item.Instance.Transform[7], static_cast<float>(Object.Position.y));
		bool bSomeMasked = false, bAllDoubleSided = true;
		for (const uint32_t Material : Object.Materials)
		{
			bSomeMasked |= IsMasked(Material);
			bAllDoubleSided &= (Scene->GetMaterials()[Material].Flags & MATERIAL_DOUBLE_SIDED) != 0;
		}
		const uint32_t Flags = (bSomeMasked ? 0 : InstanceForceOpaque) | (bAllDoubleSided ? InstanceCullDisable : 0);
		ASSERT_EQ(Item.Instance.TableOffsetAndFlags >> 24, Flags);
		const FObjectData Data = Read<FObjectData>(Scene->GetConstants().Objects, GetIndex(Item));
		ASSERT_EQ(Data.FirstSection, Scene->GetFirstSection(Id));
		for (uint32_t Section = 0; Section < Object.Materials.size(); ++Section)
		{
			for (uint32_t Type = 0; Type < Current->GetRayTypeCount(); ++Type, ++Resolved)
			{
				ASSERT_NO_FATAL_FAILURE(ExpectRecord(Object, Item, Section, Type))
				    << "object " << GetIndex(Item) << ", section " << Section << ", type " << Type;
			}
		}
	}

	std::mt19937 Random;
	std::vector<FRTGeometryRef> Geometries;
	std::map<uint32_t, std::pair<FRTObjectId, FObjectModel>> Model; ///< by index
	uint32_t Resolved = 0;
};

TEST_P(FHitRecordWalkTest, RecordsFollowEveryChangeOfTheScene)
{
	uint32_t RayTypes = 1;
	for (int Step = 0; Step < 250; ++Step)
	{
		for (uint32_t Changes = Below(12); Changes > 0; --Changes) { Change(); }
		if (Below(10) == 0)
		{
			RayTypes = 1 + Below(3); // another set of passes: another pipeline
		}
		Render(RayTypes);
		const std::vector<FRTMockInstance> Instances = GetInstances();
		ASSERT_EQ(Instances.size(), Model.size());
		for (const FRTMockInstance& Item : Instances) { ASSERT_NO_FATAL_FAILURE(ExpectInstance(Item)) << "step " << Step; }
	}
	EXPECT_GT(Resolved, 10'000u) << "the walk has become too short to say much";
}

TEST_P(FHitRecordTest, FrameCopiesOnlyRecordsOfChangedSections)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const uint32_t Other = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	for (int I = 0; I < 500; ++I) { Add(MakeGeometry("G" + std::to_string(I), 1), {Material}); }
	for (int I = 0; I < 1000; ++I) { Add(Tree, {Material}, {I, 0, 0}); }
	Render(2);
	EXPECT_EQ(Bindings->GetStats().RecordsWritten, 2 * 501u) << "1,000 trees share their records";
	Mock().ClearCalls();
	Render(2);
	EXPECT_EQ(Bindings->GetStats().RecordsWritten, 0u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::UpdateShaderTable), 0u);
	Add(Tree, {Other});
	Render(2);
	EXPECT_EQ(Bindings->GetStats().RecordsWritten, 2u);
	const std::vector<FRTMockCall> Updates = Mock().FindCalls(ERTMockCall::UpdateShaderTable);
	ASSERT_EQ(Updates.size(), 1u);
	EXPECT_EQ(Updates[0].Numbers[0], 2 * Bindings->GetTable()->GetRecordStride(ERTRecordKind::Hit));
}

TEST_P(FHitRecordTest, TwoScenesTakeTurnsWithOneTable)
{
	const auto Fill = [&](const char* Name) {
		const uint32_t Material = Scene->AddMaterial(MakeMaterial());
		FObjectModel Object{MakeGeometry(Name, 2), {Material, Material}, {}};
		Add(Object.Geometry, Object.Materials);
		return Object;
	};
	const FObjectModel First = Fill("First");
	std::unique_ptr<FRTScene> Second = std::make_unique<FRTScene>(*Device);
	std::swap(Scene, Second);
	const FObjectModel InSecond = Fill("Second");
	for (int Turn = 0; Turn < 4; ++Turn)
	{
		Render(2);
		const FObjectModel& Object = Turn % 2 ? First : InSecond;
		ASSERT_EQ(GetInstances().size(), 1u);
		for (uint32_t Type = 0; Type < 2; ++Type)
		{
			ASSERT_NO_FATAL_FAILURE(ExpectRecord(Object, GetInstances()[0], 1, Type)) << "turn " << Turn;
		}
		std::swap(Scene, Second);
	}
}

TEST_P(FHitRecordTest, RecordsOfALostFrameAreWrittenAgain)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	FObjectModel Object{MakeGeometry("Tree", 1), {Material}, {}};
	Add(Object.Geometry, Object.Materials);
	Current = &GetPipeline(1, false);
	TRTRef<IRTCommandList> List;
	ASSERT_TRUE(Device->CreateCommandList("Lost", List.ReleaseAndGetAddress()));
	ASSERT_TRUE(List->Begin());
	ASSERT_TRUE(Scene->Update(*List, *Uploads, {}, {}));
	ASSERT_TRUE(Bindings->Sync(*List, *Current, Scene->GetSections()));
	ASSERT_TRUE(List->End());
	Uploads->EndFrame(0);
	Scene->EndFrame(false);
	Bindings->Invalidate();
	Render(1);
	ASSERT_EQ(GetInstances().size(), 1u);
	ExpectRecord(Object, GetInstances()[0], 0, 0);
}

TEST_P(FHitRecordTest, TableThatCannotBeMadeIsMadeLater)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	FObjectModel Object{MakeGeometry("Tree", 1), {Material}, {}};
	Add(Object.Geometry, Object.Materials);
	Frame();
	Current = &GetPipeline(1, false);
	TRTRef<IRTCommandList> List;
	ASSERT_TRUE(Device->CreateCommandList("List", List.ReleaseAndGetAddress()));
	ASSERT_TRUE(List->Begin());
	Mock().FailAllocation(1);
	const FRTStatus Status = Bindings->Sync(*List, *Current, Scene->GetSections());
	EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_NE(std::string(Status.Message).find("ShaderTable"), std::string::npos) << Status.Message;
	EXPECT_TRUE(List->End());
	Render(1);
	ExpectRecord(Object, GetInstances()[0], 0, 0);
}

const auto Alignments =
    ::testing::Values(FAlignments{32, 32, 64}, FAlignments{32, 64, 64}, FAlignments{64, 64, 256}, FAlignments{32, 16, 32});
INSTANTIATE_TEST_SUITE_P(Alignments, FHitRecordTest, Alignments);
INSTANTIATE_TEST_SUITE_P(Alignments, FHitRecordWalkTest, Alignments);

} // namespace
} // namespace Lantern
