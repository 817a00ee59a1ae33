// The signals that the plugin makes, as measurements name them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace Lantern
{

/// Of one frame: what is compared with a reference of the same signal.
enum class ESignal : uint8_t
{
	SunShadow,        ///< fraction of the sun's disk that is seen
	AmbientOcclusion, ///< see FAmbientOcclusionOutputs
	DiffuseGI,        ///< see FDiffuseGIOutputs
	Reflections,      ///< see FReflectionOutputs
	Frame,            ///< linear radiance of the whole frame
	Count,
};

struct FSignalInfo
{
	ESignal Signal;
	const char* Name;  ///< "sun_shadow"; in files and on the command line
	const char* Title; ///< "Sun shadow"
	uint32_t Channels; ///< 1 or 3
	bool bRadiance;    ///< unbounded; else 0 to 1
	/// Passes of the frame graph whose names begin with one of these are its cost. Empty: all of the frame.
	std::span<const char* const> Passes;
};

const FSignalInfo& GetSignalInfo(ESignal Signal);
std::optional<ESignal> FindSignal(std::string_view Name);

} // namespace Lantern
