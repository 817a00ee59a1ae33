// Measures one method on one path: settings, frames, errors, times.
#include "LanternMeasure/MeasureMethod.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "LanternCore/FrameGraph/History.h"
#include "LanternMeasure/MeasureFigures.h"

namespace Lantern
{

namespace
{
bool IsIn(const std::vector<uint32_t>& Sorted, uint32_t Index) { return std::binary_search(Sorted.begin(), Sorted.end(), Index); }

/// Takes figures from frames as they come.
class FMeter
{
public:
	FMeter(const FMethod& InMethod, const FPathScript& InPath, const FPathReferences& InReferences, const FMeasureSettings& InSettings,
	    FMeasureResult& InOut)
	    : Signal(InMethod.Signal),
	      Path(InPath),
	      References(InReferences),
	      Settings(InSettings),
	      Out(InOut)
	{}
	/// False: that was enough.
	bool Take(FPlayedFrame& Frame)
	{
		FMethodFigures& Figures = Out.Figures;
		Figures.Seconds += Frame.Seconds;
		++Figures.Frames;
		Figures.PeakBytes = std::max(Figures.PeakBytes, Frame.LiveBytes);
		const FImage& F = Frame.Images.Get(Signal);
		const bool bSwitched = Path.FirstSwitched && Frame.Index >= *Path.FirstSwitched;
		if (bSwitched && F.IsEmpty()) { return TakeSwitched(MakeBlack()); } // the light was all that the signal had
		if (Path.Script[Frame.Index].bCapture && F.IsEmpty()) { return Stop(EMeasureEnd::NoSignal); }
		if (IsTooLong(Frame)) { return Stop(EMeasureEnd::TooLong); }
		TakeCost(Frame);
		TakeErrors(Frame, F);
		return bSwitched ? TakeSwitched(F) : true;
	}
	/// A frame that followed the one before without a pause. Between frames that are read back a GPU lowers its clock.
	bool TakeBusy(const FPlayedFrame& Frame)
	{
		if (Frame.Index == 0) { GpuMs.clear(), FrameGpuMs.clear(); }
		return Frame.Index < Path.FirstTimed || TakeTimes(Frame);
	}
	void Finish()
	{
		FMethodFigures& Figures = Out.Figures;
		Figures.GpuMs = ComputeMedian(GpuMs);
		Figures.FrameGpuMs = ComputeMedian(FrameGpuMs);
		if (RelMseCount > 0) { Figures.RelMse = RelMseSum / RelMseCount; }
		if (Path.bStill) { Figures.Sigma = Deviation.GetSigma(); }
		if (T90.GetFrameCount() > 0)
		{
			Figures.bT90Reached = T90.IsDone();
			Figures.T90Frames = T90.Get().value_or(T90.GetFrameCount());
		}
	}

private:
	bool Stop(EMeasureEnd End)
	{
		Out.End = End;
		return false;
	}
	bool IsTooLong(const FPlayedFrame& Frame)
	{
		// The first frame compiles and builds, which says nothing of the others.
		if (Settings.MaxSeconds <= 0.0 || Frame.Index == 0 || Frame.Index > Path.FirstTimed) { return false; }
		const uint32_t Frames = CountPathFrames(Path);
		const double Expected = Out.Figures.Seconds + Frame.Seconds * double(Frames - std::min(Frames, Frame.Index + 1));
		if (Expected <= Settings.MaxSeconds) { return false; }
		Out.Figures.Seconds = Expected;
		return true;
	}
	void TakeCost(const FPlayedFrame& Frame)
	{
		FMethodFigures& Figures = Out.Figures;
		if (Frame.Index + 1 == Path.FirstTimed)
		{
			Figures.MemoryBytes = Frame.LiveBytes - std::min(Frame.LiveBytes, Settings.BaselineBytes);
		}
		if (Frame.Index < Path.FirstTimed || Frame.Index >= Path.FirstTimed + Path.TimedCount) { return; }
		TakeTimes(Frame);
		const FView& View = Path.Script[Frame.Index].View;
		Figures.RaysPerPixel = std::max(Figures.RaysPerPixel, double(Frame.GetRays(Signal)) / (double(View.Width) * View.Height));
	}
	bool TakeTimes(const FPlayedFrame& Frame)
	{
		if (const double Ms = Frame.GetGpuMs(Signal); Ms >= 0.0) { GpuMs.push_back(Ms); }
		if (const double Ms = Frame.GetGpuMs(); Ms >= 0.0) { FrameGpuMs.push_back(Ms); }
		return true;
	}
	void TakeErrors(FPlayedFrame& Frame, const FImage& F)
	{
		FMethodFigures& Figures = Out.Figures;
		if (IsIn(Path.ErrorFrames, Frame.Index))
		{
			if (const auto Error = ComputeUnbiasedRelMse(F, References.Home))
			{
				RelMseSum += *Error;
				++RelMseCount;
			}
			if (Path.bStill) { Deviation.Add(F); }
		}
		if (Path.GhostFrame == Frame.Index && References.Before)
		{
			Figures.Ghost = ComputeProjection(F, References.Home, *References.Before);
		}
		if (Frame.Index != Path.PictureFrame) { return; }
		Figures.Flip = ComputeSignalFlip(Signal, F, References.Home.Mean, &Figures.FlipMap);
		Figures.Leak = ComputeLeak(F, References.Home.Mean);
		Figures.Picture = F;
	}
	FImage MakeBlack() const
	{
		FImage Black = References.Home.Mean;
		std::fill(Black.Pixels.begin(), Black.Pixels.end(), 0.0f);
		return Black;
	}
	bool TakeSwitched(const FImage& F)
	{
		if (!References.Switched) { return false; }
		const auto Projection = ComputeProjection(F, *References.Switched, References.Home);
		if (!Projection) { return false; }
		T90.Add(*Projection);
		return !T90.IsDone();
	}

	const ESignal Signal;
	const FPathScript& Path;
	const FPathReferences& References;
	const FMeasureSettings& Settings;
	FMeasureResult& Out;
	std::vector<double> GpuMs, FrameGpuMs;
	double RelMseSum = 0.0;
	uint32_t RelMseCount = 0;
	FTemporalDeviation Deviation;
	FFramesTo90 T90;
};

std::string Join(const std::vector<std::string>& Lines)
{
	std::string Text;
	for (const std::string& Line : Lines) { Text += (Text.empty() ? "" : "; ") + Line; }
	return Text;
}

/// The script up to where the light is switched, where the signal has no use for that.
FScript CutScript(const FPathScript& Path, const FPathReferences& References)
{
	FScript Script = Path.Script;
	if (Path.FirstSwitched && !References.Switched) { Script.resize(*Path.FirstSwitched); }
	return Script;
}
} // namespace

FRTStatus GetPathReferences(FSampleEngine& Engine, const FPathScript& Path, const FPathReferenceSettings& Settings,
    const FLightSwitch& Switch, FPathReferences& Out)
{
	constexpr uint32_t ReferenceSeed = 0x6c616e74;
	const auto Get = [&](uint32_t Frame, uint32_t SeedOffset, uint32_t Samples, FSignalReference& Reference) {
		FSignalReferenceDesc Desc;
		Desc.View = Path.Script[Frame].View;
		Desc.Time = Path.Script[Frame].Time;
		Desc.Signal = Settings.Signal;
		Desc.Samples = std::max(2u, Samples);
		// Not the numbers that frames draw, nor those of another reference: what is compared must be independent.
		Desc.Seed = Settings.Seed + ReferenceSeed + SeedOffset;
		Desc.CacheFolder = Settings.CacheFolder;
		Desc.Progress = Settings.Progress;
		return GetSignalReference(Engine, Desc, Reference);
	};
	Switch.Set(Engine.GetScene(), false);
	// Another path of the signal may have brought it.
	if (Out.Home.A.IsEmpty())
	{
		if (FRTStatus S = Get(Path.PictureFrame, 0, Settings.Samples, Out.Home); !S) { return S; }
	}
	if (Path.BeforeFrame)
	{
		if (FRTStatus S = Get(*Path.BeforeFrame, 1, Settings.OtherSamples, Out.Before.emplace()); !S) { return S; }
	}
	if (!Path.FirstSwitched || !GetSignalInfo(Settings.Signal).bLit) { return FRTStatus::Success(); }
	Switch.Set(Engine.GetScene(), true);
	const FRTStatus S = Get(*Path.FirstSwitched, 2, Settings.OtherSamples, Out.Switched.emplace());
	Switch.Set(Engine.GetScene(), false);
	return S;
}

FRTStatus MeasureMethod(FSampleEngine& Engine, const FMethods& Methods, const FMethod& Method, const FMethodPreset& Preset,
    const FPathScript& Path, const FPathReferences& References, const FLightSwitch& Switch, const FMeasureSettings& Settings,
    FMeasureResult& Out)
{
	FMethodScope Scope;
	if (const std::vector<std::string> Refused = Scope.Apply(Methods, &Method, &Preset); !Refused.empty())
	{
		Out.End = EMeasureEnd::Refused;
		Out.Reason = Join(Refused);
		return FRTStatus::Success();
	}
	FMeter Meter(Method, Path, References, Settings, Out);
	FPlaySettings Play;
	Play.Signals = {Method.Signal};
	FRTStatus S = PlayScript(Engine, CutScript(Path, References), Play, [&](FPlayedFrame& Frame) { return Meter.Take(Frame); });
	if (S && Out.End == EMeasureEnd::Done && !Engine.GetRenderer().GetDevice().GetCapabilities().bIsCpu)
	{
		Switch.Set(Engine.GetScene(), false);
		Play.bWait = false;
		const FScript Busy(Path.Script.begin(), Path.Script.begin() + Path.FirstTimed + Path.TimedCount);
		S = PlayScript(Engine, Busy, Play, [&](FPlayedFrame& Frame) { return Meter.TakeBusy(Frame); });
	}
	Switch.Set(Engine.GetScene(), false);
	Meter.Finish();
	return S;
}

uint32_t CountPathFrames(const FPathScript& Path)
{
	return Path.FirstSwitched ? *Path.FirstSwitched + 2 : static_cast<uint32_t>(Path.Script.size());
}

FRTStatus ProbeMethod(FSampleEngine& Engine, const FMethods& Methods, const FMethod& Method, const FMethodPreset& Preset, const FView& View,
    double Time, FMethodProbe& Out)
{
	FMethodScope Scope;
	Scope.Apply(Methods, &Method, &Preset);
	FScriptFrame Frame;
	Frame.View = View;
	Frame.Time = Time;
	FPlaySettings Play;
	Play.Signals = {Method.Signal};
	const FRTStatus S = PlayScript(Engine, FScript(2, Frame), Play, [&](FPlayedFrame& Played) {
		Out.bSignal = !Played.Images.Get(Method.Signal).IsEmpty();
		Out.FrameSeconds = Played.Seconds;
		return Out.bSignal;
	});
	Out.bHistory = Engine.GetRenderer().GetHistoryBytes() > 0;
	return S;
}

FRTStatus MeasureBaseline(FSampleEngine& Engine, const FMethods& Methods, const FView& View, double Time, uint64_t& OutBytes)
{
	FMethodScope Scope;
	Scope.Apply(Methods, nullptr, nullptr);
	FScriptFrame Frame;
	Frame.View = View;
	Frame.Time = Time;
	Frame.bCapture = false;
	return PlayScript(Engine, FScript(4, Frame), {}, [&](FPlayedFrame& Played) {
		OutBytes = Played.LiveBytes;
		return true;
	});
}

} // namespace Lantern
