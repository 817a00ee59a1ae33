// Scenes that take more than a second to build or load: the courtyard, and a chain of a million nodes.
#include "LanternHost/VertexPacking.h"
#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

FSceneDescription BuildCourtyard()
{
	FLoadResult Result = LoadScene("courtyard");
	EXPECT_TRUE(Result.Scene) << Result.Error;
	return Result.Scene ? std::move(*Result.Scene) : FSceneDescription();
}

TEST(Courtyard, HasWhatARendererMustHandle)
{
	const FSceneDescription Scene = BuildCourtyard();
	EXPECT_EQ(Scene.Cameras.size(), 1u);
	EXPECT_TRUE(Scene.DefaultSun.has_value() && Scene.DefaultSky.has_value());
	size_t Instances = 0, Triangles = 0, Lights = 0;
	for (const FHostNode& Node : Scene.Nodes)
	{
		Instances += Node.Mesh >= 0 ? 1 : 0;
		Triangles += Node.Mesh >= 0 ? Scene.Meshes[size_t(Node.Mesh)].Indices.size() / 3 : 0;
		Lights += Node.Light >= 0 ? 1 : 0;
	}
	EXPECT_GT(Instances, 150u);
	EXPECT_GT(Triangles, 100000u);
	EXPECT_LT(Triangles, 300000u);
	EXPECT_GE(Lights, 6u);
	int Masked = 0, Emissive = 0, Metal = 0;
	for (const FHostMaterial& Material : Scene.Materials)
	{
		Masked += Material.AlphaMode == EAlphaMode::Mask ? 1 : 0;
		Emissive += Material.Emissive.x > 0 ? 1 : 0;
		Metal += Material.Name == "bronze" ? 1 : 0;
	}
	EXPECT_EQ(Masked, 4);
	EXPECT_EQ(Emissive, 1);
	EXPECT_EQ(Metal, 1);
	// The vane turns, once in four seconds.
	const FScenePose Now = EvaluatePose(Scene, 0), Quarter = EvaluatePose(Scene, 1), Full = EvaluatePose(Scene, 4);
	bool bFound = false;
	for (size_t N = 0; N < Scene.Nodes.size(); ++N)
	{
		if (Scene.Nodes[N].Name == "vane")
		{
			bFound = true;
			EXPECT_NEAR(glm::dot(glm::dvec3(Now.World[N][0]), glm::dvec3(Quarter.World[N][0])), 0.0, 1e-5);
			EXPECT_NEAR(glm::dot(glm::dvec3(Now.World[N][0]), glm::dvec3(Full.World[N][0])), 1.0, 1e-5);
		}
	}
	EXPECT_TRUE(bFound);
}

TEST(Courtyard, IsTheSameEveryTime)
{
	const FSceneDescription A = BuildCourtyard(), B = BuildCourtyard();
	ASSERT_EQ(A.Meshes.size(), B.Meshes.size());
	for (size_t I = 0; I < A.Meshes.size(); ++I) { EXPECT_EQ(A.Meshes[I].Positions, B.Meshes[I].Positions); }
	for (size_t I = 0; I < A.Images.size(); ++I) { EXPECT_EQ(A.Images[I].Rgba, B.Images[I].Rgba); }
}

/// Single-sided closed shapes must show their fronts: a wrong winding would vanish or shade black.
TEST(Courtyard, NormalsAgreeWithTheWinding)
{
	const FSceneDescription Scene = BuildCourtyard();
	for (const FHostMesh& Mesh : Scene.Meshes)
	{
		size_t Wrong = 0, Count = 0;
		for (const FHostSection& Section : Mesh.Sections)
		{
			if (Scene.Materials[size_t(Section.Material)].AlphaMode == EAlphaMode::Mask)
			{
				continue; // cards are lit as the crown they belong to
			}
			for (uint32_t I = 0; I < Section.IndexCount; I += 3)
			{
				const uint32_t* Index = &Mesh.Indices[Section.FirstIndex + I];
				const glm::vec3 Face =
				    glm::cross(Mesh.Positions[Index[1]] - Mesh.Positions[Index[0]], Mesh.Positions[Index[2]] - Mesh.Positions[Index[0]]);
				const glm::vec3 Normal = UnpackUnitVector(Mesh.Attributes[Index[0]].Normal) +
				                         UnpackUnitVector(Mesh.Attributes[Index[1]].Normal) +
				                         UnpackUnitVector(Mesh.Attributes[Index[2]].Normal);
				Wrong += glm::dot(Face, Normal) < -1e-12f ? 1 : 0;
				++Count;
			}
		}
		EXPECT_EQ(Wrong, 0u) << Mesh.Name << " of " << Count;
	}
}

std::string MakeChain(int Count)
{
	std::string Text = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[";
	for (int I = 0; I + 1 < Count; ++I) { Text += "{\"children\":[" + std::to_string(I + 1) + "]},"; }
	return Text + "{}]}";
}

TEST(HostileGltf, AMillionNodesDeep)
{
	const FLoadResult Result = FGltfMaker::LoadText(MakeChain(1000000));
	ASSERT_TRUE(Result.Scene) << Result.Error;
	ASSERT_EQ(Result.Scene->Nodes.size(), 1000000u);
	EXPECT_EQ(Result.Scene->Nodes.back().Parent, 999998);
}

} // namespace
} // namespace Lantern
