// What the loader makes of well-formed files.
#include <chrono>

#include <glm/gtc/constants.hpp>

#include "LanternHost/VertexPacking.h"
#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

size_t CountTriangles(const FSceneDescription& Scene)
{
	size_t Count = 0;
	for (const FHostMesh& Mesh : Scene.Meshes)
	{
		for (const FHostSection& Section : Mesh.Sections) { Count += Section.IndexCount / 3; }
	}
	return Count;
}

TEST(VertexPacking, UnitVectorsSurviveWithinHalfAMinuteOfArc)
{
	for (int I = 0; I < 2000; ++I)
	{
		const float Z = 1.0f - 2.0f * (float(I) + 0.5f) / 2000.0f, Angle = float(I) * 2.399963f;
		const float R = std::sqrt(1.0f - Z * Z);
		const glm::vec3 V(R * std::cos(Angle), R * std::sin(Angle), Z);
		EXPECT_LT(glm::length(UnpackUnitVector(PackUnitVector(V)) - V), 1.5e-4f);
		for (const float Sign : {-1.0f, 1.0f})
		{
			const glm::vec4 Tangent = UnpackTangent(PackTangent(glm::vec4(V, Sign)));
			EXPECT_EQ(Tangent.w, Sign);
			EXPECT_LT(glm::length(glm::vec3(Tangent) - V), 2.5e-4f);
		}
	}
	EXPECT_EQ(PackColor({1, 0, 0.5f, 2}), 0xff8000ffu);
}

TEST(SceneLoader, ATriangleWithoutNormalsIsFlatAndHasADefaultMaterial)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSceneDescription& Scene = *Result.Scene;
	ASSERT_EQ(Scene.Meshes.size(), 1u);
	EXPECT_EQ(Scene.Meshes[0].Indices, (std::vector<uint32_t>{0, 1, 2}));
	EXPECT_EQ(Scene.Meshes[0].Positions[1], glm::vec3(1, 0, 0));
	EXPECT_EQ(Scene.Meshes[0].BoundsMax, glm::vec3(1, 1, 0));
	for (const FVertexAttributes& Attributes : Scene.Meshes[0].Attributes)
	{
		EXPECT_LT(glm::length(UnpackUnitVector(Attributes.Normal) - glm::vec3(0, 0, 1)), 1e-3f);
		EXPECT_EQ(Attributes.Color, 0xffffffffu);
	}
	ASSERT_EQ(Scene.Materials.size(), 1u);
	EXPECT_EQ(Scene.Materials[0].Name, "default");
	EXPECT_TRUE(Scene.Warnings.empty());
	EXPECT_EQ(ValidateScene(Scene), "");
}

TEST(SceneLoader, AGlbGivesTheSameAsTheText)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	const std::string Glb = Maker.GetGlb();
	const FLoadResult Result = LoadSceneFromMemory(Glb.data(), Glb.size(), "test.glb");
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Meshes[0].Positions, Maker.Load().Scene->Meshes[0].Positions);
}

TEST(SceneLoader, AllIndexTypesStripsAndFansGiveTheSameSurface)
{
	struct FCase
	{
		int Mode, ComponentType;
		std::vector<uint32_t> Expected;
	};
	// A square 0 1 2 3 as the corners (0,0) (1,0) (0,1) (1,1).
	for (const FCase& Case : {FCase{4, 5121, {0, 1, 2}}, FCase{4, 5123, {0, 1, 2}}, FCase{4, 5125, {0, 1, 2}},
	         FCase{5, 5121, {0, 1, 2, 1, 3, 2}}, FCase{6, 5123, {1, 2, 0, 2, 3, 0}}})
	{
		FGltfMaker Maker;
		auto& Primitive = Maker.AddTriangle();
		Primitive["attributes"]["POSITION"] = Maker.AddVec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
		Primitive["attributes"]["NORMAL"] = Maker.AddVec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
		Primitive["mode"] = Case.Mode;
		const size_t Count = Case.Mode == 4 ? 3 : 4;
		Primitive["indices"] = Case.ComponentType == 5121   ? Maker.AddAccessor(std::vector<uint8_t>{0, 1, 2, 3}, "SCALAR", 5121, Count)
		                       : Case.ComponentType == 5123 ? Maker.AddAccessor(std::vector<uint16_t>{0, 1, 2, 3}, "SCALAR", 5123, Count)
		                                                    : Maker.AddAccessor(std::vector<uint32_t>{0, 1, 2, 3}, "SCALAR", 5125, Count);
		const FLoadResult Result = Maker.Load();
		ASSERT_TRUE(Result.Scene) << Result.Error;
		EXPECT_EQ(Result.Scene->Meshes[0].Indices, Case.Expected) << "mode " << Case.Mode;
	}
}

TEST(SceneLoader, NormalisedAndQuantisedAttributesAreConverted)
{
	FGltfMaker Maker;
	auto& Primitive = Maker.AddTriangle();
	Maker.Json["extensionsUsed"] = Maker.Json["extensionsRequired"] = {"KHR_mesh_quantization"};
	const std::vector<int16_t> Positions = {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0};
	const int Position = Maker.AddAccessor(Positions, "VEC3", 5122, 3);
	Maker.Json["accessors"][Position]["normalized"] = true;
	Maker.Json["bufferViews"].back()["byteStride"] = 8;
	Primitive["attributes"]["POSITION"] = Position;
	const int UV0 = Maker.AddAccessor(std::vector<uint8_t>{0, 255, 0, 0, 51, 102, 0, 0, 255, 0, 0, 0}, "VEC2", 5121, 3);
	Maker.Json["accessors"][UV0]["normalized"] = true;
	Maker.Json["bufferViews"].back()["byteStride"] = 4;
	Primitive["attributes"]["TEXCOORD_0"] = UV0;
	const int UV1 = Maker.AddAccessor(std::vector<uint16_t>{0, 65535, 13107, 0, 65535, 0}, "VEC2", 5123, 3);
	Maker.Json["accessors"][UV1]["normalized"] = true;
	Primitive["attributes"]["TEXCOORD_1"] = UV1;
	const int Color = Maker.AddAccessor(std::vector<uint16_t>{65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0}, "VEC3", 5123, 3);
	Maker.Json["accessors"][Color]["normalized"] = true;
	Maker.Json["bufferViews"].back()["byteStride"] = 8;
	Primitive["attributes"]["COLOR_0"] = Color;
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FHostMesh& Mesh = Result.Scene->Meshes[0];
	EXPECT_EQ(Mesh.Positions[1], glm::vec3(1, 0, 0));
	EXPECT_EQ(Mesh.Positions[2], glm::vec3(0, -1, 0)); // −32768 is clamped
	EXPECT_EQ(Mesh.Attributes[1].UV0, glm::vec2(0.2f, 0.4f));
	EXPECT_EQ(Mesh.Attributes[1].UV1, glm::vec2(0.2f, 0.0f));
	EXPECT_EQ(Mesh.Attributes[0].Color, 0xff0000ffu);
	EXPECT_EQ(Mesh.Attributes[1].Color, 0xff00ff00u);
}

TEST(SceneLoader, SparseAccessorsReplaceElements)
{
	FGltfMaker Maker;
	auto& Primitive = Maker.AddTriangle();
	const int Indices = Maker.AddView(std::vector<uint8_t>{1, 2});
	const int Values = Maker.AddView(std::vector<float>{5, 0, 0, 0, 6, 0});
	const nlohmann::json Sparse = {
	    {"count", 2}, {"indices", {{"bufferView", Indices}, {"componentType", 5121}}}, {"values", {{"bufferView", Values}}}};
	Maker.Json["accessors"][Primitive["attributes"]["POSITION"].get<int>()]["sparse"] = Sparse;
	// A second mesh whose positions are zeros but for the sparse ones.
	Maker.Json["accessors"].push_back({{"type", "VEC3"}, {"componentType", 5126}, {"count", 3}, {"sparse", Sparse}});
	Maker.Json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", Maker.Json["accessors"].size() - 1}}}}}}});
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	for (const FHostMesh& Mesh : Result.Scene->Meshes)
	{
		EXPECT_EQ(Mesh.Positions, (std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}));
	}
}

TEST(SceneLoader, PrimitivesBecomeSectionsAndShareTheirVertices)
{
	FGltfMaker Maker;
	Maker.Json["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
	auto& Primitive = Maker.AddTriangle();
	Primitive["attributes"]["NORMAL"] = Maker.AddVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
	nlohmann::json Second = Primitive;
	Second["material"] = 1;
	Second["indices"] = Maker.AddIndices({2, 1, 0});
	Maker.Json["meshes"][0]["primitives"].push_back(Second);
	Maker.Json["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	ASSERT_EQ(Result.Scene->Meshes.size(), 1u);
	const FHostMesh& Mesh = Result.Scene->Meshes[0];
	EXPECT_EQ(Mesh.Positions.size(), 3u);
	EXPECT_EQ(Mesh.Indices, (std::vector<uint32_t>{0, 1, 2, 2, 1, 0}));
	ASSERT_EQ(Mesh.Sections.size(), 2u);
	EXPECT_EQ(Mesh.Sections[0].Material, 2); // the default one
	EXPECT_EQ(Mesh.Sections[1].Material, 1);
	EXPECT_EQ(Mesh.Sections[1].FirstIndex, 3u);
	EXPECT_EQ(Result.Scene->Nodes[0].Mesh, Result.Scene->Nodes[1].Mesh);
}

TEST(SceneLoader, AnImageUsedAsColourAndAsDataIsThereTwice)
{
	const FLoadResult Result = MakeTextured().Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSceneDescription& Scene = *Result.Scene;
	ASSERT_EQ(Scene.Images.size(), 2u);
	EXPECT_NE(Scene.Images[0].bSrgb, Scene.Images[1].bSrgb);
	EXPECT_EQ(Scene.Images[0].Rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 0, 255, 128}));
	EXPECT_EQ(Scene.Images[1].Rgba, Scene.Images[0].Rgba);
	EXPECT_TRUE(Scene.Images[1].bHasAlpha);
	const auto& Slots = Scene.Materials[0].Slots;
	EXPECT_EQ(Slots[TEXTURE_BASE_COLOR].Texture, Slots[TEXTURE_EMISSIVE].Texture);
	EXPECT_NE(Slots[TEXTURE_BASE_COLOR].Texture, Slots[TEXTURE_NORMAL].Texture);
	EXPECT_EQ(Slots[TEXTURE_OCCLUSION].Texture, -1);
	EXPECT_EQ(Scene.Materials[0].NormalScale, 0.5f);
	const FHostTexture& Texture = Scene.Textures[size_t(Slots[TEXTURE_BASE_COLOR].Texture)];
	EXPECT_FALSE(Texture.bRepeatU);
	EXPECT_TRUE(Texture.bRepeatV && Texture.bMirrorV && Texture.bNearest);
	EXPECT_TRUE(Scene.Images[size_t(Texture.Image)].bSrgb);
}

TEST(SceneLoader, TangentsAreGeneratedWhereANormalMapNeedsThem)
{
	FGltfMaker Maker = MakeTextured();
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_TRUE(Result.Scene->Meshes[0].bHasTangents);
	// u runs along x, v down: the bitangent points up.
	const glm::vec4 Tangent = UnpackTangent(Result.Scene->Meshes[0].Attributes[0].Tangent);
	EXPECT_LT(glm::length(Tangent - glm::vec4(1, 0, 0, 1)), 1e-3f);
	Maker.Json["materials"][0].erase("normalTexture");
	EXPECT_FALSE(Maker.Load().Scene->Meshes[0].bHasTangents);
}

TEST(SceneLoader, LightsAndCamerasAreRead)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	Maker.Json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"color", {1, 0.5, 0}}, {"intensity", 40}, {"range", 7},
	                                                                 {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
	    {{"type", "directional"}}};
	Maker.Json["cameras"] = {{{"type", "orthographic"}, {"orthographic", {{"xmag", 1}}}},
	    {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.05}}}}};
	Maker.Json["nodes"].push_back({{"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
	Maker.Json["nodes"].push_back({{"camera", 0}});
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSceneDescription& Scene = *Result.Scene;
	ASSERT_EQ(Scene.Lights.size(), 2u);
	EXPECT_EQ(Scene.Lights[0].Color, glm::vec3(40, 20, 0));
	EXPECT_EQ(Scene.Lights[0].Range, 7.0f);
	EXPECT_EQ(Scene.Lights[0].OuterCone, 0.2f);
	EXPECT_EQ(Scene.Lights[1].Type, LIGHT_DIRECTIONAL);
	ASSERT_EQ(Scene.Cameras.size(), 1u);
	EXPECT_EQ(Scene.Cameras[0].FovY, 0.7f);
	EXPECT_EQ(Scene.Nodes[1].Camera, 0);
	EXPECT_EQ(Scene.Nodes[1].Light, 1);
	EXPECT_EQ(Scene.Nodes[2].Camera, -1);
	EXPECT_TRUE(HasWarning(Scene, "orthographic"));
}

TEST(SceneLoader, ParentsComeFirstAndOnlyTheChosenSceneIsShown)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	Maker.Json["nodes"] = {{{"mesh", 0}, {"name", "leaf"}}, {{"children", {0}}, {"translation", {1, 2, 3}}, {"name", "root"}},
	    {{"mesh", 0}, {"name", "elsewhere"}}};
	Maker.Json["scenes"] = {{{"nodes", {2}}}, {{"nodes", {1}}}};
	Maker.Json["scene"] = 1;
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	int Shown = 0;
	for (size_t I = 0; I < Result.Scene->Nodes.size(); ++I)
	{
		const FHostNode& Node = Result.Scene->Nodes[I];
		EXPECT_LT(Node.Parent, int(I));
		if (Node.Mesh >= 0)
		{
			++Shown;
			EXPECT_EQ(Node.Name, "leaf");
			EXPECT_EQ(glm::dvec3(EvaluatePose(*Result.Scene, 0).World[I][3]), glm::dvec3(1, 2, 3));
		}
	}
	EXPECT_EQ(Shown, 1);
}

TEST(SceneLoader, GpuInstancesBecomeNodes)
{
	FGltfMaker Maker;
	Maker.AddTriangle();
	const int Places = Maker.AddVec3({1, 0, 0, 2, 0, 0, 3, 0, 0});
	Maker.Json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = Places;
	Maker.Json["nodes"][0]["translation"] = {0, 10, 0};
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	ASSERT_EQ(Result.Scene->Nodes.size(), 4u);
	EXPECT_EQ(Result.Scene->Nodes[0].Mesh, -1);
	EXPECT_EQ(glm::dvec3(EvaluatePose(*Result.Scene, 0).World[3][3]), glm::dvec3(3, 10, 0));
}

TEST(SceneLoader, PrimitivesThatCannotBeDrawnAreLeftOutWithAWord)
{
	FGltfMaker Maker;
	Maker.AddTriangle()["mode"] = 0;
	Maker.AddTriangle()["indices"] = Maker.AddAccessor(std::vector<uint16_t>{0, 1, 2}, "SCALAR", 5123, 2);
	Maker.AddTriangle();
	const FLoadResult Result = Maker.Load();
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Meshes.size(), 1u);
	EXPECT_EQ(Result.Scene->Nodes[0].Mesh, -1);
	EXPECT_EQ(Result.Scene->Nodes[1].Mesh, -1);
	EXPECT_EQ(Result.Scene->Nodes[2].Mesh, 0);
	EXPECT_TRUE(HasWarning(*Result.Scene, "points and lines"));
	EXPECT_TRUE(HasWarning(*Result.Scene, "meshes[1].primitives[0]: left out, it has no triangles"));
}

TEST(SceneLoader, FilesBesideTheAssetAreReadOnceEach)
{
	const FTemporaryFolder Folder;
	const auto& Png = GetTinyPng();
	Folder.Write("an image.png", std::string(Png.begin(), Png.end()));
	FGltfMaker Maker = MakeTextured();
	Maker.Json["images"] = {{{"uri", "an%20image.png"}}, {{"uri", "an%20image.png"}}};
	Maker.Json["textures"][1]["source"] = 1;
	Maker.Json["materials"][0]["emissiveTexture"] = {{"index", 1}};
	Maker.Json["buffers"] = {{{"byteLength", Maker.Data.size()}, {"uri", "./data.bin"}}};
	Folder.Write("data.bin", std::string(Maker.Data.begin(), Maker.Data.end()));
	const FLoadResult Result = LoadScene(Folder.Write("scene.gltf", Maker.Json.dump()));
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(Result.Scene->Name, "scene.gltf");
	EXPECT_EQ(Result.Scene->Images.size(), 2u); // as colour and as data, not four
	EXPECT_EQ(Result.Scene->Images[0].Width, 2u);
}

TEST(SceneLoader, ProgressIsReported)
{
	FLoadOptions Options;
	float Last = 0.0f;
	Options.Progress = [&](std::string_view Stage, float Fraction) { Last = Stage == "images" ? Fraction : Last; };
	ASSERT_TRUE(MakeTextured().Load(Options).Scene);
	EXPECT_EQ(Last, 1.0f);
}

TEST(RealScenes, SponzaIsComplete)
{
	const auto Path = GetScenesFolder() / "sponza/Sponza.gltf";
	LANTERN_REQUIRE_SCENE(Path);
	const FLoadResult Result = LoadScene(Path.string());
	ASSERT_TRUE(Result.Scene) << Result.Error;
	EXPECT_EQ(CountTriangles(*Result.Scene), 262267u);
	EXPECT_EQ(Result.Scene->Meshes[0].Sections.size(), 103u);
	EXPECT_EQ(Result.Scene->Images.size(), 67u);
	EXPECT_EQ(std::count_if(Result.Scene->Materials.begin(), Result.Scene->Materials.end(),
	              [](const FHostMaterial& M) { return M.AlphaMode == EAlphaMode::Mask; }),
	    3);
	EXPECT_TRUE(Result.Scene->Warnings.empty());
}

/// The file's own tangents are the reference of ours. This Sponza has normal maps with +Y down, against the
/// specification, and tangents of the opposite sign that make up for it; ours must be the specification's.
TEST(RealScenes, GeneratedTangentsRunAsSponzasOwn)
{
	const auto Path = GetScenesFolder() / "sponza/Sponza.gltf";
	LANTERN_REQUIRE_SCENE(Path);
	const FTemporaryFolder Folder;
	nlohmann::json Json = nlohmann::json::parse(std::ifstream(Path));
	for (auto& Primitive : Json["meshes"][0]["primitives"]) { Primitive["attributes"].erase("TANGENT"); }
	for (const auto& Entry : std::filesystem::directory_iterator(Path.parent_path()))
	{
		if (Entry.path().extension() != ".gltf")
		{
			std::filesystem::create_symlink(std::filesystem::absolute(Entry.path()), Folder.Get() / Entry.path().filename());
		}
	}
	const FLoadResult Theirs = LoadScene(Path.string());
	const FLoadResult Ours = LoadScene(Folder.Write("scene.gltf", Json.dump()));
	ASSERT_TRUE(Theirs.Scene && Ours.Scene) << Theirs.Error << Ours.Error;
	const FHostMesh& A = Theirs.Scene->Meshes[0];
	const FHostMesh& B = Ours.Scene->Meshes[0];
	ASSERT_EQ(A.Positions.size(), B.Positions.size());
	size_t Compared = 0, OppositeSign = 0, SameDirection = 0;
	for (const FHostSection& Section : A.Sections)
	{
		for (uint32_t I = 0; I < Section.IndexCount; ++I)
		{
			const uint32_t Vertex = A.Indices[Section.FirstIndex + I];
			if (Ours.Scene->Materials[size_t(Section.Material)].Slots[TEXTURE_NORMAL].Texture < 0) { continue; }
			const glm::vec4 TA = UnpackTangent(A.Attributes[Vertex].Tangent), TB = UnpackTangent(B.Attributes[Vertex].Tangent);
			++Compared;
			OppositeSign += TA.w == -TB.w ? 1 : 0;
			SameDirection += glm::dot(glm::vec3(TA), glm::vec3(TB)) > 0.97f ? 1 : 0;
		}
	}
	EXPECT_GT(Compared, 100000u);
	EXPECT_GT(double(OppositeSign) / double(Compared), 0.97);
	EXPECT_GT(double(SameDirection) / double(Compared), 0.95);
}

TEST(RealScenes, BlackForestIsComplete)
{
	const auto Path = GetScenesFolder() / "black_forest/black_forest.gltf";
	LANTERN_REQUIRE_SCENE(Path);
	const auto Start = std::chrono::steady_clock::now();
	const FLoadResult Result = LoadScene(Path.string());
	RecordProperty("seconds", std::to_string(std::chrono::duration<double>(std::chrono::steady_clock::now() - Start).count()));
	ASSERT_TRUE(Result.Scene) << Result.Error;
	const FSceneDescription& Scene = *Result.Scene;
	EXPECT_EQ(CountTriangles(Scene), 317096u);
	size_t Instanced = 0, Lights = 0;
	for (const FHostNode& Node : Scene.Nodes)
	{
		if (Node.Mesh >= 0) { Instanced += Scene.Meshes[size_t(Node.Mesh)].Indices.size() / 3; }
		Lights += Node.Light >= 0 ? 1 : 0;
	}
	EXPECT_EQ(Instanced, 1081410u);
	EXPECT_EQ(Scene.Nodes.size(), 1765u);
	EXPECT_EQ(Scene.Materials.size(), 156u);
	EXPECT_EQ(Lights, 65u);
	EXPECT_EQ(std::count_if(
	              Scene.Materials.begin(), Scene.Materials.end(), [](const FHostMaterial& M) { return M.AlphaMode == EAlphaMode::Mask; }),
	    48);
	EXPECT_TRUE(Scene.Warnings.empty());
	EXPECT_EQ(
	    std::count_if(Scene.Materials.begin(), Scene.Materials.end(), [](const FHostMaterial& M) { return M.Transmission > 0.0f; }), 3);
}

TEST(RealScenes, CornellAndRoughnessLoad)
{
	const auto Cornell = GetScenesFolder() / "cornell/cornell.gltf", Roughness = GetScenesFolder() / "roughness/scene.gltf";
	LANTERN_REQUIRE_SCENE(Cornell);
	const FLoadResult A = LoadScene(Cornell.string()), B = LoadScene(Roughness.string());
	ASSERT_TRUE(A.Scene && B.Scene) << A.Error << B.Error;
	EXPECT_EQ(A.Scene->Cameras.size(), 1u);
	EXPECT_EQ(A.Scene->Materials[0].Specular, 0.0f);
	EXPECT_EQ(CountTriangles(*B.Scene), 51200u);
}

} // namespace
} // namespace Lantern
