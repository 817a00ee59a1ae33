// Plays a script through the sample engine and collects pictures and timings.
#include "LanternMeasure/MeasureSequence.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <string_view>

#include "LanternCore/FrameGraph/History.h"

namespace Lantern
{

namespace
{
/// Puts back what playing changes in the engine.
class FEngineState
{
public:
	explicit FEngineState(FSampleEngine& InEngine) : Engine(InEngine), Signals(Engine.Signals), bRealTime(Engine.bRealTime) {}
	~FEngineState()
	{
		Engine.Signals = Signals;
		Engine.bRealTime = bRealTime;
	}
	FEngineState(const FEngineState&) = delete;
	FEngineState& operator=(const FEngineState&) = delete;

private:
	FSampleEngine& Engine;
	FSignalRequests Signals;
	bool bRealTime;
};

template <class T>
double SumPasses(const std::vector<FPassTiming>& Passes, T&& IsWanted)
{
	double Sum = 0.0;
	for (const FPassTiming& Pass : Passes)
	{
		if (!IsWanted(Pass.Name)) { continue; }
		if (Pass.GpuMs < 0.0) { return -1.0; }
		Sum += Pass.GpuMs;
	}
	return Sum;
}

bool IsOfSignal(std::string_view Pass, ESignal Signal)
{
	const FSignalInfo& Info = GetSignalInfo(Signal);
	if (Pass == "HalfFrame") { return true; } // runs for signals of half the resolution alone
	return Pass.starts_with(Info.Pass) || (*Info.SharedPass && Pass.starts_with(Info.SharedPass)); // "": all passes are the frame's
}

FRTStatus StartAnew(FSampleEngine& Engine)
{
	FRenderer& Renderer = Engine.GetRenderer();
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	Renderer.ClearHistories();
	Renderer.GetGraphResources().Trim(0);
	Engine.SetFrameIndex(0);
	return FRTStatus::Success();
}

FRTStatus PlayFrame(
    FSampleEngine& Engine, const FScriptFrame& Frame, const FFrameCapture& Capture, const FPlaySettings& Settings, FPlayedFrame& Out)
{
	const auto Start = std::chrono::steady_clock::now();
	if (Frame.Change) { Frame.Change(Engine); }
	FRenderer& Renderer = Engine.GetRenderer();
	// Asked for in every frame, if only looked at in some: what nobody reads is culled.
	if (FRTStatus S = Engine.RenderFrame(Frame.View, Frame.Time, Capture, Frame.bCapture && Settings.bWait ? &Out.Images : nullptr); !S)
	{
		return S;
	}
	// So that the newest finished frame is this one.
	if (FRTStatus S = Settings.bWait ? Renderer.WaitForAll() : FRTStatus::Success(); !S) { return S; }
	Out.Passes = GetTimings(Renderer);
	std::erase_if(Out.Passes, [](const FPassTiming& Pass) { return Pass.Name == "Readback"; });
	Out.LiveBytes = Renderer.GetDevice().GetMemoryStats().Total;
	Out.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - Start).count();
	return FRTStatus::Success();
}
} // namespace

std::vector<FPassTiming> GetTimings(FRenderer& Renderer)
{
	std::vector<FPassTiming> Timings = Renderer.GetGraphResources().GetTimings();
	for (const auto& [Name, Rays] : Renderer.GetRayCounts().Passes)
	{
		for (FPassTiming& Pass : Timings) { Pass.Rays = Pass.Name == Name ? Rays : Pass.Rays; }
	}
	return Timings;
}

double FPlayedFrame::GetGpuMs() const
{
	return SumPasses(Passes, [](const std::string&) { return true; });
}

double FPlayedFrame::GetGpuMs(ESignal Signal) const
{
	return SumPasses(Passes, [&](const std::string& Name) { return IsOfSignal(Name, Signal); });
}

uint64_t FPlayedFrame::GetRays(ESignal Signal) const
{
	uint64_t Rays = 0;
	for (const FPassTiming& Pass : Passes) { Rays += IsOfSignal(Pass.Name, Signal) ? Pass.Rays : 0; }
	return Rays;
}

FRTStatus PlayScript(
    FSampleEngine& Engine, const FScript& Script, const FPlaySettings& Settings, const std::function<bool(FPlayedFrame&)>& OnFrame)
{
	const FEngineState State(Engine);
	FFrameCapture Capture;
	Capture.bLighting = true;
	for (const ESignal Signal : Settings.Signals)
	{
		Capture.Signals.Add(Signal);
		Engine.Signals.Wanted.Add(Signal);
	}
	Engine.bRealTime = Settings.bRealTime;
	if (!Settings.bKeepHistory)
	{
		if (FRTStatus S = StartAnew(Engine); !S) { return S; }
	}
	for (size_t I = 0; I < Script.size(); ++I)
	{
		FPlayedFrame Frame;
		Frame.Index = static_cast<uint32_t>(I);
		if (FRTStatus S = PlayFrame(Engine, Script[I], Capture, Settings, Frame); !S) { return S; }
		if (OnFrame && !OnFrame(Frame)) { break; }
	}
	return FRTStatus::Success();
}

FRTStatus GetScriptReferences(FSampleEngine& Engine, const FScript& Script, const std::vector<uint32_t>& Indices,
    const FSignalReferenceDesc& InDesc, FScriptReferences& Out)
{
	assert(std::is_sorted(Indices.begin(), Indices.end()) && (Indices.empty() || Indices.back() < Script.size()));
	uint32_t Next = 0;
	for (size_t I = 0; I < Indices.size(); ++I)
	{
		const uint32_t Index = Indices[I];
		for (; Next <= Index; ++Next)
		{
			if (Script[Next].Change) { Script[Next].Change(Engine); }
		}
		FSignalReferenceDesc Desc = InDesc;
		Desc.View = Script[Index].View;
		Desc.Time = Script[Index].Time;
		if (!Desc.StateKey.empty()) { Desc.StateKey += '#' + std::to_string(Index); }
		if (InDesc.Progress)
		{
			Desc.Progress = [&](double Done, double) { InDesc.Progress((double(I) + Done) / double(Indices.size()), 0.0); };
		}
		if (FRTStatus S = GetSignalReference(Engine, Desc, Out.Frames[Index]); !S) { return S; }
	}
	return FRTStatus::Success();
}

} // namespace Lantern
