// The open world of lantern bench frame: meshes, objects and their motion.
#include "Bench/BenchFrameWorld.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternHost/VertexPacking.h"

namespace Lantern
{

namespace
{
constexpr double Pi = 3.14159265358979;
constexpr uint32_t LeafTexels = 32;

enum EKind : uint32_t
{
	Tree,
	Bush,
	Rock,
	Prop,
	House,
	KindCount
};
/// Share of each kind among all objects, and number of its meshes.
constexpr double Share[KindCount] = {0.35, 0.25, 0.20, 0.15, 0.05};
constexpr uint32_t MeshesOf[KindCount] = {96, 64, 96, 96, 48};

enum EPalette : uint32_t
{
	Bark,
	Leaves,
	Stone,
	Paint,
	PaletteCount
};
constexpr uint32_t PaletteSize = 64;

class FWorldMaker
{
public:
	explicit FWorldMaker(const FBenchWorldOptions& InOptions) : Options(InOptions), Random(InOptions.Seed) {}
	FBenchWorld Make();

private:
	float Uniform(float Min, float Max) { return Min + (Max - Min) * float(Random() >> 8) * (1.0f / 16777216.0f); }
	uint32_t Below(uint32_t Count) { return Random() % Count; }
	int32_t PickMaterial(EPalette Palette) { return int32_t(1 + Palette * PaletteSize + Below(PaletteSize)); }

	void AddMaterials();
	int32_t AddMesh(FHostMesh Mesh);
	void Section(FHostMesh& Mesh, EPalette Palette);
	static void Quad(FHostMesh& Mesh, glm::vec3 Corner, glm::vec3 U, glm::vec3 V);
	static void Box(FHostMesh& Mesh, glm::vec3 Center, glm::vec3 Half);
	void Ball(FHostMesh& Mesh, glm::vec3 Center, glm::vec3 Radii, uint32_t Rings, float Roughness);
	void Cards(FHostMesh& Mesh, glm::vec3 Center, float Radius, uint32_t Count, float Size);
	FHostMesh MakeKind(EKind Kind);
	int32_t MakeCharacter();
	void Scatter();
	FHostNode& AddNode(int32_t Mesh, double Spread);

	FBenchWorldOptions Options;
	std::mt19937 Random;
	FBenchWorld World;
	std::vector<int32_t> Meshes[KindCount];
	std::vector<std::vector<EPalette>> Palettes; // of meshes' sections
};

void FWorldMaker::AddMaterials()
{
	FHostImage Leaf;
	Leaf.Name = "leaf";
	Leaf.Width = Leaf.Height = LeafTexels;
	Leaf.bSrgb = Leaf.bHasAlpha = true;
	for (uint32_t Y = 0; Y < LeafTexels; ++Y)
	{
		for (uint32_t X = 0; X < LeafTexels; ++X)
		{
			const float U = (float(X) + 0.5f) / LeafTexels - 0.5f, V = (float(Y) + 0.5f) / LeafTexels - 0.5f;
			Leaf.Rgba.insert(Leaf.Rgba.end(), {120, 200, 90, uint8_t(std::abs(U) + 2 * std::abs(V) < 0.5f ? 255 : 0)});
		}
	}
	World.Scene.Images.push_back(std::move(Leaf));
	World.Scene.Textures.push_back({.Image = 0});
	World.Scene.Materials.emplace_back().Name = "ground";
	for (uint32_t Palette = 0; Palette < PaletteCount; ++Palette)
	{
		for (uint32_t I = 0; I < PaletteSize; ++I)
		{
			FHostMaterial& Material = World.Scene.Materials.emplace_back();
			Material.BaseColor = {Uniform(0.1f, 0.9f), Uniform(0.1f, 0.9f), Uniform(0.1f, 0.9f), 1};
			Material.Metallic = 0;
			Material.Roughness = Uniform(0.3f, 1.0f);
			if (Palette != Leaves) { continue; }
			Material.AlphaMode = EAlphaMode::Mask;
			Material.bDoubleSided = true;
			Material.Slots[TEXTURE_BASE_COLOR].Texture = 0;
		}
	}
}

void FWorldMaker::Section(FHostMesh& Mesh, EPalette Palette)
{
	const uint32_t First = Mesh.Sections.empty() ? 0 : Mesh.Sections.back().FirstIndex + Mesh.Sections.back().IndexCount;
	const int32_t Material = int32_t(1 + Palette * PaletteSize);
	Mesh.Sections.push_back({First, uint32_t(Mesh.Indices.size()) - First, Material});
}

void FWorldMaker::Quad(FHostMesh& Mesh, glm::vec3 Corner, glm::vec3 U, glm::vec3 V)
{
	const uint32_t First = uint32_t(Mesh.Positions.size());
	const uint32_t Normal = PackUnitVector(glm::normalize(glm::cross(U, V)));
	for (uint32_t I = 0; I < 4; ++I)
	{
		const glm::vec2 UV(I == 1 || I == 2 ? 1 : 0, I >= 2 ? 1 : 0);
		Mesh.Positions.push_back(Corner + UV.x * U + UV.y * V);
		Mesh.Attributes.push_back({Normal, 0, UV, UV, 0xffffffffu});
	}
	for (const uint32_t I : {0u, 1u, 2u, 0u, 2u, 3u}) { Mesh.Indices.push_back(First + I); }
}

void FWorldMaker::Box(FHostMesh& Mesh, glm::vec3 Center, glm::vec3 Half)
{
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		for (const float Side : {-1.0f, 1.0f})
		{
			glm::vec3 N(0), U(0), V(0);
			N[Axis] = Side * Half[Axis];
			U[(Axis + 1) % 3] = Side * Half[(Axis + 1) % 3];
			V[(Axis + 2) % 3] = Half[(Axis + 2) % 3];
			Quad(Mesh, Center + N - U - V, 2.0f * U, 2.0f * V);
		}
	}
}

void FWorldMaker::Ball(FHostMesh& Mesh, glm::vec3 Center, glm::vec3 Radii, uint32_t Rings, float Roughness)
{
	const uint32_t First = uint32_t(Mesh.Positions.size()), Columns = 2 * Rings;
	for (uint32_t Ring = 0; Ring <= Rings; ++Ring)
	{
		for (uint32_t Column = 0; Column < Columns; ++Column)
		{
			const float Theta = float(Pi) * float(Ring) / float(Rings), Phi = 2 * float(Pi) * float(Column) / float(Columns);
			const glm::vec3 N(std::sin(Theta) * std::cos(Phi), std::cos(Theta), -std::sin(Theta) * std::sin(Phi));
			Mesh.Positions.push_back(Center + N * Radii * Uniform(1.0f - Roughness, 1.0f));
			Mesh.Attributes.push_back({PackUnitVector(N), 0, glm::vec2(N.x, N.y), glm::vec2(0), 0xffffffffu});
		}
	}
	for (uint32_t Ring = 0; Ring < Rings; ++Ring)
	{
		for (uint32_t Column = 0; Column < Columns; ++Column)
		{
			const uint32_t A = First + Ring * Columns + Column, B = First + Ring * Columns + (Column + 1) % Columns;
			if (Ring > 0) { Mesh.Indices.insert(Mesh.Indices.end(), {A, A + Columns, B}); }
			if (Ring + 1 < Rings) { Mesh.Indices.insert(Mesh.Indices.end(), {B, A + Columns, B + Columns}); }
		}
	}
}

void FWorldMaker::Cards(FHostMesh& Mesh, glm::vec3 Center, float Radius, uint32_t Count, float Size)
{
	for (uint32_t I = 0; I < Count; ++I)
	{
		const glm::vec3 At(Uniform(-Radius, Radius), Uniform(-Radius, Radius), Uniform(-Radius, Radius));
		const float Angle = Uniform(0, 6.28f);
		Quad(Mesh, Center + At, Size * glm::vec3(std::cos(Angle), 0, std::sin(Angle)), Size * glm::vec3(0, 1, Uniform(-0.4f, 0.4f)));
	}
}

FHostMesh FWorldMaker::MakeKind(EKind Kind)
{
	FHostMesh Mesh;
	switch (Kind)
	{
	case Tree:
	{
		const float Height = Uniform(3, 9);
		Ball(Mesh, {0, 0.5f * Height, 0}, {0.3f, 0.6f * Height, 0.3f}, 5, 0.2f);
		Section(Mesh, Bark);
		Cards(Mesh, {0, Height, 0}, 0.35f * Height, 48, 1.2f);
		Section(Mesh, Leaves);
		break;
	}
	case Bush:
		Cards(Mesh, {0, 0.6f, 0}, 0.5f, 20, 0.5f);
		Section(Mesh, Leaves);
		break;
	case Rock:
		Ball(Mesh, {0, 0.2f, 0}, {Uniform(0.3f, 2), Uniform(0.3f, 1.5f), Uniform(0.3f, 2)}, 6, 0.3f);
		Section(Mesh, Stone);
		break;
	case Prop:
		Box(Mesh, {0, 0.5f, 0}, {Uniform(0.2f, 0.8f), 0.5f, Uniform(0.2f, 0.8f)});
		Ball(Mesh, {0, 1.2f, 0}, glm::vec3(0.3f), 4, 0.0f);
		Section(Mesh, Paint);
		break;
	default:
	{
		const glm::vec3 Half(Uniform(3, 8), Uniform(2, 6), Uniform(3, 8));
		Box(Mesh, {0, Half.y, 0}, Half);
		Section(Mesh, Stone);
		Box(Mesh, {0, 2 * Half.y + 0.4f, 0}, Half * glm::vec3(1.1f, 0, 1.1f) + glm::vec3(0, 0.4f, 0));
		Section(Mesh, Bark);
		for (int I = 0; I < 6; ++I) { Box(Mesh, {Uniform(-Half.x, Half.x), Uniform(1, 2 * Half.y), Half.z}, {0.5f, 0.7f, 0.1f}); }
		Section(Mesh, Paint);
	}
	}
	return Mesh;
}

int32_t FWorldMaker::AddMesh(FHostMesh Mesh)
{
	Mesh.Name = "mesh " + std::to_string(World.Scene.Meshes.size());
	Mesh.BoundsMin = Mesh.BoundsMax = Mesh.Positions.front();
	for (const glm::vec3& P : Mesh.Positions)
	{
		Mesh.BoundsMin = glm::min(Mesh.BoundsMin, P);
		Mesh.BoundsMax = glm::max(Mesh.BoundsMax, P);
	}
	std::vector<EPalette>& OfSections = Palettes.emplace_back();
	for (const FHostSection& S : Mesh.Sections) { OfSections.push_back(EPalette(std::max(0, S.Material - 1) / int32_t(PaletteSize))); }
	World.Scene.Meshes.push_back(std::move(Mesh));
	return int32_t(World.Scene.Meshes.size() - 1);
}

int32_t FWorldMaker::MakeCharacter()
{
	FHostMesh Mesh;
	for (uint32_t Joint = 0; Joint < FBenchWorld::JointCount; ++Joint)
	{
		const size_t First = Mesh.Positions.size();
		Ball(
		    Mesh, {0.12f * float(Joint % 3) - 0.12f, 1.8f * (float(Joint) + 0.5f) / FBenchWorld::JointCount, 0}, glm::vec3(0.12f), 4, 0.0f);
		for (size_t V = First; V < Mesh.Positions.size(); ++V)
		{
			const auto Next = uint16_t(std::min(Joint + 1, FBenchWorld::JointCount - 1));
			Mesh.Skin.push_back({{uint16_t(Joint), Next, 0, 0}, {0.7f, 0.3f, 0, 0}});
		}
	}
	Section(Mesh, Paint);
	return AddMesh(std::move(Mesh));
}

FHostNode& FWorldMaker::AddNode(int32_t Mesh, double Spread)
{
	FHostNode& Node = World.Scene.Nodes.emplace_back();
	Node.Mesh = Mesh;
	const float Half = float(0.5 * Spread);
	Node.Translation = {Uniform(-Half, Half), 0, Uniform(-Half, Half)};
	Node.Rotation = glm::angleAxis(Uniform(0, 6.28f), glm::vec3(0, 1, 0));
	Node.Scale = glm::vec3(Uniform(0.7f, 1.4f));
	return Node;
}

void FWorldMaker::Scatter()
{
	const uint32_t Rigid = Options.Objects - Options.Characters - 1;
	for (uint32_t I = 0; I < Rigid; ++I)
	{
		double Kind = double(I) / Rigid;
		uint32_t K = 0;
		while (K + 1 < KindCount && Kind >= Share[K]) { Kind -= Share[K++]; }
		const int32_t Mesh = Meshes[K][Below(uint32_t(Meshes[K].size()))];
		FHostNode& Node = AddNode(Mesh, Options.Extent);
		for (const EPalette Palette : Palettes[Mesh]) { Node.Materials.push_back(PickMaterial(Palette)); }
	}
	for (uint32_t I = 0; I < Options.Movers; ++I) { World.Movers.push_back(1 + uint32_t(uint64_t(I) * Rigid / Options.Movers)); }
}

FBenchWorld FWorldMaker::Make()
{
	World.Scene.Name = "bench world";
	AddMaterials();
	FHostMesh Ground;
	const float Half = float(0.5 * Options.Extent);
	Quad(Ground, {-Half, 0, Half}, {2 * Half, 0, 0}, {0, 0, -2 * Half});
	Section(Ground, Bark);
	Ground.Sections.back().Material = 0;
	World.Scene.Nodes.emplace_back().Mesh = AddMesh(std::move(Ground));
	for (uint32_t Kind = 0; Kind < KindCount; ++Kind)
	{
		for (uint32_t I = 0; I < MeshesOf[Kind]; ++I) { Meshes[Kind].push_back(AddMesh(MakeKind(EKind(Kind)))); }
	}
	Scatter();
	const int32_t Body = MakeCharacter();
	FHostSkin& Skin = World.Scene.Skins.emplace_back();
	for (uint32_t I = 0; I < Options.Characters; ++I)
	{
		World.Characters.push_back(uint32_t(World.Scene.Nodes.size()));
		FHostNode& Node = AddNode(Body, 0.2 * Options.Extent); // where the player is
		Node.Skin = 0;
		Node.Materials = {PickMaterial(Paint)};
	}
	Skin.Joints.assign(FBenchWorld::JointCount, 0);
	Skin.InverseBind.assign(FBenchWorld::JointCount, glm::mat4(1.0f));
	return std::move(World);
}
} // namespace

FBenchWorld MakeBenchWorld(const FBenchWorldOptions& Options) { return FWorldMaker(Options).Make(); }

glm::dmat4 MoveObject(const FHostNode& Node, uint32_t Index, uint32_t Frame)
{
	const double Angle = 0.01 * Frame + Index;
	glm::dmat4 Transform = glm::rotate(glm::dmat4(1.0), Angle, glm::dvec3(0, 1, 0));
	Transform = glm::scale(Transform, glm::dvec3(Node.Scale));
	Transform[3] = glm::dvec4(Node.Translation + glm::dvec3(4 * std::cos(Angle), 0, 4 * std::sin(Angle)), 1);
	return Transform;
}

std::vector<uint32_t> Repaint(const std::vector<int32_t>& Materials, uint32_t Frame)
{
	std::vector<uint32_t> Painted;
	for (const int32_t Material : Materials)
	{
		const uint32_t Palette = uint32_t(Material - 1) / PaletteSize, Old = uint32_t(Material - 1) % PaletteSize;
		Painted.push_back(1 + Palette * PaletteSize + (Old + 7 * Frame + 1) % PaletteSize);
	}
	return Painted;
}

std::vector<glm::mat4> BendCharacter(uint32_t Index, uint32_t Frame)
{
	std::vector<glm::mat4> Joints(FBenchWorld::JointCount);
	for (uint32_t Joint = 0; Joint < FBenchWorld::JointCount; ++Joint)
	{
		const float Angle = 0.3f * std::sin(0.1f * float(Frame) + 0.4f * float(Joint) + float(Index));
		Joints[Joint] = glm::rotate(glm::mat4(1.0f), Angle, glm::vec3(1, 0, 0));
	}
	return Joints;
}

} // namespace Lantern
