// FSceneLights: the constants of lights, sun and sky.
#include "LanternScene/Scene/SceneLights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace Lantern
{

void FSceneLights::SetSun(const FSunLight& InSun)
{
	Sun = InSun;
	assert(Sun.Irradiance <= 0.0f || glm::length(Sun.Direction) > 0.0);
}

void FSceneLights::FillConstants(FSceneConstants& Out) const
{
	Out.Lights = Store.GetTable().GetAddress();
	Out.LightCount = Store.GetSlotCount();
	Out.LightProfiles = Profiles.GetHeaders().GetAddress();
	Out.ProfileTexels = Profiles.GetTexels().GetAddress();
	Out.SunChannels = Sun.Channels;
	Out.SunDirection = glm::vec3(glm::normalize(Sun.Direction));
	Out.SunIrradiance = Sun.Irradiance;
	Out.SunColor = Sun.Color;
	// 1 − cos r = 2 sin²(r/2): the difference itself would lose all digits for a disk as small as the sun's.
	const double HalfSin = std::sin(0.25 * double(Sun.AngularDiameter));
	Out.SunOneMinusCos = static_cast<float>(2.0 * HalfSin * HalfSin);
	Out.SkyRadiance = HasSkyMap() ? glm::vec3(SkyMap.Intensity) : Sky;
	Out.SkyMap = SkyMap.Slot;
	Out.SkyMapKind = SkyMap.Kind;
	const glm::mat3 Rows = glm::transpose(SkyMap.WorldToMap);
	for (int Row = 0; Row < 3; ++Row) { Out.SkyMapAxes[Row] = Rows[Row]; }
}

FSkyData FSceneLights::MakeSkyData() const
{
	FSkyData Out{};
	Out.ToSun = SkyProgram->WorldToProgram * -glm::vec3(glm::normalize(Sun.Direction));
	Out.Seconds = static_cast<float>(SkyProgram->Seconds);
	Out.SunIrradiance = HasSun() ? Sun.Color * Sun.Irradiance : glm::vec3(0);
	Out.Radiance = Sky;
	std::ranges::copy(SkyProgram->Values, Out.Values);
	const glm::mat3 Rows = glm::transpose(SkyProgram->WorldToProgram);
	for (int Row = 0; Row < 3; ++Row) { Out.Axes[Row] = Rows[Row]; }
	return Out;
}

} // namespace Lantern
