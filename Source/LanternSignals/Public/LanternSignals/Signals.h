// The registry of signals. A signal is a picture that the plugin makes for a host: a shadow mask, occlusion, indirect light.
//
// This list is the only one. The module's inputs and outputs, the frame, the reference path tracer, captures, `lantern chart`,
// `lantern stability` and r.RT.Debug.View go through it. A new signal takes an enumerator and a row here, a row in
// LanternRenderer/Private/SignalPasses.cpp and a call in Frame.cpp. Scripts/NewPass writes them; see Docs/AddingAPass.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// New signals go to the end: an engine that was compiled with an older list keeps its numbers.
enum class ESignal : uint8_t
{
	/// The whole frame: linear radiance, in nits. The composite and the reference path tracer make it; no module output.
	Frame,
	/// Fraction of the sun's disk that a pixel sees: 1 lit, 0 shadowed.
	SunShadow,
	/// Cosine-weighted fraction of the hemisphere about the shading normal in which nothing is within r.RT.AO.Radius. A
	/// surface within that radius counts less the farther away it is. 1: open.
	AmbientOcclusion,
	/// Indirect irradiance / π about the shading normal. It holds all light but that of the sun's disk and of punctual lights,
	/// which direct lighting adds. The sky and emissive surfaces are in it. Times diffuse albedo it is radiance. A direction
	/// below the geometric surface brings nothing. Sky pixels: 0.
	///
	/// LocalDiffuse takes over what emissive triangles bring to the surface directly, if it is made and r.RT.Lights.Emissive is on.
	/// A path's first ray then sees no emission of triangles that light sampling lists. Deforming meshes are listed, too.
	DiffuseGI,
	/// Radiance that the surface's specular lobe reflects towards the camera, Fresnel included, of the light that DiffuseGI
	/// has. A mirror (roughness² < 0.001) is a delta. Alpha is the share of it, 0 to 1, that a host shows; the rest is that of
	/// RoughSpecular. It is 1 for smooth surfaces, and 0 from r.RT.Reflections.MaxRoughness on. There rgb is the reflection of an
	/// unoccluded sky. Sky pixels: 0.
	///
	/// LocalSpecular shares directly reflected emissive triangles with it, as LocalDiffuse does with DiffuseGI. Here they count
	/// w = 1 - smoothstep(0.2, 0.3, roughness), there 1 - w, so that narrow lobes find them by their own ray. Where alpha is below 1,
	/// w is 0.
	Reflections,
	/// Shadowed light of local lights, which are all but the sun and the sky. Emissive triangles are among them if r.RT.Lights.Emissive is
	/// on: see DiffuseGI. It is what the diffuse lobe reflects towards the camera, over the lobe's directional albedo: irradiance / π.
	/// Sky pixels: 0. A host that reads the light mask gets what is not in the mask (FRTModuleFrame::bLightMask).
	LocalDiffuse,
	/// What the specular lobe reflects of these lights, over its directional albedo. A mirror is as rough as a lobe can be seen. Emissive
	/// triangles count as Reflections says. Sky pixels: 0.
	LocalSpecular,
	/// What the specular lobe reflects of the light that DiffuseGI has, over its directional albedo. Diffuse GI's paths find it. Lobes
	/// narrower than that of roughness 0.2 are taken for as wide. It stands in where Reflections has an alpha below 1, and is not made if
	/// reflections of all surfaces are. LocalSpecular has all light of emissive triangles there. Sky pixels: 0.
	RoughSpecular,
	Count,
};

inline constexpr size_t SignalCount = static_cast<size_t>(ESignal::Count);
/// Room in the module's arrays, so that a new signal changes no layout.
inline constexpr size_t MaxSignals = 32;
static_assert(SignalCount <= MaxSignals);

constexpr size_t ToIndex(ESignal Signal) { return static_cast<size_t>(Signal); }

/// A set of signals.
class FSignalSet
{
public:
	constexpr FSignalSet() = default;
	constexpr FSignalSet(std::initializer_list<ESignal> Signals)
	{
		for (const ESignal Signal : Signals) { Add(Signal); }
	}
	constexpr bool Has(ESignal Signal) const { return (Bits >> ToIndex(Signal) & 1u) != 0; }
	constexpr void Add(ESignal Signal) { Bits |= 1u << ToIndex(Signal); }
	constexpr void Remove(ESignal Signal) { Bits &= ~(1u << ToIndex(Signal)); }
	constexpr FSignalSet& operator|=(FSignalSet Other)
	{
		Bits |= Other.Bits;
		return *this;
	}
	constexpr bool operator==(FSignalSet Other) const { return Bits == Other.Bits; }

private:
	uint32_t Bits = 0;
};

/// What everybody may know of a signal. How it is made stands in LanternRenderer/Private/SignalPasses.cpp.
struct FSignalInfo
{
	ESignal Signal;
	const char* Name;  ///< "sun_shadow": in files and on the command line
	const char* Title; ///< "Sun shadow"
	/// Folder, shader and passes begin with it: Shaders/<Pass>/<Pass>.rgen, frame-graph passes "<Pass>…". Those passes are the
	/// signal's cost. "" stands for all passes of the frame.
	const char* Pass;
	/// Begins the names of passes that make it and other signals at once. They are a cost of the signal as well. "": there are none.
	const char* SharedPass;
	ERTFormat Format;   ///< of the output
	uint32_t Channels;  ///< 1 or 3
	bool bRadiance;     ///< unbounded and ≥ 0; if false, 0 to 1
	bool bNeedsSun;     ///< the scene must have a sun
	bool bLit;          ///< follows changes of light; if false, only geometry counts
	bool bNeedsSurface; ///< reads base colour and material of the G-buffer
	bool bSpecular;     ///< made of the specular lobe alone: a rough surface shows little of it
	/// Console variables that its reference depends on beside the scene, separated by blanks.
	const char* ReferenceVariables;
};

inline constexpr FSignalInfo SignalInfos[] = {
    {ESignal::Frame, "frame", "Whole frame", "", "", ERTFormat::RGBA32_FLOAT, 3, true, false, true, true, false, ""},
    {ESignal::SunShadow, "sun_shadow", "Sun shadow", "SunShadow", "Shadow", ERTFormat::R16_FLOAT, 1, false, true, true, false, false, ""},
    {ESignal::AmbientOcclusion, "ambient_occlusion", "Ambient occlusion", "AmbientOcclusion", "", ERTFormat::R16_FLOAT, 1, false, false,
        false, false, false, "r.RT.AO.Radius r.RT.AO.InstanceMask"},
    {ESignal::DiffuseGI, "diffuse_gi", "Diffuse GI", "DiffuseGI", "", ERTFormat::RGBA16_FLOAT, 3, true, false, true, false, false,
        "r.RT.GI.Toon"},
    {ESignal::Reflections, "reflections", "Reflections", "Reflections", "", ERTFormat::RGBA16_FLOAT, 3, true, false, true, true, true,
        "r.RT.Reflections r.RT.Reflections.MaxRoughness r.RT.Reflections.Toon r.RT.Reflections.Toon.Threshold "
        "r.RT.Reflections.Toon.MinRoughness r.RT.Reflections.Toon.MaxRoughness r.RT.Reflections.Toon.Tint r.RT.GI.Toon"},
    {ESignal::LocalDiffuse, "local_diffuse", "Local lights, diffuse", "LocalDiffuse", "Shadow", ERTFormat::RGBA16_FLOAT, 3, true, false,
        true, true, false, ""},
    {ESignal::LocalSpecular, "local_specular", "Local lights, specular", "LocalSpecular", "Shadow", ERTFormat::RGBA16_FLOAT, 3, true, false,
        true, true, true, "r.RT.Reflections r.RT.Reflections.MaxRoughness"},
    {ESignal::RoughSpecular, "rough_specular", "Rough specular", "RoughSpecular", "DiffuseGI", ERTFormat::RGBA16_FLOAT, 3, true, false,
        true, true, true, "r.RT.GI.Toon"},
};
static_assert(sizeof(SignalInfos) / sizeof(SignalInfos[0]) == SignalCount, "each signal needs a row");
static_assert(
    [] {
	for (size_t I = 0; I < SignalCount; ++I)
	{
		if (ToIndex(SignalInfos[I].Signal) != I) { return false; }
	}
	return true;
    }(),
    "rows stand in the order of ESignal");

/// Signal: not Count.
constexpr const FSignalInfo& GetSignalInfo(ESignal Signal) { return SignalInfos[ToIndex(Signal)]; }

/// Finds a signal by its name in files; nullopt if there is none.
inline std::optional<ESignal> FindSignal(std::string_view Name)
{
	for (const FSignalInfo& Info : SignalInfos)
	{
		if (Name == Info.Name) { return Info.Signal; }
	}
	return std::nullopt;
}

/// Returns the names of all signals, for messages and help: "frame, sun_shadow, …".
inline std::string ListSignalNames()
{
	std::string Names;
	for (const FSignalInfo& Info : SignalInfos) { Names += (Names.empty() ? "" : ", ") + std::string(Info.Name); }
	return Names;
}

} // namespace Lantern
