// Checks of what an engine hands to the module.
#include "ArgumentChecks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

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

FRTStatus CheckView(const FRTModuleView& View)
{
	// What engines keep in half precision still passes; what was never normalised does not.
	constexpr float LengthTolerance = 0.01f, SineTolerance = 1e-4f;
	const glm::vec3 Forward(View.Forward[0], View.Forward[1], View.Forward[2]);
	const glm::vec3 Up(View.Up[0], View.Up[1], View.Up[2]);
	if (!AreFinite(View.Position, 3)) { return Refuse("FRTModuleView::Position is not finite"); }
	if (!(std::abs(length(Forward) - 1.0f) < LengthTolerance))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleView::Forward must be of unit length, is of %g", double(length(Forward)));
	}
	if (!AreFinite(View.Up, 3) || !(length(cross(Forward, Up)) > SineTolerance * length(Up)))
	{
		return Refuse("FRTModuleView::Up is zero, not finite, or parallel to Forward");
	}
	if (!(View.FovY > 0.0f && View.FovY < glm::pi<float>()))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleView::FovY must lie between 0 and pi (radians), is %g", double(View.FovY));
	}
	if (!(View.Near > 0.0f) || !std::isfinite(View.Near))
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleView::Near must be positive, is %g", double(View.Near));
	}
	return FRTStatus::Success();
}

/// A texture of the G-buffer, which goes with depth and has one format.
struct FGBufferTexture
{
	const IRTTexture* Texture;
	ERTAccess Access;
	ERTFormat Format;
	const char* Name;
	const char* FormatName;
	const char* AccessName;
};

FRTStatus CheckTexture(const FGBufferTexture& Item, const FRTTextureDesc& Depth)
{
	const auto Fail = [&](const char* Reason, const char* What) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "the %s texture %s %s", Item.Name, Reason, What);
	};
	if (Item.Texture == nullptr) { return FRTStatus::Success(); }
	const FRTTextureDesc& Desc = Item.Texture->GetDesc();
	if (Desc.Width != Depth.Width || Desc.Height != Depth.Height)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "the %s texture is %u x %u, depth is %u x %u", Item.Name, Desc.Width,
		    Desc.Height, Depth.Width, Depth.Height);
	}
	if (Desc.Format != Item.Format) { return Fail("must be", Item.FormatName); }
	if (!HasAny(Desc.Usage, ERTTextureUsage::Sampled)) { return Fail("needs", "ERTTextureUsage::Sampled"); }
	return Item.Access != ERTAccess::None ? FRTStatus::Success()
	                                      : Fail("would be discarded by None: how it was used must be said by", Item.AccessName);
}

FRTStatus CheckGBuffer(const FRTModuleFrame& Frame)
{
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	if (Depth.Format != ERTFormat::D32_FLOAT && Depth.Format != ERTFormat::R32_FLOAT)
	{
		return Refuse("the depth texture must be D32_FLOAT or R32_FLOAT");
	}
	using enum ERTFormat;
	const FGBufferTexture Textures[] = {{Frame.Depth, Frame.DepthAccess, Depth.Format, "depth", "", "DepthAccess"},
	    {Frame.Normals, Frame.NormalsAccess, RGBA16_SNORM, "normals", "RGBA16_SNORM", "NormalsAccess"},
	    {Frame.Motion, Frame.MotionAccess, RGBA32_FLOAT, "motion", "RGBA32_FLOAT", "MotionAccess"},
	    {Frame.BaseColor, Frame.BaseColorAccess, RGBA8_SRGB, "base colour", "RGBA8_SRGB", "BaseColorAccess"},
	    {Frame.Material, Frame.MaterialAccess, RGBA8_UNORM, "material", "RGBA8_UNORM", "MaterialAccess"}};
	FRTStatus Status;
	for (const FGBufferTexture& Texture : Textures) { Status = Status ? CheckTexture(Texture, Depth) : Status; }
	return Status;
}

} // namespace

FRTStatus CheckFrame(const FRTModuleFrame& Frame)
{
	if (Frame.Commands == nullptr || Frame.Depth == nullptr || Frame.Normals == nullptr)
	{
		return Refuse("a frame needs a command list, a depth and a normal texture");
	}
	if (!(Frame.DeltaSeconds > 0.0f) || !std::isfinite(Frame.DeltaSeconds))
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTModuleFrame::DeltaSeconds must be positive, is %g", double(Frame.DeltaSeconds));
	}
	const FRTStatus Status = CheckGBuffer(Frame);
	return Status.IsOk() ? CheckView(Frame.View) : Status;
}

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
	if (Material.BaseColorSampler == nullptr || Material.BaseColorTexture->GetSampledIndex() == ~0u)
	{
		return Refuse("a material's texture needs a sampler, and to be Sampled");
	}
	return FRTStatus::Success();
}

FRTStatus RefuseHandle(const char* Function, const char* Kind)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: no such %s: never added, or removed", Function, Kind);
}

} // namespace Lantern
