// Methods: ways of making a signal. Each is a named set of console variables with presets from cheap to expensive. They are
// registered in Config/Methods.ini. Each entry is a line on the chart (lantern chart) and runs in the stability suite (lantern
// stability) without further code.
//
//   [MethodDefaults]                        set before every method; turns all signals off
//   +CVars=r.RT.Shadow=0
//   [Method.SunShadowQuery]
//   Title=sun shadow, query
//   Signal=sun_shadow                       see Signals.h
//   Needs=query                             pipeline, query or any: what the device must have
//   +CVars=r.RT.Shadow=1 r.RT.Shadow.Path=2 for all presets; NAME=VALUE, separated by blanks
//   +Presets=hard: r.RT.Shadow.Soft=0       NAME: and its settings
//   +Presets=4 rays: r.RT.Shadow.Samples=4
//   Typical=4 rays                          the preset to use if only one is run; absent: the first
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
	std::vector<FMethodSetting> Settings; ///< for all presets
	std::vector<FMethodPreset> Presets;   ///< cheap to expensive; not empty
	size_t Typical = 0;                   ///< into Presets
	std::string Where;
	const FMethodPreset* FindPreset(std::string_view PresetName) const; ///< null: none of this name
	const FMethodPreset& GetTypical() const { return Presets[Typical]; }
};

struct FMethods
{
	std::vector<FMethodSetting> Defaults;
	std::vector<FMethod> Methods;
	/// One line each, with file and line. A method with a problem is left out of Methods.
	std::vector<std::string> Problems;
	const FMethod* Find(std::string_view NameOrTitle) const; ///< case ignored; null: there is none
};

/// Parses methods. Unknown console variables are problems, so that all must be registered already. Nothing is logged.
FMethods ParseMethods(std::string_view Text, const std::string& Name);
FMethods LoadMethods(const std::string& Path);

/// Returns why the device cannot run the method; empty if it can.
std::string GetMissing(const FMethod& Method, const FRTCapabilities& Capabilities);

/// Sets console variables during its lifetime, with ERTSetBy::Console, which overrides all others. Then restores their values
/// and ERTSetBy. Changes reach the render thread with the next frame. Scopes may be nested. Render thread only.
class FMethodScope
{
public:
	FMethodScope() = default;
	~FMethodScope() { Restore(); }
	FMethodScope(const FMethodScope&) = delete;
	FMethodScope& operator=(const FMethodScope&) = delete;

	/// Sets the defaults, then the method's settings, then the preset's; Method and Preset may be null. Returns messages of
	/// refused settings (wrong values) with file and line. If there are any, all settings are restored.
	std::vector<std::string> Apply(const FMethods& Methods, const FMethod* Method, const FMethodPreset* Preset);
	std::vector<std::string> Apply(const std::vector<FMethodSetting>& Settings);
	/// Restores everything before the destructor does.
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
