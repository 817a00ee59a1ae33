#include "LanternHost/SampleEngine.h"

#include <cassert>
#include <cstring>

#include <glm/gtc/packing.hpp>

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
	assert(Format == ERTFormat::RGBA32_FLOAT);
	FImage Image(Width, Height, 3);
	const auto* Floats = static_cast<const float*>(Data);
	for (size_t I = 0; I < 3 * Count; ++I) { Image.Pixels[I] = Floats[I / 3 * 4 + I % 3]; }
	return Image;
}
} // namespace

FSampleEngine::FSampleEngine(IRTDevice& Device, FRendererDesc Desc) : Renderer(Device, std::move(Desc)), GBufferPass(Renderer) {}

FRTStatus FSampleEngine::Load(FSceneDescription Description, const std::function<void(float)>& Progress)
{
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	Scene.reset();
	LastTime.reset();
	return FHostScene::Create(Renderer, std::move(Description), Progress, Scene);
}

FRTStatus FSampleEngine::AddReadback(FFrameContext& Context, FGraphTexture Texture, FReadback& Out)
{
	if (!Texture.IsValid()) { return FRTStatus::Success(); }
	Out.Texture = Texture;
	Out.Width = Context.Width;
	Out.Height = Context.Height;
	Out.Format = Context.Graph.GetDesc(Texture).Format;
	const uint64_t Size = uint64_t(Out.Width) * Out.Height * BytesPerTexel(Out.Format);
	if (FRTStatus S = Context.Device.CreateBuffer({Size, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Capture"}, Out.Buffer.ReleaseAndGetAddress()); !S)
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

FRTStatus FSampleEngine::CaptureFrame(const FFrameOutputs& Frame, const FFrameCapture& Capture, FReadback (&Readbacks)[3])
{
	FFrameContext& Context = Renderer.GetContext();
	const FGraphTexture Textures[3] = {Capture.bLighting ? Frame.Lighting : FGraphTexture{}, Capture.bDisplay ? Frame.Display : FGraphTexture{},
	                                   Capture.bSunShadow ? Frame.SunShadow.Visibility : FGraphTexture{}};
	for (int I = 0; I < 3; ++I)
	{
		if (FRTStatus S = AddReadback(Context, Textures[I], Readbacks[I]); !S) { return S; }
	}
	return FRTStatus::Success();
}

std::vector<FSkinningInputs> FSampleEngine::MoveTo(double Time)
{
	// What was skinned for a lost frame never ran.
	if (LastTime == Time && !Renderer.IsFrameLost()) { return {}; }
	LastTime = Time;
	return Scene->SetTime(Time);
}

FRTStatus FSampleEngine::RenderFrame(const FView& InView, double Time, const FFrameCapture& Capture, FCapturedFrame* Out)
{
	assert(Scene);
	FFrameFeatures Features;
	Features.Skinning = MoveTo(Time);
	Features.bWaitForPipelines = Features.bBuildAll = !bRealTime;
	FView View = InView;
	View.FrameIndex = FrameIndex++;
	if (FRTStatus S = Renderer.BeginFrame(Scene->GetScene(), View, Features); !S) { return S; }
	FFrameContext& Context = Renderer.GetContext();
	const FGBuffer GBuffer = GBufferPass.Add(Context, *Scene);
	const FFrameOutputs Frame = AddFramePasses(Context, GBuffer);
	if (ExtraPasses) { ExtraPasses(Context, GBuffer, Frame); }
	FReadback Readbacks[3];
	const FRTStatus Captured = CaptureFrame(Frame, Capture, Readbacks);
	FRTFence Fence = 0;
	if (FRTStatus S = Renderer.EndFrame(&Fence); !S) { return S; }
	if (!Captured || !Out) { return Captured; }
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	FImage* const Images[3] = {&Out->Lighting, &Out->Display, &Out->SunShadow};
	for (int I = 0; I < 3; ++I)
	{
		const FReadback& R = Readbacks[I];
		if (R.Buffer) { *Images[I] = DecodeReadback(R.Buffer->GetMapped(), R.Width, R.Height, R.Format); }
	}
	return FRTStatus::Success();
}

} // namespace Lantern
