// The filter's console variables, defined once for all signals.
#include "Denoise/DenoiseVariables.h"

#include <optional>
#include <string>

namespace Lantern
{

namespace
{
const FDenoiseSettings Common;

/// A variable whose name is made at start-up.
template <class T>
class TNamedVariable : public TRTConsoleVariable<T>
{
public:
	TNamedVariable(const std::string& Name, T Default, const std::string& Help, FRTCVarRange Range = {})
	    : TRTConsoleVariable<T>(Name.c_str(), Default, Help.c_str(), Range)
	{}
};
} // namespace

struct FDenoiseVariables::FVariables
{
	FVariables(const std::string& Prefix, const FDenoiseDefaults& Defaults)
	    : Denoise(Prefix + ".Denoise", true,
	          "Accumulates the signal over frames and smooths it along surfaces. If off, it is as noisy as its rays."),
	      HistorySeconds(Prefix + ".HistorySeconds", Defaults.HistorySeconds,
	          "Time constant of what " + Prefix + ".Denoise accumulates, in seconds. 0: nothing is accumulated.", {0.0, 60.0}),
	      ChangeSigma(Prefix + ".ChangeSigma", Common.ChangeSigma,
	          "Accumulation starts anew where the signal has changed by more than this many standard errors. 0: never.", {0.0, 100.0}),
	      FilterPasses(Prefix + ".FilterPasses", static_cast<int32_t>(Defaults.Passes),
	          "Number of passes of the spatial filter; n of them reach 2^n - 1 pixels.", {0, 5}),
	      FilterSigma(Prefix + ".FilterSigma", Defaults.SigmaValue,
	          "Differences below this many standard deviations are noise to the spatial filter.", {0.0, 100.0})
	{
		if (Defaults.bExtent)
		{
			FilterReach.emplace(Prefix + ".FilterReach", Common.ReachExtent, "Reach of the spatial filter, in widths of the penumbra.",
			    FRTCVarRange{0.001, 100.0});
		}
		if (!Defaults.bColor)
		{
			Resampling.emplace(Prefix + ".Resampling", Common.Resampling,
			    "Share of the difference between neighbours that counts as error where accumulated values are resampled between them.",
			    FRTCVarRange{0.0, 100.0});
		}
		else
		{
			ClampSigma.emplace(Prefix + ".ClampSigma", Defaults.ClampSigma,
			    "Accumulated colours stay within the neighbourhood's mean, plus or minus this many standard deviations. 0: no limit.",
			    FRTCVarRange{0.0, 100.0});
		}
	}

	TNamedVariable<bool> Denoise;
	TNamedVariable<float> HistorySeconds, ChangeSigma;
	TNamedVariable<int32_t> FilterPasses;
	TNamedVariable<float> FilterSigma;
	std::optional<TNamedVariable<float>> FilterReach, ClampSigma, Resampling;
};

FDenoiseVariables::FDenoiseVariables(const char* Prefix, const FDenoiseDefaults& Defaults)
    : Variables(std::make_unique<FVariables>(Prefix, Defaults))
{}

FDenoiseVariables::~FDenoiseVariables() = default;

bool FDenoiseVariables::IsEnabled() const { return Variables->Denoise.GetOnRenderThread(); }

FDenoiseSettings FDenoiseVariables::Get() const
{
	FDenoiseSettings Settings;
	Settings.HistorySeconds = Variables->HistorySeconds.GetOnRenderThread();
	Settings.ChangeSigma = Variables->ChangeSigma.GetOnRenderThread();
	if (Variables->Resampling) { Settings.Resampling = Variables->Resampling->GetOnRenderThread(); }
	Settings.Passes = static_cast<uint32_t>(Variables->FilterPasses.GetOnRenderThread());
	Settings.SigmaValue = Variables->FilterSigma.GetOnRenderThread();
	if (Variables->ClampSigma) { Settings.ClampSigma = Variables->ClampSigma->GetOnRenderThread(); }
	if (Variables->FilterReach) { Settings.ReachExtent = Variables->FilterReach->GetOnRenderThread(); }
	return Settings;
}

} // namespace Lantern
