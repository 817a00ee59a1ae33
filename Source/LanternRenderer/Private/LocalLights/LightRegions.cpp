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
	return MakeComputeSource("LocalLights/Regions.comp", MakeFactDefines(Used));
}

FGraphBuffer AddLightRegions(FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Pipeline)
{
	// As RegionColumns of Regions.glsl: regions may begin outside of the picture.
	const auto Count = [](uint32_t Pixels) { return (DivideUp(Pixels, TILE_SIZE) + 2 * (REGION_TILES - 1)) / REGION_TILES; };
	const uint32_t Columns = Count(Context.Width), Rows = Count(Context.Height);
	const FGraphBuffer Regions = Context.Graph.CreateBuffer({uint64_t(Columns) * Rows * sizeof(FLightRegion)}, "LightRegions");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ShadowLightRegions", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		Builder.Write(Regions, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FLightRegionsConstants C{};
			C.Pass = Frame->Pass;
			C.Regions = GetAddress(Pass, Regions);
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Dispatch2D(Pass, Pipeline, C, Columns, Rows, 1);
		};
	});
	return Regions;
}

} // namespace Lantern
