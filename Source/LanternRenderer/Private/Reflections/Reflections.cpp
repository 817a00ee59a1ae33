// Reflections by brute force: the baseline that every later method must beat.
#include "IndirectTypes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternRenderer/Frame.h"
#include "PassTools.h"
#include "RayPrograms.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable(
    "r.RT.Reflections", false, "Reflections by path tracing, without a filter. Off: unoccluded light of the sky.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.Reflections.Samples", 1, "Paths of reflections per pixel.", {1, 64});
TRTConsoleVariable<int32_t> CVarBounces("r.RT.Reflections.Bounces", 1,
    "How many surfaces may reflect light before it comes to the one that mirrors it. The reference of as many has one "
    "scattering event more, the last.",
    {1, 4});
TRTConsoleVariable<float> CVarMaxRoughness("r.RT.Reflections.MaxRoughness", 1.0f,
    "Surfaces that are rougher have no reflections traced; the sky's ambient light stands in. 1: all are traced.", {0.0, 1.0});
} // namespace

std::optional<FPassRays> ChooseReflectionsRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts)
{
	if (!IsRayTracingEnabled() || !CVarEnable.GetOnRenderThread() || Facts.Objects == 0 || !HasAnyLight(Facts)) { return std::nullopt; }
	if (!Capabilities.bRayTracingPipeline)
	{
		LogOnce(ERTLogLevel::Warning,
		    "r.RT.Reflections is off: paths run material shaders where they hit, and this device has no ray-tracing pipelines");
		return std::nullopt;
	}
	return MakePassRays("Reflections/Reflections.rgen", MakePathDefines(Facts), true);
}

FReflectionOutputs AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const bool bWanted = ChooseReflectionsRays(Context.Device.GetCapabilities(), Context.Facts).has_value();
	if (!bWanted || Context.GetRayGen(EFrameRayGen::Reflections) == NoRayGen) { return {}; }
	Context.RequireRays();
	FReflectionOutputs Out;
	Out.Radiance =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT, ERTTextureUsage::CopySource}, "Reflections");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("Reflections", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, GBuffer.BaseColor, GBuffer.Material})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		Builder.Write(Out.Radiance, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			const auto Sampled = [&](FGraphTexture Texture) { return Pass.GetTexture(Texture)->GetSampledIndex(); };
			const uint32_t Bounces = static_cast<uint32_t>(CVarBounces.GetOnRenderThread());
			FReflectionsConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = Sampled(GBuffer.Depth);
			C.Normals = Sampled(GBuffer.Normals);
			C.BaseColor = Sampled(GBuffer.BaseColor);
			C.Material = Sampled(GBuffer.Material);
			C.Output = Pass.GetTexture(Out.Radiance)->GetStorageIndex();
			C.SamplesPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
			C.MaxBounces = Bounces + 1;
			C.MaxRoughness = CVarMaxRoughness.GetOnRenderThread();
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * C.SamplesPerPixel * GetMaxPathRays(Frame->Facts, Bounces));
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().TraceRays(
			    Frame->RayBindings->GetTable(), Frame->GetRayGen(EFrameRayGen::Reflections), Frame->Width, Frame->Height, 1);
		};
	});
	return Out;
}

} // namespace Lantern
