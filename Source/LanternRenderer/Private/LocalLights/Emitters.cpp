// Emissive triangles as local lights.
#include "LocalLights/Emitters.h"

#include "Lighting/DirectLighting.h"
#include "LocalLightTypes.h"
#include "LocalLights/LightRegions.h"
#include "LocalLights/LocalLights.h"
#include "Reflections/Reflections.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEmissive("r.RT.Lights.Emissive", true,
    "Emissive triangles shine as local lights do, with shadow rays of their own. If off, only global illumination and reflections find "
    "them.");
TRTConsoleVariable<float> CVarDim("r.RT.Lights.DimEmitters", 0.0156f,
    "Brightness of a pixel's light from emissive triangles, as a share of white, below which it asks for a ray only in some frames. Its "
    "mean stays. Smaller values have less noise where light is dim, and more rays. 0: it asks in all frames.",
    {0.0, 1.0});
TRTConsoleVariable<bool> CVarTwice("r.RT.Debug.Lights.EmissiveTwice", false,
    "Planted fault. Global illumination and reflections count emissive triangles in full, as if local lights had none.");

bool IsDirect(const FSceneFacts& Facts) { return HasEmitters(Facts) && !CVarTwice.GetOnRenderThread(); }

bool HasManyClusters(const FSceneFacts& Facts) { return Facts.EmissiveClusters > REGION_EMITTERS; }

FShaderSource MakeClustersSource() { return MakeComputeSource("LocalLights/EmitterClusters.comp"); }
} // namespace

bool HasEmitters(const FSceneFacts& Facts) { return Facts.bEmissive && !Facts.bMaskAlone && CVarEmissive.GetOnRenderThread(); }

bool IsEmissionDirect(const FPassQuery& Query, ESignal Lobe)
{
	if (Lobe == ESignal::Count) { return false; }
	return IsDirect(Query.Facts) && IsMade(Lobe, Query.Requests) && ChooseLocalLightPath(Query) != ERayPath::None;
}

bool IsEmissionDirectInReference(const FSceneFacts& Facts)
{
	return IsRayTracingEnabled() && HasEmitters(Facts) && HasLocalLight() && AreLocalLightsShadowed();
}

void AddEmitterDefines(const FSceneFacts& Facts, FShaderDefines& InOut)
{
	if (HasEmitters(Facts)) { InOut.emplace_back("LOCAL_EMISSIVE", "1"); }
}

void ListEmitterShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (!HasEmitters(Facts)) { return; }
	Out.push_back(MakeClustersSource());
	if (HasManyClusters(Facts)) { Out.push_back(MakeEmitterRegionsSource(Facts)); }
}

bool AreEmittersReady(FFrameContext& Context)
{
	if (!HasEmitters(Context.Facts)) { return true; }
	if (!RequireCompute(Context, MakeClustersSource())) { return false; }
	return !HasManyClusters(Context.Scene.GetFacts()) || RequireCompute(Context, MakeEmitterRegionsSource(Context.Facts));
}

FGraphBuffer AddEmitterClusters(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FSceneFacts& Facts = Context.Scene.GetFacts(); // the frame's own, since the list was brought up to date
	const uint32_t Count = Facts.EmissiveClusters;
	if (!HasEmitters(Context.Facts) || Count == 0) { return {}; }
	const uint64_t Regions = HasManyClusters(Facts) ? GetLightRegionBytes(Context) : 0;
	const FGraphBuffer Clusters =
	    Context.Graph.CreateBuffer({sizeof(FEmitterHeader) + Count * sizeof(FEmitterCluster) + Regions}, "EmitterClusters");
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeClustersSource());
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ShadowEmitters", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Clusters, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FEmitterClustersConstants C{};
			C.Pass = Frame->Pass;
			C.Clusters = GetAddress(Pass, Clusters);
			C.ReflectedRoughness = GetReflectedRoughness({Frame->Device.GetCapabilities(), Frame->Facts, Frame->Signals});
			C.Dim = CVarDim.GetOnRenderThread();
			C.Count = Count;
			DispatchMany(Pass, Pipeline, C, DivideUp(Count, EMITTER_GROUP_SIZE));
		};
	});
	if (Regions > 0) { AddEmitterRegions(Context, GBuffer, RequireCompute(Context, MakeEmitterRegionsSource(Context.Facts)), Clusters); }
	return Clusters;
}

} // namespace Lantern
