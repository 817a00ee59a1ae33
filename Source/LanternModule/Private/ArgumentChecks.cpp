// Checks of what an engine hands to the module.
#include "ArgumentChecks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "LanternScene/Scene/TextureSlot.h"

namespace Lantern
{

namespace
{

template <class T>
bool AreFinite(const T* Values, size_t Count)
{
	return std::all_of(Values, Values + Count, [](T Value) { return std::isfinite(Value); });
}

FRTStatus CheckMap(const FRTModuleMap& Map, const char* Name)
{
	uint32_t Slot = NO_TEXTURE;
	const auto Fail = [&](const char* Reason) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleMaterial::%s %s", Name, Reason);
	};
	if (Map.Texture == nullptr) { return FRTStatus::Success(); }
	if (Map.Texture->GetSampledIndex() == ~0u) { return Fail("has a texture that was created without Sampled"); }
	if (Map.Sampler == nullptr) { return Fail("needs a sampler"); }
	if (!MakeTextureSlot(Map.Texture->GetSampledIndex(), Map.Sampler->GetIndex(), Slot))
	{
		return Fail("has a texture or a sampler with an index that materials have no room for");
	}
	if (Map.UVSet > 1) { return Fail("has another UVSet than 0 and 1"); }
	const bool bFinite = AreFinite(Map.UVMatrix, 4) && AreFinite(Map.UVOffset, 2);
	return bFinite ? FRTStatus::Success() : Fail("has a UVMatrix or UVOffset that is not finite");
}

} // namespace

FRTStatus CheckSky(const float Radiance[3])
{
	const bool bGood =
	    Radiance != nullptr && AreFinite(Radiance, 3) && std::all_of(Radiance, Radiance + 3, [](float C) { return C >= 0.0f; });
	return bGood ? FRTStatus::Success() : Refuse("the sky's radiance must be finite and not negative");
}

FRTStatus CheckSkyProgram(const FRTModuleSkyProgram& Program)
{
	constexpr double MostSeconds = 1.0e7; // of a float: steps of one second there
	if (!(std::abs(Program.Seconds) <= MostSeconds)) { return Refuse("FRTModuleSkyProgram::Seconds must be from -1e7 to 1e7: wrap it"); }
	const bool bFinite = AreFinite(Program.Values, std::size(Program.Values));
	return bFinite ? FRTStatus::Success() : Refuse("FRTModuleSkyProgram::Values has a number that is not finite");
}

FRTStatus CheckSkyMap(const FRTModuleSkyMap& Map)
{
	uint32_t Slot = NO_TEXTURE;
	if (Map.Texture == nullptr) { return Refuse("FRTModuleSkyMap::Texture is null"); }
	if (Map.Texture->GetSampledIndex() == ~0u) { return Refuse("FRTModuleSkyMap::Texture was created without Sampled"); }
	if (Map.Sampler == nullptr) { return Refuse("FRTModuleSkyMap::Sampler is null"); }
	if (!MakeTextureSlot(Map.Texture->GetSampledIndex(), Map.Sampler->GetIndex(), Slot))
	{
		return Refuse("FRTModuleSkyMap::Texture or Sampler has an index that there is no room for");
	}
	if (Map.Kind > ERTModuleSkyMap::Octahedral) { return Refuse("FRTModuleSkyMap::Kind is none"); }
	const FRTTextureDesc& Desc = Map.Texture->GetDesc();
	if (Desc.bCube != (Map.Kind == ERTModuleSkyMap::Cube)) { return Refuse("FRTModuleSkyMap::Kind does not fit FRTTextureDesc::bCube"); }
	if (Desc.Width != Desc.Height || (!Desc.bCube && Desc.ArraySize != 1))
	{
		return Refuse("FRTModuleSkyMap::Texture is not square, or is an array");
	}
	if (!(Map.Intensity >= 0.0f) || !std::isfinite(Map.Intensity)) { return Refuse("FRTModuleSkyMap::Intensity must be finite, ≥ 0"); }
	constexpr float Tolerance = 1e-3f;
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Other = Row; Other < 3; ++Other)
		{
			const float* const A = Map.WorldToMap + 3 * Row;
			const float* const B = Map.WorldToMap + 3 * Other;
			const float Dot = A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
			if (!(std::abs(Dot - (Row == Other ? 1.0f : 0.0f)) < Tolerance))
			{
				return Refuse("FRTModuleSkyMap::WorldToMap is no rotation");
			}
		}
	}
	return FRTStatus::Success();
}

FRTStatus CheckSun(const FRTModuleSun& Sun)
{
	const double Length = length(glm::dvec3(Sun.Direction[0], Sun.Direction[1], Sun.Direction[2]));
	if (!(Length > 0.0) || !std::isfinite(Length) || !AreFinite(Sun.Color, 3))
	{
		return Refuse("FRTModuleSun::Direction is zero, or Direction or Color is not finite");
	}
	if (!(Sun.Irradiance >= 0.0f) || !std::isfinite(Sun.Irradiance))
	{
		return Refuse("FRTModuleSun::Irradiance must be finite and not negative");
	}
	if (!(Sun.AngularDiameter >= 0.0f && Sun.AngularDiameter <= glm::pi<float>()))
	{
		return Refuse("FRTModuleSun::AngularDiameter must lie between 0 and pi (radians)");
	}
	return FRTStatus::Success();
}

bool HasCone(const FRTModuleLight& Light)
{
	return Light.Type == ERTModuleLight::Spot || (Light.Type >= ERTModuleLight::Rectangle && Light.bCone);
}

bool NeedsDirection(const FRTModuleLight& Light)
{
	return Light.Type == ERTModuleLight::Directional || Light.Type == ERTModuleLight::Rectangle || Light.Type == ERTModuleLight::Disk ||
	       HasCone(Light) || Light.Ies != ERTIesHandle::None;
}

bool NeedsTangent(const FRTModuleLight& Light)
{
	return Light.Type == ERTModuleLight::Rectangle || Light.Type == ERTModuleLight::Tube || Light.Ies != ERTIesHandle::None;
}

namespace
{
FRTStatus CheckLightAxes(const FRTModuleLight& Light)
{
	const glm::dvec3 Direction(Light.Direction[0], Light.Direction[1], Light.Direction[2]);
	const glm::dvec3 Tangent(Light.Tangent[0], Light.Tangent[1], Light.Tangent[2]);
	const auto IsAxis = [](const glm::dvec3& Axis) { return length(Axis) > 0.0 && std::isfinite(length(Axis)); };
	if (NeedsDirection(Light) && !IsAxis(Direction)) { return Refuse("FRTModuleLight::Direction is zero or not finite"); }
	if (!NeedsTangent(Light)) { return FRTStatus::Success(); }
	if (!IsAxis(Tangent)) { return Refuse("FRTModuleLight::Tangent is zero or not finite"); }
	const bool bAlong = Light.Type == ERTModuleLight::Rectangle && length(cross(normalize(Direction), normalize(Tangent))) < 1e-3;
	return bAlong ? Refuse("FRTModuleLight::Tangent is along Direction") : FRTStatus::Success();
}

FRTStatus CheckLightSize(const FRTModuleLight& Light)
{
	struct FMember
	{
		const char* Name;
		float Value;
		bool bCounts;
	};
	constexpr float MostLength = 1e9f; // its square and the next ones are numbers
	const bool bRectangle = Light.Type == ERTModuleLight::Rectangle;
	const FMember Members[] = {{"Width", Light.Width, bRectangle}, {"Height", Light.Height, bRectangle},
	    {"Radius", Light.Radius, Light.Type > ERTModuleLight::Rectangle}};
	for (const FMember& Member : Members)
	{
		if (!Member.bCounts || (Member.Value > 0.0f && Member.Value <= MostLength)) { continue; }
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleLight::%s must be above 0 and at most 1e9, is %g", Member.Name, double(Member.Value));
	}
	if (Light.Type == ERTModuleLight::Tube && !(Light.Length >= 0.0f && Light.Length <= MostLength))
	{
		return Refuse("FRTModuleLight::Length must lie between 0 and 1e9");
	}
	const bool bAngle = Light.AngularDiameter >= 0.0f && Light.AngularDiameter <= glm::pi<float>();
	if (Light.Type == ERTModuleLight::Directional && !bAngle)
	{
		return Refuse("FRTModuleLight::AngularDiameter must lie between 0 and pi (radians)");
	}
	return FRTStatus::Success();
}
} // namespace

FRTStatus CheckLight(const FRTModuleLight& Light)
{
	constexpr float MostColor = 1e20f; // divided by the square of the least distance, and reflected: still a number
	if (Light.Type > ERTModuleLight::Tube) { return Refuse("FRTModuleLight::Type is none"); }
	if (Light.Ies != ERTIesHandle::None && Light.Type > ERTModuleLight::Spot)
	{
		return Refuse("FRTModuleLight::Ies is for points and spots");
	}
	const bool bPlace = std::all_of(Light.Position, Light.Position + 3, [](double P) { return std::abs(P) <= 1e12; });
	if (Light.Type != ERTModuleLight::Directional && !bPlace) { return Refuse("FRTModuleLight::Position must lie within 1e12"); }
	if (!std::all_of(Light.Color, Light.Color + 3, [](float C) { return C >= 0.0f && C <= MostColor; }))
	{
		return Refuse("FRTModuleLight::Color must lie between 0 and 1e20");
	}
	if (!(Light.Range >= 0.0f) || !std::isfinite(Light.Range)) { return Refuse("FRTModuleLight::Range must be finite and not negative"); }
	const bool bCones = Light.InnerCone >= 0.0f && Light.InnerCone < Light.OuterCone && Light.OuterCone <= glm::half_pi<float>();
	if (HasCone(Light) && !bCones) { return Refuse("FRTModuleLight: 0 ≤ InnerCone < OuterCone ≤ pi/2 does not hold"); }
	if (const FRTStatus Status = CheckLightAxes(Light); !Status) { return Status; }
	return CheckLightSize(Light);
}

FRTStatus CheckToon(const FRTModuleToon* Toon)
{
	if (Toon == nullptr) { return FRTStatus::Success(); }
	if (!std::all_of(Toon->Center, Toon->Center + 3, [](float V) { return std::isfinite(V); }))
	{
		return Refuse("FRTModuleToon::Center must be finite");
	}
	if (!(Toon->MaxValue >= 0.0f) || !std::isfinite(Toon->MaxValue))
	{
		return Refuse("FRTModuleToon::MaxValue must be finite and not negative");
	}
	const std::pair<float, const char*> Shares[] = {
	    {Toon->SphereWeight, "SphereWeight"}, {Toon->Bend, "Bend"}, {Toon->MaxSaturation, "MaxSaturation"}, {Toon->Occlusion, "Occlusion"}};
	for (const auto& [Value, Name] : Shares)
	{
		if (!(Value >= 0.0f && Value <= 1.0f))
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleToon::%s must lie between 0 and 1, is %g", Name, double(Value));
		}
	}
	const bool bColor = std::all_of(Toon->Tint, Toon->Tint + 3, [](float C) { return C >= 0.0f && std::isfinite(C); });
	if (!bColor || Toon->Tint[0] + Toon->Tint[1] + Toon->Tint[2] <= 0.0f)
	{
		return Refuse("FRTModuleToon::Tint must be finite, not negative and not black");
	}
	return FRTStatus::Success();
}

FRTStatus CheckTransform(const double Transform[12])
{
	return Transform != nullptr && AreFinite(Transform, 12) ? FRTStatus::Success() : Refuse("an object's transform is null or not finite");
}

std::array<const FRTModuleMap*, MaterialMapCount> GetMaps(const FRTModuleMaterial& Material)
{
	return {&Material.BaseColorMap, &Material.MetallicRoughnessMap, &Material.NormalMap, &Material.OcclusionMap, &Material.EmissiveMap,
	    &Material.TransmissionMap, &Material.DiffuseTransmissionMap, &Material.DiffuseTransmissionColorMap};
}

FRTStatus CheckMaterial(const FRTModuleMaterial& Material)
{
	const auto IsLight = [](float Value) { return std::isfinite(Value) && Value >= 0.0f; };
	if (!std::all_of(Material.BaseColor, Material.BaseColor + 4, IsLight) ||
	    !std::all_of(Material.Emissive, Material.Emissive + 3, IsLight) ||
	    !std::all_of(Material.LightEmissive, Material.LightEmissive + 3, IsLight))
	{
		return Refuse("FRTModuleMaterial::BaseColor, Emissive and LightEmissive must be finite and not negative");
	}
	const std::pair<float, const char*> Shares[] = {{Material.Metallic, "Metallic"}, {Material.Roughness, "Roughness"},
	    {Material.OcclusionStrength, "OcclusionStrength"}, {Material.Specular, "Specular"}, {Material.Transmission, "Transmission"},
	    {Material.DiffuseTransmission, "DiffuseTransmission"}, {Material.DiffuseTransmissionColor[0], "DiffuseTransmissionColor[0]"},
	    {Material.DiffuseTransmissionColor[1], "DiffuseTransmissionColor[1]"},
	    {Material.DiffuseTransmissionColor[2], "DiffuseTransmissionColor[2]"}, {Material.ScatterAlbedo[0], "ScatterAlbedo[0]"},
	    {Material.ScatterAlbedo[1], "ScatterAlbedo[1]"}, {Material.ScatterAlbedo[2], "ScatterAlbedo[2]"}};
	for (const auto& [Value, Name] : Shares)
	{
		if (!(Value >= 0.0f && Value <= 1.0f))
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "FRTModuleMaterial::%s must lie between 0 and 1, is %g", Name, double(Value));
		}
	}
	if (!std::isfinite(Material.AlphaCutoff)) { return Refuse("FRTModuleMaterial::AlphaCutoff is not finite"); }
	if (!std::isfinite(Material.NormalScale)) { return Refuse("FRTModuleMaterial::NormalScale is not finite"); }
	if (!(Material.Ior >= 1.0f) || !std::isfinite(Material.Ior)) { return Refuse("FRTModuleMaterial::Ior must be finite and at least 1"); }
	if (!std::all_of(Material.EmissiveMapMean, Material.EmissiveMapMean + 3, IsLight))
	{
		return Refuse("FRTModuleMaterial::EmissiveMapMean must be finite and not negative");
	}
	const auto IsColor = [](float Value) { return Value > 0.0f && Value <= 1.0f; };
	if (!std::all_of(Material.AttenuationColor, Material.AttenuationColor + 3, IsColor) || !(Material.AttenuationDistance > 0.0f))
	{
		return Refuse("FRTModuleMaterial::AttenuationColor must be greater than 0 and at most 1, and AttenuationDistance greater than 0");
	}
	if (!(std::abs(Material.ScatterAnisotropy) < 1.0f))
	{
		return Refuse("FRTModuleMaterial::ScatterAnisotropy must be greater than -1 and less than 1");
	}
	FRTStatus Status;
	const char* const Names[] = {"BaseColorMap", "MetallicRoughnessMap", "NormalMap", "OcclusionMap", "EmissiveMap", "TransmissionMap",
	    "DiffuseTransmissionMap", "DiffuseTransmissionColorMap"};
	const std::array<const FRTModuleMap*, MaterialMapCount> Maps = GetMaps(Material);
	for (size_t Map = 0; Map < Maps.size() && Status; ++Map) { Status = CheckMap(*Maps[Map], Names[Map]); }
	return Status;
}

FRTStatus Refuse(const char* Reason) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Reason); }

FRTStatus RefuseNull(const char* Function, const char* Argument)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: %s is null", Function, Argument);
}

FRTStatus CheckDevice(const char* Function, IRTDevice* Device)
{
	if (Device == nullptr) { return RefuseNull(Function, "Device"); }
	if (Device->GetVersion() == RHIVersion) { return FRTStatus::Success(); }
	return FRTStatus::Error(
	    ERTResult::Unsupported, "%s: the device speaks RHI version %u, Lantern %u", Function, Device->GetVersion(), RHIVersion);
}

FRTStatus RefuseHandle(const char* Function, const char* Kind)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: no such %s: never added, removed, or of another renderer", Function, Kind);
}

} // namespace Lantern
