// Diffuse global illumination by brute force: the baseline that every later method must beat.
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
    "r.RT.GI", false, "Diffuse global illumination by path tracing, without a filter. Off: unoccluded ambient light of the sky.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.GI.Samples", 1, "Paths of diffuse global illumination per pixel.", {1, 64});
TRTConsoleVariable<int32_t> CVarBounces("r.RT.GI.Bounces", 1,
    "How many surfaces may reflect light before it comes to the one that is lit. The reference of as many has one scattering "
    "event more, the last.",
    {1, 4});
} // namespace

std::optional<FPassRays> ChooseDiffuseGIRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts)
{
	if (!IsRayTracingEnabled() || !CVarEnable.GetOnRenderThread() || Facts.Objects == 0 || !HasAnyLight(Facts)) { return std::nullopt; }
	if (!Capabilities.bRayTracingPipeline)
	{
		LogOnce(ERTLogLevel::Warning,
		    "r.RT.GI is off: paths run material shaders where they hit, and this device has no ray-tracing pipelines");
		return std::nullopt;
	}
	return MakePassRays("DiffuseGI/DiffuseGI.rgen", MakePathDefines(Facts), true);
}

FDiffuseGIOutputs AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const bool bWanted = ChooseDiffuseGIRays(Context.Device.GetCapabilities(), Context.Facts).has_value();
	if (!bWanted || Context.GetRayGen(EFrameRayGen::DiffuseGI) == NoRayGen) { return {}; }
	Context.RequireRays();
	FDiffuseGIOutputs Out;
	Out.Radiance =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT, ERTTextureUsage::CopySource}, "DiffuseGI");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("DiffuseGI", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		Builder.Write(Out.Radiance, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			const uint32_t Bounces = static_cast<uint32_t>(CVarBounces.GetOnRenderThread());
			FDiffuseGIConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = Pass.GetTexture(GBuffer.Depth)->GetSampledIndex();
			C.Normals = Pass.GetTexture(GBuffer.Normals)->GetSampledIndex();
			C.Output = Pass.GetTexture(Out.Radiance)->GetStorageIndex();
			C.SamplesPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
			C.MaxBounces = Bounces + 1;
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * C.SamplesPerPixel * GetMaxPathRays(Frame->Facts, Bounces));
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().TraceRays(
			    Frame->RayBindings->GetTable(), Frame->GetRayGen(EFrameRayGen::DiffuseGI), Frame->Width, Frame->Height, 1);
		};
	});
	return Out;
}

} // namespace Lantern
