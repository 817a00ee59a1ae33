// A bathing pond: water that deepens from a shore of sand to four metres, with stones and posts that fade into it.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "Builtin/Random.h"
#include "Builtin/SceneBuilder.h"
#include "Builtin/WaterScene.h"

namespace Lantern::Builtin
{

namespace
{
constexpr float Shore = 2.5f, Far = -13.0f; ///< z of the water's edges

float BedHeight(float X, float Z)
{
	const float Out = (Shore - Z) / (Shore - Far);
	return 0.12f - 4.2f * std::pow(std::max(Out, 0.0f), 1.15f) + 0.06f * std::sin(1.7f * X + 0.6f * Z) * std::sin(1.1f * Z - 0.5f * X);
}

void AddBed(FSceneBuilder& Builder)
{
	FMeshBuilder Bed("bed");
	Bed.BeginSection(Builder.AddLambert("sand", {0.5f, 0.43f, 0.31f}));
	constexpr float Step = 0.5f;
	for (int I = -24; I < 24; ++I)
	{
		for (int J = -28; J < 14; ++J)
		{
			const float X0 = Step * float(I), X1 = X0 + Step, Z0 = Step * float(J), Z1 = Z0 + Step;
			Bed.AddQuad({X0, BedHeight(X0, Z1), Z1}, {X1, BedHeight(X1, Z1), Z1}, {X1, BedHeight(X1, Z0), Z0}, {X0, BedHeight(X0, Z0), Z0});
		}
	}
	Builder.AddNode("bed", Builder.AddMesh(Bed));
}

void AddWater(FSceneBuilder& Builder, bool bScattering)
{
	FHostMaterial Water;
	Water.Name = "water";
	Water.BaseColor = glm::vec4(1);
	Water.Metallic = 0.0f;
	Water.Roughness = 0.0f;
	Water.Transmission = 1.0f;
	Water.Ior = 1.333f;
	Water.bSolid = true;
	Water.Extinction = {1.15f, 0.75f, 0.85f};
	if (bScattering)
	{
		Water.ScatterAlbedo = {0.3f, 0.62f, 0.55f};
		Water.ScatterAnisotropy = 0.6f;
	}
	FMeshBuilder Surface("water");
	Surface.BeginSection(Builder.AddMaterial(Water));
	Surface.AddQuad({-12, 0, Shore}, {12, 0, Shore}, {12, 0, Far}, {-12, 0, Far});
	Builder.AddNode("water", Builder.AddMesh(Surface));
}

void AddJetty(FSceneBuilder& Builder)
{
	FMeshBuilder Jetty("jetty");
	Jetty.BeginSection(Builder.AddLambert("planks", {0.34f, 0.25f, 0.17f}));
	for (int I = 0; I < 22; ++I)
	{
		const float Z = 2.9f - 0.3f * float(I);
		Jetty.AddBox({-3.2f, 0.42f, Z - 0.13f}, {-1.8f, 0.48f, Z + 0.13f});
	}
	Jetty.BeginSection(Builder.AddLambert("posts", {0.42f, 0.36f, 0.28f}));
	for (int I = 0; I < 5; ++I)
	{
		const float Z = 2.2f - 1.4f * float(I);
		for (const float X : {-3.1f, -1.9f}) { Jetty.AddBox({X - 0.07f, -5.0f, Z - 0.07f}, {X + 0.07f, 0.75f, Z + 0.07f}); }
	}
	Builder.AddNode("jetty", Builder.AddMesh(Jetty));
}

void AddStones(FSceneBuilder& Builder)
{
	FMeshBuilder Stones("stones");
	Stones.BeginSection(Builder.AddLambert("stone", {0.36f, 0.35f, 0.33f}));
	FRandomStream Random(5);
	for (int I = 0; I < 60; ++I)
	{
		const float X = Random.Between(-6.0f, 6.0f), Z = Random.Between(-9.0f, 3.6f), Radius = Random.Between(0.12f, 0.5f);
		glm::mat4 Transform = glm::translate(glm::mat4(1), {X, BedHeight(X, Z) + 0.3f * Radius, Z});
		Transform = glm::rotate(Transform, Random.Between(0.0f, glm::two_pi<float>()), {0, 1, 0});
		Stones.SetTransform(glm::scale(Transform, {Radius, 0.6f * Radius, 0.8f * Radius}));
		Stones.AddSphere(glm::vec3(0), 1.0f, 4);
	}
	Stones.SetTransform(glm::mat4(1));
	Builder.AddNode("stones", Builder.AddMesh(Stones));
	FMeshBuilder Bank("bank");
	Bank.BeginSection(Builder.AddLambert("bushes", {0.1f, 0.17f, 0.07f}));
	for (int I = 0; I < 34; ++I)
	{
		const float Radius = Random.Between(0.7f, 1.6f);
		Bank.AddSphere({-14.0f + 0.85f * float(I), 0.5f * Radius, Far - Random.Between(0.3f, 1.6f)}, Radius, 4);
	}
	Builder.AddNode("bank", Builder.AddMesh(Bank));
}
} // namespace

FSceneDescription BuildWaterScene(bool bScattering)
{
	FSceneBuilder Builder("water");
	AddBed(Builder);
	AddWater(Builder, bScattering);
	AddJetty(Builder);
	AddStones(Builder);
	Builder.AddCamera({1.1, 2.4, 4.6}, {-0.5, 0.0, -2.0}, 55);
	Builder.SetLight(glm::normalize(glm::vec3(-0.55f, -0.9f, -0.35f)), 9.0f, {0.55f, 0.72f, 1.0f});
	Builder.Scene.DefaultExposure = -0.7f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
