#include "StreamingWorld.h"

#include <cmath>
#include <random>

namespace Lantern
{

namespace
{
constexpr double HalfWorld = 16'000.0; // metres
constexpr double Speed = 200.0;        // metres per second

/// A point that runs to and fro over [−HalfWorld, HalfWorld].
double Bounce(double Way)
{
	const double Phase = std::fmod(Way, 4.0 * HalfWorld);
	return Phase < 2.0 * HalfWorld ? Phase - HalfWorld : 3.0 * HalfWorld - Phase;
}

uint32_t TileSeed(uint32_t Seed, int X, int Z)
{
	return Seed * 2654435761u ^ static_cast<uint32_t>(X) * 73856093u ^ static_cast<uint32_t>(Z) * 19349663u;
}
} // namespace

FStreamingWorld::FStreamingWorld(IRTDevice& InDevice, FRTScene& InScene, const FStreamingSettings& InSettings)
    : Scene(InScene),
      Settings(InSettings),
      Uploader(InDevice)
{}

glm::dvec3 FStreamingWorld::FlightAt(double Seconds)
{
	// Two directions whose ratio is not a simple fraction, so that the flight soon has been everywhere.
	const double Way = Speed * Seconds;
	return {Bounce(HalfWorld + 0.8 * Way), 60.0, Bounce(HalfWorld + 0.6 * 0.9137 * Way)};
}

uint32_t FStreamingWorld::GetObjectCount() const
{
	size_t Count = 0;
	for (const auto& [Key, Tile] : Tiles) { Count += Tile.Objects.size(); }
	return static_cast<uint32_t>(Count);
}

double FStreamingWorld::GetDistance(FTileKey Key, glm::dvec3 Camera) const
{
	return std::hypot((Key.first + 0.5) * Settings.TileSize - Camera.x, (Key.second + 0.5) * Settings.TileSize - Camera.z);
}

void FStreamingWorld::DropBeyond(glm::dvec3 Camera, double Limit)
{
	for (auto It = Tiles.begin(); It != Tiles.end();)
	{
		if (GetDistance(It->first, Camera) <= Limit)
		{
			++It;
			continue;
		}
		Drop(It->second);
		It = Tiles.erase(It);
	}
}

FRTStatus FStreamingWorld::MoveTo(glm::dvec3 Camera)
{
	// What is dropped lies farther out than what is loaded, or a camera at the border would load and drop for ever.
	DropBeyond(Camera, Settings.Radius + Settings.TileSize);
	const int Reach = static_cast<int>(std::ceil(Settings.Radius / Settings.TileSize)) + 1;
	const int CenterX = static_cast<int>(std::floor(Camera.x / Settings.TileSize));
	const int CenterZ = static_cast<int>(std::floor(Camera.z / Settings.TileSize));
	for (int X = CenterX - Reach; X <= CenterX + Reach; ++X)
	{
		for (int Z = CenterZ - Reach; Z <= CenterZ + Reach; ++Z)
		{
			if (GetDistance({X, Z}, Camera) > Settings.Radius || Tiles.count({X, Z})) { continue; }
			if (FRTStatus S = Load({X, Z}); !S) { return S; }
		}
	}
	return Uploader.Flush();
}

FRTStatus FStreamingWorld::CreateMesh(uint32_t Seed, FRTGeometryRef& Out)
{
	// A crown of triangles around an axis: as many as the seed says.
	const uint32_t Triangles = 8 + Seed % 57;
	std::vector<glm::vec3> Positions;
	std::vector<FVertexAttributes> Attributes(3 * Triangles);
	std::vector<uint32_t> Indices;
	for (uint32_t Triangle = 0; Triangle < Triangles; ++Triangle)
	{
		const float Angle = 6.2831853f * static_cast<float>(Triangle) / static_cast<float>(Triangles);
		const glm::vec3 Foot(std::cos(Angle), 0.0f, std::sin(Angle));
		Positions.insert(Positions.end(), {Foot, Foot * 2.0f, Foot + glm::vec3(0, 2, 0)});
		for (uint32_t Corner = 0; Corner < 3; ++Corner) { Indices.push_back(3 * Triangle + Corner); }
	}
	FRTGeometryInfo Info;
	Info.Name = "Mesh" + std::to_string(Seed);
	Info.VertexCount = static_cast<uint32_t>(Positions.size());
	Info.Sections = {{0, static_cast<uint32_t>(Indices.size()), false}};
	Info.BoundsCenter = {0, 1, 0};
	Info.BoundsRadius = 2.3f;
	const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput | ERTBufferUsage::Index;
	if (FRTStatus S = Uploader.CreateBuffer("Positions", Usage, Positions.data(), Positions.size() * sizeof(Positions[0]), Info.Positions);
	    !S)
	{
		return S;
	}
	if (FRTStatus S =
	        Uploader.CreateBuffer("Attributes", Usage, Attributes.data(), Attributes.size() * sizeof(Attributes[0]), Info.Attributes);
	    !S)
	{
		return S;
	}
	if (FRTStatus S = Uploader.CreateBuffer("Indices", Usage, Indices.data(), Indices.size() * sizeof(Indices[0]), Info.Indices); !S)
	{
		return S;
	}
	return Scene.CreateGeometry(std::move(Info), Out);
}

FRTStatus FStreamingWorld::Load(FTileKey Key)
{
	std::minstd_rand Random(TileSeed(Settings.Seed, Key.first, Key.second) | 1u);
	const auto Uniform = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(Random); };
	std::vector<FRTGeometryRef> Meshes(Settings.MeshesPerTile);
	for (FRTGeometryRef& Mesh : Meshes)
	{
		if (FRTStatus S = CreateMesh(static_cast<uint32_t>(Random()), Mesh); !S) { return S; }
	}
	FTile& Tile = Tiles[Key];
	++TilesLoaded;
	for (uint32_t Material = 0; Material < 2; ++Material)
	{
		FMaterialData Data{};
		Data.BaseColor = glm::vec4(Uniform(), Uniform(), Uniform(), 1);
		std::fill(std::begin(Data.Textures), std::end(Data.Textures), NO_TEXTURE);
		Data.Flags = Material ? MATERIAL_MASKED | MATERIAL_DOUBLE_SIDED : 0u;
		Data.AlphaCutoff = 0.5f;
		Tile.Materials.push_back(Scene.AddMaterial(Data));
	}
	for (uint32_t Object = 0; Object < Settings.ObjectsPerTile; ++Object)
	{
		FRTObjectInfo Info;
		Info.Geometry = Meshes[Object % Meshes.size()];
		Info.Materials = {Tile.Materials[Object % 2]};
		Info.Transform[3] = glm::dvec4((Key.first + Uniform()) * Settings.TileSize, 0.0, (Key.second + Uniform()) * Settings.TileSize, 1.0);
		Tile.Objects.push_back(Scene.AddObject(std::move(Info)));
	}
	return FRTStatus::Success();
}

void FStreamingWorld::Drop(FTile& Tile)
{
	for (const FRTObjectId Object : Tile.Objects) { Scene.RemoveObject(Object); }
	for (const uint32_t Material : Tile.Materials) { Scene.RemoveMaterial(Material); }
}

} // namespace Lantern
