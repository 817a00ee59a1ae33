// Makes the scenes of lantern bench growth.
#include "Bench/GrowthScenes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "Bench/BenchFrameWorld.h"
#include "LanternHost/VertexPacking.h"
#include "LanternMeasure/MaterialWall.h"

namespace Lantern
{

namespace
{
constexpr FGrowthLineInfo Lines[] = {{"objects", "1 % of them move, 6 km, one size of picture"},
    {"triangles", "256 objects of one mesh each, one material"}, {"materials", "one quad each"},
    {"programs", "a room of 1,500 quads with a polished floor, and a material for each program"}, {"pixels", "1,000 objects"}};
constexpr uint32_t TriangleObjects = 256;

/// Gentle hills of about that many triangles over a square of 2 m.
FHostMesh MakeHills(uint64_t Triangles)
{
	FHostMesh Mesh;
	Mesh.Name = "hills";
	const auto Edge = static_cast<uint32_t>(std::max(1.0, std::round(std::sqrt(0.5 * double(Triangles)))));
	for (uint32_t Z = 0; Z <= Edge; ++Z)
	{
		for (uint32_t X = 0; X <= Edge; ++X)
		{
			const glm::vec2 At = 2.0f * glm::vec2(float(X), float(Z)) / float(Edge) - 1.0f;
			const glm::vec2 Slope = -0.6f * glm::vec2(std::sin(6.0f * At.x), std::sin(6.0f * At.y));
			Mesh.Positions.emplace_back(At.x, 0.1f * (std::cos(6.0f * At.x) + std::cos(6.0f * At.y)), At.y);
			FVertexAttributes Vertex{};
			Vertex.Normal = PackUnitVector(glm::normalize(glm::vec3(-Slope.x, 1.0f, -Slope.y)));
			Vertex.Color = PackColor(glm::vec4(1));
			Mesh.Attributes.push_back(Vertex);
			if (X == Edge || Z == Edge) { continue; }
			const uint32_t A = Z * (Edge + 1) + X, B = A + Edge + 1;
			Mesh.Indices.insert(Mesh.Indices.end(), {A, B, A + 1, A + 1, B, B + 1});
		}
	}
	Mesh.BoundsMin = {-1.0f, -0.2f, -1.0f};
	Mesh.BoundsMax = {1.0f, 0.2f, 1.0f};
	Mesh.Sections.push_back({0, static_cast<uint32_t>(Mesh.Indices.size()), 0});
	return Mesh;
}

FGrowthScene MakeHillScene(uint64_t Triangles)
{
	FGrowthScene Out;
	FHostMaterial& Material = Out.Scene.Materials.emplace_back();
	Material.Name = "grey";
	Material.BaseColor = {0.5f, 0.5f, 0.5f, 1.0f};
	Material.Metallic = 0.0f;
	const auto Columns = static_cast<uint32_t>(std::sqrt(double(TriangleObjects)));
	for (uint32_t I = 0; I < TriangleObjects; ++I)
	{
		// A mesh each: one shared mesh would be one acceleration structure, whatever the number of objects.
		Out.Scene.Meshes.push_back(MakeHills(std::max<uint64_t>(2, Triangles / TriangleObjects)));
		FHostNode& Node = Out.Scene.Nodes.emplace_back();
		Node.Mesh = static_cast<int32_t>(I);
		const glm::dvec3 At(2.0 * (double(I % Columns) - 0.5 * Columns), 0.0, 2.0 * (double(I / Columns) - 0.5 * Columns));
		Node.Matrix = glm::translate(glm::dmat4(1), At);
	}
	Out.View = LookAt({0, 8, 22}, {0, 0, 0}, 1.0f, 1, 1);
	return Out;
}

FGrowthScene MakeWorldScene(uint64_t Objects)
{
	FBenchWorldOptions Options;
	Options.Objects = static_cast<uint32_t>(Objects);
	Options.Characters = 0;
	Options.Movers = static_cast<uint32_t>(Objects / 100);
	Options.Repainted = 0;
	FBenchWorld World = MakeBenchWorld(Options);
	FGrowthScene Out{std::move(World.Scene), LookAt({0, 1.8, 0}, {100, 1.8, 30}, 1.1f, 1, 1), std::move(World.Movers)};
	return Out;
}

FGrowthScene MakeWallScene(uint64_t Materials)
{
	const double Columns = std::ceil(std::sqrt(double(Materials)));
	FGrowthScene Out;
	const double Step = 40.0 / Columns; // the wall has one size
	Out.Scene = MakeMaterialWall({static_cast<uint32_t>(Materials), static_cast<uint32_t>(Columns), 0.9 * Step, Step, {-20.0, -20.0, 0.0}});
	Out.View = LookAt({0, 0, 40}, {0, 0, 0}, 1.0f, 1, 1);
	return Out;
}

/// A room whose quads take the programs in turn, so that neighbouring rays of indirect light meet different ones. The floor is polished, and
/// the sky shines in from above.
FGrowthScene MakeRoomScene(uint64_t Programs)
{
	constexpr uint32_t Edge = 16;
	constexpr double Half = 0.5 * Edge;
	FGrowthScene Out;
	for (uint64_t I = 0; I <= Programs; ++I)
	{
		const bool bFloor = I == Programs;
		FHostMaterial& Material = Out.Scene.Materials.emplace_back();
		Material.Name = bFloor ? "floor" : "program " + std::to_string(I);
		Material.BaseColor = {0.7f, 0.7f, 0.7f, 1.0f};
		Material.Metallic = bFloor ? 1.0f : 0.0f;
		Material.Roughness = bFloor ? 0.1f : 1.0f;
		FHostMesh Mesh = MakeHills(2);
		Mesh.Sections[0].Material = static_cast<uint32_t>(I);
		Out.Scene.Meshes.push_back(std::move(Mesh));
	}
	// Faces by the axis across them: where their quads look is the inside.
	const glm::dmat4 Faces[] = {glm::dmat4(1), glm::rotate(glm::dmat4(1), glm::pi<double>(), glm::dvec3(1, 0, 0)),
	    glm::rotate(glm::dmat4(1), glm::half_pi<double>(), glm::dvec3(1, 0, 0)),
	    glm::rotate(glm::dmat4(1), -glm::half_pi<double>(), glm::dvec3(1, 0, 0)),
	    glm::rotate(glm::dmat4(1), glm::half_pi<double>(), glm::dvec3(0, 0, 1)),
	    glm::rotate(glm::dmat4(1), -glm::half_pi<double>(), glm::dvec3(0, 0, 1))};
	uint32_t Quad = 0;
	for (const glm::dmat4& Face : Faces)
	{
		for (uint32_t Y = 0; Y < Edge; ++Y)
		{
			for (uint32_t X = 0; X < Edge; ++X, ++Quad)
			{
				const bool bOpening =
				    &Face == &Faces[1] && std::abs(double(X) + 0.5 - Half) < 3.0 && std::abs(double(Y) + 0.5 - Half) < 3.0;
				if (bOpening) { continue; }
				FHostNode& Node = Out.Scene.Nodes.emplace_back();
				Node.Mesh = static_cast<int32_t>(&Face == &Faces[0] ? Programs : (Quad * 97u) % Programs);
				const glm::dvec3 At(double(X) + 0.5 - Half, -Half, double(Y) + 0.5 - Half);
				Node.Matrix = glm::scale(Face * glm::translate(glm::dmat4(1), At), glm::dvec3(0.5, 0.5, 0.5));
			}
		}
	}
	Out.View = LookAt({-6, -3, -6}, {6, -1, 6}, 1.2f, 1, 1);
	return Out;
}
} // namespace

const FGrowthLineInfo& GetGrowthLine(EGrowthLine Line) { return Lines[static_cast<size_t>(Line)]; }

std::vector<uint64_t> ListGrowthPoints(EGrowthLine Line, bool bIsCpu, bool bQuick)
{
	std::vector<uint64_t> Points;
	switch (Line)
	{
	case EGrowthLine::Objects: Points = {1000, 10'000, 100'000, 1'000'000}; break;
	case EGrowthLine::Triangles: Points = {10'000, 100'000, 1'000'000, 10'000'000}; break;
	case EGrowthLine::Materials: Points = {16, 256, 4096, 16'384}; break;
	case EGrowthLine::Programs: Points = {1, 8, 64, 256}; break;
	case EGrowthLine::Pixels:
		for (const uint64_t Width : {160, 320, 640, 1280, 2560, 3840}) { Points.push_back(Width * Width * 9 / 16); }
		break;
	case EGrowthLine::Count: break;
	}
	Points.resize(bQuick ? 2 : Line == EGrowthLine::Pixels && bIsCpu ? 4 : Points.size());
	return Points;
}

FGrowthScene MakeGrowthScene(EGrowthLine Line, uint64_t Value, bool bIsCpu)
{
	FGrowthScene Out;
	switch (Line)
	{
	case EGrowthLine::Objects: Out = MakeWorldScene(Value); break;
	case EGrowthLine::Triangles: Out = MakeHillScene(Value); break;
	case EGrowthLine::Materials: Out = MakeWallScene(Value); break;
	case EGrowthLine::Programs: Out = MakeRoomScene(Value); break;
	default: Out = MakeWorldScene(1000); break;
	}
	Out.View.Width = bIsCpu ? 160 : 1280;
	if (Line == EGrowthLine::Pixels) { Out.View.Width = static_cast<uint32_t>(std::lround(std::sqrt(double(Value) * 16.0 / 9.0))); }
	Out.View.Height = Out.View.Width * 9 / 16;
	return Out;
}

} // namespace Lantern
