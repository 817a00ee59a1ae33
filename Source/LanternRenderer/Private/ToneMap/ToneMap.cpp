// The display transform: exposure, filmic curve, sRGB.
#include "ToneMap/ToneMap.h"

#include "ToneMapTypes.h"

namespace Lantern
{

FGraphTexture AddToneMapPass(FFrameContext& Context, FGraphTexture Radiance)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeToneMapSource());
	if (!Pipeline || !Radiance.IsValid()) { return {}; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "Display");
	const FPassConstants PassConstants = Context.Pass;
	const uint32_t Width = Context.Width, Height = Context.Height;
	Context.Graph.AddPass("ToneMap", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Radiance, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FToneMapConstants C{};
			C.Pass = PassConstants;
			C.Input = Pass.GetTexture(Radiance)->GetSampledIndex();
			C.Output = Pass.GetTexture(Output)->GetStorageIndex();
			Dispatch2D(Pass, Pipeline, C, Width, Height, TONE_MAP_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
