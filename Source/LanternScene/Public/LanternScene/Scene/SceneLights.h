// FSceneLights keeps the sun, the sky and the punctual lights of a scene. Emissive triangles are in EmissiveTriangles.h.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Memory/GpuTable.h"
#include "SceneTypes.h"

namespace Lantern
{

/// The sun, as FSceneConstants has it but in plain units.
struct FSunLight
{
	glm::dvec3 Direction{0, -1, 0}; ///< in which the light travels; need not be of unit length
	glm::vec3 Color{1};
	float Irradiance = 0.0f;      ///< on a plane that faces the sun, lux; 0: no sun
	float AngularDiameter = 0.0f; ///< radians; 0: hard shadows
};

/// Radiance of the sky by direction, as a texture.
struct FSkyMap
{
	uint32_t Slot = NO_TEXTURE; ///< as in FMaterialData::Textures; NO_TEXTURE: the sky is uniform
	uint32_t Kind = SKY_MAP_CUBE;
	float Intensity = 1.0f; ///< nits of a texel of 1
	glm::mat3 WorldToMap{1.0f};
};

/// A punctual light in the world.
struct FSceneLight
{
	FLightData Data; ///< Position is filled in from WorldPosition
	glm::dvec3 WorldPosition{0};
};

/// Threads: one at a time.
class FSceneLights
{
public:
	void SetLights(std::vector<FSceneLight> InLights);
	const std::vector<FSceneLight>& GetLights() const { return Lights; }
	void SetSun(const FSunLight& InSun);
	const FSunLight& GetSun() const { return Sun; }
	bool HasSun() const { return Sun.Irradiance > 0.0f; }
	void SetSky(glm::vec3 Radiance) { Sky = Radiance; }
	glm::vec3 GetSky() const { return Sky; }
	/// Takes the place of the radiance of SetSky while it has a texture.
	void SetSkyMap(const FSkyMap& Map) { SkyMap = Map; }
	const FSkyMap& GetSkyMap() const { return SkyMap; }
	bool HasSkyMap() const { return SkyMap.Slot != NO_TEXTURE; }
	bool HasSky() const { return HasSkyMap() ? SkyMap.Intensity > 0.0f : glm::any(glm::greaterThan(Sky, glm::vec3(0))); }

	/// Marks the table as out of date. The lights' positions in it are relative to the scene's origin.
	void OnOriginMoved() { bStale = true; }
	/// Tells whether Update would write the table.
	bool NeedsUpdate() const { return bStale; }
	/// Writes the table if a light or the origin changed since the last call.
	void Update(const glm::dvec3& Origin);
	/// Fills the members of Out that describe lights. The table must have been flushed.
	void FillConstants(FSceneConstants& Out) const;
	TGpuTable<FLightData>& GetTable() { return Table; }

private:
	std::vector<FSceneLight> Lights;
	TGpuTable<FLightData> Table{"Lights"};
	FSunLight Sun;
	glm::vec3 Sky{0};
	FSkyMap SkyMap;
	bool bStale = true;
};

} // namespace Lantern
