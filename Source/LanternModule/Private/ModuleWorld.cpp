// The engine's axes and unit.
#include "ModuleWorld.h"

#include <cassert>
#include <cmath>
#include <cstring>

#include "LanternScene/Scene/TextureSlot.h"

namespace Lantern
{

namespace
{
glm::dvec3 ToVector(const float Axis[3]) { return {Axis[0], Axis[1], Axis[2]}; }
} // namespace

FModuleWorld::FModuleWorld(const FRTModuleRendererDesc& Desc)
    : Axes(ToVector(Desc.AxisX), ToVector(Desc.AxisY), ToVector(Desc.AxisZ)),
      // What a float makes of 0.01 is off by 2e-10: 0.2 mm in 1,000 km.
      MetersPerUnit(std::round(double(Desc.MetersPerUnit) * 1e9) * 1e-9),
      bOwnSky(Desc.SkyShader != nullptr)
{
	if (!(MetersPerUnit > 0.0)) { MetersPerUnit = double(Desc.MetersPerUnit); }
}

glm::dmat4 FModuleWorld::ToTransform(const double Rows[12]) const
{
	glm::dmat4 Matrix(1.0);
	for (int Column = 0; Column < 4; ++Column)
	{
		const double Engine[3] = {Rows[Column], Rows[4 + Column], Rows[8 + Column]};
		Matrix[Column] = glm::dvec4(ToPosition(Engine), Matrix[Column].w);
	}
	return Matrix;
}

glm::dvec3 FModuleWorld::ToPosition(const double Position[3]) const
{
	return Axes * (glm::dvec3(Position[0], Position[1], Position[2]) * MetersPerUnit);
}

FSkyMap FModuleWorld::ToSkyMap(const FRTModuleSkyMap& Map) const
{
	FSkyMap Out;
	[[maybe_unused]] const bool bFits = MakeTextureSlot(Map.Texture->GetSampledIndex(), Map.Sampler->GetIndex(), Out.Slot);
	assert(bFits && "CheckSkyMap has seen to it");
	static_assert(uint32_t(ERTModuleSkyMap::Cube) == SKY_MAP_CUBE && uint32_t(ERTModuleSkyMap::Octahedral) == SKY_MAP_OCTAHEDRAL);
	Out.Kind = static_cast<uint32_t>(Map.Kind);
	Out.Intensity = Map.Intensity;
	glm::dmat3 EngineToMap;
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Column = 0; Column < 3; ++Column) { EngineToMap[Column][Row] = double(Map.WorldToMap[3 * Row + Column]); }
	}
	Out.WorldToMap = glm::mat3(EngineToMap * glm::transpose(Axes)); // the axes' inverse: they are perpendicular
	return Out;
}

FSkyProgram FModuleWorld::ToSkyProgram(const FRTModuleSkyProgram& Program) const
{
	FSkyProgram Out;
	Out.Seconds = Program.Seconds;
	static_assert(sizeof(Out.Values) == sizeof(Program.Values));
	std::memcpy(Out.Values.data(), Program.Values, sizeof(Program.Values));
	if (bOwnSky) { Out.WorldToProgram = glm::mat3(glm::transpose(Axes)); } // the plugin's own sky has y up, as Lantern's world
	return Out;
}

FRTStatus CheckWorld(const FRTModuleRendererDesc& Desc)
{
	constexpr double Tolerance = 1e-4;
	const glm::dvec3 Axes[3] = {ToVector(Desc.AxisX), ToVector(Desc.AxisY), ToVector(Desc.AxisZ)};
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		const char Name = static_cast<char>('X' + Axis);
		if (!(std::abs(glm::length(Axes[Axis]) - 1.0) < Tolerance))
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleRendererDesc::Axis%c must be of unit length, is of %g", Name,
			    glm::length(Axes[Axis]));
		}
		const int Next = (Axis + 1) % 3;
		if (!(std::abs(glm::dot(Axes[Axis], Axes[Next])) < Tolerance))
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleRendererDesc::Axis%c and Axis%c must be perpendicular", Name,
			    static_cast<char>('X' + Next));
		}
	}
	if (!(Desc.MetersPerUnit > 0.0f) || !std::isfinite(Desc.MetersPerUnit))
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleRendererDesc::MetersPerUnit must be positive and finite, is %g",
		    double(Desc.MetersPerUnit));
	}
	return FRTStatus::Success();
}

} // namespace Lantern
