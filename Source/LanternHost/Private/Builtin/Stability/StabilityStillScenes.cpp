// Scenes in which nothing moves by itself.
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityWall(float Centimetres, float SlitCentimetres)
{
	FSceneBuilder Builder("stability-wall");
	AddGround(Builder, AddPaint(Builder, "ground", glm::vec3(0.5f), 0.6f), 40.0f, -0.5f);
	const int32_t Wall = AddPaint(Builder, "wall", {0.7f, 0.65f, 0.6f}, 0.6f);
	Builder.Scene.Materials[size_t(Wall)].bDoubleSided = true;
	FMeshBuilder Room("room");
	Room.BeginSection(Wall);
	const glm::vec3 Min(-2, 0, -2), Max(2, 4, 2), Thick(Centimetres / 100.0f);
	const float Slit = SlitCentimetres / 100.0f;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		for (int Side = 0; Side < 2; ++Side)
		{
			// Slabs reach over the corners: no gap there, whatever rays do at edges. Those of no thickness meet in them.
			glm::vec3 Low = Min - Thick, High = Max + Thick;
			Low[Axis] = Side ? Max[Axis] : Low[Axis];
			High[Axis] = Side ? High[Axis] : Min[Axis];
			High.x -= Axis == 1 && Side ? Slit + Thick.x : 0.0f;
			if (Centimetres > 0.0f)
			{
				Room.AddBox(Low, High);
				continue;
			}
			glm::vec3 Right(0), Up(0);
			Right[(Axis + 1) % 3] = (High - Low)[(Axis + 1) % 3];
			Up[(Axis + 2) % 3] = (High - Low)[(Axis + 2) % 3];
			Room.AddQuad(Low, Low + Right, High, Low + Up);
		}
	}
	Builder.AddNode("room", Builder.AddMesh(Room));
	AddBoxNode(Builder, "crate", AddPaint(Builder, "crate", {0.4f, 0.3f, 0.2f}, 0.5f), {-1.5f, 0, -1.5f}, {-0.5f, 1, -0.5f});
	Builder.AddCamera({1.6, 1.8, 1.6}, {-1.6, 1.2, -1.6}, 75);
	Builder.SetLight({0.5f, -1, -0.4f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityTime()
{
	FSceneBuilder Builder("stability-time");
	AddGround(Builder, AddPaint(Builder, "ground", glm::vec3(0.5f), 0.5f), 60.0f);
	const int32_t Materials[] = {AddPaint(Builder, "plaster", {0.8f, 0.75f, 0.7f}, 0.7f),
	    AddPaint(Builder, "brick", {0.6f, 0.3f, 0.2f}, 0.6f), AddPaint(Builder, "slate", {0.3f, 0.35f, 0.4f}, 0.3f)};
	FRandomStream Random(5);
	for (int I = 0; I < 9; ++I)
	{
		const glm::vec3 At(float(I % 3) * 3.0f - 3.0f, 0, float(I / 3) * 3.0f - 3.0f);
		const float Height = Random.Between(0.5f, 2.0f), Half = Random.Between(0.3f, 0.7f);
		AddBoxNode(Builder, "block", Materials[I % 3], At - glm::vec3(Half, 0, Half), At + glm::vec3(Half, Height, Half));
	}
	Builder.AddCamera({2, 7, 9}, {0, 0, 0}, 50);
	// Little sky: what is indirect comes from the sun, too.
	Builder.SetLight({-0.5f, -std::sqrt(3.0f) / 2, 0}, 4.0f, {0.015f, 0.02f, 0.03f});
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityCandles()
{
	FSceneBuilder Builder("stability-candles");
	FMeshBuilder Hall("hall");
	Hall.BeginSection(AddPaint(Builder, "stone", {0.6f, 0.55f, 0.5f}, 0.6f));
	Hall.AddBox({-4, 0, -6}, {4, 3.5f, 6}, true);
	Builder.AddNode("hall", Builder.AddMesh(Hall));
	const int32_t Wood = AddPaint(Builder, "wood", {0.35f, 0.2f, 0.1f}, 0.4f);
	AddBoxNode(Builder, "table", Wood, {-1, 0.9f, -4}, {1, 1, 2});
	FMeshBuilder Flame("flame");
	Flame.BeginSection(Builder.AddLambert("flame", glm::vec3(0), {40'000.0f, 28'000.0f, 12'000.0f}));
	const float Half = 0.5f * std::sqrt(1e-4f / 6.0f); // six faces: 1 cm²
	Flame.AddBox(glm::vec3(-Half), glm::vec3(Half));
	const int32_t FlameMesh = Builder.AddMesh(Flame);
	for (int I = 0; I < 24; ++I) { Builder.AddNode("candle", FlameMesh, {I % 2 ? 0.6f : -0.6f, 1.25f, -3.8f + 0.5f * float(I / 2)}); }
	Builder.AddCamera({2.5, 2, 5}, {-0.5, 1, -2}, 60);
	Builder.SetLight({0, -1, 0}, 0.0f, glm::vec3(0));
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityNan()
{
	FSceneBuilder Builder("stability-nan");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.5f), 0.0f), 20.0f);
	const int32_t Materials[] = {AddMetal(Builder, "mirror", glm::vec3(1), 0.0f), AddPaint(Builder, "glass-like", glm::vec3(0.2f), 0.0f),
	    AddMetal(Builder, "black metal", glm::vec3(0), 0.0f), AddPaint(Builder, "white", glm::vec3(1), 1.0f)};
	for (int I = 0; I < 4; ++I)
	{
		FMeshBuilder Sphere("sphere");
		Sphere.BeginSection(Materials[I]);
		Sphere.AddSphere(glm::vec3(0), 0.5f, 3);
		Builder.AddNode("sphere", Builder.AddMesh(Sphere), {float(I) * 1.2f - 1.8f, 0.5f, 0});
	}
	FMeshBuilder Odd("triangles without area");
	Odd.BeginSection(Materials[3]);
	for (const glm::vec3& End : {glm::vec3(1, 0.5f, 0.6f), glm::vec3(-1, 1.2f, 0.6f), glm::vec3(0)})
	{
		const uint32_t A = Odd.AddVertex({-1, 0.5f, 0.6f}, {0, 1, 0}, {0, 0}), B = Odd.AddVertex({-1, 0.5f, 0.6f}, {0, 1, 0}, {0, 0}),
		               C = Odd.AddVertex(End, {0, 0, 1}, {1, 0});
		Odd.AddTriangle(A, B, C);
		Odd.AddTriangle(A, A, A);
	}
	// Edge-on to the camera, at its very height.
	Odd.AddQuad({-0.3f, 1.5f, 1.2f}, {0.3f, 1.5f, 1.2f}, {0.3f, 1.5f, -3}, {-0.3f, 1.5f, -3});
	Builder.AddNode("odd", Builder.AddMesh(Odd));
	AddBoxNode(Builder, "lamp", Builder.AddLambert("lamp", glm::vec3(0), glm::vec3(1e6f)), {-2.6f, 0.2f, -1.2f}, {-2.4f, 0.4f, -1.0f});
	Builder.AddCamera({0, 1.5, 4}, {0, 0.5, 0}, 50);
	Builder.SetLight({0.3f, -1, -0.3f}, 1e6f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityFurnace()
{
	FSceneBuilder Builder("stability-furnace");
	for (int Metal = 0; Metal < 2; ++Metal)
	{
		for (int I = 0; I < 5; ++I)
		{
			const std::string Name = fmt::format("{} {}", Metal ? "metal" : "dielectric", I);
			FMeshBuilder Sphere(Name);
			const float Roughness = float(I) / 4.0f;
			Sphere.BeginSection(Metal ? AddMetal(Builder, Name.c_str(), glm::vec3(1), Roughness)
			                          : AddPaint(Builder, Name.c_str(), glm::vec3(1), Roughness));
			Sphere.AddSphere(glm::vec3(0), 1.0f, 4);
			Builder.AddNode(Name.c_str(), Builder.AddMesh(Sphere), {float(I - 2) * 4.0f, Metal ? -2.0f : 2.0f, 0});
		}
	}
	Builder.AddCamera({0, 0, 100}, {0, 0, 0}, 6.5);
	Builder.SetLight({0, -1, 0}, 0.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilitySeams()
{
	FSceneBuilder Builder("stability-seams");
	const int32_t Plain = AddPaint(Builder, "plain", glm::vec3(0.6f), 0.5f);
	AddGround(Builder, Plain, 30.0f);
	FMeshBuilder Roof("roof");
	Roof.BeginSection(Plain);
	Roof.AddBox({-12, 4, -12}, {0, 4.2f, 12});
	Builder.AddNode("roof", Builder.AddMesh(Roof));
	AddBoxNode(Builder, "wall", Plain, {-12, 0, -2.2f}, {12, 1.5f, -2});
	Builder.AddCamera({0, 3, 1.5}, {0, 0, -1}, 70);
	Builder.SetLight({0.02f, -1, 0.02f}, 4.0f, {0.5f, 0.7f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 20.0f;
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityFar(float Far)
{
	FSceneBuilder Builder("stability-far");
	const glm::dvec3 Place = double(Far) * glm::dvec3(16'000.0, 500.0, 16'000.0);
	const int32_t Wall = AddPaint(Builder, "wall", {0.7f, 0.65f, 0.6f}, 0.6f);
	AddBoxNode(Builder, "floor", Wall, {-2.37f, -0.2f, -2.37f}, {2.37f, 0, 2.37f});
	AddBoxNode(Builder, "back", Wall, {-2.37f, 0, -2.57f}, {2.37f, 2.71f, -2.37f});
	AddBoxNode(Builder, "side", Wall, {-2.57f, 0, -2.37f}, {-2.37f, 2.71f, 2.37f});
	AddBoxNode(Builder, "roof", Wall, {-2.37f, 2.71f, -2.37f}, {0.13f, 2.81f, 2.37f});
	AddBoxNode(Builder, "crate", AddPaint(Builder, "crate", {0.4f, 0.3f, 0.2f}, 0.4f), {-0.93f, 0, -1.21f}, {0.17f, 1.1f, -0.11f});
	FMeshBuilder Ball("ball");
	// Nothing that focuses light: rare bright paths would hide what is looked for.
	Ball.BeginSection(AddPaint(Builder, "ball", {0.8f, 0.7f, 0.5f}, 0.5f));
	Ball.AddSphere(glm::vec3(0), 0.41f, 4);
	Builder.AddNode("ball", Builder.AddMesh(Ball), {1.13f, 0.41f, 0.37f});
	for (FHostNode& Node : Builder.Scene.Nodes) { Node.Translation += Place; }
	Builder.AddCamera(Place + glm::dvec3(2.77, 2.03, 3.91), Place + glm::dvec3(-0.31, 0.83, -0.53), 55);
	Builder.SetLight({-0.45f, -1, -0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityMaterials()
{
	FSceneBuilder Builder("stability-materials");
	constexpr int Columns = 20, Rows = 10;
	FMeshBuilder Quad("quad");
	Quad.BeginSection(0);
	Quad.AddUnitQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
	const int32_t Mesh = Builder.AddMesh(Quad);
	for (int I = 0; I < Columns * Rows; ++I)
	{
		const int32_t Material = Builder.AddLambert("quad", {float(I % Columns) / Columns, float(I / Columns) / Rows, 0.5f});
		const int32_t Node = Builder.AddNode("quad", Mesh, {float(I % Columns), float(I / Columns), 0});
		Builder.Scene.Nodes[size_t(Node)].Materials = {Material};
	}
	Builder.AddCamera({10, 5, 12}, {10, 5, 0}, 50);
	Builder.SetLight({0, -0.3f, -1}, 4.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityFlat(bool bMetal)
{
	FSceneBuilder Builder("stability-flat");
	AddGround(Builder, bMetal ? AddMetal(Builder, "mirror", glm::vec3(1), 0.0f) : Builder.AddLambert("grey", glm::vec3(0.5f)), 1000.0f);
	Builder.AddCamera({0, 2, 0}, {0, 0, -0.4}, 60);
	Builder.SetLight({0.3f, -1, -0.3f}, 4.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
