// What the scene makes of classified sections: parts, records, and the way back where the alpha test is another.
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternScene/Opacity/OpacityClassifier.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{

namespace
{
class FOpacitySceneTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		Set("r.RT.Opacity.Classify", "1");
		Masked = MakeMaterial(MATERIAL_MASKED);
		Masked.AlphaCutoff = 0.5f;
		Masked.Textures[TEXTURE_BASE_COLOR] = 7;
		MaskedIndex = Scene->AddMaterial(Masked);
		OtherIndex = Scene->AddMaterial(MakeMaterial(MATERIAL_MASKED));
		SolidIndex = Scene->AddMaterial(MakeMaterial());
	}
	void TearDown() override
	{
		Set("r.RT.Opacity.Classify", "1");
		FSceneTest::TearDown();
	}
	static void Set(const char* Name, const char* Value)
	{
		FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test");
		FConsoleVariables::Get().BeginFrame();
	}

	/// Two sections of 10 triangles. The first: 4 mixed, 5 opaque, 1 transparent; the second is opaque.
	FRTGeometryInfo MakeClassifiedInfo(uint32_t Pieces = 0)
	{
		FGeometryOptions Options;
		Options.TrianglesPerSection = 10;
		FRTGeometryInfo Info = MakeInfo("Foliage", 2, Options);
		FRTSectionInfo& Section = Info.Sections[0];
		Section.bOpaque = false;
		Section.OpaqueIndexCount = 15;
		Section.TransparentIndexCount = 3;
		Section.OpacityKey = MakeOpacityKey(Masked);
		Section.PieceCount = Pieces;
		if (Pieces > 0)
		{
			Info.PiecePositions = MakeBuffer("Pieces", uint64_t(Pieces) * 36);
			Info.PieceIndices = MakeBuffer("PieceCorners", uint64_t(Pieces) * 12);
		}
		return Info;
	}
	FRTGeometryRef Create(FRTGeometryInfo Info)
	{
		FRTGeometryRef Geometry;
		const FRTStatus Status = Scene->CreateGeometry(std::move(Info), Geometry);
		EXPECT_TRUE(Status) << Status.Message;
		return Geometry;
	}
	/// Triangles of each part that was built, in its order.
	std::vector<uint32_t> GetBuilt(const FRTGeometryRef& Geometry)
	{
		std::vector<uint32_t> Out;
		for (const FRTGeometrySection& Section : Mock().GetGeometry(Geometry->GetStructure()).Sections)
		{
			Out.push_back(Section.TriangleCount);
		}
		return Out;
	}
	std::vector<bool> GetOpaque(const FRTGeometryRef& Geometry)
	{
		std::vector<bool> Out;
		for (const FRTGeometrySection& Section : Mock().GetGeometry(Geometry->GetStructure()).Sections) { Out.push_back(Section.bOpaque); }
		return Out;
	}
	const FSectionData& GetSection(FRTObjectId Object, uint32_t Part)
	{
		return Scene->GetSections().Get(Scene->GetFirstSection(Object) + Part);
	}
	/// Every instance must point at a structure that holds what its records say, or not be there.
	void ExpectFallback(const FRTGeometryRef& Geometry)
	{
		Settle();
		EXPECT_EQ(GetBuilt(Geometry), Whole);
		EXPECT_EQ(GetInstances().size(), 1u);
		EXPECT_TRUE(GetInstances()[0].bBuilt);
		EXPECT_FALSE(Geometry->IsClassified());
	}

	const std::vector<uint32_t> Classified = {4, 10, 5}, Whole = {10, 10};
	FMaterialData Masked;
	uint32_t MaskedIndex = 0, OtherIndex = 0, SolidIndex = 0;
};
} // namespace

TEST_F(FOpacitySceneTest, PartsAreMixedAndOpaque)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo());
	const FRTObjectId Object = Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	EXPECT_EQ(GetBuilt(Geometry), Classified);
	EXPECT_EQ(GetOpaque(Geometry), (std::vector<bool>{false, true, true}));
	const FSectionData Mixed = GetSection(Object, 0), Opaque = GetSection(Object, 2);
	EXPECT_TRUE(Mixed.Flags & SECTION_MASKED);
	EXPECT_FALSE(Opaque.Flags & SECTION_MASKED);
	EXPECT_EQ(Opaque.Material, MaskedIndex);
	EXPECT_EQ(Opaque.Indices, Mixed.Indices + 4 * 3 * 4) << "behind the mixed ones";
	EXPECT_EQ(Scene->GetSections().GetHitProgram(Scene->GetFirstSection(Object) + 2).Class, ERTHitClass::Opaque);
}

TEST_F(FOpacitySceneTest, PiecesStandInForMixedTriangles)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo(9));
	const FRTObjectId Object = Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	EXPECT_EQ(GetBuilt(Geometry), (std::vector<uint32_t>{9, 10, 5}));
	const FRTGeometrySection Built = Mock().GetGeometry(Geometry->GetStructure()).Sections[0];
	EXPECT_EQ(Built.Vertices, Geometry->GetInfo().PiecePositions.Get());
	EXPECT_EQ(Built.IndexType, ERTIndexType::None);
	const FSectionData Pieces = GetSection(Object, 0);
	EXPECT_EQ(Pieces.Indices, Geometry->GetInfo().PieceIndices->GetDeviceAddress());
	EXPECT_EQ(Pieces.Flags & (SECTION_PIECES | SECTION_IS_PIECES | SECTION_MASKED),
	    uint32_t(SECTION_PIECES | SECTION_IS_PIECES | SECTION_MASKED));
	EXPECT_EQ(GetSection(Object, 2).Flags & (SECTION_PIECES | SECTION_IS_PIECES), uint32_t(SECTION_PIECES));
	Set("r.RT.Opacity.Classify", "0");
	ExpectFallback(Geometry);
	EXPECT_EQ(GetSection(Object, 0).Flags & (SECTION_PIECES | SECTION_IS_PIECES), uint32_t(SECTION_PIECES));
	EXPECT_EQ(GetSection(Object, 0).Indices, Geometry->GetIndices()->GetDeviceAddress() + Geometry->GetIndicesOffset());
}

TEST_F(FOpacitySceneTest, TogglesFallBackAndReturn)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo());
	Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	const auto ExpectReturn = [&] {
		Settle();
		EXPECT_EQ(GetBuilt(Geometry), Classified);
	};
	Set("r.RT.Opacity.Classify", "0");
	ExpectFallback(Geometry);
	Set("r.RT.Opacity.Classify", "1");
	ExpectReturn();
	// What is cut away is solid then: also what no part holds.
	Scene->SetAlphaTest(false);
	ExpectFallback(Geometry);
	Scene->SetAlphaTest(true);
	ExpectReturn();
	Scene->SetMaterialOverride(2);
	ExpectFallback(Geometry);
	Scene->SetMaterialOverride(1);
	ExpectReturn();
}

TEST_F(FOpacitySceneTest, EditedAlphaTestIsNeverTrustedAgain)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo());
	Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	FMaterialData Edited = Masked;
	Edited.Roughness = 0.3f;
	Scene->SetMaterial(MaskedIndex, Edited);
	Settle();
	EXPECT_EQ(GetBuilt(Geometry), Classified) << "the alpha test does not read it";
	Edited.AlphaCutoff = 0.4f;
	Scene->SetMaterial(MaskedIndex, Edited);
	ExpectFallback(Geometry);
	Scene->SetMaterial(MaskedIndex, Masked);
	ExpectFallback(Geometry);
	Set("r.RT.Opacity.Classify", "0");
	Set("r.RT.Opacity.Classify", "1");
	ExpectFallback(Geometry);
}

TEST_F(FOpacitySceneTest, ObjectsWithOtherMaterialsFallBack)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo());
	const FRTObjectId Object = Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	Scene->SetMaterials(Object, {MaskedIndex, OtherIndex});
	Settle();
	EXPECT_EQ(GetBuilt(Geometry), Classified) << "of a section that is not classified";
	Scene->SetMaterials(Object, {OtherIndex, SolidIndex});
	ExpectFallback(Geometry);

	const FRTGeometryRef Solid = Create(MakeClassifiedInfo());
	Scene->RemoveObject(Object);
	Add(Solid, {SolidIndex, SolidIndex});
	ExpectFallback(Solid);
}

// What was found out about a geometry says nothing about the one that has its slot now.
TEST_F(FOpacitySceneTest, ReusedSlotKeepsItsClassification)
{
	FRTGeometryRef Gone = Create(MakeClassifiedInfo());
	const uint32_t Slot = Gone->GetSlot();
	FSectionTable& Sections = Scene->GetSections();
	Sections.Release(Sections.Acquire(*Gone, {OtherIndex, SolidIndex}));
	ASSERT_TRUE(Sections.HasRefutedGeometries());
	Gone.reset();
	const FRTGeometryRef Next = Create(MakeClassifiedInfo());
	ASSERT_EQ(Next->GetSlot(), Slot);
	Add(Next, {MaskedIndex, SolidIndex});
	Settle();
	EXPECT_TRUE(Next->IsClassified());
	EXPECT_EQ(GetBuilt(Next), Classified);
}

TEST_F(FOpacitySceneTest, FallBackIsInTheSameFrame)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo());
	const FRTObjectId Object = Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	Scene->SetMaterials(Object, {OtherIndex, SolidIndex});
	Frame();
	ASSERT_EQ(GetInstances().size(), 1u);
	EXPECT_EQ(GetInstances()[0].Geometry, Geometry->GetStructure());
	EXPECT_EQ(GetBuilt(Geometry), Whole);
	EXPECT_TRUE(GetInstances()[0].bBuilt);
	// Within a budget that has room for nothing, too: what was in the picture stays in it.
	FSceneUse Use;
	Use.bBuildAll = false;
	Set("r.RT.Build.TrianglesPerFrame", "1");
	const FRTGeometryRef Second = Create(MakeClassifiedInfo()), Third = Create(MakeClassifiedInfo());
	Add(Second, {MaskedIndex, SolidIndex});
	Add(Third, {MaskedIndex, SolidIndex});
	Settle({}, Use);
	ASSERT_EQ(GetInstances().size(), 3u);
	Scene->SetAlphaTest(false);
	Frame({}, Use);
	EXPECT_EQ(GetInstances().size(), 3u);
	EXPECT_EQ(GetBuilt(Second), Whole);
	EXPECT_EQ(GetBuilt(Third), Whole);
	Set("r.RT.Build.TrianglesPerFrame", "500000");
}

TEST_F(FOpacitySceneTest, EmissiveMaterialsHaveNoPieces)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo(9));
	Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	FMaterialData Lit = Masked;
	Lit.EmissiveWeight = 1.0f;
	Scene->SetMaterial(MaskedIndex, Lit);
	ExpectFallback(Geometry);
}

TEST_F(FOpacitySceneTest, SectionsOfOneClassAlone)
{
	FRTGeometryInfo Info = MakeClassifiedInfo();
	Info.Sections[0].OpaqueIndexCount = 30;
	Info.Sections[0].TransparentIndexCount = 0;
	const FRTGeometryRef Opaque = Create(Info);
	Info.Sections[0].OpaqueIndexCount = 0;
	Info.Sections[0].TransparentIndexCount = 30;
	const FRTGeometryRef Transparent = Create(Info);
	const FRTObjectId Object = Add(Opaque, {MaskedIndex, SolidIndex});
	Add(Transparent, {MaskedIndex, SolidIndex});
	Settle();
	EXPECT_EQ(GetBuilt(Opaque), (std::vector<uint32_t>{10, 10}));
	EXPECT_EQ(GetOpaque(Opaque), (std::vector<bool>{true, true}));
	EXPECT_FALSE(GetSection(Object, 0).Flags & SECTION_MASKED);
	EXPECT_EQ(GetBuilt(Transparent), (std::vector<uint32_t>{1, 10})) << "no part may be empty";
	EXPECT_EQ(GetOpaque(Transparent), (std::vector<bool>{false, true}));
}

TEST_F(FOpacitySceneTest, LostFrameFallsBackAllTheSame)
{
	const FRTGeometryRef Geometry = Create(MakeClassifiedInfo());
	const FRTObjectId Object = Add(Geometry, {MaskedIndex, SolidIndex});
	Settle();
	Scene->SetMaterials(Object, {OtherIndex, SolidIndex});
	TRTRef<IRTCommandList> List;
	ASSERT_TRUE(Device->CreateCommandList("Lost", List.ReleaseAndGetAddress()));
	ASSERT_TRUE(List->Begin());
	EXPECT_TRUE(Scene->Update(*List, *Uploads, glm::dvec3(0), {}));
	ASSERT_TRUE(List->End());
	Uploads->EndFrame(0);
	Scene->EndFrame(false);
	ExpectFallback(Geometry);
}

} // namespace Lantern
