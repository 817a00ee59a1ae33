#include "TestScene.h"

#include <algorithm>

#include "LanternHost/VertexPacking.h"

namespace Lantern
{

int32_t FTestScene::AddMaterial(const FHostMaterial& Material)
{
	Scene.Materials.push_back(Material);
	return static_cast<int32_t>(Scene.Materials.size()) - 1;
}

int32_t FTestScene::AddLambert(const glm::vec3& Albedo, const glm::vec3& Emission, bool bDoubleSided)
{
	FHostMaterial Material;
	Material.Name = "lambert";
	Material.BaseColor = glm::vec4(Albedo, 1);
	Material.Emissive = Emission;
	Material.Metallic = 0.0f;
	Material.Specular = 0.0f;
	Material.bDoubleSided = bDoubleSided;
	return AddMaterial(Material);
}

int32_t FTestScene::AddHalfCutLambert()
{
	constexpr uint32_t Size = 64;
	FHostImage Image;
	Image.Name = "half";
	Image.Width = Image.Height = Size;
	Image.bHasAlpha = true;
	Image.Rgba.assign(4 * Size * Size, 255);
	for (uint32_t I = 0; I < Size * Size; ++I) { Image.Rgba[4 * I + 3] = I % Size < Size / 2 ? 0 : 255; }
	FHostTexture Texture;
	Texture.Image = static_cast<int32_t>(Scene.Images.size());
	Texture.bRepeatU = Texture.bRepeatV = false;
	Texture.bNearest = true;
	Scene.Images.push_back(std::move(Image));
	Scene.Textures.push_back(Texture);
	const int32_t Index = AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	FHostMaterial& Material = Scene.Materials.back();
	Material.AlphaMode = EAlphaMode::Mask;
	Material.Slots[TEXTURE_BASE_COLOR].Texture = static_cast<int32_t>(Scene.Textures.size()) - 1;
	return Index;
}

int32_t FTestScene::AddBumpyLambert(const glm::vec3& Albedo)
{
	FHostImage Image;
	Image.Name = "bump";
	Image.Width = Image.Height = 1;
	Image.Rgba = {166, 204, 217, 255}; // (0.3, 0.6, 0.7): away from both axes
	FHostTexture Texture;
	Texture.Image = static_cast<int32_t>(Scene.Images.size());
	Scene.Images.push_back(std::move(Image));
	Scene.Textures.push_back(Texture);
	const int32_t Index = AddLambert(Albedo);
	Scene.Materials.back().Slots[TEXTURE_NORMAL].Texture = static_cast<int32_t>(Scene.Textures.size()) - 1;
	return Index;
}

int32_t FTestScene::AddMesh(const std::vector<FQuad>& Quads)
{
	FHostMesh Mesh;
	Mesh.Name = "quads";
	Mesh.bHasTangents = true;
	Mesh.BoundsMin = glm::vec3(1e30f);
	Mesh.BoundsMax = glm::vec3(-1e30f);
	for (const FQuad& Quad : Quads)
	{
		const auto First = static_cast<uint32_t>(Mesh.Positions.size());
		const glm::vec3 Normal = glm::normalize(glm::cross(Quad.P[1] - Quad.P[0], Quad.P[2] - Quad.P[0]));
		for (int Corner = 0; Corner < 4; ++Corner)
		{
			FVertexAttributes Vertex{};
			Vertex.Normal = PackUnitVector(Normal);
			Vertex.Tangent = PackTangent(glm::vec4(glm::normalize(Quad.P[1] - Quad.P[0]), 1));
			Vertex.UV0 = Vertex.UV1 = glm::vec2(Corner == 1 || Corner == 2 ? 1 : 0, Corner >= 2 ? 1 : 0);
			Vertex.Color = PackColor(glm::vec4(1));
			Mesh.Positions.push_back(Quad.P[Corner]);
			Mesh.Attributes.push_back(Vertex);
			Mesh.BoundsMin = glm::min(Mesh.BoundsMin, Quad.P[Corner]);
			Mesh.BoundsMax = glm::max(Mesh.BoundsMax, Quad.P[Corner]);
		}
		Mesh.Sections.push_back({static_cast<uint32_t>(Mesh.Indices.size()), 6, Quad.Material});
		for (const uint32_t Corner : {0u, 1u, 2u, 0u, 2u, 3u}) { Mesh.Indices.push_back(First + Corner); }
	}
	Scene.Meshes.push_back(std::move(Mesh));
	return static_cast<int32_t>(Scene.Meshes.size()) - 1;
}

int32_t FTestScene::AddNode(int32_t Mesh, const glm::dmat4& Matrix)
{
	FHostNode Node;
	Node.Name = "node";
	Node.Mesh = Mesh;
	Node.Matrix = Matrix;
	Scene.Nodes.push_back(Node);
	return static_cast<int32_t>(Scene.Nodes.size()) - 1;
}

void FTestScene::AddLight(const FHostLight& Light, const glm::dmat4& Matrix)
{
	const int32_t Node = AddNode(-1, Matrix);
	Scene.Nodes[static_cast<size_t>(Node)].Light = static_cast<int32_t>(Scene.Lights.size());
	Scene.Lights.push_back(Light);
}

FTestScene::FQuad FTestScene::MakeFloor(int32_t Material, float Half, float Height, glm::vec2 Center)
{
	const auto Corner = [&](float X, float Z) { return glm::vec3(Center.x + X * Half, Height, Center.y + Z * Half); };
	return {Material, {Corner(-1, 1), Corner(1, 1), Corner(1, -1), Corner(-1, -1)}};
}

FHostMesh MakeMirrored(FHostMesh Mesh)
{
	for (size_t I = 0; I < Mesh.Positions.size(); ++I)
	{
		Mesh.Positions[I].x = -Mesh.Positions[I].x;
		glm::vec3 Normal = UnpackUnitVector(Mesh.Attributes[I].Normal);
		Normal.x = -Normal.x;
		Mesh.Attributes[I].Normal = PackUnitVector(Normal);
		// The bitangent must keep its direction, and the cross product of mirrored vectors does not.
		const glm::vec4 Tangent = UnpackTangent(Mesh.Attributes[I].Tangent);
		Mesh.Attributes[I].Tangent = PackTangent(Tangent * glm::vec4(-1, 1, 1, -1));
	}
	for (size_t I = 0; I < Mesh.Indices.size(); I += 3) { std::swap(Mesh.Indices[I + 1], Mesh.Indices[I + 2]); }
	const glm::vec3 Min = Mesh.BoundsMin;
	Mesh.BoundsMin.x = -Mesh.BoundsMax.x;
	Mesh.BoundsMax.x = -Min.x;
	return Mesh;
}

} // namespace Lantern
