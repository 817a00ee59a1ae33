#include "ArgumentChecks.h"

#include <algorithm>
#include <cmath>

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

FRTStatus Refuse(const char* Reason)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Reason);
}

FRTStatus CheckView(const FRTModuleView& View)
{
	// What engines keep in half precision still passes; what was never normalised does not.
	constexpr float LengthTolerance = 0.01f, SineTolerance = 1e-4f;
	const glm::vec3 Forward(View.Forward[0], View.Forward[1], View.Forward[2]);
	const glm::vec3 Up(View.Up[0], View.Up[1], View.Up[2]);
	if (!AreFinite(View.Position, 3))
	{
		return Refuse("FRTModuleView::Position is not finite");
	}
	if (!(std::abs(length(Forward) - 1.0f) < LengthTolerance))
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleView::Forward must be of unit length, is of %g",
		                        double(length(Forward)));
	}
	if (!AreFinite(View.Up, 3) || !(length(cross(Forward, Up)) > SineTolerance * length(Up)))
	{
		return Refuse("FRTModuleView::Up is zero, not finite, or parallel to Forward");
	}
	if (!(View.FovY > 0.0f && View.FovY < glm::pi<float>()))
	{
		return FRTStatus::Error(ERTResult::InvalidArgument,
		                        "FRTModuleView::FovY must lie between 0 and pi (radians), is %g", double(View.FovY));
	}
	if (!(View.Near > 0.0f) || !std::isfinite(View.Near))
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleView::Near must be positive, is %g",
		                        double(View.Near));
	}
	return FRTStatus::Success();
}

FRTStatus CheckGBuffer(const FRTModuleFrame& Frame)
{
	const FRTTextureDesc& Depth = Frame.Depth->GetDesc();
	const FRTTextureDesc& Normals = Frame.Normals->GetDesc();
	if (Depth.Width != Normals.Width || Depth.Height != Normals.Height)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "depth is %u x %u, normals are %u x %u", Depth.Width,
		                        Depth.Height, Normals.Width, Normals.Height);
	}
	if (Depth.Format != ERTFormat::D32_FLOAT && Depth.Format != ERTFormat::R32_FLOAT)
	{
		return Refuse("the depth texture must be D32_FLOAT or R32_FLOAT");
	}
	if (Normals.Format != ERTFormat::RGBA16_SNORM)
	{
		return Refuse("the normal texture must be RGBA16_SNORM");
	}
	if (!HasAny(Depth.Usage, ERTTextureUsage::Sampled) || !HasAny(Normals.Usage, ERTTextureUsage::Sampled))
	{
		return Refuse("depth and normals need ERTTextureUsage::Sampled");
	}
	if (Frame.DepthAccess == ERTAccess::None || Frame.NormalsAccess == ERTAccess::None)
	{
		return Refuse("DepthAccess and NormalsAccess must say how the textures were used: None discards them");
	}
	return FRTStatus::Success();
}

} // namespace

FRTStatus CheckFrame(const FRTModuleFrame& Frame)
{
	if (Frame.Commands == nullptr || Frame.Depth == nullptr || Frame.Normals == nullptr)
	{
		return Refuse("a frame needs a command list, a depth and a normal texture");
	}
	const FRTStatus Status = CheckGBuffer(Frame);
	return Status.IsOk() ? CheckView(Frame.View) : Status;
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
	return AreFinite(Transform, 12) ? FRTStatus::Success() : Refuse("an object's transform is not finite");
}

FRTStatus CheckMaterial(const FRTModuleMaterial& Material)
{
	if (Material.BaseColorTexture == nullptr)
	{
		return FRTStatus::Success();
	}
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
