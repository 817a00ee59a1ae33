// The sample engine, which the plugin runs in if there is no other: loads a scene, renders frames, reads pictures back.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "LanternHost/GBufferPass.h"
#include "LanternHost/ShadowMapPass.h"
#include "LanternImage/Image.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// The pictures of a frame to read back.
struct FFrameCapture
{
	bool bLighting = false; ///< linear radiance
	bool bDisplay = false;  ///< tone-mapped
	/// Signals as in FFrameOutputs, with 1 or 3 channels; empty if the frame does not have one. A signal is traced even if the
	/// composite does not use it. ESignal::Frame is an alias of bLighting.
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
	/// Compiles the shaders of all later frames with Capture, unless settings change, and waits for it. Progress gets 0 to 1 and may
	/// be empty. The result is an error only if a picture would not be complete.
	FRTStatus Precache(const FFrameCapture& Capture, const std::function<void(float)>& Progress);
	FHostScene& GetScene() { return *Scene; }
	FRenderer& GetRenderer() { return Renderer; }

	/// Moves the scene to Time (seconds), so that it can be queried between frames.
	void SeekTo(double Time);
	/// Moves the scene to Time, and returns what the next frame must skin. The list is empty if the previous frame had this time.
	std::vector<FSkinningInputs> MoveTo(double Time);
	/// Returns the scene's time; absent before the first frame.
	std::optional<double> GetTime() const { return LastTime; }
	/// Renders one frame at Time (seconds), and waits for it if something is captured. Sets the view's FrameIndex; the caller
	/// sets DeltaSeconds and bCut, which temporal accumulation follows.
	FRTStatus RenderFrame(const FView& View, double Time, const FFrameCapture& Capture, FCapturedFrame* Out);
	/// Adds the raster to a frame that the caller began with this engine's renderer and scene.
	FGBuffer AddGBuffer(FFrameContext& Context) { return GBufferPass.Add(Context, *Scene); }
	/// Adds passes of a test or benchmark; called after the plugin's own passes.
	std::function<void(FFrameContext&, const FGBuffer&, const FFrameOutputs&)> ExtraPasses;
	/// On: frames do not wait for pipelines, and builds keep to their budget, as in a game. Off: every frame is complete.
	bool bRealTime = false;
	/// On: every frame is shown, as in a game. Off: passes run only if their results are captured.
	bool bPresent = false;
	/// Signals to make in every frame, captured or not, so that they have accumulated when they are captured.
	FSignalRequests Signals;
	/// Returns the index of the next frame.
	uint32_t GetFrameIndex() const { return FrameIndex; }
	/// Sets the index of the next frame. Random numbers depend on it: frames of equal index and seed draw equal numbers.
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
	FFrameFeatures MakeFeatures(const FFrameCapture& Capture) const;
	FRTStatus AddReadback(FFrameContext& Context, FGraphTexture Texture, FReadback& Out);
	void KeepSignals(const FFrameOutputs& Frame);
	FRTStatus AddReadbacks(const FFrameOutputs& Frame, const FFrameCapture& Capture, FReadbacks& Out);
	static void DecodeReadbacks(const FReadbacks& Readbacks, const FFrameCapture& Capture, FCapturedFrame& Out);

	FRenderer Renderer;
	FGBufferPass GBufferPass;
	FShadowMapPass ShadowMapPass;
	std::unique_ptr<FHostScene> Scene;
	std::optional<double> LastTime;
	std::vector<FSkinningInputs> Skinning; // that no frame has done yet
	uint32_t FrameIndex = 0;
};

} // namespace Lantern
