#include "LanternRenderer/Signals.h"

#include <array>
#include <cassert>

namespace Lantern
{

namespace
{
constexpr const char* SunShadowPasses[] = {"SunShadow"};
constexpr const char* AmbientOcclusionPasses[] = {"AmbientOcclusion"};
constexpr const char* DiffuseGIPasses[] = {"DiffuseGI"};
constexpr const char* ReflectionPasses[] = {"Reflections"};

constexpr std::array<FSignalInfo, static_cast<size_t>(ESignal::Count)> Infos = {{
    {ESignal::SunShadow, "sun_shadow", "Sun shadow", 1, false, SunShadowPasses},
    {ESignal::AmbientOcclusion, "ambient_occlusion", "Ambient occlusion", 1, false, AmbientOcclusionPasses},
    {ESignal::DiffuseGI, "diffuse_gi", "Diffuse GI", 3, true, DiffuseGIPasses},
    {ESignal::Reflections, "reflections", "Reflections", 3, true, ReflectionPasses},
    {ESignal::Frame, "frame", "Whole frame", 3, true, {}},
}};
} // namespace

const FSignalInfo& GetSignalInfo(ESignal Signal)
{
	assert(Signal < ESignal::Count);
	return Infos[static_cast<size_t>(Signal)];
}

std::optional<ESignal> FindSignal(std::string_view Name)
{
	for (const FSignalInfo& Info : Infos)
	{
		if (Name == Info.Name) { return Info.Signal; }
	}
	return std::nullopt;
}

} // namespace Lantern
