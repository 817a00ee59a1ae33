// Checks of the engine's shadow map.
#include "HostShadowChecks.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/glm.hpp>

namespace Lantern
{

namespace
{
FRTStatus Refuse(uint32_t Cascade, const char* Member, const char* Reason)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleHostShadow::Cascades[%u].%s %s", Cascade, Member, Reason);
}

FRTStatus CheckMap(uint32_t Index, const FRTModuleShadowCascade& Cascade, const IRTDevice& Device)
{
	using enum ERTFormat;
	constexpr ERTFormat Formats[] = {D32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM, R32_FLOAT};
	if (Cascade.Texture == nullptr) { return Refuse(Index, "Texture", "is null"); }
	const FRTTextureDesc& Desc = Cascade.Texture->GetDesc();
	const uint64_t Owner = Cascade.Texture->GetNative(ERTNative::Device), Mine = Device.GetNative(ERTNative::Device);
	if (Owner != 0 && Mine != 0 && Owner != Mine) { return Refuse(Index, "Texture", "is of another device than the renderer"); }
	if (std::find(std::begin(Formats), std::end(Formats), Desc.Format) == std::end(Formats))
	{
		return Refuse(Index, "Texture", "must be D32_FLOAT, D32_FLOAT_S8_UINT, D24_UNORM_S8_UINT, D16_UNORM or R32_FLOAT");
	}
	if (!HasAny(Desc.Usage, ERTTextureUsage::Sampled)) { return Refuse(Index, "Texture", "needs ERTTextureUsage::Sampled"); }
	if (Cascade.Access == ERTAccess::None) { return Refuse(Index, "Access", "is None, so that the map would be discarded"); }
	const auto IsInside = [](uint32_t Offset, uint32_t Size, uint32_t All) { return Offset < All && Size <= All - Offset; };
	if (!IsInside(Cascade.OffsetX, Cascade.Width, Desc.Width)) { return Refuse(Index, "OffsetX or Width", "reaches beyond the texture"); }
	return IsInside(Cascade.OffsetY, Cascade.Height, Desc.Height) ? FRTStatus::Success()
	                                                              : Refuse(Index, "OffsetY or Height", "reaches beyond the texture");
}

FRTStatus CheckMatrix(uint32_t Index, const FRTModuleShadowCascade& Cascade)
{
	const double* const M = Cascade.WorldToMap;
	if (!std::all_of(M, M + 12, [](double Value) { return std::isfinite(Value); })) { return Refuse(Index, "WorldToMap", "is not finite"); }
	const glm::dvec3 X(M[0], M[1], M[2]), Y(M[4], M[5], M[6]), Z(M[8], M[9], M[10]);
	// The volume of rows of any length, against that of rows at right angles.
	const double Volume = glm::dot(glm::cross(X, Y), Z), Most = glm::length(X) * glm::length(Y) * glm::length(Z);
	if (!(std::abs(Volume) > 1e-6 * Most)) { return Refuse(Index, "WorldToMap", "has rows that lie in one plane"); }
	return FRTStatus::Success();
}

FRTStatus CheckCascade(uint32_t Index, const FRTModuleShadowCascade& Cascade, const IRTDevice& Device)
{
	if (const FRTStatus Status = CheckMap(Index, Cascade, Device); !Status) { return Status; }
	if (const FRTStatus Status = CheckMatrix(Index, Cascade); !Status) { return Status; }
	if (!(Cascade.TexelSize > 0.0f) || !std::isfinite(Cascade.TexelSize)) { return Refuse(Index, "TexelSize", "must be positive"); }
	if (!(Cascade.DepthBias >= 0.0f) || !std::isfinite(Cascade.DepthBias)) { return Refuse(Index, "DepthBias", "must not be negative"); }
	return FRTStatus::Success();
}

} // namespace

FRTStatus CheckHostShadow(const FRTModuleFrame& Frame, const IRTDevice& Device, bool bOwnShader)
{
	const auto Fail = [](const char* Reason) { return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleHostShadow::%s", Reason); };
	if (Frame.HostShadow == nullptr) { return FRTStatus::Success(); }
	const FRTModuleHostShadow& Shadow = *Frame.HostShadow;
	if (static_cast<uint32_t>(Shadow.Held) > 15u) { return Fail("Held has bits that are none of ERTModuleCasters"); }
	if (bOwnShader != (Shadow.ShaderData != 0))
	{
		return bOwnShader ? Fail("ShaderData is 0, and FRTModuleRendererDesc::HostShadowShader reads it")
		                  : Fail("ShaderData has no FRTModuleRendererDesc::HostShadowShader that reads it");
	}
	if (bOwnShader) { return Shadow.CascadeCount == 0 ? FRTStatus::Success() : Fail("CascadeCount must be 0 with ShaderData"); }
	if (Shadow.CascadeCount == 0 || Shadow.CascadeCount > MaxShadowCascades)
	{
		return Fail("CascadeCount must be 1 to 4: without cascades nothing is held, and HostShadow is null");
	}
	for (uint32_t I = 0; I < Shadow.CascadeCount; ++I)
	{
		if (const FRTStatus Status = CheckCascade(I, Shadow.Cascades[I], Device); !Status) { return Status; }
	}
	return FRTStatus::Success();
}

} // namespace Lantern
