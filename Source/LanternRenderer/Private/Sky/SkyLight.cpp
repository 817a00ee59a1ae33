// The sky's map as spherical harmonics.
#include "Sky/SkyLight.h"

#include "SkyLightTypes.h"

namespace Lantern
{

FShaderSource MakeSkyLightSource(const FSceneFacts& Facts)
{
	FShaderDefines Defines;
	AddSkyDefines(Facts, Defines);
	return MakeComputeSource("Sky/SkyLight.comp", std::move(Defines));
}

FGraphTexture AddSkyLightPass(FFrameContext& Context)
{
	IRTPipeline* const Pipeline = NeedsSkyLight(Context.Facts) ? RequireCompute(Context, MakeSkyLightSource(Context.Facts)) : nullptr;
	if (!Pipeline) { return {}; }
	const FGraphTexture Output = Context.Graph.CreateTexture({SKY_LIGHT_TERMS, 1, ERTFormat::RGBA32_FLOAT}, "SkyLight");
	const FPassConstants PassConstants = Context.Pass;
	Context.Graph.AddPass("SkyLight", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FSkyLightConstants C{};
			C.Pass = PassConstants;
			C.Output = Pass.GetTexture(Output)->GetStorageIndex();
			Dispatch2D(Pass, Pipeline, C, 1, 1, 1);
		};
	});
	return Output;
}

} // namespace Lantern
