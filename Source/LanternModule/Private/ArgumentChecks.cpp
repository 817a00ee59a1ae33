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

FRTStatus Refuse(const char* Reason) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Reason); }

} // namespace

FRTStatus CheckSky(const float Radiance[3])
{
	const bool bGood =
	    Radiance != nullptr && AreFinite(Radiance, 3) && std::all_of(Radiance, Radiance + 3, [](float C) { return C >= 0.0f; });
	return bGood ? FRTStatus::Success() : Refuse("the sky's radiance must be finite and not negative");
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

FRTStatus CheckTransform(const double Transform[12])
{
	return Transform != nullptr && AreFinite(Transform, 12) ? FRTStatus::Success() : Refuse("an object's transform is null or not finite");
}

FRTStatus CheckMaterial(const FRTModuleMaterial& Material)
{
	const auto IsLight = [](float Value) { return std::isfinite(Value) && Value >= 0.0f; };
	if (!std::all_of(Material.BaseColor, Material.BaseColor + 4, IsLight) ||
	    !std::all_of(Material.Emissive, Material.Emissive + 3, IsLight))
	{
		return Refuse("FRTModuleMaterial::BaseColor and Emissive must be finite and not negative");
	}
	for (const auto& [Value, Name] : {std::pair(Material.Metallic, "Metallic"), std::pair(Material.Roughness, "Roughness")})
	{
		if (!(Value >= 0.0f && Value <= 1.0f))
		{
			return FRTStatus::Error(
			    ERTResult::InvalidArgument, "FRTModuleMaterial::%s must lie between 0 and 1, is %g", Name, double(Value));
		}
	}
	if (!std::isfinite(Material.AlphaCutoff)) { return Refuse("FRTModuleMaterial::AlphaCutoff is not finite"); }
	if (Material.BaseColorTexture == nullptr) { return FRTStatus::Success(); }
	if (Material.BaseColorSampler == nullptr) { return Refuse("FRTModuleMaterial::BaseColorSampler is null beside a texture"); }
	if (Material.BaseColorTexture->GetSampledIndex() == ~0u)
	{
		return Refuse("FRTModuleMaterial::BaseColorTexture lacks ERTTextureUsage::Sampled");
	}
	uint32_t Slot = NO_TEXTURE;
	if (!MakeTextureSlot(Material.BaseColorTexture->GetSampledIndex(), Material.BaseColorSampler->GetIndex(), Slot))
	{
		return Refuse("FRTModuleMaterial::BaseColorTexture or BaseColorSampler has an index that materials have no room for");
	}
	return FRTStatus::Success();
}

FRTStatus RefuseNull(const char* Function, const char* Argument)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: %s is null", Function, Argument);
}

FRTStatus RefuseHandle(const char* Function, const char* Kind)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: no such %s: never added, removed, or of another renderer", Function, Kind);
}

} // namespace Lantern
