// The little engine that the plugin runs in when there is no other: loads a scene, renders frames, reads pictures.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "LanternHost/HostScene.h"
#include "LanternImage/Image.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// What of a frame is read back.
struct FFrameCapture
{
	bool bLighting = false; ///< linear radiance
	bool bDisplay = false;  ///< tone-mapped
	/// Each as FFrameOutputs has it, 1 or 3 channels; nothing where the frame does not have it. What is asked for here is
	/// made also where the composite has no use for it. ESignal::Frame is bLighting by another name.
	FSignalSet Signals;
	bool Wants(ESignal Signal) const { return Signals.Has(Signal); }
};

struct FCapturedFrame
{
	FImage Lighting, Display;
	std::array<FImage, SignalCount> Signals;
	FImage& Get(ESignal Signal) { return Signals[ToIndex(Signal)]; }
	const FImage& Get(ESignal Signal) const { return Signals[ToIndex(Signal)]; }
};

class FSampleEngine
{
public:
	FSampleEngine(IRTDevice& Device, FRendererDesc Desc);
	/// Replaces the scene. Progress may be empty.
	FRTStatus Load(FSceneDescription Description, const std::function<void(float)>& Progress = {});
	FHostScene& GetScene() { return *Scene; }
	FRenderer& GetRenderer() { return Renderer; }

	/// Moves the scene to Time (seconds), for whoever asks it something between frames.
	void SeekTo(double Time);
	/// The same; returns what the next frame must skin: nothing where the scene was there in the frame before.
	std::vector<FSkinningInputs> MoveTo(double Time);
	/// Where it is; nothing before the first frame.
	std::optional<double> GetTime() const { return LastTime; }
	/// Renders one frame at Time (seconds) and, where something is captured, waits for it. The view's FrameIndex is set here;
	/// its DeltaSeconds and bCut are the caller's: what is accumulated over frames follows them.
	FRTStatus RenderFrame(const FView& View, double Time, const FFrameCapture& Capture, FCapturedFrame* Out);
	/// The raster of a frame that somebody else began with this engine's renderer and scene.
	FGBuffer AddGBuffer(FFrameContext& Context) { return GBufferPass.Add(Context, *Scene); }
	const FGBufferPass& GetGBufferPass() const { return GBufferPass; }
	/// Extra passes of a test or benchmark: called after the plugin's own.
	std::function<void(FFrameContext&, const FGBuffer&, const FFrameOutputs&)> ExtraPasses;
	/// Frames wait for no pipeline and builds keep to their budget, as in a game; off: every frame is complete.
	bool bRealTime = false;
	/// Every frame is shown, as in a game. Off: passes whose results nobody captures do not run.
	bool bPresent = false;
	/// Asked for in every frame, captured or not: what a signal accumulates over frames is then there when it is captured.
	FSignalRequests Signals;
	/// How often ExtraPasses etc. find the frame: index of the next one.
	uint32_t GetFrameIndex() const { return FrameIndex; }
	/// Random numbers follow the index: two frames of the same index and seed draw the same.
	void SetFrameIndex(uint32_t Index) { FrameIndex = Index; }

private:
	struct FReadback
	{
		FGraphTexture Texture;
		TRTRef<IRTBuffer> Buffer;
		uint32_t Width = 0, Height = 0;
		ERTFormat Format = ERTFormat::Unknown;
	};
	struct FReadbacks
	{
		FReadback Lighting, Display;
		std::array<FReadback, SignalCount> Signals;
	};
	FRTStatus AddReadback(FFrameContext& Context, FGraphTexture Texture, FReadback& Out);
	void KeepSignals(const FFrameOutputs& Frame);
	FRTStatus AddReadbacks(const FFrameOutputs& Frame, const FFrameCapture& Capture, FReadbacks& Out);
	static void DecodeReadbacks(const FReadbacks& Readbacks, const FFrameCapture& Capture, FCapturedFrame& Out);

	FRenderer Renderer;
	FGBufferPass GBufferPass;
	std::unique_ptr<FHostScene> Scene;
	std::optional<double> LastTime;
	std::vector<FSkinningInputs> Skinning; // that no frame has done yet
	uint32_t FrameIndex = 0;
};

} // namespace Lantern
