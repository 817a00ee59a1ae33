// FSceneLights keeps the sun, the sky and the other lights of a scene. Emissive triangles are in EmissiveTriangles.h.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "LanternScene/Lights/LightProfiles.h"
#include "LanternScene/Lights/LightStore.h"
#include "SceneTypes.h"
#include "SkyTypes.h"

namespace Lantern
{

/// The sun, as FSceneConstants has it but in plain units.
struct FSunLight
{
	glm::dvec3 Direction{0, -1, 0}; ///< in which the light travels; need not be of unit length
	glm::vec3 Color{1};
	float Irradiance = 0.0f;             ///< on a plane that faces the sun, lux; 0: no sun
	float AngularDiameter = 0.0f;        ///< radians; 0: hard shadows
	uint8_t Channels = CHANNELS_DEFAULT; ///< as FSceneLight::Channels
};

/// Radiance of the sky by direction, as a texture.
struct FSkyMap
{
	uint32_t Slot = NO_TEXTURE; ///< as in FMaterialData::Textures; NO_TEXTURE: the sky is uniform
	uint32_t Kind = SKY_MAP_CUBE;
	float Intensity = 1.0f; ///< nits of a texel of 1
	glm::mat3 WorldToMap{1.0f};
};

/// Radiance of the sky by direction, as a program: Shaders/Sky/SkyProgram.glsl, or a host's own in its place. It reads the scene's sun too.
struct FSkyProgram
{
	double Seconds = 0.0; ///< moves clouds; finite
	std::array<glm::vec4, SKY_PROGRAM_VALUES> Values{};
	glm::mat3 WorldToProgram{1.0f}; ///< a rotation, mirrored or not
	friend bool operator==(const FSkyProgram&, const FSkyProgram&) = default;
};

/// Threads: one at a time.
class FSceneLights
{
public:
	FLightStore& GetStore() { return Store; }
	const FLightStore& GetStore() const { return Store; }
	FLightProfiles& GetProfiles() { return Profiles; }
	const FLightProfiles& GetProfiles() const { return Profiles; }
	void SetSun(const FSunLight& InSun);
	const FSunLight& GetSun() const { return Sun; }
	bool HasSun() const { return Sun.Irradiance > 0.0f; }
	void SetSky(glm::vec3 Radiance) { Sky = Radiance; }
	glm::vec3 GetSky() const { return Sky; }
	/// Takes the place of the radiance of SetSky while it has a texture.
	void SetSkyMap(const FSkyMap& Map) { SkyMap = Map; }
	const FSkyMap& GetSkyMap() const { return SkyMap; }
	bool HasSkyMap() const { return SkyMap.Slot != NO_TEXTURE; }
	/// Takes the place of the map. The radiance of SetSky then says how bright the program's sky is.
	void SetSkyProgram(const std::optional<FSkyProgram>& InProgram) { SkyProgram = InProgram; }
	const std::optional<FSkyProgram>& GetSkyProgram() const { return SkyProgram; }
	/// Returns what the program gets. There is one.
	FSkyData MakeSkyData() const;
	bool HasSky() const { return SkyProgram || (HasSkyMap() ? SkyMap.Intensity > 0.0f : glm::any(glm::greaterThan(Sky, glm::vec3(0)))); }

	/// Fills the members of Out that describe lights. The table must have been flushed.
	void FillConstants(FSceneConstants& Out) const;

private:
	FLightStore Store;
	FLightProfiles Profiles;
	FSunLight Sun;
	glm::vec3 Sky{0};
	FSkyMap SkyMap;
	std::optional<FSkyProgram> SkyProgram;
};

} // namespace Lantern
