// The walls behind the arcades, the upper storey with its windows, doors and tiled roofs.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Courtyard/CourtyardParts.h"

namespace Lantern::Builtin
{

namespace
{

constexpr float Q = glm::half_pi<float>();

/// A wall in the xy plane facing +z, with a rectangular opening of some depth.
struct FWallOpening
{
	float X0, X1, Y0, Y1, Depth;
};

void AddWallWithOpening(FMeshBuilder& Mesh, float Half, float Top, const FWallOpening& O)
{
	const auto AddFace = [&](float X0, float Y0, float X1, float Y1) { Mesh.AddQuad({X0, Y0, 0}, {X1, Y0, 0}, {X1, Y1, 0}, {X0, Y1, 0}); };
	AddFace(-Half, 0, O.X0, Top);
	AddFace(O.X1, 0, Half, Top);
	AddFace(O.X0, O.Y1, O.X1, Top);
	if (O.Y0 > 0)
	{
		AddFace(O.X0, 0, O.X1, O.Y0);
		Mesh.AddQuad({O.X0, O.Y0, 0}, {O.X1, O.Y0, 0}, {O.X1, O.Y0, -O.Depth}, {O.X0, O.Y0, -O.Depth});
	}
	Mesh.AddQuad({O.X0, O.Y1, -O.Depth}, {O.X1, O.Y1, -O.Depth}, {O.X1, O.Y1, 0}, {O.X0, O.Y1, 0});
	Mesh.AddQuad({O.X0, O.Y0, 0}, {O.X0, O.Y0, -O.Depth}, {O.X0, O.Y1, -O.Depth}, {O.X0, O.Y1, 0});
	Mesh.AddQuad({O.X1, O.Y0, -O.Depth}, {O.X1, O.Y0, 0}, {O.X1, O.Y1, 0}, {O.X1, O.Y1, -O.Depth});
}

void AddShutter(FMeshBuilder& Mesh, float X, float Y0, float Y1)
{
	constexpr float Half = 0.27f;
	Mesh.AddBeveledBox({X - Half, Y0, 0.02f}, {X - Half + 0.06f, Y1, 0.07f}, 0.006f);
	Mesh.AddBeveledBox({X + Half - 0.06f, Y0, 0.02f}, {X + Half, Y1, 0.07f}, 0.006f);
	for (const float Y : {Y0, (Y0 + Y1) / 2 - 0.03f, Y1 - 0.06f})
	{
		Mesh.AddBeveledBox({X - Half + 0.06f, Y, 0.022f}, {X + Half - 0.06f, Y + 0.06f, 0.068f}, 0.005f);
	}
	const int Slats = int((Y1 - Y0) / 0.07f);
	for (int I = 1; I < Slats; ++I)
	{
		const float Y = Y0 + (Y1 - Y0) * float(I) / float(Slats);
		Mesh.AddQuad({X - Half + 0.05f, Y - 0.035f, 0.065f}, {X + Half - 0.05f, Y - 0.035f, 0.065f}, {X + Half - 0.05f, Y + 0.03f, 0.03f},
		    {X - Half + 0.05f, Y + 0.03f, 0.03f});
	}
}

int32_t MakeWindowBay(const FCourtyard& Yard, int32_t Glass)
{
	constexpr float Height = UpperTop - ArcadeTop;
	const FWallOpening Window{-0.5f, 0.5f, 0.95f, 2.65f, 0.22f};
	FMeshBuilder Mesh("window bay");
	Mesh.BeginSection(Yard.M.Plaster);
	AddWallWithOpening(Mesh, BayWidth / 2, Height, Window);
	Mesh.BeginSection(Yard.M.Trim);
	Mesh.AddBeveledBox({-0.66f, 0.82f, -0.1f}, {0.66f, 0.95f, 0.14f}, 0.02f);
	Mesh.AddBeveledBox({-0.62f, 2.65f, -0.1f}, {0.62f, 2.83f, 0.08f}, 0.02f);
	Mesh.AddBeveledBox({-BayWidth / 2, Height - 0.28f, -0.1f}, {BayWidth / 2, Height, 0.16f}, 0.03f);
	Mesh.AddBeveledBox({-BayWidth / 2, 0, -0.1f}, {BayWidth / 2, 0.14f, 0.05f}, 0.015f);
	Mesh.BeginSection(Yard.M.DarkWood);
	AddShutter(Mesh, -0.80f, 0.97f, 2.63f);
	AddShutter(Mesh, 0.80f, 0.97f, 2.63f);
	for (const float X : {-0.5f, -0.025f, 0.45f}) { Mesh.AddBeveledBox({X, 0.95f, -0.20f}, {X + 0.05f, 2.65f, -0.14f}, 0.006f); }
	for (const float Y : {0.95f, 1.50f, 2.05f, 2.60f}) { Mesh.AddBeveledBox({-0.45f, Y, -0.195f}, {0.45f, Y + 0.05f, -0.145f}, 0.006f); }
	Mesh.BeginSection(Glass);
	Mesh.AddQuad({-0.5f, 0.95f, -0.18f}, {0.5f, 0.95f, -0.18f}, {0.5f, 2.65f, -0.18f}, {-0.5f, 2.65f, -0.18f});
	return Yard.Builder.AddMesh(Mesh);
}

int32_t MakeDoorBay(const FCourtyard& Yard)
{
	constexpr float Top = ArcadeTop - GalleryHeight;
	const FWallOpening Door{-0.75f, 0.75f, 0.0f, 2.6f, 0.25f};
	FMeshBuilder Mesh("door bay");
	Mesh.BeginSection(Yard.M.Plaster);
	AddWallWithOpening(Mesh, BayWidth / 2, Top, Door);
	Mesh.BeginSection(Yard.M.Trim);
	Mesh.AddBeveledBox({-0.95f, 0, -0.1f}, {-0.75f, 2.6f, 0.07f}, 0.02f);
	Mesh.AddBeveledBox({0.75f, 0, -0.1f}, {0.95f, 2.6f, 0.07f}, 0.02f);
	Mesh.AddBeveledBox({-1.0f, 2.6f, -0.1f}, {1.0f, 2.86f, 0.10f}, 0.03f);
	Mesh.BeginSection(Yard.M.Wood);
	Mesh.AddBeveledBox({-0.75f, 0.01f, -0.24f}, {-0.006f, 2.6f, -0.16f}, 0.008f);
	Mesh.AddBeveledBox({0.006f, 0.01f, -0.24f}, {0.75f, 2.6f, -0.16f}, 0.008f);
	Mesh.BeginSection(Yard.M.Iron);
	for (const float Side : {-1.0f, 1.0f})
	{
		for (const float Y : {0.35f, 1.25f, 2.15f})
		{
			Mesh.AddBeveledBox({Side > 0 ? 0.16f : -0.74f, Y, -0.17f}, {Side > 0 ? 0.74f : -0.16f, Y + 0.07f, -0.145f}, 0.005f);
		}
		Mesh.SetTransform(glm::mat4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, Side * 0.10f, 1.12f, -0.155f, 1));
		const glm::vec2 Ring[] = {{0.045f, -0.01f}, {0.06f, -0.01f}, {0.06f, 0.01f}, {0.045f, 0.01f}, {0.045f, -0.01f}};
		Mesh.AddLathe(Ring, 20);
		Mesh.SetTransform(glm::mat4(1));
	}
	return Yard.Builder.AddMesh(Mesh);
}

int32_t MakePlainBay(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("wall bay");
	constexpr float Half = BayWidth / 2, Top = ArcadeTop - GalleryHeight;
	Mesh.BeginSection(Yard.M.Plaster);
	Mesh.AddQuad({-Half, 0, 0}, {Half, 0, 0}, {Half, Top, 0}, {-Half, Top, 0});
	Mesh.BeginSection(Yard.M.Ashlar);
	Mesh.AddBeveledBox({-Half, 0, -0.05f}, {Half, 0.9f, 0.06f}, 0.01f);
	return Yard.Builder.AddMesh(Mesh);
}

/// A panel of barrel tiles one bay wide: rows of half tubes over a plane. Runs up along −z and y.
int32_t MakeRoofPanel(const FCourtyard& Yard, float Run, float Rise)
{
	constexpr int Columns = 10, Arc = 6;
	constexpr float Radius = BayWidth / Columns / 2;
	FMeshBuilder Mesh("roof panel");
	Mesh.BeginSection(Yard.M.RoofTile);
	constexpr float Half = BayWidth / 2;
	Mesh.AddQuad({-Half, 0, 0}, {Half, 0, 0}, {Half, Rise, -Run}, {-Half, Rise, -Run});
	Mesh.AddQuad({-Half, -0.12f, 0}, {-Half, Rise - 0.12f, -Run}, {Half, Rise - 0.12f, -Run}, {Half, -0.12f, 0});
	Mesh.AddQuad({-Half, -0.12f, 0}, {Half, -0.12f, 0}, {Half, 0, 0}, {-Half, 0, 0});
	const float Slope = std::sqrt(Run * Run + Rise * Rise);
	const glm::vec3 Up(0, Rise / Slope, -Run / Slope), Out(0, Run / Slope, Rise / Slope);
	const int Rows = int(Slope / 0.42f);
	FRandomStream Random(7);
	for (int Column = 0; Column < Columns; ++Column)
	{
		for (int Row = 0; Row < Rows; ++Row)
		{
			const float Start = Slope * float(Row) / float(Rows) - 0.05f, Length = Slope / float(Rows) + 0.06f;
			const float X = -Half + (float(Column) + 0.5f) * Radius * 2 + Random.Between(-0.006f, 0.006f);
			const float Lift = 0.035f + Random.Between(-0.006f, 0.008f);
			Mesh.SetColor(glm::vec3(Random.Between(0.65f, 1.0f)) * glm::vec3(1, Random.Between(0.85f, 1.0f), 0.92f));
			uint32_t Previous[2] = {0, 0};
			for (int S = 0; S <= Arc; ++S)
			{
				const float Angle = glm::pi<float>() * float(S) / float(Arc);
				const glm::vec3 N = glm::vec3(-std::cos(Angle), 0, 0) + Out * std::sin(Angle);
				const glm::vec3 Lower = glm::vec3(X, 0, 0) + Up * Start + Out * Lift + N * Radius * 0.92f;
				const glm::vec3 Upper = glm::vec3(X, 0, 0) + Up * (Start + Length) + N * Radius * 0.80f;
				const float U = X + Radius * Angle, V = -Start;
				const uint32_t A = Mesh.AddVertex(Lower, N, {U, V}), B = Mesh.AddVertex(Upper, N, {U, V - Length});
				if (S > 0)
				{
					Mesh.AddTriangle(Previous[0], A, B);
					Mesh.AddTriangle(Previous[0], B, Previous[1]);
				}
				Previous[0] = A;
				Previous[1] = B;
			}
		}
	}
	return Yard.Builder.AddMesh(Mesh);
}

/// Ceiling beams and lid of a gallery, and a lid on the north wing, so that no light falls in from above.
void AddCeilings(const FCourtyard& Yard)
{
	constexpr float S = YardHalf, D = GalleryDepth;
	FMeshBuilder Mesh("ceilings");
	Mesh.BeginSection(Yard.M.Wood);
	Mesh.AddBox({-S - D, ArcadeTop - 0.14f, -S - D}, {S + D, ArcadeTop - 0.02f, -S});
	Mesh.AddBox({S, ArcadeTop - 0.14f, -S}, {S + D, ArcadeTop - 0.02f, S});
	for (int I = 0; I <= BayCount * 2; ++I)
	{
		const float T = float(I) * BayWidth / 2 - S;
		Mesh.AddBeveledBox({T - 0.07f, ArcadeTop - 0.36f, -S - D}, {T + 0.07f, ArcadeTop - 0.14f, -S - 0.2f}, 0.01f);
		Mesh.AddBeveledBox({S + 0.2f, ArcadeTop - 0.36f, T - 0.07f}, {S + D, ArcadeTop - 0.14f, T + 0.07f}, 0.01f);
	}
	Mesh.BeginSection(Yard.M.Plaster);
	// Gable ends and backs.
	Mesh.AddBox({-S - 0.02f, ArcadeTop, -S - D - 3.0f}, {S + 0.02f, UpperTop - 0.02f, -S - 0.24f});
	Mesh.AddBox({-S - D, 0, -S - D - 3.0f}, {S + D, ArcadeTop - 0.05f, -S - D - 0.03f});
	Mesh.AddBox({S + D + 0.03f, 0, -S - D}, {S + D + 0.4f, ArcadeTop + 1.4f, S + 0.3f});
	Mesh.BeginSection(Yard.M.Ashlar);
	Mesh.AddBox({-S - 0.3f, 0, S - 0.3f}, {-1.6f, 2.6f, S + 0.3f});
	Mesh.AddBox({1.6f, 0, S - 0.3f}, {S + D + 0.3f, 2.6f, S + 0.3f});
	Yard.Builder.AddNode("ceilings", Yard.Builder.AddMesh(Mesh));
}

void PlaceBays(const FCourtyard& Yard, int32_t Door, int32_t Plain, int32_t Window, int32_t NorthRoof, int32_t EastRoof)
{
	for (int I = 0; I < BayCount; ++I)
	{
		const float T = (float(I) - float(BayCount - 1) / 2) * BayWidth;
		Yard.Builder.AddNode("north wall", I % 3 == 0 ? Door : Plain, {T, GalleryHeight, -YardHalf - GalleryDepth});
		Yard.Builder.AddNode("window", Window, {T, ArcadeTop, -YardHalf - 0.02f});
		Yard.Builder.AddNode("north roof", NorthRoof, {T, UpperTop + 0.02f, -YardHalf + 0.45f});
		Yard.Builder.AddNode("east wall", I % 3 == 1 ? Door : Plain, {YardHalf + GalleryDepth, GalleryHeight, T}, -Q);
		Yard.Builder.AddNode("east roof", EastRoof, {YardHalf - 0.45f, ArcadeTop + 0.12f, T}, -Q);
	}
	// The corners between the wings.
	Yard.Builder.AddNode("north wall", Plain, {-YardHalf - BayWidth / 2, GalleryHeight, -YardHalf - GalleryDepth});
	Yard.Builder.AddNode("north wall", Plain, {YardHalf + BayWidth / 2, GalleryHeight, -YardHalf - GalleryDepth});
	Yard.Builder.AddNode("east wall", Plain, {YardHalf + GalleryDepth, GalleryHeight, -YardHalf - BayWidth / 2}, -Q);
	Yard.Builder.AddNode("east roof", EastRoof, {YardHalf - 0.45f, ArcadeTop + 0.12f, -YardHalf - BayWidth / 2}, -Q);
}

} // namespace

void BuildWings(const FCourtyard& Yard)
{
	FHostMaterial Glass;
	Glass.Name = "window glass";
	Glass.BaseColor = {0.015f, 0.02f, 0.025f, 1};
	Glass.Metallic = 0.0f;
	Glass.Roughness = 0.05f;
	const int32_t Window = MakeWindowBay(Yard, Yard.Builder.AddMaterial(Glass));
	const int32_t NorthRoof = MakeRoofPanel(Yard, 4.4f, 2.0f), EastRoof = MakeRoofPanel(Yard, 3.5f, 1.35f);
	PlaceBays(Yard, MakeDoorBay(Yard), MakePlainBay(Yard), Window, NorthRoof, EastRoof);
	AddCeilings(Yard);
}

} // namespace Lantern::Builtin
