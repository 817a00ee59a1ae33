// What an engine says of its scene, as shaders see it: materials with all their maps, vertices, indices, objects and lights.
#include <cmath>
#include <limits>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

class FModuleSceneTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(SetSun(-1.0));
	}
	void TearDown() override
	{
		Samplers.clear();
		Textures.clear();
		FModuleTest::TearDown();
	}
	FRTModuleMap MakeMap(uint32_t UVSet)
	{
		FRTModuleMap Map;
		TRTRef<IRTSampler>& Sampler = Samplers.emplace_back();
		const FRTStatus Status = Device->CreateSampler({}, Sampler.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		Textures.push_back(MakeTexture(ERTFormat::RGBA8_SRGB, 4));
		Map.Texture = Textures.back().Get();
		Map.Sampler = Sampler.Get();
		Map.UVSet = UVSet;
		const auto Number = float(Textures.size());
		Map.UVMatrix[0] = Number;
		Map.UVMatrix[1] = 0.5f;
		Map.UVOffset[1] = -Number;
		return Map;
	}
	/// Renders, and reads the only buffer of the name from the device.
	std::vector<uint8_t> ReadMesh(const char* Name)
	{
		const FRTStatus Status = RenderWholeFrame();
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		const auto Buffers = Mock().FindLiveBuffers(Name);
		EXPECT_EQ(Buffers.size(), 1u);
		if (Buffers.size() != 1) { return {}; }
		const uint8_t* const Bytes = Mock().GetBytes(Buffers[0]);
		return {Bytes, Bytes + Buffers[0]->GetDesc().Size};
	}
	uint64_t CountInstances() { return Mock().FindCalls(ERTMockCall::BuildScene).back().Numbers[0]; }

	std::vector<TRTRef<IRTSampler>> Samplers;
	std::vector<TRTRef<IRTTexture>> Textures;
};

TEST_F(FModuleSceneTest, EveryMapOfAMaterialReachesTheShaders)
{
	FRTModuleMaterial Material;
	Material.NormalScale = 0.75f;
	Material.OcclusionStrength = 0.25f;
	Material.Ior = 1.33f;
	Material.Specular = 0.5f;
	Material.Transmission = 0.125f;
	Material.Emissive[0] = 100.0f;
	Material.EmissiveMapMean[0] = 0.5f;
	Material.bSolid = true;
	Material.AttenuationColor[1] = 0.5f;
	Material.AttenuationDistance = 0.25f;
	Material.ScatterAlbedo[2] = 0.875f;
	Material.ScatterAnisotropy = -0.5f;
	Material.DiffuseTransmission = 0.375f;
	Material.DiffuseTransmissionColor[1] = 0.625f;
	FRTModuleMap* const Maps[] = {&Material.BaseColorMap, &Material.MetallicRoughnessMap, &Material.NormalMap, &Material.OcclusionMap,
	    &Material.EmissiveMap, &Material.TransmissionMap, &Material.DiffuseTransmissionMap, &Material.DiffuseTransmissionColorMap};
	for (uint32_t Slot = 0; Slot < TEXTURE_SLOTS; ++Slot) { *Maps[Slot] = MakeMap(Slot % 2); }
	ERTMaterialHandle Handle = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial(Material, &Handle));
	ASSERT_OK(AddObject(AddOpaqueMesh(), Handle));
	const FSceneConstants Constants = ReadConstants(DescribeFrame());
	const auto Data = ReadEntry<FMaterialData>(Constants.Materials, 2); // behind those of the fixture
	for (uint32_t Slot = 0; Slot < TEXTURE_SLOTS; ++Slot)
	{
		EXPECT_EQ(Data.Textures[Slot], Maps[Slot]->Texture->GetSampledIndex() | Maps[Slot]->Sampler->GetIndex() << TEXTURE_INDEX_BITS)
		    << Slot;
		EXPECT_EQ(Data.UVTransform[Slot], glm::vec4(float(Slot + 1), 0.5f, 0, 1)) << Slot;
		EXPECT_EQ(Data.UVOffset[Slot], glm::vec2(0, -float(Slot + 1))) << Slot;
	}
	EXPECT_EQ(Data.UVSets, 0b10101010u);
	EXPECT_EQ(Data.DiffuseTransmission, 0.375f);
	EXPECT_EQ(Data.DiffuseTransmissionColor, glm::vec3(1, 0.625f, 1));
	EXPECT_EQ(Data.Flags, MATERIAL_SOLID);
	EXPECT_NEAR(Data.Extinction.y, std::log(2.0f) / 0.25f, 1e-5f);
	EXPECT_EQ(Data.Extinction.x, 0.0f);
	EXPECT_EQ(Data.ScatterAlbedo, glm::vec3(0, 0, 0.875f));
	EXPECT_EQ(Data.ScatterAnisotropy, -0.5f);
	EXPECT_EQ(Data.NormalScale, 0.75f);
	EXPECT_EQ(Data.OcclusionStrength, 0.25f);
	EXPECT_EQ(Data.Ior, 1.33f);
	EXPECT_EQ(Data.Specular, 0.5f);
	EXPECT_EQ(Data.Transmission, 0.125f);
	EXPECT_NEAR(Data.EmissiveWeight, 100.0f * 0.5f * 0.2126f / 64.0f, 1e-3f) << "the mean of the map counts";
	EXPECT_EQ(Data.LightEmissive, Data.Emissive) << "unless the material says otherwise";
}

TEST_F(FModuleSceneTest, ScatteringOutOfRangeIsRefused)
{
	const float NaN = std::numeric_limits<float>::quiet_NaN();
	ERTMaterialHandle Handle = ERTMaterialHandle::None;
	for (const float Value : {1.0f, -1.0f, NaN})
	{
		FRTModuleMaterial Water;
		Water.ScatterAnisotropy = Value;
		EXPECT_REFUSED(Renderer->AddMaterial(Water, &Handle), "ScatterAnisotropy");
	}
	for (const float Value : {1.5f, -0.5f, NaN})
	{
		FRTModuleMaterial Water;
		Water.ScatterAlbedo[1] = Value;
		EXPECT_REFUSED(Renderer->AddMaterial(Water, &Handle), "ScatterAlbedo[1]");
	}
}

TEST_F(FModuleSceneTest, BlendedMaterialsAreMarkedUnlessLightShinesThroughThem)
{
	FRTModuleMaterial Smoke;
	Smoke.bBlended = true;
	Smoke.BaseColor[3] = 0.25f;
	Smoke.Emissive[0] = 100.0f;
	FRTModuleMaterial Glass = Smoke;
	Glass.Transmission = 1.0f;
	ERTMaterialHandle Handles[2] = {};
	ASSERT_OK(Renderer->AddMaterial(Smoke, &Handles[0]));
	ASSERT_OK(Renderer->AddMaterial(Glass, &Handles[1]));
	EXPECT_REFUSED(AddObject(AddOpaqueMesh(), Handles[0]), "bMayBeMasked"); // an opaque section has no layers
	const FRTModuleSection Section{0, 3, true};
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.Name = "Cards";
	Mesh.Sections = &Section;
	Mesh.SectionCount = 1;
	for (const ERTMaterialHandle Handle : Handles) { ASSERT_OK(AddObject(AddMesh(Mesh), Handle)); }
	const FSceneConstants Constants = ReadConstants(DescribeFrame());
	const auto First = ReadEntry<FMaterialData>(Constants.Materials, 2), Second = ReadEntry<FMaterialData>(Constants.Materials, 3);
	EXPECT_EQ(First.Flags, MATERIAL_BLENDED | MATERIAL_MASKED) << "masked where r.RT.Transmission is off";
	EXPECT_EQ(First.EmissiveWeight, 0.0f) << "light sampling counts whole triangles";
	EXPECT_EQ(Second.Flags, 0u);
	EXPECT_GT(Second.EmissiveWeight, 0.0f);
}

TEST_F(FModuleSceneTest, MaterialsMayLightOtherwiseThanTheyLook)
{
	FRTModuleMaterial Material;
	Material.Emissive[0] = 1.0f;
	Material.LightEmissive[1] = 510.0f;
	Material.bLightEmissive = true;
	ERTMaterialHandle Handle = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial(Material, &Handle));
	ASSERT_OK(AddObject(AddOpaqueMesh(), Handle));
	const auto Data = ReadEntry<FMaterialData>(ReadConstants(DescribeFrame()).Materials, 2);
	EXPECT_EQ(Data.Emissive, glm::vec3(1, 0, 0));
	EXPECT_EQ(Data.LightEmissive, glm::vec3(0, 510, 0));
	EXPECT_NEAR(Data.EmissiveWeight, 510.0f * 0.7152f / 64.0f, 5e-3f);
}

TEST_F(FModuleSceneTest, MapsOfAReplacedMaterialAreLetGo)
{
	FRTModuleMaterial Material;
	Material.NormalMap = MakeMap(0);
	Material.EmissiveMap = MakeMap(0);
	ASSERT_OK(Renderer->SetMaterial(Solid, Material));
	ASSERT_OK(RenderWholeFrame());
	Samplers.clear();
	Textures.clear();
	EXPECT_EQ(CountDestroyed("Test"), 0u);
	ASSERT_OK(Renderer->SetMaterial(Solid, {}));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountDestroyed("Test"), 2u);
}

TEST_F(FModuleSceneTest, WrongMapsAreNamed)
{
	ERTMaterialHandle Handle = ERTMaterialHandle::None;
	FRTModuleMaterial Material;
	Material.OcclusionMap = MakeMap(0);
	Material.OcclusionMap.Sampler = nullptr;
	EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "OcclusionMap needs a sampler");
	Material.OcclusionMap = MakeMap(2);
	EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "OcclusionMap has another UVSet");
	Material.OcclusionMap = MakeMap(1);
	Material.OcclusionMap.UVMatrix[3] = std::numeric_limits<float>::quiet_NaN();
	EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "OcclusionMap has a UVMatrix");
	Material.OcclusionMap = {};
	Material.Ior = 0.5f;
	EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "Ior");
	Material.Ior = 1.5f;
	Material.Transmission = 1.5f;
	EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "Transmission");
	for (const float Bad : {0.0f, 1.5f, std::numeric_limits<float>::quiet_NaN()})
	{
		Material = {};
		Material.AttenuationColor[1] = Bad;
		EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "AttenuationColor");
	}
	Material = {};
	Material.AttenuationDistance = 0.0f;
	EXPECT_REFUSED(Renderer->AddMaterial(Material, &Handle), "AttenuationDistance");
}

TEST_F(FModuleSceneTest, VerticesCarryTangentsBothCoordinatesAndColours)
{
	const float VertexNormals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
	const float Tangents[] = {1, 0, 0, 1, 0, 1, 0, -1, 1, 0, 0, 1};
	const float UVs[] = {1, 2, 3, 4, 5, 6}, UVs1[] = {7, 8, 9, 10, 11, 12};
	const uint8_t Colors[] = {1, 2, 3, 4, 5, 6, 7, 8, 255, 255, 255, 255};
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.Name = "Rich";
	Mesh.Normals = VertexNormals;
	Mesh.Tangents = Tangents;
	Mesh.UVs = UVs;
	Mesh.UVs1 = UVs1;
	Mesh.Colors = Colors;
	AddMesh(Mesh);
	const std::vector<uint8_t> Bytes = ReadMesh("Rich");
	ASSERT_EQ(Bytes.size(), 36u + 3 * sizeof(FVertexAttributes) + 12);
	FVertexAttributes Vertices[3];
	std::memcpy(Vertices, Bytes.data() + 36, sizeof(Vertices));
	EXPECT_EQ(Vertices[0].Tangent, 0x00007fffu) << "+x";
	EXPECT_EQ(Vertices[1].Tangent, 0x7fff0000u) << "+y; the lowest bit of y is the sign of the bitangent";
	EXPECT_EQ(Vertices[1].UV0, glm::vec2(3, 4));
	EXPECT_EQ(Vertices[2].UV1, glm::vec2(11, 12));
	EXPECT_EQ(Vertices[0].Color, 0x04030201u);
	EXPECT_EQ(Vertices[2].Color, 0xffffffffu);
}

TEST_F(FModuleSceneTest, SectionsMayHaveAnIndexBase)
{
	const float Positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0};
	const uint32_t Local[] = {0, 1, 2, 0, 1, 2};
	const FRTModuleSection Sections[] = {{0, 3, false, 0}, {3, 3, false, 3}};
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.Name = "Based";
	Mesh.Positions = Positions;
	Mesh.VertexCount = 6;
	Mesh.Indices = Local;
	Mesh.IndexCount = 6;
	Mesh.Sections = Sections;
	Mesh.SectionCount = 2;
	const ERTMeshHandle Handle = AddMesh(Mesh);
	const ERTMaterialHandle Materials[] = {Solid, Solid};
	FRTModuleObject Desc;
	Desc.Mesh = Handle;
	Desc.Materials = Materials;
	Desc.MaterialCount = 2;
	ASSERT_OK(Renderer->AddObject(Desc, &Object));
	const std::vector<uint8_t> Bytes = ReadMesh("Based");
	uint32_t Indices[6] = {};
	ASSERT_EQ(Bytes.size(), 6 * (12 + sizeof(FVertexAttributes)) + sizeof(Indices));
	std::memcpy(Indices, Bytes.data() + Bytes.size() - sizeof(Indices), sizeof(Indices));
	EXPECT_THAT(Indices, ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
	FRTModuleSection Past[] = {{0, 3, false, 4}};
	Mesh.Sections = Past;
	Mesh.SectionCount = 1;
	ERTMeshHandle None = ERTMeshHandle::None;
	EXPECT_REFUSED(Renderer->AddMesh(Mesh, &None), "an index is out of range");
	Past[0].FirstVertex = ~0u;
	EXPECT_REFUSED(Renderer->AddMesh(Mesh, &None), "an index is out of range");
}

TEST_F(FModuleSceneTest, IndicesOf16BitsStaySo)
{
	const uint16_t Indices[] = {2, 1, 0};
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.Name = "Short";
	Mesh.Indices = nullptr;
	Mesh.Indices16 = Indices;
	ASSERT_OK(AddObject(AddMesh(Mesh), Solid));
	const std::vector<uint8_t> Bytes = ReadMesh("Short");
	ASSERT_EQ(Bytes.size(), 36 + 3 * sizeof(FVertexAttributes) + 8) << "padded to whole words";
	EXPECT_EQ(std::memcmp(Bytes.data() + Bytes.size() - 8, Indices, sizeof(Indices)), 0);
	Mesh.Indices = TriangleIndices;
	ERTMeshHandle None = ERTMeshHandle::None;
	EXPECT_REFUSED(Renderer->AddMesh(Mesh, &None), "Indices16");
	const FSceneConstants Constants = ReadConstants(DescribeFrame());
	const auto Data = ReadEntry<FObjectData>(Constants.Objects, 0);
	EXPECT_NE(ReadEntry<FSectionData>(Constants.Sections, Data.FirstSection).Flags & SECTION_INDEX_16, 0u);
}

TEST_F(FModuleSceneTest, ManyObjectsComeInOneCallOrNone)
{
	const ERTMeshHandle Mesh = AddOpaqueMesh();
	std::vector<FRTModuleObject> Descs(100);
	for (FRTModuleObject& Desc : Descs)
	{
		Desc.Mesh = Mesh;
		Desc.Materials = &Solid;
		Desc.MaterialCount = 1;
	}
	std::vector<ERTObjectHandle> Handles(100);
	Descs[70].Materials = &Masked;
	EXPECT_REFUSED(Renderer->AddObjects(Descs.data(), 100, Handles.data()), "object 70: mesh \"Wall\": section 0");
	for (const ERTObjectHandle Handle : Handles) { EXPECT_EQ(Handle, ERTObjectHandle::None); }
	ASSERT_OK(Renderer->RemoveMesh(Mesh)); // nothing uses it
	const ERTMeshHandle Other = AddOpaqueMesh();
	for (FRTModuleObject& Desc : Descs)
	{
		Desc.Mesh = Other;
		Desc.Materials = &Solid;
	}
	ASSERT_OK(Renderer->AddObjects(Descs.data(), 100, Handles.data()));
	ASSERT_OK(Renderer->AddObjects(nullptr, 0, nullptr));
	EXPECT_REFUSED(Renderer->AddObjects(nullptr, 1, Handles.data()), "Objects is null");
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 100u);
	for (const ERTObjectHandle Handle : Handles) { ASSERT_OK(Renderer->RemoveObject(Handle)); }
}

TEST_F(FModuleSceneTest, WhoSeesAnObjectIsForTheEngineToSay)
{
	const ERTMeshHandle Mesh = AddOpaqueMesh();
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u);
	ASSERT_OK(Renderer->SetObjectCastsShadow(Object, false));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u) << "others see it";
	ASSERT_OK(Renderer->SetObjectVisible(Object, false));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 1u) << "nobody does";
	ASSERT_OK(Renderer->SetObjectCastsShadow(Object, true));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountInstances(), 2u);
	EXPECT_REFUSED(Renderer->SetObjectVisible(ERTObjectHandle::None, true), "SetObjectVisible: no such object");
}

TEST_F(FModuleSceneTest, TheEnginesGpuMayWriteVertices)
{
	FRTModuleMeshBuffer Where;
	EXPECT_REFUSED(Renderer->GetMeshBuffer(AddMesh(DescribeTriangle()), &Where), "without bDeformable");
	EXPECT_REFUSED(Renderer->GetMeshBuffer(AddDeformableMesh(), &Where), "without BoundsRadius");
	FRTModuleMesh Mesh = DescribeTriangle();
	Mesh.Name = "Skin";
	Mesh.bDeformable = true;
	Mesh.BoundsRadius = 5.0f;
	const ERTMeshHandle Skin = AddMesh(Mesh);
	ASSERT_OK(AddObject(Skin, Solid));
	ASSERT_OK(Renderer->GetMeshBuffer(Skin, &Where));
	EXPECT_EQ(Where.Buffer, nullptr) << "it is still on its way";
	ASSERT_OK(RenderWholeFrame());
	ASSERT_OK(Renderer->GetMeshBuffer(Skin, &Where));
	ASSERT_NE(Where.Buffer, nullptr);
	EXPECT_GE(Where.Buffer->GetDesc().Size, Where.PositionsOffset + 36);
	Mock().ClearCalls();
	ASSERT_OK(Renderer->MarkMeshDeformed(Skin));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Skin"), 0u);
	const std::vector<FRTMockCall> Builds = Mock().FindCalls(ERTMockCall::BuildGeometry, "Skin");
	ASSERT_EQ(Builds.size(), 1u);
	EXPECT_EQ(Builds[0].Numbers[1], 1u) << "a refit";
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry, "Skin"), 1u);
}

TEST_F(FModuleSceneTest, FramesLeaveTheGraphicsStateAlone)
{
	ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
	const auto Step = [&] {
		ASSERT_OK(RenderWholeFrame());
		GiveWay();
	};
	Outputs = {};
	ASSERT_TRUE(WaitUntil(
	    "a complete frame", [&] { return Outputs.bComplete; }, Step));
	for (const ERTMockCall Kind : {ERTMockCall::BeginRasterPass, ERTMockCall::SetIndexBuffer, ERTMockCall::Draw, ERTMockCall::DrawIndexed})
	{
		EXPECT_EQ(Mock().CountCalls(Kind), 0u) << static_cast<int>(Kind);
	}
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker), Mock().CountCalls(ERTMockCall::EndMarker));
}

} // namespace
} // namespace Lantern
