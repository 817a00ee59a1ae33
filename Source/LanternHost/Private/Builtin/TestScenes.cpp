#include "Builtin/TestScenes.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

namespace
{

// So narrow that all pixels read one point.
constexpr float PointFov = 0.05f;
constexpr float FloorAlbedo = 0.5f;
// Large enough that its edge is of no matter, although nothing here looks at it.
constexpr float FloorSize = 40.0f;
const glm::vec3 Down(0, -1, 0);

void AddFloor(FSceneBuilder& Builder, float Albedo)
{
	FMeshBuilder Mesh("floor");
	constexpr float S = FloorSize / 2;
	Mesh.BeginSection(Builder.AddLambert("floor", glm::vec3(Albedo)));
	Mesh.AddQuad({-S, 0, S}, {S, 0, S}, {S, 0, -S}, {-S, 0, -S});
	Builder.AddNode("floor", Builder.AddMesh(Mesh));
}

int32_t AddEmitter(FSceneBuilder& Builder) { return Builder.AddLambert("emitter", glm::vec3(0), glm::vec3(1)); }

/// Looks at a point of the floor from a low height, where no emitter is in the way.
void AddPointCamera(FSceneBuilder& Builder, const glm::dvec3& Point)
{
	Builder.AddCamera(Point + glm::dvec3(0, 0.3, 0.6), Point, PointFov);
}

void Darken(FSceneBuilder& Builder) { Builder.SetLight(Down, 0.0f, glm::vec3(0)); }

} // namespace

FSceneDescription BuildFurnace(float Albedo)
{
	FSceneBuilder Builder("furnace");
	FMeshBuilder Mesh("room");
	Mesh.BeginSection(Builder.AddLambert("glow", glm::vec3(Albedo), glm::vec3(0.5f)));
	Mesh.AddBox({-2, 0, -2}, {2, 3, 2}, true);
	Mesh.AddBox({-1.2f, 0, -1.4f}, {-0.2f, 1.6f, -0.4f});
	Mesh.AddBox({0.4f, 0.5f, -1.0f}, {1.2f, 1.3f, -0.2f});
	Builder.AddNode("room", Builder.AddMesh(Mesh));
	Builder.AddCamera({0.3, 1.6, 1.7}, {0, 0.9, -1}, 70);
	Darken(Builder);
	return std::move(Builder.Scene);
}

FSceneDescription BuildSphere(float Albedo)
{
	constexpr double Area = 96.0, Flux = 10000.0;
	FSceneBuilder Builder("sphere");
	FMeshBuilder Mesh("sphere");
	Mesh.BeginSection(Builder.AddLambert("wall", glm::vec3(Albedo)));
	Mesh.AddSphere(glm::vec3(0), 1.0f, 6, true);
	// The triangles' area, not the sphere's: the inscribed polyhedron is a little smaller.
	Mesh.Scale(float(std::sqrt(Area / Mesh.ComputeArea())));
	Builder.AddNode("sphere", Builder.AddMesh(Mesh));
	Builder.AddPointLight("light", glm::vec3(0), glm::vec3(float(Flux / (4.0 * glm::pi<double>()))));
	Builder.AddCamera({0, 0.4, 1.5}, {0, 0, -1}, 60);
	Darken(Builder);
	return std::move(Builder.Scene);
}

FSceneDescription BuildPolygonLight(float X)
{
	FSceneBuilder Builder("polygonlight");
	AddFloor(Builder, FloorAlbedo);
	FMeshBuilder Mesh("emitter");
	Mesh.BeginSection(AddEmitter(Builder));
	Mesh.AddQuad({-0.5f, 1, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.5f}, {-0.5f, 1, 0.5f});
	Builder.AddNode("emitter", Builder.AddMesh(Mesh));
	AddPointCamera(Builder, {X, 0, 0});
	Darken(Builder);
	return std::move(Builder.Scene);
}

FSceneDescription BuildFormFactors(bool bPerpendicular)
{
	FSceneBuilder Builder("formfactors");
	FMeshBuilder Receiver("receiver");
	Receiver.BeginSection(Builder.AddLambert("receiver", glm::vec3(FloorAlbedo)));
	Receiver.AddQuad({-0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {-0.5f, 0, -0.5f});
	Builder.AddNode("receiver", Builder.AddMesh(Receiver));
	FMeshBuilder Emitter("emitter");
	Emitter.BeginSection(AddEmitter(Builder));
	if (bPerpendicular) { Emitter.AddQuad({-0.5f, 0, -0.5f}, {0.5f, 0, -0.5f}, {0.5f, 1, -0.5f}, {-0.5f, 1, -0.5f}); }
	else { Emitter.AddQuad({-0.5f, 1, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.5f}, {-0.5f, 1, 0.5f}); }
	Builder.AddNode("emitter", Builder.AddMesh(Emitter));
	// From between the squares: at half a metre and 90° the square fills a square picture.
	Builder.AddCamera({0, 0.5, 0}, {0, 0, 0}, 90, {0, 0, -1});
	Darken(Builder);
	return std::move(Builder.Scene);
}

FSceneDescription BuildDisk(float Height)
{
	FSceneBuilder Builder("disk");
	AddFloor(Builder, FloorAlbedo);
	FMeshBuilder Mesh("emitter");
	Mesh.BeginSection(AddEmitter(Builder));
	Mesh.AddDisk({0, Height, 0}, Down, 1.0f, 1024);
	Builder.AddNode("emitter", Builder.AddMesh(Mesh));
	const double Low = std::min(0.3, double(Height) * 0.4);
	Builder.AddCamera({0, Low, 2 * Low}, {0, 0, 0}, PointFov);
	Darken(Builder);
	return std::move(Builder.Scene);
}

FSceneDescription BuildSphereLight(float Distance, float AngleDegrees)
{
	constexpr double Radius = 0.5;
	FSceneBuilder Builder("spherelight");
	AddFloor(Builder, FloorAlbedo);
	FMeshBuilder Mesh("emitter");
	Mesh.BeginSection(AddEmitter(Builder));
	Mesh.AddSphere(glm::vec3(0), 1.0f, 5);
	// By Cauchy's formula a convex body shows a quarter of its area on average: equal area, equal light.
	Mesh.Scale(float(Radius * std::sqrt(4.0 * glm::pi<double>() / Mesh.ComputeArea())));
	const float Angle = glm::radians(AngleDegrees);
	Builder.AddNode("emitter", Builder.AddMesh(Mesh), Distance * glm::vec3(std::sin(Angle), std::cos(Angle), 0));
	Builder.AddCamera({-0.1, 0.2, 0.3}, {0, 0, 0}, PointFov);
	Darken(Builder);
	return std::move(Builder.Scene);
}

FSceneDescription BuildGgx(float Roughness, float Mu)
{
	FSceneBuilder Builder("ggx");
	FHostMaterial Metal;
	Metal.Name = "metal";
	Metal.Metallic = 1.0f;
	Metal.Roughness = Roughness;
	FMeshBuilder Mesh("plane");
	Mesh.BeginSection(Builder.AddMaterial(Metal));
	Mesh.AddQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
	Builder.AddNode("plane", Builder.AddMesh(Mesh));
	const double Sin = std::sqrt(std::max(0.0, 1.0 - double(Mu) * double(Mu)));
	Builder.AddCamera(4.0 * glm::dvec3(0, Mu, Sin), {0, 0, 0}, PointFov, {0, Sin, -double(Mu)});
	Builder.SetLight(Down, 0.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

FSceneDescription BuildPenumbra(float Height)
{
	constexpr float DiameterDegrees = 0.533f;
	FSceneBuilder Builder("penumbra");
	AddFloor(Builder, 1.0f);
	FMeshBuilder Mesh("occluder");
	Mesh.BeginSection(Builder.AddLambert("occluder", glm::vec3(0)));
	constexpr float S = FloorSize / 2;
	Mesh.AddQuad({-S, Height, S}, {0, Height, S}, {0, Height, -S}, {-S, Height, -S});
	Builder.AddNode("occluder", Builder.AddMesh(Mesh));
	const double Width = 2.0 * Height * std::tan(glm::radians(double(DiameterDegrees)) / 2);
	const double CameraHeight = 0.5 * Height;
	const double FovY = 2.0 * std::atan(2.0 * Width / CameraHeight);
	Builder.AddCamera({0, CameraHeight, 0}, {0, 0, 0}, float(glm::degrees(FovY)), {0, 0, -1});
	Builder.SetLight(Down, glm::pi<float>(), glm::vec3(0));
	Builder.Scene.DefaultSunDiameter = DiameterDegrees;
	return std::move(Builder.Scene);
}

FSceneDescription BuildPlanes()
{
	FSceneBuilder Builder("planes");
	AddFloor(Builder, 0.7f);
	const int32_t Single = Builder.AddLambert("single-sided", {0.7f, 0.3f, 0.2f});
	const int32_t Double = Builder.AddLambert("double-sided", {0.2f, 0.4f, 0.7f});
	Builder.Scene.Materials[size_t(Double)].bDoubleSided = true;
	for (int I = 0; I < 3; ++I)
	{
		FMeshBuilder Mesh(I == 0 ? "facing up" : I == 1 ? "facing down" : "double-sided");
		Mesh.BeginSection(I == 2 ? Double : Single);
		const glm::vec3 A(-0.75f, 0, 0.75f), B(0.75f, 0, 0.75f), C(0.75f, 0, -0.75f), D(-0.75f, 0, -0.75f);
		if (I == 1) { Mesh.AddQuad(A, D, C, B); }
		else { Mesh.AddQuad(A, B, C, D); }
		const int32_t MeshIndex = Builder.AddMesh(Mesh);
		Builder.AddNode(Builder.Scene.Meshes.back().Name.c_str(), MeshIndex, {float(I - 1) * 2.5f, 1.5f, 0});
	}
	Builder.AddCamera({0, 4.5, 8}, {0, 0.5, 0}, 45);
	Builder.SetLight({0.25f, -1, 0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

FSceneDescription BuildEmptySky()
{
	FSceneBuilder Builder("emptysky");
	Builder.AddLambert("unused", glm::vec3(0.5f));
	Builder.AddCamera({0, 0, 0}, {0, 0, -1}, 60);
	Builder.SetLight({0.25f, -1, 0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
