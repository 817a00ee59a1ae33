// A room with a window, and a table with what light shines through: solid, thin, tinted, frosted, and a tank of water.
#include <glm/gtc/matrix_transform.hpp>

#include "Builtin/GlassScene.h"
#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

namespace
{
constexpr float TableTop = 0.8f;

FHostMaterial MakeGlass(const char* Name, const glm::vec3& Color = glm::vec3(1), float Roughness = 0.0f)
{
	FHostMaterial Glass;
	Glass.Name = Name;
	Glass.BaseColor = glm::vec4(Color, 1.0f);
	Glass.Metallic = 0.0f;
	Glass.Roughness = Roughness;
	Glass.Transmission = 1.0f;
	Glass.bDoubleSided = true;
	return Glass;
}

FHostMaterial MakeSolid(const char* Name, float Ior, const glm::vec3& Extinction)
{
	FHostMaterial Solid = MakeGlass(Name);
	Solid.Ior = Ior;
	Solid.bSolid = true;
	Solid.Extinction = Extinction;
	Solid.bDoubleSided = false;
	return Solid;
}

void AddPart(FSceneBuilder& Builder, const char* Name, int32_t Material, const glm::vec3& Min, const glm::vec3& Max)
{
	FMeshBuilder Part(Name);
	Part.BeginSection(Material);
	Part.AddBox(Min, Max);
	Builder.AddNode(Name, Builder.AddMesh(Part));
}

void AddTiles(FSceneBuilder& Builder)
{
	const int32_t Light = Builder.AddLambert("light tile", {0.7f, 0.66f, 0.58f}),
	              Dark = Builder.AddLambert("dark tile", {0.16f, 0.2f, 0.24f});
	FMeshBuilder Tiles("tiles");
	for (const bool bDark : {false, true})
	{
		Tiles.BeginSection(bDark ? Dark : Light);
		for (int X = -5; X < 5; ++X)
		{
			for (int Z = -5; Z < 5; ++Z)
			{
				if (((X + Z) & 1) != int(bDark)) { continue; }
				const float X0 = 0.6f * float(X), Z0 = 0.6f * float(Z);
				Tiles.AddQuad({X0, 0, Z0 + 0.6f}, {X0 + 0.6f, 0, Z0 + 0.6f}, {X0 + 0.6f, 0, Z0}, {X0, 0, Z0});
			}
		}
	}
	Builder.AddNode("tiles", Builder.AddMesh(Tiles));
}

void AddRoom(FSceneBuilder& Builder)
{
	const int32_t Wall = Builder.AddLambert("wall", {0.72f, 0.62f, 0.5f}), Side = Builder.AddLambert("side", {0.6f, 0.3f, 0.22f});
	const int32_t Frame = Builder.AddLambert("frame", {0.3f, 0.22f, 0.16f}), Ground = Builder.AddLambert("ground", {0.3f, 0.42f, 0.18f});
	AddPart(Builder, "left wall", Side, {-3.2f, 0, -3}, {-3, 3, 3});
	AddPart(Builder, "right wall", Wall, {3, 0, -3}, {3.2f, 3, 3});
	AddPart(Builder, "ceiling", Wall, {-3.2f, 3, -3}, {3.2f, 3.2f, 3});
	AddPart(Builder, "back wall, left", Wall, {-3, 0, -3.2f}, {-1.6f, 3, -3});
	AddPart(Builder, "back wall, right", Wall, {1.6f, 0, -3.2f}, {3, 3, -3});
	AddPart(Builder, "back wall, below", Wall, {-1.6f, 0, -3.2f}, {1.6f, 0.9f, -3});
	AddPart(Builder, "back wall, above", Wall, {-1.6f, 2.6f, -3.2f}, {1.6f, 3, -3});
	AddPart(Builder, "upright", Frame, {-0.04f, 0.9f, -3.14f}, {0.04f, 2.6f, -3.06f});
	AddPart(Builder, "rail", Frame, {-1.6f, 1.75f, -3.14f}, {1.6f, 1.83f, -3.06f});
	AddPart(Builder, "ground", Ground, {-30, -0.4f, -40}, {30, -0.02f, 10});
	for (int I = 0; I < 4; ++I)
	{
		const float X = 1.5f * float(I) - 2.4f;
		AddPart(Builder, "column", I % 2 == 0 ? Wall : Side, {X, 0, -7}, {X + 0.5f, 3.2f, -6.5f});
	}
	FMeshBuilder Panes("panes");
	Panes.BeginSection(Builder.AddMaterial(MakeGlass("window")));
	Panes.AddQuad({-1.6f, 0.9f, -3.1f}, {1.6f, 0.9f, -3.1f}, {1.6f, 2.6f, -3.1f}, {-1.6f, 2.6f, -3.1f});
	Builder.AddNode("panes", Builder.AddMesh(Panes));
}

void AddTable(FSceneBuilder& Builder)
{
	const int32_t Wood = Builder.AddLambert("wood", {0.42f, 0.28f, 0.16f});
	AddPart(Builder, "table", Wood, {-1.5f, TableTop - 0.06f, -1.6f}, {1.5f, TableTop, -0.5f});
	for (const float X : {-1.4f, 1.32f})
	{
		for (const float Z : {-1.5f, -0.66f}) { AddPart(Builder, "leg", Wood, {X, 0, Z}, {X + 0.08f, TableTop - 0.06f, Z + 0.08f}); }
	}
}

void AddSheet(FSceneBuilder& Builder, const FHostMaterial& Material, const glm::vec3& Foot)
{
	FMeshBuilder Sheet(Material.Name);
	Sheet.BeginSection(Builder.AddMaterial(Material));
	const glm::vec3 X(0.3f, 0, 0), Y(0, 0.42f, 0);
	Sheet.AddQuad(Foot, Foot + X, Foot + X + Y, Foot + Y);
	Builder.AddNode(Material.Name.c_str(), Builder.AddMesh(Sheet));
}

void AddGlasses(FSceneBuilder& Builder)
{
	FMeshBuilder Ball("ball");
	Ball.BeginSection(Builder.AddMaterial(MakeSolid("clear glass", 1.5f, glm::vec3(0.1f, 0.05f, 0.1f))));
	Ball.AddSphere({0, 0.2f, 0}, 0.2f, 5);
	Builder.AddNode("ball", Builder.AddMesh(Ball), {-0.35f, TableTop + 0.001f, -0.85f});
	FMeshBuilder Vase("vase");
	Vase.BeginSection(Builder.AddMaterial(MakeSolid("green glass", 1.52f, {9.0f, 1.2f, 6.0f})));
	const glm::vec2 Profile[] = {{0.0f, 0.0f}, {0.1f, 0.0f}, {0.1f, 0.0f}, {0.13f, 0.06f}, {0.14f, 0.14f}, {0.11f, 0.24f}, {0.06f, 0.32f},
	    {0.05f, 0.4f}, {0.07f, 0.46f}, {0.07f, 0.46f}, {0.055f, 0.46f}, {0.055f, 0.46f}, {0.038f, 0.4f}, {0.048f, 0.32f}, {0.095f, 0.24f},
	    {0.125f, 0.14f}, {0.115f, 0.06f}, {0.08f, 0.025f}, {0.0f, 0.02f}};
	Vase.AddLathe(Profile, 64);
	Builder.AddNode("vase", Builder.AddMesh(Vase), {0.25f, TableTop + 0.001f, -1.0f});
	FMeshBuilder Tank("water");
	Tank.BeginSection(Builder.AddMaterial(MakeSolid("water", 1.333f, {1.2f, 0.35f, 0.2f})));
	Tank.AddBox({0, 0, 0}, {0.55f, 0.3f, 0.4f});
	Builder.AddNode("water", Builder.AddMesh(Tank), {0.7f, TableTop + 0.001f, -1.2f});
	AddSheet(Builder, MakeGlass("red sheet", {0.85f, 0.1f, 0.08f}), {-1.35f, TableTop, -0.8f});
	AddSheet(Builder, MakeGlass("blue sheet", {0.1f, 0.25f, 0.85f}), {-1.2f, TableTop, -1.05f});
	AddSheet(Builder, MakeGlass("frosted sheet", glm::vec3(0.95f), 0.3f), {-0.95f, TableTop, -1.4f});
}
} // namespace

FSceneDescription BuildGlassScene()
{
	FSceneBuilder Builder("glass");
	AddTiles(Builder);
	AddRoom(Builder);
	AddTable(Builder);
	AddGlasses(Builder);
	Builder.AddCamera({0.25, 1.45, 1.5}, {0.0, 1.02, -1.2}, 52);
	Builder.SetLight(glm::normalize(glm::vec3(-0.35f, -0.8f, 1.0f)), 20.0f, {0.7f, 0.95f, 1.3f});
	Builder.Scene.DefaultExposure = 0.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
