// Lanterns, banners, benches and the weather vane.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "Builtin/Courtyard/CourtyardParts.h"

namespace Lantern::Builtin
{

namespace
{

constexpr float Q = glm::half_pi<float>();

/// Hangs from its origin: chain, cap, four panes between bars.
int32_t MakeLantern(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("lantern");
	Mesh.BeginSection(Yard.M.Iron);
	const glm::vec3 Chain[] = {{0, 0, 0}, {0, -0.45f, 0}};
	const float ChainRadii[] = {0.008f, 0.008f};
	Mesh.AddTube(Chain, ChainRadii, 8);
	const glm::vec2 Cap[] = {{0.14f, -0.60f}, {0.15f, -0.58f}, {0.05f, -0.48f}, {0.02f, -0.44f}};
	Mesh.AddLathe(Cap, 20);
	constexpr float H = 0.10f;
	Mesh.AddBeveledBox({-H - 0.01f, -0.625f, -H - 0.01f}, {H + 0.01f, -0.60f, H + 0.01f}, 0.004f);
	Mesh.AddBeveledBox({-H - 0.01f, -0.93f, -H - 0.01f}, {H + 0.01f, -0.90f, H + 0.01f}, 0.004f);
	for (const float X : {-H, H})
	{
		for (const float Z : {-H, H}) { Mesh.AddBeveledBox({X - 0.012f, -0.90f, Z - 0.012f}, {X + 0.012f, -0.625f, Z + 0.012f}, 0.003f); }
	}
	Mesh.BeginSection(Yard.M.Glow);
	constexpr float P = H - 0.008f;
	Mesh.AddBox({-P, -0.90f, -P}, {P, -0.625f, P});
	return Yard.Builder.AddMesh(Mesh);
}

void AddLanterns(const FCourtyard& Yard)
{
	const int32_t Lantern = MakeLantern(Yard);
	// Below the lantern, whose own panes would shut it in.
	const glm::vec3 Below(0, -1.05f, 0);
	const glm::vec3 Candela = glm::vec3(1.0f, 0.58f, 0.25f) * 2.2f;
	for (int I = 0; I < BayCount; I += 2)
	{
		const float T = (float(I) - float(BayCount - 1) / 2) * BayWidth;
		for (const glm::vec3& Place : {glm::vec3(T, ArcadeTop - 0.36f, -YardHalf - 1.2f), glm::vec3(YardHalf + 1.2f, ArcadeTop - 0.36f, T)})
		{
			Yard.Builder.AddNode("lantern", Lantern, Place);
			Yard.Builder.AddPointLight("lantern", Place + Below, Candela, 7.0f);
		}
	}
}

/// A cloth that hangs down from its origin in the xy plane, with folds that grow towards the hem.
int32_t MakeBanner(const FCourtyard& Yard, int32_t Material)
{
	constexpr int Across = 16, Down = 32;
	constexpr float Width = 0.9f, Height = 2.7f;
	const auto GetPoint = [](float U, float V) {
		const float Fold = 0.075f * V * std::sin(U * 9.0f + V * 2.5f) + 0.05f * V * V * std::sin(V * 5.0f);
		const float Hem = U < 0.5f ? U : 1 - U; // swallow-tailed
		return glm::vec3((U - 0.5f) * Width * (1 - 0.05f * V), -V * (Height - Hem * 0.5f), Fold);
	};
	FMeshBuilder Mesh("banner");
	Mesh.BeginSection(Material);
	for (int Y = 0; Y <= Down; ++Y)
	{
		for (int X = 0; X <= Across; ++X)
		{
			const float U = float(X) / Across, V = float(Y) / Down;
			const glm::vec3 DU = GetPoint(U + 0.01f, V) - GetPoint(U - 0.01f, V);
			const glm::vec3 DV = GetPoint(U, V + 0.01f) - GetPoint(U, V - 0.01f);
			Mesh.AddVertex(GetPoint(U, V), glm::normalize(glm::cross(DV, DU)), {U, V});
		}
	}
	constexpr uint32_t Row = Across + 1;
	for (uint32_t Y = 0; Y < Down; ++Y)
	{
		for (uint32_t X = 0; X < Across; ++X)
		{
			const uint32_t A = Y * Row + X;
			Mesh.AddTriangle(A, A + Row, A + Row + 1);
			Mesh.AddTriangle(A, A + Row + 1, A + 1);
		}
	}
	Mesh.BeginSection(Yard.M.Iron);
	const glm::vec3 Pole[] = {{-0.56f, 0.02f, 0}, {0.56f, 0.02f, 0}};
	const glm::vec3 Arm[] = {{0, 0.02f, 0}, {0, 0.12f, -0.35f}};
	const float Radii[] = {0.018f, 0.018f};
	Mesh.AddTube(Pole, Radii, 10);
	Mesh.AddTube(Arm, Radii, 10);
	Mesh.BeginSection(Yard.M.Bronze);
	Mesh.AddSphere({-0.58f, 0.02f, 0}, 0.04f, 2);
	Mesh.AddSphere({0.58f, 0.02f, 0}, 0.04f, 2);
	return Yard.Builder.AddMesh(Mesh);
}

void AddBanners(const FCourtyard& Yard)
{
	const int32_t Red = MakeBanner(Yard, Yard.M.Cloth), Blue = MakeBanner(Yard, Yard.M.ClothBlue);
	for (int I = 0; I < BayCount - 1; ++I)
	{
		const float T = (float(I) - float(BayCount - 2) / 2) * BayWidth;
		Yard.Builder.AddNode("banner", I % 2 == 0 ? Red : Blue, {T, UpperTop - 0.55f, -YardHalf + 0.32f}, 0.06f * float(I % 3 - 1));
	}
}

void AddBenches(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("bench");
	Mesh.BeginSection(Yard.M.Trim);
	Mesh.AddBeveledBox({-0.9f, 0.40f, -0.24f}, {0.9f, 0.50f, 0.24f}, 0.02f);
	Mesh.AddBeveledBox({-0.72f, 0, -0.19f}, {-0.50f, 0.40f, 0.19f}, 0.02f);
	Mesh.AddBeveledBox({0.50f, 0, -0.19f}, {0.72f, 0.40f, 0.19f}, 0.02f);
	const int32_t Bench = Yard.Builder.AddMesh(Mesh);
	Yard.Builder.AddNode("bench", Bench, {4.2f, 0, -0.8f}, Q);
	Yard.Builder.AddNode("bench", Bench, {-4.2f, 0, -0.8f}, Q);
	Yard.Builder.AddNode("bench", Bench, {0, 0, -5.0f});
	Yard.Builder.AddNode("bench", Bench, {-1.2f, 0, 3.6f}, 0.15f);
}

/// On the western balustrade, where its shadow falls into the yard.
void AddWeatherVane(const FCourtyard& Yard)
{
	const glm::vec3 Place(-YardHalf, ArcadeTop + 0.86f, -1.2f);
	FMeshBuilder Pole("vane pole");
	Pole.BeginSection(Yard.M.Iron);
	const glm::vec2 Profile[] = {{0.10f, 0}, {0.10f, 0.06f}, {0.10f, 0.06f}, {0.03f, 0.12f}, {0.02f, 1.1f}, {0.0f, 1.14f}};
	Pole.AddLathe(Profile, 16);
	Yard.Builder.AddNode("vane pole", Yard.Builder.AddMesh(Pole), Place);

	FMeshBuilder Vane("vane");
	Vane.BeginSection(Yard.M.Bronze);
	const glm::vec3 Shaft[] = {{-0.55f, 0, 0}, {0.55f, 0, 0}};
	const float Radii[] = {0.016f, 0.016f};
	Vane.AddTube(Shaft, Radii, 10);
	Vane.AddBeveledBox({-0.62f, -0.20f, -0.010f}, {-0.34f, 0.20f, 0.010f}, 0.004f);
	Vane.SetTransform(glm::rotate(glm::translate(glm::mat4(1), {0.55f, 0, 0}), -Q, {0, 0, 1}));
	const glm::vec2 Head[] = {{0.0f, 0.0f}, {0.09f, 0.0f}, {0.09f, 0.0f}, {0.0f, 0.2f}};
	Vane.AddLathe(Head, 16);
	Vane.SetTransform(glm::mat4(1));
	Vane.AddSphere({0, 0, 0}, 0.07f, 3);
	// Four sails below, as a fan has them: they make the shadow move.
	for (int Sail = 0; Sail < 4; ++Sail)
	{
		Vane.SetTransform(glm::rotate(glm::translate(glm::mat4(1), {0, -0.30f, 0}), Q * float(Sail), {0, 1, 0}));
		Vane.AddBeveledBox({0.02f, -0.16f, -0.008f}, {0.42f, 0.16f, 0.008f}, 0.003f);
	}
	const int32_t Node = Yard.Builder.AddNode("vane", Yard.Builder.AddMesh(Vane), Place + glm::vec3(0, 0.95f, 0));
	AddTurning(Yard.Builder, Node, 4.0f);
}

} // namespace

void AddTurning(FSceneBuilder& Builder, int32_t Node, float Seconds)
{
	FHostAnimation Animation;
	Animation.Name = "turning";
	Animation.Duration = Seconds;
	FHostChannel Channel;
	Channel.Node = Node;
	Channel.Path = EAnimationPath::Rotation;
	for (int I = 0; I <= 4; ++I)
	{
		const float Half = glm::pi<float>() * float(I) / 4;
		Channel.Times.push_back(Seconds * float(I) / 4);
		Channel.Values.emplace_back(0, std::sin(Half), 0, std::cos(Half));
	}
	Animation.Channels.push_back(Channel);
	Builder.Scene.Animations.push_back(Animation);
}

void BuildFurnishings(const FCourtyard& Yard)
{
	AddLanterns(Yard);
	AddBanners(Yard);
	AddBenches(Yard);
	AddWeatherVane(Yard);
}

} // namespace Lantern::Builtin
