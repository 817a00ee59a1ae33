// A building of 15 × 15 rooms with columns and crates, and up to 10,000 coloured lamps of finite range.
#include "Builtin/Lamps.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"

namespace Lantern::Builtin
{

namespace
{
constexpr int Rooms = 15;         // along each side
constexpr float RoomSize = 16.0f; // metres
constexpr float Height = 5.0f;    // metres
constexpr float HalfDoor = 2.5f;  // metres
constexpr float HalfSide = 0.5f * RoomSize * float(Rooms);
constexpr int LampsPerSide = 100;
constexpr float HalfRoom = 0.5f * RoomSize; // the room in the picture reaches so far to each side

/// Walls between rooms, each with a door in its middle.
void AddWalls(FSceneBuilder& Builder, int32_t Material)
{
	FMeshBuilder Mesh("walls");
	Mesh.BeginSection(Material);
	for (int Line = 1; Line < Rooms; ++Line)
	{
		const float At = -HalfSide + RoomSize * float(Line);
		for (int Room = 0; Room < Rooms; ++Room)
		{
			const float Begin = -HalfSide + RoomSize * float(Room), Middle = Begin + 0.5f * RoomSize, End = Begin + RoomSize;
			for (const auto& [From, To, Bottom] : {std::tuple(Begin, Middle - HalfDoor, 0.0f), std::tuple(Middle + HalfDoor, End, 0.0f),
			         std::tuple(Middle - HalfDoor, Middle + HalfDoor, 3.5f)})
			{
				Mesh.AddBox({At - 0.15f, Bottom, From}, {At + 0.15f, Height, To});
				Mesh.AddBox({From, Bottom, At - 0.15f}, {To, Height, At + 0.15f});
			}
		}
	}
	Builder.AddNode("walls", Builder.AddMesh(Mesh));
}

/// Four columns in each room.
void AddColumns(FSceneBuilder& Builder, int32_t Material)
{
	FMeshBuilder Mesh("columns");
	Mesh.BeginSection(Material);
	for (int I = 0; I < 4 * Rooms * Rooms; ++I)
	{
		const glm::vec3 At(-HalfSide + 4.0f + 8.0f * float(I % (2 * Rooms)), 0, -HalfSide + 4.0f + 8.0f * float(I / (2 * Rooms)));
		Mesh.AddBeveledBox(At - glm::vec3(0.3f, 0, 0.3f), At + glm::vec3(0.3f, Height, 0.3f), 0.08f);
	}
	Builder.AddNode("columns", Builder.AddMesh(Mesh));
}

/// Crates that stand about, never in a door.
void AddCrates(FSceneBuilder& Builder, int32_t Material)
{
	FMeshBuilder Mesh("crates");
	Mesh.BeginSection(Material);
	FRandomStream Random(7);
	for (int Room = 0; Room < Rooms * Rooms; ++Room)
	{
		const glm::vec3 Corner(-HalfSide + RoomSize * float(Room % Rooms), 0, -HalfSide + RoomSize * float(Room / Rooms));
		for (int I = 0; I < 8; ++I)
		{
			const float Size = Random.Between(0.5f, 1.4f);
			const glm::vec3 At = Corner + glm::vec3(Random.Between(1.5f, 5.0f) + (I % 2 ? 8.5f : 0.0f), 0,
			                                  Random.Between(1.5f, 5.0f) + (I / 2 % 2 ? 8.5f : 0.0f));
			Mesh.AddBeveledBox(At, At + glm::vec3(Size, Size * Random.Between(0.6f, 1.6f), Size), 0.03f);
		}
	}
	Builder.AddNode("crates", Builder.AddMesh(Mesh));
}

/// Three of five lamps are points, one is a spot that looks down, and one is one of the four kinds with an extent.
void AddLamp(FSceneBuilder& Builder, uint32_t Index, const glm::vec3& At, FRandomStream& Random)
{
	const glm::vec3 Color(Random.Between(0.15f, 1.0f), Random.Between(0.15f, 1.0f), Random.Between(0.15f, 1.0f));
	const float Range = Random.Between(3.5f, 5.5f), Turn = Random.Between(0.0f, 2.0f * glm::pi<float>()),
	            Tilt = Random.Between(-0.5f, 0.5f);
	const int32_t Node = Builder.AddPointLight("lamp", At, 3.0f * Color, Range);
	FHostLight& Light = Builder.Scene.Lights.back();
	const glm::quat Down = glm::angleAxis(-glm::half_pi<float>() + Tilt, glm::vec3(1, 0, 0));
	Builder.Scene.Nodes[size_t(Node)].Rotation = glm::angleAxis(Turn, glm::vec3(0, 1, 0)) * Down;
	if (Index % 5 == 3)
	{
		Light.InnerCone = 0.4f;
		Light.OuterCone = 0.8f;
		Light.Color *= 3.0f;
	}
	if (Index % 5 != 4) { return; }
	// About as bright as a point: candela divided by the area that is seen.
	constexpr uint32_t Types[] = {LIGHT_RECTANGLE, LIGHT_DISK, LIGHT_SPHERE, LIGHT_TUBE};
	constexpr glm::vec2 Sizes[] = {{0.6f, 0.3f}, {0.25f, 0.0f}, {0.15f, 0.0f}, {0.05f, 1.0f}};
	constexpr float Areas[] = {0.18f, 0.196f, 0.0707f, 0.108f};
	const uint32_t Kind = Index / 5 % 4;
	Light.Type = Types[Kind];
	Light.Size = Sizes[Kind];
	Light.Color *= 2.0f / Areas[Kind];
	Light.bTwoSided = Index % 3 == 0;
}

void AddLamps(FSceneBuilder& Builder, uint32_t Count)
{
	constexpr float Step = 2.0f * HalfSide / float(LampsPerSide);
	FRandomStream Random(640);
	std::vector<glm::vec3> Places;
	for (int I = 0; I < LampsPerSide * LampsPerSide; ++I)
	{
		const glm::vec3 Jitter(Random.Between(-0.5f, 0.5f), Random.Between(0.4f, Height - 0.4f), Random.Between(-0.5f, 0.5f));
		Places.push_back(
		    glm::vec3(Step * (float(I % LampsPerSide) + 0.5f) - HalfSide, 0, Step * (float(I / LampsPerSide) + 0.5f) - HalfSide) + Jitter);
	}
	const auto GetDistance = [](const glm::vec3& Place) {
		const float X = std::max(std::abs(Place.x) - HalfRoom, 0.0f), Z = std::max(std::abs(Place.z) - HalfRoom, 0.0f);
		return X * X + Z * Z;
	};
	const auto IsNearer = [&](const glm::vec3& A, const glm::vec3& B) { return GetDistance(A) < GetDistance(B); };
	std::stable_sort(Places.begin(), Places.end(), IsNearer);
	for (uint32_t Index = 0; Index < std::min<size_t>(Count, Places.size()); ++Index) { AddLamp(Builder, Index, Places[Index], Random); }
}
} // namespace

FSceneDescription BuildLamps(uint32_t Count)
{
	FSceneBuilder Builder("lamps");
	AddRoom(Builder, AddPaint(Builder, "shell", glm::vec3(0.5f), 0.35f), {-HalfSide, 0, -HalfSide}, {HalfSide, Height, HalfSide});
	AddWalls(Builder, AddPaint(Builder, "wall", glm::vec3(0.6f, 0.57f, 0.52f), 0.7f));
	AddColumns(Builder, AddPaint(Builder, "column", glm::vec3(0.55f), 0.3f));
	AddCrates(Builder, AddPaint(Builder, "crate", glm::vec3(0.45f, 0.33f, 0.2f), 0.6f));
	AddLamps(Builder, Count);
	Builder.AddCamera({7.2, 2.2, 1.4}, {-6.0, 1.0, -2.4}, 70);
	SetDarkness(Builder, 0.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
