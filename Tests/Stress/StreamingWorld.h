// A world that streams: tiles of objects come and go around a camera that flies over 32 × 32 km. Each tile has meshes
// and materials of its own, which go with it, so that whatever is not given back grows without bound.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "LanternHost/SampleEngine.h"
#include "LanternScene/Memory/Upload.h"

namespace Lantern
{

struct FStreamingSettings
{
	double TileSize = 256.0; ///< metres
	double Radius = 700.0;   ///< tiles nearer than this are loaded
	uint32_t ObjectsPerTile = 12;
	uint32_t MeshesPerTile = 3;
	uint32_t Seed = 1;
};

class FStreamingWorld
{
public:
	FStreamingWorld(IRTDevice& InDevice, FRTScene& InScene, const FStreamingSettings& InSettings);
	/// Loads and drops what a camera at Camera calls for. An error leaves the world as far as it came; call it again.
	FRTStatus MoveTo(glm::dvec3 Camera);
	/// Drops all that MoveTo would not load: what is left does not depend on the way here.
	void Trim(glm::dvec3 Camera) { DropBeyond(Camera, Settings.Radius); }
	/// Where the flight is after Seconds at 200 m/s: to and fro over the whole world.
	static glm::dvec3 FlightAt(double Seconds);

	uint32_t GetObjectCount() const;
	uint64_t GetTilesLoaded() const { return TilesLoaded; } ///< ever

private:
	using FTileKey = std::pair<int, int>;
	struct FTile
	{
		std::vector<FRTObjectId> Objects;
		std::vector<uint32_t> Materials;
	};
	FRTStatus Load(FTileKey Key);
	void Drop(FTile& Tile);
	void DropBeyond(glm::dvec3 Camera, double Limit);
	double GetDistance(FTileKey Key, glm::dvec3 Camera) const; ///< of its centre, on the ground
	FRTStatus CreateMesh(uint32_t Seed, FRTGeometryRef& Out);

	FRTScene& Scene;
	FStreamingSettings Settings;
	FUploader Uploader;
	std::map<FTileKey, FTile> Tiles;
	uint64_t TilesLoaded = 0;
};

} // namespace Lantern
