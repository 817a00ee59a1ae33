// Columns, arches and the balustrade of the western arcade.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Courtyard/CourtyardParts.h"

namespace Lantern::Builtin
{

namespace
{

constexpr float Springing = 2.5f; // where the arch begins, above the gallery floor
constexpr float ArchRadius = 0.95f;
constexpr float WallTop = ArcadeTop - GalleryHeight;
constexpr float HalfThickness = 0.25f;
constexpr int ArchSegments = 22;

glm::vec2 GetArchPoint(float Radius, float T)
{
	const float Angle = glm::pi<float>() * (1.0f - T);
	return {Radius * std::cos(Angle), Springing + Radius * std::sin(Angle)};
}

/// One face of the wall above the columns, with the arch left out. Side: +1 front, −1 back.
void AddArchFace(FMeshBuilder& Mesh, float Side)
{
	const float Z = HalfThickness * Side;
	const auto AddFace = [&](const glm::vec2& A, const glm::vec2& B, const glm::vec2& C, const glm::vec2& D) {
		if (Side > 0) { Mesh.AddQuad({A, Z}, {B, Z}, {C, Z}, {D, Z}); }
		else { Mesh.AddQuad({A, Z}, {D, Z}, {C, Z}, {B, Z}); }
	};
	constexpr float HalfBay = BayWidth / 2;
	AddFace({-HalfBay, Springing}, {-ArchRadius, Springing}, {-ArchRadius, WallTop}, {-HalfBay, WallTop});
	AddFace({ArchRadius, Springing}, {HalfBay, Springing}, {HalfBay, WallTop}, {ArchRadius, WallTop});
	for (int I = 0; I < ArchSegments; ++I)
	{
		const glm::vec2 A = GetArchPoint(ArchRadius, float(I) / ArchSegments);
		const glm::vec2 B = GetArchPoint(ArchRadius, float(I + 1) / ArchSegments);
		AddFace(A, B, {B.x, WallTop}, {A.x, WallTop});
	}
}

/// The ring of voussoirs, alternately light and dark, standing out a little on both faces, and the arch's underside.
void AddVoussoirs(FMeshBuilder& Mesh)
{
	constexpr float Outer = ArchRadius + 0.24f, Z = HalfThickness + 0.035f;
	for (int I = 0; I < ArchSegments; ++I)
	{
		const float T0 = float(I) / ArchSegments, T1 = float(I + 1) / ArchSegments;
		const glm::vec2 A = GetArchPoint(ArchRadius, T0), B = GetArchPoint(ArchRadius, T1);
		const glm::vec2 C = GetArchPoint(Outer, T1), D = GetArchPoint(Outer, T0);
		Mesh.SetColor((I / 2) % 2 == 0 ? glm::vec3(1) : glm::vec3(0.72f, 0.36f, 0.26f));
		Mesh.AddQuad({A, Z}, {B, Z}, {C, Z}, {D, Z});
		Mesh.AddQuad({A, -Z}, {D, -Z}, {C, -Z}, {B, -Z});
		Mesh.AddQuad({D, Z}, {C, Z}, {C, -Z}, {D, -Z});
		Mesh.AddQuad({A, -Z}, {B, -Z}, {B, Z}, {A, Z});
	}
	Mesh.SetColor(glm::vec3(1));
}

int32_t MakeArchBay(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("arch bay");
	constexpr float HalfBay = BayWidth / 2;
	Mesh.BeginSection(Yard.M.Ashlar);
	AddArchFace(Mesh, 1.0f);
	AddArchFace(Mesh, -1.0f);
	Mesh.AddQuad({-HalfBay, Springing, -HalfThickness}, {-ArchRadius, Springing, -HalfThickness}, {-ArchRadius, Springing, HalfThickness},
	    {-HalfBay, Springing, HalfThickness});
	Mesh.AddQuad({ArchRadius, Springing, -HalfThickness}, {HalfBay, Springing, -HalfThickness}, {HalfBay, Springing, HalfThickness},
	    {ArchRadius, Springing, HalfThickness});
	Mesh.BeginSection(Yard.M.Trim);
	AddVoussoirs(Mesh);
	Mesh.AddBeveledBox({-HalfBay, WallTop - 0.24f, -HalfThickness - 0.10f}, {HalfBay, WallTop - 0.10f, HalfThickness + 0.10f}, 0.03f);
	Mesh.AddBeveledBox({-HalfBay, WallTop - 0.10f, -HalfThickness - 0.18f}, {HalfBay, WallTop, HalfThickness + 0.18f}, 0.02f);
	return Yard.Builder.AddMesh(Mesh);
}

int32_t MakeColumn(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("column");
	Mesh.BeginSection(Yard.M.Trim);
	Mesh.AddBeveledBox({-0.27f, 0, -0.27f}, {0.27f, 0.12f, 0.27f}, 0.012f);
	const glm::vec2 Profile[] = {{0.26f, 0.12f}, {0.275f, 0.15f}, {0.26f, 0.19f}, {0.22f, 0.20f}, {0.22f, 0.20f}, {0.205f, 0.23f},
	    {0.22f, 0.26f}, {0.19f, 0.28f}, {0.19f, 0.28f}, {0.185f, 0.90f}, {0.175f, 1.60f}, {0.16f, 2.08f}, {0.16f, 2.08f}, {0.185f, 2.10f},
	    {0.185f, 2.13f}, {0.165f, 2.14f}, {0.165f, 2.14f}, {0.17f, 2.22f}, {0.20f, 2.29f}, {0.25f, 2.34f}, {0.27f, 2.37f}};
	Mesh.AddLathe(Profile, 32);
	Mesh.AddBeveledBox({-0.29f, 2.37f, -0.29f}, {0.29f, Springing, 0.29f}, 0.02f);
	return Yard.Builder.AddMesh(Mesh);
}

int32_t MakeCornerPier(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("corner pier");
	Mesh.BeginSection(Yard.M.Ashlar);
	Mesh.AddBeveledBox({-0.3f, 0, -0.3f}, {0.3f, WallTop - 0.1f, 0.3f}, 0.02f);
	Mesh.BeginSection(Yard.M.Trim);
	Mesh.AddBeveledBox({-0.36f, 0, -0.36f}, {0.36f, 0.25f, 0.36f}, 0.03f);
	Mesh.AddBeveledBox({-0.34f, Springing - 0.12f, -0.34f}, {0.34f, Springing, 0.34f}, 0.02f);
	Mesh.AddBeveledBox({-0.44f, WallTop - 0.10f, -0.44f}, {0.44f, WallTop + 0.002f, 0.44f}, 0.02f);
	return Yard.Builder.AddMesh(Mesh);
}

/// A row of bays along x through Center, turned by Yaw.
void PlaceRow(const FCourtyard& Yard, int32_t Bay, int32_t Column, const glm::vec3& Center, float Yaw)
{
	const glm::vec3 Along(std::cos(Yaw), 0, -std::sin(Yaw));
	for (int I = 0; I < BayCount; ++I)
	{
		const float Offset = (float(I) - float(BayCount - 1) / 2) * BayWidth;
		Yard.Builder.AddNode("arch", Bay, Center + Along * Offset, Yaw);
		if (I > 0) { Yard.Builder.AddNode("column", Column, Center + Along * (Offset - BayWidth / 2), Yaw); }
	}
}

int32_t MakeBaluster(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("baluster");
	Mesh.BeginSection(Yard.M.Trim);
	const glm::vec2 Profile[] = {{0.07f, 0}, {0.07f, 0.05f}, {0.07f, 0.05f}, {0.035f, 0.07f}, {0.055f, 0.14f}, {0.075f, 0.22f},
	    {0.06f, 0.32f}, {0.035f, 0.42f}, {0.03f, 0.48f}, {0.055f, 0.50f}, {0.055f, 0.52f}, {0.055f, 0.52f}, {0.07f, 0.54f}, {0.07f, 0.58f}};
	Mesh.AddLathe(Profile, 16);
	return Yard.Builder.AddMesh(Mesh);
}

void AddBalustrade(const FCourtyard& Yard)
{
	const int32_t Baluster = MakeBaluster(Yard);
	FMeshBuilder Rail("rail");
	Rail.BeginSection(Yard.M.Trim);
	Rail.AddBeveledBox({-0.14f, 0, -YardHalf}, {0.14f, 0.08f, YardHalf}, 0.01f);
	Rail.AddBeveledBox({-0.13f, 0.66f, -YardHalf}, {0.13f, 0.78f, YardHalf}, 0.025f);
	for (int I = 0; I <= BayCount; ++I)
	{
		const float Z = float(I) * BayWidth - YardHalf;
		Rail.AddBeveledBox({-0.17f, 0, Z - 0.17f}, {0.17f, 0.86f, Z + 0.17f}, 0.02f);
	}
	const int32_t RailMesh = Yard.Builder.AddMesh(Rail);
	Yard.Builder.AddNode("rail", RailMesh, {-YardHalf, ArcadeTop, 0});
	for (int I = 0; I < BayCount * 6; ++I)
	{
		const float Z = (float(I) + 0.5f) * BayWidth / 6 - YardHalf;
		Yard.Builder.AddNode("baluster", Baluster, {-YardHalf, ArcadeTop + 0.08f, Z});
	}
}

} // namespace

void BuildArcades(const FCourtyard& Yard)
{
	const int32_t Bay = MakeArchBay(Yard), Column = MakeColumn(Yard), Pier = MakeCornerPier(Yard);
	constexpr float Q = glm::half_pi<float>();
	PlaceRow(Yard, Bay, Column, {0, GalleryHeight, -YardHalf}, 0.0f);
	PlaceRow(Yard, Bay, Column, {YardHalf, GalleryHeight, 0}, -Q);
	// The western arcade stands free, so that the low sun shines through it.
	PlaceRow(Yard, Bay, Column, {-YardHalf, GalleryHeight, 0}, Q);
	for (const float X : {-YardHalf, YardHalf})
	{
		for (const float Z : {-YardHalf, YardHalf}) { Yard.Builder.AddNode("corner pier", Pier, {X, GalleryHeight, Z}); }
	}
	AddBalustrade(Yard);
}

} // namespace Lantern::Builtin
