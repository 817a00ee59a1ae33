// From the engine's world to Lantern's: metres, right-handed, y up. Everything that crosses the interface goes through here.
#pragma once

#include <glm/glm.hpp>

#include "LanternModule/Module.h"
#include "LanternScene/Scene/SceneLights.h"

namespace Lantern
{

class FModuleWorld
{
public:
	FModuleWorld() = default;
	/// Desc has passed CheckWorld.
	explicit FModuleWorld(const FRTModuleRendererDesc& Desc);

	/// Object to world, 3 rows of 4, the last column being the translation. Object space stays the engine's.
	glm::dmat4 ToTransform(const double Rows[12]) const;
	glm::dvec3 ToPosition(const double Position[3]) const;
	/// The length stays.
	glm::dvec3 ToDirection(const double Direction[3]) const { return Axes * glm::dvec3(Direction[0], Direction[1], Direction[2]); }
	glm::dvec3 ToDirection(const float Direction[3]) const { return Axes * glm::dvec3(Direction[0], Direction[1], Direction[2]); }
	/// Map: checked.
	FSkyMap ToSkyMap(const FRTModuleSkyMap& Map) const;
	/// Program: checked.
	FSkyProgram ToSkyProgram(const FRTModuleSkyProgram& Program) const;
	double ToMeters(double Length) const { return Length * MetersPerUnit; }
	double GetMetersPerUnit() const { return MetersPerUnit; }
	/// Columns: the engine's axes.
	const glm::dmat3& GetAxes() const { return Axes; }

private:
	glm::dmat3 Axes{1.0};
	double MetersPerUnit = 1.0;
	bool bOwnSky = false; ///< FRTModuleRendererDesc::SkyShader is the engine's
};

/// Ok, or InvalidArgument, which names the member.
FRTStatus CheckWorld(const FRTModuleRendererDesc& Desc);

} // namespace Lantern
