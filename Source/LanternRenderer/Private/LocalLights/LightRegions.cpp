// The pass that lists the lights of regions of the screen.
#include "LocalLights/LightRegions.h"

#include "LocalLightTypes.h"
#include "PassTools.h"

namespace Lantern
{

bool NeedsLightRegions(const FSceneFacts& Facts) { return Facts.Lights > REGION_LIGHTS; }

FShaderSource MakeLightRegionsSource(const FSceneFacts& Facts)
{
	FSceneFacts Used;
	Used.Lights = Facts.Lights;
	Used.bAreaLights = Facts.bAreaLights;
	Used.bLightProfiles = Facts.bLightProfiles;
	Used.bBackPixels = Facts.bBackPixels;
	return MakeComputeSource("LocalLights/Regions.comp", MakeFactDefines(Used));
}

namespace
{
// As RegionColumns of Regions.glsl: regions may begin outside of the picture.
uint32_t CountRegions(uint32_t Pixels) { return (DivideUp(Pixels, TILE_SIZE) + 2 * (REGION_TILES - 1)) / REGION_TILES; }

/// bClusters: Regions holds what the pass reads as well.
void AddRegionsPass(
    FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Pipeline, const char* Name, FGraphBuffer Regions, bool bClusters)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		if (bClusters) { Builder.Read(Regions, ERTAccess::StorageRead); }
		Builder.Write(Regions, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FLightRegionsConstants C{};
			C.Pass = Frame->Pass;
			C.Regions = GetAddress(Pass, Regions);
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Dispatch2D(Pass, Pipeline, C, CountRegions(Frame->Width), CountRegions(Frame->Height), 1);
		};
	});
}
} // namespace

uint64_t GetLightRegionBytes(const FFrameContext& Context)
{
	return uint64_t(CountRegions(Context.Width)) * CountRegions(Context.Height) * sizeof(FLightRegion);
}

FGraphBuffer AddLightRegions(FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Pipeline)
{
	const FGraphBuffer Regions = Context.Graph.CreateBuffer({GetLightRegionBytes(Context)}, "LightRegions");
	AddRegionsPass(Context, GBuffer, Pipeline, "ShadowLightRegions", Regions, false);
	return Regions;
}

FShaderSource MakeEmitterRegionsSource(const FSceneFacts& Facts)
{
	FShaderDefines Defines = {{"EMITTERS", "1"}};
	AddBackPixelsDefine(Facts.bBackPixels, Defines);
	return MakeComputeSource("LocalLights/Regions.comp", std::move(Defines));
}

void AddEmitterRegions(FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Pipeline, FGraphBuffer Clusters)
{
	AddRegionsPass(Context, GBuffer, Pipeline, "ShadowEmitterRegions", Clusters, true);
}

} // namespace Lantern
