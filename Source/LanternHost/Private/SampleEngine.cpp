// The frame loop of the sample engine: scene time, G-buffer, renderer, submission.
#include "LanternHost/SampleEngine.h"

#include <cassert>
#include <cstring>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternHost/SampleSky.h"

namespace Lantern
{

namespace
{
FImage DecodeReadback(const void* Data, uint32_t Width, uint32_t Height, ERTFormat Format)
{
	const size_t Count = size_t(Width) * Height;
	if (Format == ERTFormat::RGBA8_UNORM)
	{
		FImage Image(Width, Height, 3, EImageSpace::Display);
		const auto* Bytes = static_cast<const uint8_t*>(Data);
		for (size_t I = 0; I < 3 * Count; ++I) { Image.Pixels[I] = static_cast<float>(Bytes[I / 3 * 4 + I % 3]) / 255.0f; }
		return Image;
	}
	if (Format == ERTFormat::R16_FLOAT)
	{
		FImage Image(Width, Height, 1);
		const auto* Halves = static_cast<const uint16_t*>(Data);
		for (size_t I = 0; I < Count; ++I) { Image.Pixels[I] = glm::unpackHalf1x16(Halves[I]); }
		return Image;
	}
	FImage Image(Width, Height, 3);
	if (Format == ERTFormat::RGBA16_FLOAT)
	{
		const auto* Halves = static_cast<const uint16_t*>(Data);
		for (size_t I = 0; I < 3 * Count; ++I) { Image.Pixels[I] = glm::unpackHalf1x16(Halves[I / 3 * 4 + I % 3]); }
		return Image;
	}
	assert(Format == ERTFormat::RGBA32_FLOAT);
	const auto* Floats = static_cast<const float*>(Data);
	for (size_t I = 0; I < 3 * Count; ++I) { Image.Pixels[I] = Floats[I / 3 * 4 + I % 3]; }
	return Image;
}

} // namespace

FSampleEngine::FSampleEngine(IRTDevice& Device, FRendererDesc Desc)
    : Renderer(Device, std::move(Desc)),
      GBufferPass(Renderer),
      ShadowMapPass(Renderer)
{}

FRTStatus FSampleEngine::Load(FSceneDescription Description, const std::function<void(float)>& Progress)
{
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	Scene.reset();
	LastTime.reset();
	Skinning.clear();
	return FHostScene::Create(Renderer, std::move(Description), Progress, Scene);
}

FFrameFeatures FSampleEngine::MakeFeatures(const FFrameCapture& Capture) const
{
	FFrameFeatures Features;
	Features.bWaitForPipelines = Features.bBuildAll = !bRealTime;
	Features.Signals = Signals;
	Features.Signals.Wanted |= Capture.Signals;
	Features.bHostShadow = FShadowMapPass::IsOn();
	return Features;
}

FRTStatus FSampleEngine::Precache(const FFrameCapture& Capture, const std::function<void(float)>& Progress)
{
	assert(Scene);
	constexpr float RasterShare = 0.1f; // of the time: ray-tracing pipelines take most of it
	const auto Report = [&](float Begin, float Share) {
		return Progress ? std::function<void(float)>([=, &Progress](float Done) { Progress(Begin + Share * Done); }) : nullptr;
	};
	FFrameFeatures Features = MakeFeatures(Capture);
	Features.Skinning = Scene->SetTime(LastTime.value_or(0.0));
	ApplySampleSky(Scene->GetScene(), LastTime.value_or(0.0));
	GBufferPass.Want(*Scene, Features); // beside the others
	if (FRTStatus S = Renderer.Precache(Scene->GetScene(), Features, Report(0.0f, 1.0f - RasterShare)); !S) { return S; }
	if (FRTStatus S = ShadowMapPass.Precache(*Scene); !S) { return S; }
	return GBufferPass.Precache(*Scene, Features, Report(1.0f - RasterShare, RasterShare));
}

FRTStatus FSampleEngine::AddReadback(FFrameContext& Context, FGraphTexture Texture, FReadback& Out)
{
	Out.Texture = Texture;
	Out.Width = Context.Width;
	Out.Height = Context.Height;
	Out.Format = Context.Graph.GetDesc(Texture).Format;
	const uint64_t Size = uint64_t(Out.Width) * Out.Height * BytesPerTexel(Out.Format);
	if (FRTStatus S = Context.Device.CreateBuffer(
	        {Size, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Capture"}, Out.Buffer.ReleaseAndGetAddress());
	    !S)
	{
		return S;
	}
	const FGraphBuffer Target = Context.Graph.ImportBuffer(Out.Buffer.Get(), ERTAccess::None, ERTAccess::HostRead, "Capture");
	Context.Graph.AddPass("Readback", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Texture, ERTAccess::CopyRead);
		Builder.Write(Target, ERTAccess::CopyWrite);
		return [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Target), 0, Pass.GetTexture(Texture), 0, 0); };
	});
	return FRTStatus::Success();
}

FRTStatus FSampleEngine::AddReadbacks(const FFrameOutputs& Frame, const FFrameCapture& Capture, FReadbacks& Out)
{
	FFrameContext& Context = Renderer.GetContext();
	const auto Add = [&](bool bWanted, FGraphTexture Texture, FReadback& Readback) {
		return bWanted && Texture.IsValid() ? AddReadback(Context, Texture, Readback) : FRTStatus::Success();
	};
	if (FRTStatus S = Add(Capture.bLighting || Capture.Wants(ESignal::Frame), Frame.Lighting, Out.Lighting); !S) { return S; }
	if (FRTStatus S = Add(Capture.bDisplay, Frame.Display, Out.Display); !S) { return S; }
	for (size_t I = 0; I < Out.Signals.size(); ++I)
	{
		const auto Signal = static_cast<ESignal>(I);
		if (Signal == ESignal::Frame) { continue; }
		if (FRTStatus S = Add(Capture.Wants(Signal), Frame.Get(Signal), Out.Signals[I]); !S) { return S; }
	}
	return FRTStatus::Success();
}

/// Keeps the passes of signals that are shown or requested in every frame, even if nothing else reads them.
void FSampleEngine::KeepSignals(const FFrameOutputs& Frame)
{
	const auto Keep = [&](bool bWanted, FGraphTexture Texture) {
		if (!bWanted || !Texture.IsValid()) { return; }
		Renderer.GetContext().Graph.AddPass("Keep", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Texture, ERTAccess::ShaderRead);
			Builder.NeverCull();
			return [](FPassContext&) {};
		});
	};
	Keep(bPresent, Frame.Display);
	for (const FSignalInfo& Info : SignalInfos) { Keep(Signals.Wanted.Has(Info.Signal), Frame.Get(Info.Signal)); }
}

void FSampleEngine::DecodeReadbacks(const FReadbacks& Readbacks, const FFrameCapture& Capture, FCapturedFrame& Out)
{
	const auto Decode = [](const FReadback& R, FImage& Image) {
		if (R.Buffer) { Image = DecodeReadback(R.Buffer->GetMapped(), R.Width, R.Height, R.Format); }
	};
	Decode(Readbacks.Display, Out.Display);
	for (size_t I = 0; I < Readbacks.Signals.size(); ++I) { Decode(Readbacks.Signals[I], Out.Signals[I]); }
	if (Capture.Wants(ESignal::Frame)) { Decode(Readbacks.Lighting, Out.Get(ESignal::Frame)); }
	if (Capture.bLighting) { Decode(Readbacks.Lighting, Out.Lighting); }
}

void FSampleEngine::SeekTo(double Time)
{
	ApplySampleSky(Scene->GetScene(), Time);
	// The skinning of a lost frame never ran and must be repeated, as must one that was left out.
	if (LastTime == Time && !Renderer.IsFrameLost() && !Renderer.WasSkinningLeftOut()) { return; }
	LastTime = Time;
	Skinning = Scene->SetTime(Time);
}

std::vector<FSkinningInputs> FSampleEngine::MoveTo(double Time)
{
	SeekTo(Time);
	return std::exchange(Skinning, {});
}

FRTStatus FSampleEngine::RenderFrame(const FView& InView, double Time, const FFrameCapture& Capture, FCapturedFrame* Out)
{
	assert(Scene);
	FConsoleVariables::Get().BeginFrame();
	if (Out) { *Out = {}; } // what this frame does not have is not that of the one before
	FFrameFeatures Features = MakeFeatures(Capture);
	Features.Skinning = MoveTo(Time);
	FView View = InView;
	View.FrameIndex = FrameIndex++;
	if (FRTStatus S = Renderer.BeginFrame(Scene->GetScene(), View, Features); !S) { return S; }
	FFrameContext& Context = Renderer.GetContext();
	AddFogShadowPass(Context); // needs no G-buffer, and may run beside it
	const FGBuffer GBuffer = GBufferPass.Add(Context, *Scene);
	Context.HostShadow = ShadowMapPass.Add(Context, *Scene);
	const FFrameOutputs Frame = AddFramePasses(Context, GBuffer);
	if (ExtraPasses) { ExtraPasses(Context, GBuffer, Frame); }
	KeepSignals(Frame);
	FReadbacks Readbacks;
	const FRTStatus Captured = AddReadbacks(Frame, Capture, Readbacks);
	FRTFence Fence = 0;
	if (FRTStatus S = Renderer.EndFrame(&Fence); !S) { return S; }
	if (!Captured || !Out) { return Captured; }
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	DecodeReadbacks(Readbacks, Capture, *Out);
	return FRTStatus::Success();
}

} // namespace Lantern
