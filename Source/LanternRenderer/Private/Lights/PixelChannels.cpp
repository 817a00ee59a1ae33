// The pass that finds the channels of pixels, once a frame.
#include "Lights/PixelChannels.h"

#include "PassTools.h"
#include "PixelChannelsTypes.h"

namespace Lantern
{

FShaderSource MakePixelChannelsSource() { return MakeComputeSource("Lights/PixelChannels.comp"); }

FGraphTexture RequirePixelChannels(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (!Context.Facts.bLightChannels || Context.PixelChannels.IsValid()) { return Context.PixelChannels; }
	const FGraphTexture Host = GBuffer.Channels;
	const FGraphTexture Motion = !Host.IsValid() && GBuffer.bNamesObjects ? GBuffer.Motion : FGraphTexture();
	if (!Host.IsValid() && !Motion.IsValid()) { return {}; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakePixelChannelsSource());
	if (!Pipeline) { return {}; }
	const FFrameContext* const Frame = &Context;
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R8_UNORM}, "PixelChannels");
	Context.PixelChannels = Output;
	const uint32_t Offset = GBuffer.ClassesOffset.x | (GBuffer.ClassesOffset.y << 16);
	Context.Graph.AddPass("PixelChannels", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Host.IsValid() ? Host : Motion, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FPixelChannelsConstants C{};
			C.Pass = Frame->Pass;
			C.Host = GetSampledIndex(Pass, Host);
			C.Motion = GetSampledIndex(Pass, Motion);
			C.HostOffset = Offset;
			C.Output = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, PIXEL_CHANNELS_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
