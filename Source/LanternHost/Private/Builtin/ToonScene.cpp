// Two figures of a stylised look in a lane between painted walls: faces and hair that gather light as spheres do.
#include <cmath>
#include <initializer_list>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "Builtin/SceneBuilder.h"
#include "Builtin/ToonScene.h"

namespace Lantern::Builtin
{

namespace
{
constexpr float HeadHeight = 1.42f, HeadRadius = 0.13f;
constexpr glm::vec3 HeadCenter{0, HeadHeight, 0}, SkinColor{0.86f, 0.66f, 0.56f};

struct FLook
{
	glm::vec3 Hair, Dress, Trim;
};

struct FFigure
{
	glm::vec3 Place{0};
	float Yaw = 0.0f;
	FLook Look;
};

void AddEllipsoid(FMeshBuilder& Builder, const glm::vec3& Center, const glm::vec3& Radii, int Subdivisions = 3)
{
	Builder.SetTransform(glm::scale(glm::translate(glm::mat4(1), Center), Radii));
	Builder.AddSphere({0, 0, 0}, 1.0f, Subdivisions);
	Builder.SetTransform(glm::mat4(1));
}

/// The figures' only metal: what else they have reflects nothing.
int32_t AddGold(FSceneBuilder& Builder)
{
	FHostMaterial Gold;
	Gold.Name = "gold";
	Gold.BaseColor = {0.9f, 0.68f, 0.32f, 1.0f};
	Gold.Metallic = 1.0f;
	Gold.Roughness = 0.15f;
	return Builder.AddMaterial(Gold);
}

FMeshBuilder MakeFace(FSceneBuilder& Builder, const std::string& Name)
{
	FMeshBuilder Face(Name + " face");
	Face.BeginSection(Builder.AddLambert("skin", SkinColor));
	AddEllipsoid(Face, HeadCenter, {0.118f, HeadRadius, 0.122f}, 5);
	AddEllipsoid(Face, HeadCenter + glm::vec3(0, -0.085f, 0.03f), {0.06f, 0.054f, 0.064f}, 4); // chin
	AddEllipsoid(Face, HeadCenter + glm::vec3(0, -0.028f, 0.122f), {0.013f, 0.017f, 0.019f});  // nose
	const int32_t Dark = Builder.AddLambert("eye", {0.04f, 0.05f, 0.1f}), White = Builder.AddLambert("glint", glm::vec3(0.9f));
	Face.BeginSection(Builder.AddLambert("mouth", {0.55f, 0.2f, 0.2f}));
	AddEllipsoid(Face, HeadCenter + glm::vec3(0, -0.067f, 0.103f), {0.016f, 0.004f, 0.006f});
	for (const float Side : {-1.0f, 1.0f})
	{
		Face.BeginSection(Dark);
		AddEllipsoid(Face, HeadCenter + glm::vec3(Side * 0.046f, 0.002f, 0.106f), {0.017f, 0.027f, 0.011f});
		Face.BeginSection(White);
		AddEllipsoid(Face, HeadCenter + glm::vec3(Side * 0.046f + 0.006f, 0.013f, 0.115f), {0.005f, 0.007f, 0.004f});
	}
	return Face;
}

/// A cap with locks before the forehead and at the sides, and a tail behind.
FMeshBuilder MakeHair(FSceneBuilder& Builder, const std::string& Name, const glm::vec3& Color)
{
	FMeshBuilder Hair(Name + " hair");
	Hair.BeginSection(Builder.AddLambert("hair", Color));
	AddEllipsoid(Hair, HeadCenter + glm::vec3(0, 0.035f, -0.024f), {0.137f, 0.132f, 0.133f}, 5);
	const auto AddLock = [&](std::initializer_list<glm::vec3> Path, std::initializer_list<float> Radii) {
		Hair.AddTube({Path.begin(), Path.size()}, {Radii.begin(), Radii.size()}, 12);
	};
	for (int I = -3; I <= 3; ++I)
	{
		const float X = 0.036f * float(I), Drop = 0.012f * std::abs(float(I));
		AddLock({HeadCenter + glm::vec3(0.5f * X, 0.155f, 0.03f), HeadCenter + glm::vec3(X, 0.1f, 0.118f - 0.5f * std::abs(X)),
		            HeadCenter + glm::vec3(1.1f * X, 0.042f - Drop, 0.136f - 0.4f * std::abs(X))},
		    {0.022f, 0.024f, 0.004f});
	}
	for (const float Side : {-1.0f, 1.0f})
	{
		AddLock({HeadCenter + glm::vec3(Side * 0.11f, 0.08f, 0.05f), HeadCenter + glm::vec3(Side * 0.135f, -0.04f, 0.07f),
		            HeadCenter + glm::vec3(Side * 0.125f, -0.19f, 0.08f)},
		    {0.02f, 0.026f, 0.005f});
	}
	AddLock({HeadCenter + glm::vec3(0, 0.08f, -0.12f), HeadCenter + glm::vec3(0, 0.0f, -0.22f), HeadCenter + glm::vec3(0, -0.3f, -0.22f),
	            HeadCenter + glm::vec3(0, -0.55f, -0.16f)},
	    {0.05f, 0.06f, 0.055f, 0.01f});
	return Hair;
}

FMeshBuilder MakeBody(FSceneBuilder& Builder, const std::string& Name, const FLook& Look)
{
	FMeshBuilder Body(Name + " body");
	const int32_t Dress = Builder.AddLambert("dress", Look.Dress), Trim = Builder.AddLambert("trim", Look.Trim);
	Body.BeginSection(Dress);
	const glm::vec2 Skirt[] = {{0.34f, 0.42f}, {0.3f, 0.5f}, {0.21f, 0.68f}, {0.115f, 0.88f}};
	Body.AddLathe(Skirt, 48);
	const glm::vec2 Chest[] = {{0.115f, 0.88f}, {0.14f, 1.02f}, {0.145f, 1.12f}, {0.09f, 1.21f}, {0.045f, 1.235f}};
	Body.AddLathe(Chest, 48);
	Body.BeginSection(Builder.AddLambert("neck", SkinColor));
	const glm::vec3 Neck[] = {{0, HeadHeight - 0.22f, -0.01f}, {0, HeadHeight - 0.06f, -0.005f}};
	const float NeckRadii[] = {0.042f, 0.042f};
	Body.AddTube(Neck, NeckRadii, 24);
	Body.BeginSection(Trim);
	const glm::vec2 Hem[] = {{0.345f, 0.4f}, {0.35f, 0.43f}, {0.34f, 0.45f}};
	Body.AddLathe(Hem, 48);
	Body.BeginSection(AddGold(Builder));
	AddEllipsoid(Body, {0, 1.08f, 0.135f}, {0.034f, 0.034f, 0.016f}, 4);  // brooch
	AddEllipsoid(Body, {0, 0.885f, 0.128f}, {0.034f, 0.024f, 0.014f}, 4); // buckle
	const glm::vec2 Belt[] = {{0.122f, 0.86f}, {0.128f, 0.88f}, {0.122f, 0.91f}};
	Body.AddLathe(Belt, 48);
	Body.BeginSection(Dress);
	for (const float Side : {-1.0f, 1.0f})
	{
		const glm::vec3 Leg[] = {{Side * 0.075f, 0.62f, 0}, {Side * 0.08f, 0.3f, 0.005f}, {Side * 0.085f, 0.0f, 0}};
		const float LegRadii[] = {0.065f, 0.05f, 0.04f};
		Body.AddTube(Leg, LegRadii, 20);
		const glm::vec3 Arm[] = {{Side * 0.125f, 1.16f, 0}, {Side * 0.21f, 0.98f, 0.01f}, {Side * 0.25f, 0.78f, 0.06f}};
		const float ArmRadii[] = {0.042f, 0.034f, 0.026f};
		Body.AddTube(Arm, ArmRadii, 20);
		AddEllipsoid(Body, {Side * 0.085f, 0.03f, 0.05f}, {0.045f, 0.035f, 0.1f});
	}
	return Body;
}

FToonStyle MakeHeadStyle(const glm::vec3& Tint)
{
	FToonStyle Style;
	Style.Center = HeadCenter;
	Style.SphereWeight = 1.0f;
	Style.Tint = Tint;
	return Style;
}

void AddFigure(FSceneBuilder& Builder, const std::string& Name, const FFigure& Figure, bool bStyled)
{
	FMeshBuilder Face = MakeFace(Builder, Name), Hair = MakeHair(Builder, Name, Figure.Look.Hair),
	             Body = MakeBody(Builder, Name, Figure.Look);
	const auto Add = [&](FMeshBuilder& Mesh, const char* Part, const FToonStyle& Style) {
		const int32_t Node = Builder.AddNode((Name + " " + Part).c_str(), Builder.AddMesh(Mesh), Figure.Place, Figure.Yaw);
		FHostNode& Added = Builder.Scene.Nodes[static_cast<size_t>(Node)];
		Added.Traits.bCharacter = true;
		if (bStyled) { Added.Toon = Style; }
	};
	Add(Face, "face", MakeHeadStyle({1.0f, 0.93f, 0.88f}));
	Add(Hair, "hair", MakeHeadStyle(glm::vec3(1)));
	Add(Body, "body", FToonStyle());
}

void AddLane(FSceneBuilder& Builder)
{
	const int32_t Ground = Builder.AddLambert("ground", {0.55f, 0.5f, 0.44f}), Red = Builder.AddLambert("red", {0.75f, 0.2f, 0.14f});
	const int32_t Blue = Builder.AddLambert("blue", {0.12f, 0.4f, 0.6f}), Back = Builder.AddLambert("back", {0.7f, 0.66f, 0.56f});
	const auto AddPart = [&](const char* Name, int32_t Material, const glm::vec3& Min, const glm::vec3& Max) {
		FMeshBuilder Part(Name);
		Part.BeginSection(Material);
		Part.AddBeveledBox(Min, Max, 0.01f);
		Builder.AddNode(Name, Builder.AddMesh(Part));
	};
	AddPart("ground", Ground, {-20, -0.2f, -20}, {20, 0, 20});
	AddPart("red wall", Red, {-1.7f, 0, -2.2f}, {-1.5f, 2.6f, 2.0f});
	AddPart("blue wall", Blue, {1.5f, 0, -2.2f}, {1.7f, 2.6f, 2.0f});
	AddPart("back wall", Back, {-1.5f, 0, -2.2f}, {1.5f, 2.6f, -2.0f});
	AddPart("awning", Back, {-1.5f, 2.5f, -2.0f}, {1.5f, 2.6f, -0.4f});
}
} // namespace

FSceneDescription BuildToonScene(bool bStyled)
{
	FSceneBuilder Builder("toon");
	AddLane(Builder);
	AddFigure(Builder, "first", {{-0.42f, 0, -0.75f}, 0.25f, {{0.9f, 0.62f, 0.2f}, {0.2f, 0.34f, 0.62f}, {0.86f, 0.82f, 0.7f}}}, bStyled);
	AddFigure(Builder, "second", {{0.5f, 0, -0.95f}, -0.2f, {{0.5f, 0.62f, 0.86f}, {0.72f, 0.2f, 0.28f}, {0.9f, 0.86f, 0.8f}}}, bStyled);
	Builder.AddCamera({0.1, 1.35, 1.45}, {0.03, 1.15, -0.9}, 40);
	// The sun stands behind the back wall: it lights the ground in front, and that the figures.
	Builder.SetLight(glm::normalize(glm::vec3(-0.5f, -1.0f, 0.55f)), 12.0f, {0.25f, 0.35f, 0.5f});
	Builder.Scene.DefaultExposure = 0.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
