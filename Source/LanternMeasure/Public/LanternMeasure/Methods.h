// Methods: ways of making a signal, each a named set of console variables with presets from cheap to dear. They are
// registered in Config/Methods.ini; what is there is a line on the chart (lantern chart) and runs in the stability suite
// (lantern stability) with no other code.
//
//   [MethodDefaults]                        set before every method: all signals off, so that a method is what it sets
//   +CVars=r.RT.Shadow=0
//   [Method.SunShadowQuery]
//   Title=sun shadow, query
//   Signal=sun_shadow                       see Signals.h
//   Needs=query                             pipeline, query or any: what the device must have
//   +CVars=r.RT.Shadow=1 r.RT.Shadow.Path=2 of all presets; NAME=VALUE, separated by blanks
//   +Presets=hard: r.RT.Shadow.Soft=0       NAME: and what it sets
//   +Presets=4 rays: r.RT.Shadow.Samples=4
//   Typical=4 rays                          the preset for those who run one only; absent: the first
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRHI/RTTypes.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

enum class EMethodNeeds : uint8_t
{
	Any,
	Pipeline, ///< ray-tracing pipelines
	Query,    ///< ray queries
};

struct FMethodSetting
{
	std::string Name, Value;
	std::string Where; ///< "Config/Methods.ini:12"
};

struct FMethodPreset
{
	std::string Name; ///< "4 rays"
	std::vector<FMethodSetting> Settings;
};

struct FMethod
{
	std::string Name;  ///< "SunShadowQuery": its section without "Method."
	std::string Title; ///< "sun shadow, query"
	ESignal Signal = ESignal::Frame;
	EMethodNeeds Needs = EMethodNeeds::Any;
	std::vector<FMethodSetting> Settings; ///< of all presets
	std::vector<FMethodPreset> Presets;   ///< cheap to dear; > 0
	size_t Typical = 0;                   ///< into Presets
	std::string Where;
	const FMethodPreset* FindPreset(std::string_view PresetName) const; ///< null: none of this name
	const FMethodPreset& GetTypical() const { return Presets[Typical]; }
};

struct FMethods
{
	std::vector<FMethodSetting> Defaults;
	std::vector<FMethod> Methods;
	/// One line each, with file and line. A method with a problem is not in Methods; the others are.
	std::vector<std::string> Problems;
	const FMethod* Find(std::string_view NameOrTitle) const; ///< case ignored; null: there is none
};

/// Console variables must be registered already: one that is not known is a problem. Nothing is logged.
FMethods ParseMethods(std::string_view Text, const std::string& Name);
FMethods LoadMethods(const std::string& Path);

/// Why the device cannot run it; empty where it can.
std::string GetMissing(const FMethod& Method, const FRTCapabilities& Capabilities);

/// Sets console variables for as long as it lives, above whoever set them before (ERTSetBy::Console), and puts them back
/// to the value and the ERTSetBy that they had. Both take effect for the render thread with the next frame. Scopes may be
/// nested; the inner ends first. On the thread that renders.
class FMethodScope
{
public:
	FMethodScope() = default;
	~FMethodScope() { Restore(); }
	FMethodScope(const FMethodScope&) = delete;
	FMethodScope& operator=(const FMethodScope&) = delete;

	/// Defaults, then the method's, then the preset's; either may be null. Returns what was refused (wrong value), with file
	/// and line, empty if nothing was: then all of it is put back.
	std::vector<std::string> Apply(const FMethods& Methods, const FMethod* Method, const FMethodPreset* Preset);
	std::vector<std::string> Apply(const std::vector<FMethodSetting>& Settings);
	/// Before the end of its life.
	void Restore();

private:
	struct FSaved
	{
		const FRTConsoleVariable* Variable;
		FRTCVarValue Value;
		ERTSetBy By;
	};
	std::vector<FSaved> Saved; // in the order of setting
};

} // namespace Lantern
