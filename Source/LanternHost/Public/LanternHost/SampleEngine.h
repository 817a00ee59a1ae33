// The little engine that the plugin runs in when there is no other: loads a scene, renders frames, reads pictures.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "LanternHost/HostScene.h"
#include "LanternHost/Image.h"

namespace Lantern
{

/// What of a frame is read back.
struct FFrameCapture
{
	bool bLighting = false;   ///< linear radiance
	bool bDisplay = false;    ///< tone-mapped
	bool bSunShadow = false;  ///< visibility; nothing where the frame has no sun shadows
};

struct FCapturedFrame
{
	FImage Lighting, Display, SunShadow;
};

class FSampleEngine
{
public:
	FSampleEngine(IRTDevice& Device, FRendererDesc Desc);
	/// Replaces the scene. Progress may be empty.
	FRTStatus Load(FSceneDescription Description, const std::function<void(float)>& Progress = {});
	FHostScene& GetScene() { return *Scene; }
	FRenderer& GetRenderer() { return Renderer; }

	/// Moves the scene to Time (seconds); returns what the next frame must skin: nothing where the scene is there already.
	std::vector<FSkinningInputs> MoveTo(double Time);
	/// Renders one frame at Time (seconds) and, where something is captured, waits for it.
	FRTStatus RenderFrame(const FView& View, double Time, const FFrameCapture& Capture, FCapturedFrame* Out);
	/// Extra passes of a test or benchmark: called after the plugin's own.
	std::function<void(FFrameContext&, const FGBuffer&, const FFrameOutputs&)> ExtraPasses;
	/// Frames wait for no pipeline and builds keep to their budget, as in a game; off: every frame is complete.
	bool bRealTime = false;
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
	FRTStatus AddReadback(FFrameContext& Context, FGraphTexture Texture, FReadback& Out);
	FRTStatus CaptureFrame(const FFrameOutputs& Frame, const FFrameCapture& Capture, FReadback (&Readbacks)[3]);

	FRenderer Renderer;
	FGBufferPass GBufferPass;
	std::unique_ptr<FHostScene> Scene;
	std::optional<double> LastTime;
	uint32_t FrameIndex = 0;
};

} // namespace Lantern
