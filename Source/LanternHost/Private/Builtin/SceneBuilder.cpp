// Adds materials, meshes, nodes, cameras and lights to a scene description.
#include "Builtin/SceneBuilder.h"

#include <glm/gtc/quaternion.hpp>

namespace Lantern::Builtin
{

int32_t FSceneBuilder::AddMaterial(const FHostMaterial& Material)
{
	Scene.Materials.push_back(Material);
	return int32_t(Scene.Materials.size() - 1);
}

int32_t FSceneBuilder::AddLambert(const char* Name, const glm::vec3& Albedo, const glm::vec3& Emission)
{
	FHostMaterial Material;
	Material.Name = Name;
	Material.BaseColor = glm::vec4(Albedo, 1);
	Material.Emissive = Emission;
	Material.Metallic = 0.0f;
	Material.Roughness = 1.0f;
	Material.Specular = 0.0f;
	return AddMaterial(Material);
}

int32_t FSceneBuilder::AddImage(FHostImage&& Image)
{
	FHostTexture Texture;
	Texture.Image = int32_t(Scene.Images.size());
	Scene.Images.push_back(std::move(Image));
	Scene.Textures.push_back(Texture);
	return int32_t(Scene.Textures.size() - 1);
}

int32_t FSceneBuilder::AddMesh(FMeshBuilder& Builder)
{
	Scene.Meshes.push_back(Builder.Build());
	return int32_t(Scene.Meshes.size() - 1);
}

int32_t FSceneBuilder::AddNode(
    const char* Name, int32_t Mesh, const glm::vec3& Position, float YawRadians, const glm::vec3& Scale, int32_t Parent)
{
	FHostNode Node;
	Node.Name = Name;
	Node.Mesh = Mesh;
	Node.Parent = Parent;
	Node.Translation = glm::dvec3(Position);
	Node.Rotation = glm::angleAxis(YawRadians, glm::vec3(0, 1, 0));
	Node.Scale = Scale;
	Scene.Nodes.push_back(Node);
	return int32_t(Scene.Nodes.size() - 1);
}

void FSceneBuilder::AddCamera(const glm::dvec3& From, const glm::dvec3& To, float FovYDegrees, const glm::dvec3& Up)
{
	const glm::dvec3 Back = glm::normalize(From - To);
	const glm::dvec3 Right = glm::normalize(glm::cross(Up, Back));
	FHostNode Node;
	Node.Name = "camera";
	Node.Translation = From;
	Node.Rotation = glm::quat(glm::quat_cast(glm::dmat3(Right, glm::cross(Back, Right), Back)));
	Node.Camera = int32_t(Scene.Cameras.size());
	Scene.Nodes.push_back(Node);
	FHostCamera Camera;
	Camera.FovY = glm::radians(FovYDegrees);
	Camera.Near = 0.01f;
	Scene.Cameras.push_back(Camera);
}

int32_t FSceneBuilder::AddPointLight(const char* Name, const glm::vec3& Position, const glm::vec3& Candela, float Range)
{
	FHostLight Light;
	Light.Name = Name;
	Light.Color = Candela;
	Light.Range = Range;
	const int32_t Node = AddNode(Name, -1, Position);
	Scene.Nodes[size_t(Node)].Light = int32_t(Scene.Lights.size());
	Scene.Lights.push_back(Light);
	return Node;
}

void FSceneBuilder::SetLight(const glm::vec3& SunDirection, float SunIrradiance, const glm::vec3& Sky)
{
	Scene.DefaultSun = glm::vec4(glm::normalize(SunDirection), SunIrradiance);
	Scene.DefaultSky = Sky;
}

} // namespace Lantern::Builtin
