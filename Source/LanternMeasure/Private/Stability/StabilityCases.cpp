// The cases of `lantern stability`, in order, with what is planted in each.
#include "LanternMeasure/Stability/StabilityCase.h"

#include <algorithm>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

std::vector<FMethodSetting> KnownSettings(std::initializer_list<std::pair<const char*, const char*>> Settings)
{
	std::vector<FMethodSetting> Known;
	for (const auto& [Name, Value] : Settings)
	{
		if (FConsoleVariables::Get().Find(Name)) { Known.push_back({Name, Value, "planted fault"}); }
	}
	return Known;
}

namespace
{
constexpr ESignal Sun = ESignal::SunShadow, Occlusion = ESignal::AmbientOcclusion, Diffuse = ESignal::DiffuseGI,
                  Reflected = ESignal::Reflections, LampDiffuse = ESignal::LocalDiffuse, LampSpecular = ESignal::LocalSpecular,
                  Whole = ESignal::Frame;

enum class ELamps : uint8_t
{
	No,
	Yes
};

/// All signals of the registry: a new one is measured in these cases as soon as it has a method. Lamps: whether the case has a scene
/// with lamps.
std::vector<ESignal> EverySignal(bool bWhole, ELamps Lamps = ELamps::No)
{
	std::vector<ESignal> Signals;
	for (const FSignalInfo& Info : SignalInfos)
	{
		const bool bLamps = Info.Signal == LampDiffuse || Info.Signal == LampSpecular;
		if (Info.Signal != Whole && (!bLamps || Lamps == ELamps::Yes)) { Signals.push_back(Info.Signal); }
	}
	if (bWhole) { Signals.push_back(Whole); }
	return Signals;
}

FStabilityFault MakeFault(std::vector<FMethodSetting> Settings, const char* Otherwise)
{
	FStabilityFault Fault;
	for (const FMethodSetting& Setting : Settings) { Fault.Text += (Fault.Text.empty() ? "" : " ") + Setting.Name + "=" + Setting.Value; }
	if (Settings.empty()) { Fault.Text = Otherwise; }
	Fault.Settings = std::move(Settings);
	return Fault;
}

FStabilityFault MakeThinWallFault(const FMethod& Method)
{
	if (Method.Signal == Sun) { return MakeFault(KnownSettings({{"r.RT.Shadow.MaxDistance", "1"}}), ""); }
	return MakeFault({}, "a slit in the roof");
}

/// Nothing is validated: what was there is taken for what is there, for a minute, and no rays make up for it.
FStabilityFault MakeUncoveringFault(const FMethod&)
{
	return MakeFault(KnownSettings({{"r.RT.Debug.Denoise.Validate", "0"}, {"r.RT.Debug.Denoise.Adapt", "0"}, {"r.RT.Lights.MoreRays", "0"},
	                     {"r.RT.Shadow.HistorySeconds", "60"}, {"r.RT.AO.HistorySeconds", "60"}, {"r.RT.Lights.HistorySeconds", "60"},
	                     {"r.RT.GI.HistorySeconds", "60"}, {"r.RT.Debug.GI.Events", "0"}, {"r.RT.Reflections.HistorySeconds", "60"}}),
	    "");
}

FStabilityFault MakeStaleLampsFault(const FMethod& Method)
{
	// Of a method that keeps nothing, the case itself hides the switch.
	const bool bFiltered = std::any_of(Method.Settings.begin(), Method.Settings.end(), [](const FMethodSetting& Setting) {
		return (Setting.Name == "r.RT.Lights.Denoise" || Setting.Name == "r.RT.GI.Denoise") && Setting.Value == "1";
	});
	const auto Stale = KnownSettings({{"r.RT.Debug.Denoise.Adapt", "0"}, {"r.RT.Lights.HistorySeconds", "60"},
	    {"r.RT.Debug.Lights.Rescale", "0"}, {"r.RT.GI.HistorySeconds", "60"}, {"r.RT.Debug.GI.Events", "0"}});
	return MakeFault(bFiltered ? Stale : std::vector<FMethodSetting>(), "what changes does so late");
}

/// Each pixel of many lights takes one at random, hidden or not, and forgets it after a frame.
FStabilityFault MakeBlindLampsFault(const FMethod&)
{
	return MakeFault(KnownSettings({{"r.RT.Lights.Exact", "1"}, {"r.RT.Lights.Candidates", "1"}, {"r.RT.Lights.GuideSeconds", "0"},
	                     {"r.RT.Lights.HistorySeconds", "0.02"}, {"r.RT.GI.HistorySeconds", "0.02"}, {"r.RT.GI.FilterPasses", "0"}}),
	    "");
}

/// History that is kept for a minute, never compared with what is there now, and never told.
FStabilityFault MakeStaleFault(const FMethod&)
{
	return MakeFault(KnownSettings({{"r.RT.Debug.Denoise.Adapt", "0"}, {"r.RT.Shadow.HistorySeconds", "60"},
	                     {"r.RT.Debug.Lights.Rescale", "0"}, {"r.RT.AO.HistorySeconds", "60"}, {"r.RT.Lights.HistorySeconds", "60"},
	                     {"r.RT.GI.HistorySeconds", "60"}, {"r.RT.Debug.GI.Events", "0"}, {"r.RT.Reflections.HistorySeconds", "60"}}),
	    "");
}

/// The same, where mirrors are taken for what they show.
FStabilityFault MakeStaleMirrorFault(const FMethod&)
{
	return MakeFault(
	    KnownSettings({{"r.RT.Debug.Reflections.Motion", "0"}, {"r.RT.Debug.MovedShare.Shown", "0"}, {"r.RT.Debug.Denoise.Validate", "0"},
	        {"r.RT.Debug.Denoise.Adapt", "0"}, {"r.RT.Reflections.HistorySeconds", "60"}}),
	    "");
}

FStabilityFault MakeUnguardedFault(const FMethod& Method)
{
	const auto IsOn = [&](const char* Name) {
		for (const auto* Settings : {&Method.Settings, &Method.GetTypical().Settings})
		{
			for (const FMethodSetting& Setting : *Settings)
			{
				if (Setting.Name == Name && Setting.Value == "1") { return true; }
			}
		}
		return false;
	};
	// The composite has a guard of its own: in a whole frame nothing would be seen.
	const bool bFiltered =
	    Method.Signal != Whole && (IsOn("r.RT.Shadow.Denoise") || IsOn("r.RT.AO.Denoise") || IsOn("r.RT.Reflections.Denoise"));
	const std::vector<FMethodSetting> Unguarded = KnownSettings({{"r.RT.Debug.Denoise.Guard", "0"}, {"r.RT.Debug.Denoise.Adapt", "0"}});
	return MakeFault(bFiltered ? Unguarded : std::vector<FMethodSetting>(), "one pixel is overwritten");
}

FStabilityFault MakeSeamsFault(const FMethod& Method)
{
	const bool bFew = std::any_of(Method.GetTypical().Settings.begin(), Method.GetTypical().Settings.end(),
	    [](const FMethodSetting& Setting) { return Setting.Name == "r.RT.Lights.Rate" && Setting.Value != "0"; });
	// A filter smooths what second rays would have made right.
	const bool bFiltered = std::any_of(Method.Settings.begin(), Method.Settings.end(),
	    [](const FMethodSetting& Setting) { return Setting.Name == "r.RT.Lights.Denoise" && Setting.Value == "1"; });
	const auto NoSecondRay = KnownSettings({{"r.RT.Debug.Lights.SecondRay", "0"}});
	return MakeFault(
	    bFew && !bFiltered ? NoSecondRay : std::vector<FMethodSetting>(), "every other tile is brighter, by 10 and 30 % in turn");
}

/// Light is that of one frame.
FStabilityFault MakeForgetfulFault(const FMethod&) { return MakeFault(KnownSettings({{"r.RT.GI.HistorySeconds", "0.02"}}), ""); }

/// What finds no cell is dark.
FStabilityFault MakeDarkFault(const FMethod&) { return MakeFault(KnownSettings({{"r.RT.Debug.GI.Fallback", "0"}}), ""); }

FStabilityFault MakePlanesFault(const FMethod&) { return MakeFault(KnownSettings({{"r.RT.Shadow.CasterFaces", "2"}}), ""); }
} // namespace

std::span<const FStabilityCase> GetStabilityCases()
{
	static const std::vector<FStabilityCase> Cases = {
	    {1, "thin wall", {Sun, Diffuse, Reflected}, MeasureThinWall, MakeThinWallFault},
	    {2, "edge and level of detail", {}},
	    {3, "nested votes", {Diffuse}, MeasureTemple, nullptr, "the sun is 20 % brighter"},
	    {4, "light switch", {Diffuse, LampDiffuse, LampSpecular}, MeasureLightSwitch, MakeStaleLampsFault},
	    {5, "time of day", {Sun, Diffuse, Reflected}, MeasureTimeOfDay, nullptr, "the plugin is not told that the sun moves"},
	    {6, "flicker", {Diffuse, LampDiffuse, LampSpecular}, MeasureFlicker, MakeStaleLampsFault},
	    {7, "tiny emitters", {Diffuse, LampDiffuse, Reflected}, MeasureTinyEmitters, nullptr, "a fifth of the candles is out"},
	    {8, "boiling", {Diffuse, LampDiffuse, LampSpecular}, MeasureBoiling, MakeBlindLampsFault},
	    {9, "disocclusion", EverySignal(false, ELamps::Yes), MeasureDisocclusion, MakeUncoveringFault},
	    {10, "ghost", EverySignal(false, ELamps::Yes), MeasureGhost, MakeStaleFault},
	    {11, "shadow lag", {Sun, LampDiffuse}, MeasureShadowLag, nullptr, "the fan is where it was three frames ago"},
	    {12, "mover in a mirror", {Reflected}, MeasureMirrorGhost, MakeStaleMirrorFault},
	    {13, "thin specular", {LampSpecular}, MeasureThinSpecular, MakeBlindLampsFault},
	    {14, "not a number", EverySignal(true), MeasureNotANumber, MakeUnguardedFault},
	    {15, "huge mesh", {}},
	    {16, "hash overflow", {Diffuse}, MeasureHashOverflow, MakeDarkFault},
	    {17, "light grid", {LampDiffuse}, MeasureLightGrid, nullptr, "every other metre is 5 % brighter"},
	    {18, "frame rate", EverySignal(false, ELamps::Yes), MeasureFrameRate, nullptr,
	        "every frame is said to last 1/60 s, and changes are not looked for"},
	    {19, "furnace", {Diffuse, Reflected}, MeasureFurnace, nullptr, "the sky is 5 % brighter"},
	    {20, "hybrid seams", {Sun, Occlusion, Diffuse, LampDiffuse, Reflected}, MeasureSeams, MakeSeamsFault},
	    {21, "caustics", {}},
	    {22, "toon edge", {Diffuse}, MeasureToonEdge, MakeForgetfulFault},
	    {23, "fog volume", {}},
	    {24, "far from the origin", EverySignal(true), MeasureFarAway, nullptr, "the camera is moved in steps of 1/16 m"},
	    {25, "single-sided plane", {Sun}, MeasurePlanes, MakePlanesFault},
	    {26, "missing shaders", {}, MeasureMissingShaders, nullptr, "missing shaders are left out, and colours are of other materials",
	        true},
	    {27, "odd sizes", EverySignal(true), MeasureOddSizes, nullptr, "columns beyond the last whole tile of 8 are missing"},
	    {28, "door", {Diffuse}, MeasureDoor, MakeStaleLampsFault},
	    {29, "mirror room", {Diffuse, Reflected}, MeasureMirrorRoom, nullptr, "the lamp is a tenth brighter"},
	    {30, "carried emitter", {Diffuse, LampDiffuse}, MeasureCarriedEmitter, MakeStaleFault},
	    {31, "cut and resize", {Occlusion, Diffuse, LampDiffuse}, MeasureCuts, MakeUncoveringFault},
	    {32, "streaming", {Diffuse, LampDiffuse}, MeasureStreaming, MakeStaleLampsFault},
	};
	return Cases;
}

} // namespace Lantern
