// What the facts of a scene cost.
#include <functional>

#include "LanternMeasure/MeasureFigures.h"
#include "LanternMeasure/MeasureMethod.h"

namespace Lantern
{

namespace
{
/// One fact: how the scene goes without it, and back.
struct FFact
{
	const char* Name;
	bool bThere = false;
	std::function<void(FSampleEngine&, bool bWithout)> Set;
	bool bHoldsTime = false; ///< without it time stands
};

std::vector<FFact> FindFacts(FSampleEngine& Engine)
{
	FHostScene& Host = Engine.GetScene();
	const FSceneFacts& Facts = Host.GetScene().GetFacts();
	const FSunLight Sun = Host.GetScene().GetSun();
	const glm::vec3 Sky = Host.GetScene().GetSky();
	std::vector<FFact> Out;
	Out.push_back({"alpha tests", Facts.bMasked, [](FSampleEngine&, bool) {}});
	Out.push_back({Facts.DynamicGeometries > 0 ? "skinning" : "animation", Host.IsAnimated(), [](FSampleEngine&, bool) {}, true});
	Out.push_back({"local lights", Facts.Lights > 0, [](FSampleEngine& E, bool bWithout) { E.GetScene().SetSceneLights(!bWithout); }});
	Out.push_back({"sun", Facts.bSun, [Sun](FSampleEngine& E, bool bWithout) {
		               FSunLight Light = Sun;
		               if (bWithout) { Light.Irradiance = 0.0f; }
		               E.GetScene().SetSun(Light);
	               }});
	Out.push_back({"sky", Facts.bSky && !Facts.bSkyProgram,
	    [Sky](FSampleEngine& E, bool bWithout) { E.GetScene().GetScene().SetSky(bWithout ? glm::vec3(0) : Sky); }});
	std::erase_if(Out, [](const FFact& Fact) { return !Fact.bThere; });
	return Out;
}

/// Frames of one round, the first WarmUp of which do not count.
struct FRound
{
	FSampleEngine& Engine;
	const FFactSettings& Settings;
	double Clock = 0.0; ///< of the animation: each round goes on where the last one stopped
	FRTStatus Play(bool bHoldTime, std::vector<double>& OutMs, double& OutSeconds)
	{
		FScript Script;
		for (uint32_t I = 0; I < Settings.WarmUp + Settings.FramesPerRound; ++I)
		{
			FScriptFrame Frame;
			Frame.View = Settings.View;
			Frame.Time = Settings.Time + (bHoldTime ? 0.0 : Clock += double(Settings.View.DeltaSeconds));
			Frame.bCapture = false;
			Script.push_back(Frame);
		}
		FPlaySettings Play;
		Play.bKeepHistory = true;
		return PlayScript(Engine, Script, Play, [&](FPlayedFrame& Frame) {
			if (Frame.Index < Settings.WarmUp) { return true; }
			if (const double Ms = Frame.GetGpuMs(); Ms >= 0.0) { OutMs.push_back(Ms); }
			OutSeconds += Frame.Seconds;
			return true;
		});
	}
};

FRTStatus PlayWithout(FRound& Round, const FFact& Fact, std::vector<double>& OutMs, double& OutSeconds)
{
	FMethodScope Scope;
	if (std::string_view(Fact.Name) == "alpha tests") { Scope.Apply({{"r.RT.AlphaTest", "0", "facts"}}); }
	Fact.Set(Round.Engine, true);
	const FRTStatus S = Round.Play(Fact.bHoldsTime, OutMs, OutSeconds);
	Fact.Set(Round.Engine, false);
	return S;
}
} // namespace

FRTStatus MeasureFacts(FSampleEngine& Engine, const FMethods& Methods, const FMethod* Method, const FMethodPreset* Preset,
    const FFactSettings& Settings, std::vector<FFactCost>& Out, EMeasureEnd& OutEnd)
{
	OutEnd = EMeasureEnd::Done;
	FMethodScope Scope;
	if (!Scope.Apply(Methods, Method, Preset).empty())
	{
		OutEnd = EMeasureEnd::Refused;
		return FRTStatus::Success();
	}
	// Facts are known after a frame. The second tells how long frames take.
	FFactSettings Probe = Settings;
	Probe.WarmUp = Probe.FramesPerRound = 1;
	std::vector<double> Ms;
	double Seconds = 0.0;
	if (FRTStatus S = FRound{Engine, Probe}.Play(true, Ms, Seconds); !S) { return S; }
	const std::vector<FFact> Facts = FindFacts(Engine);
	const double Frames = double(Facts.size() + 1) * Settings.Rounds * (Settings.WarmUp + Settings.FramesPerRound);
	if (Settings.MaxSeconds > 0.0 && Seconds * Frames > Settings.MaxSeconds)
	{
		OutEnd = EMeasureEnd::TooLong;
		return FRTStatus::Success();
	}
	FRound Round{Engine, Settings};
	std::vector<double> With;
	std::vector<std::vector<double>> Without(Facts.size());
	for (uint32_t I = 0; I < Settings.Rounds; ++I)
	{
		if (FRTStatus S = Round.Play(false, With, Seconds); !S) { return S; }
		for (size_t F = 0; F < Facts.size(); ++F)
		{
			if (FRTStatus S = PlayWithout(Round, Facts[F], Without[F], Seconds); !S) { return S; }
		}
	}
	for (size_t F = 0; F < Facts.size(); ++F)
	{
		const auto A = ComputeMedian(With), B = ComputeMedian(Without[F]);
		if (A && B) { Out.push_back({Facts[F].Name, *A, *B}); }
	}
	return FRTStatus::Success();
}

} // namespace Lantern
