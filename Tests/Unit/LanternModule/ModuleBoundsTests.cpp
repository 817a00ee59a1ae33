// Bounds of the module's meshes, and all that follows from them: culling, the order of builds, the reach of rays, coarser
// levels and the list of emissive triangles.
#include <limits>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

constexpr double Far = 100'000.0;

class FModuleBoundsTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(SetSun(-1.0));
		ASSERT_OK(AddObject(AddOpaqueMesh(), Solid)); // at the camera
	}
	/// A square of Size metres at Offset from its pivot, in Count × Count quads.
	struct FSheet
	{
		std::vector<float> Positions;
		std::vector<uint32_t> Indices;
		FRTModuleMesh Mesh;
	};
	static FSheet MakeSheet(const char* Name, uint32_t Count, float Size, float Offset = 0.0f)
	{
		FSheet Out;
		const auto At = [&](uint32_t Step) { return Offset + Size * static_cast<float>(Step) / static_cast<float>(Count); };
		for (uint32_t Row = 0; Row <= Count; ++Row)
		{
			for (uint32_t Column = 0; Column <= Count; ++Column) { Out.Positions.insert(Out.Positions.end(), {At(Column), 0.0f, At(Row)}); }
		}
		for (uint32_t Row = 0; Row < Count; ++Row)
		{
			for (uint32_t Column = 0; Column < Count; ++Column)
			{
				const uint32_t A = Row * (Count + 1) + Column, B = A + Count + 1;
				Out.Indices.insert(Out.Indices.end(), {A, B, A + 1, A + 1, B, B + 1});
			}
		}
		Out.Mesh.Name = Name;
		Out.Mesh.Positions = Out.Positions.data();
		Out.Mesh.VertexCount = static_cast<uint32_t>(Out.Positions.size() / 3);
		Out.Mesh.Indices = Out.Indices.data();
		Out.Mesh.IndexCount = static_cast<uint32_t>(Out.Indices.size());
		return Out;
	}
	void PlaceAt(double X)
	{
		const double Transform[12] = {1, 0, 0, X, 0, 1, 0, 0, 0, 0, 1, 0};
		ASSERT_OK(Renderer->SetObjectTransform(Object, Transform));
	}
	/// Instances of the last frame's structure.
	uint64_t CountInstances() { return Mock().FindCalls(ERTMockCall::BuildScene).back().Numbers[0]; }
	std::vector<std::string> GetBuilt()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BuildGeometry)) { Names.push_back(Call.Name); }
		return Names;
	}
};

TEST_F(FModuleBoundsTest, WhatIsFarAwayAndSmallIsNoInstance)
{
	SetVariable("r.RT.Culling.Radius", "50");
	SetVariable("r.RT.Culling.RadiusBehind", "50");
	ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
	PlaceAt(Far);
	const ERTObjectHandle Away = Object;
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 1u);
	Object = Away;
	PlaceAt(10.0);
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u);
}

TEST_F(FModuleBoundsTest, BoundsThatAnEngineGivesCount)
{
	SetVariable("r.RT.Culling.Radius", "50");
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.BoundsCenter[0] = -float(Far);
	Mesh.BoundsRadius = 2.0f;
	ASSERT_OK(AddObject(AddMesh(Mesh), Solid));
	PlaceAt(Far); // its bounds are at the camera
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u);
	PlaceAt(0.0); // its vertices are at the camera
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 1u);
	Mesh.BoundsRadius = std::numeric_limits<float>::quiet_NaN();
	ERTMeshHandle Handle = ERTMeshHandle::None;
	EXPECT_REFUSED(Renderer->AddMesh(Mesh, &Handle), "BoundsRadius");
	Mesh.BoundsRadius = 1.0f;
	Mesh.BoundsCenter[2] = std::numeric_limits<float>::infinity();
	EXPECT_REFUSED(Renderer->AddMesh(Mesh, &Handle), "BoundsCenter");
}

TEST_F(FModuleBoundsTest, BoundsFollowVertices)
{
	SetVariable("r.RT.Culling.Radius", "50");
	SetVariable("r.RT.Culling.RadiusBehind", "50");
	const ERTMeshHandle Cloth = AddDeformableMesh();
	ASSERT_OK(AddObject(Cloth, Solid));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u);
	const float X = float(Far);
	const float Away[] = {X, 0, 0, X + 1, 0, 0, X, 1, 0};
	ASSERT_OK(Renderer->UpdateMeshVertices(Cloth, Away, nullptr));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 1u) << "it was left out with its new vertices";
	ASSERT_OK(Renderer->UpdateMeshVertices(Cloth, TrianglePositions, nullptr));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u);
}

TEST_F(FModuleBoundsTest, NearAndLargeMeshesAreBuiltFirst)
{
	SetVariable("r.RT.Build.TrianglesPerFrame", "1");
	const char* const Names[] = {"Distant", "Small", "Large"};
	const double Places[] = {900.0, 20.0, 20.0};
	for (int I = 0; I < 3; ++I)
	{
		const FSheet Sheet = MakeSheet(Names[I], 1, I == 2 ? 8.0f : 1.0f);
		ASSERT_OK(AddObject(AddMesh(Sheet.Mesh), Solid));
		PlaceAt(Places[I]);
	}
	// The first frame has seen nothing yet: it takes what came first.
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_EQ(GetBuilt(), (std::vector<std::string>{"Wall", "Large", "Small", "Distant"}));
}

TEST_F(FModuleBoundsTest, RaysKnowHowFarPivotsAre)
{
	EXPECT_FLOAT_EQ(ReadConstants(DescribeFrame()).ObjectReach, 8.0f) << "what small objects have";
	const FSheet Terrain = MakeSheet("Terrain", 4, 2000.0f, -1000.0f);
	ASSERT_OK(AddObject(AddMesh(Terrain.Mesh), Solid));
	PlaceAt(600.0);
	const float Reach = ReadConstants(DescribeFrame()).ObjectReach;
	EXPECT_GT(Reach, 500.0f) << "rays into its space lose the precision of its pivot's distance";
	EXPECT_LT(Reach, 700.0f);
}

TEST_F(FModuleBoundsTest, WhatDoesNotFitIsMadeCoarser)
{
	SetVariable("r.RT.Build.MemoryMB", "2");
	const FSheet Dense = MakeSheet("Dense", 180, 10.0f);
	const uint64_t Triangles = Dense.Mesh.IndexCount / 3;
	ASSERT_OK(AddObject(AddMesh(Dense.Mesh), Solid));
	const auto IsBuilt = [&] { return Mock().CountCalls(ERTMockCall::BuildGeometry, "Dense") > 0; };
	const auto Step = [&] {
		ASSERT_OK(RenderWholeFrame());
		GiveWay();
	};
	ASSERT_TRUE(WaitUntil(
	    "a coarser level", [&] { return IsBuilt() || !Messages.empty(); }, Step));
	ASSERT_TRUE(IsBuilt());
	EXPECT_LT(Mock().FindCalls(ERTMockCall::CreateGeometry, "Dense").back().Numbers[1], Triangles);

	// Nothing is kept of it on the CPU: it cannot be made coarser, and is left out.
	FRTModuleMesh Bare = Dense.Mesh;
	Bare.Name = "Bare";
	Bare.bKeepOnCpu = false;
	ASSERT_OK(AddObject(AddMesh(Bare), Solid));
	for (int Frame = 0; Frame < 10; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry, "Bare"), 0u);
}

TEST_F(FModuleBoundsTest, EmissiveMeshesAreLights)
{
	SetVariable("r.RT.GI", "1");
	FRTModuleMaterial Glow;
	Glow.Emissive[1] = 5.0f;
	ERTMaterialHandle Lamp = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial(Glow, &Lamp));
	ASSERT_OK(AddObject(AddOpaqueMesh(), Lamp));
	const TRTRef<IRTTexture> BaseColor = MakeTexture(ERTFormat::RGBA8_SRGB, 64), Material = MakeTexture(ERTFormat::RGBA8_UNORM, 64);
	FRTModuleFrame Frame = DescribeFrame();
	Frame.BaseColor = BaseColor.Get();
	Frame.Material = Material.Get();
	Frame.Wanted = {ESignal::DiffuseGI};
	const FSceneConstants Constants = ReadConstants(Frame);
	EXPECT_EQ(Constants.EmissiveTriangleCount, 1u);
	EXPECT_NE(Constants.EmissivePowers, 0u);
}

} // namespace
} // namespace Lantern
