// One dispatch of the reference path tracer: adds samples to a band of rows.
#include <cassert>

#include "AmbientOcclusion/AmbientOcclusion.h"
#include "LanternRenderer/Frame.h"
#include "PassTools.h"
#include "RayPrograms.h"
#include "ReferenceTypes.h"

namespace Lantern
{

FPassRays ChooseReferenceRays(const FSceneFacts& Facts, EReferenceSignal Signal, bool bFromGBuffer)
{
	assert(!bFromGBuffer || Signal != EReferenceSignal::Frame);
	auto Defines = MakePathDefines(Facts);
	switch (Signal)
	{
	case EReferenceSignal::SunShadow: Defines.emplace_back("SIGNAL_SUN_SHADOW", "1"); break;
	case EReferenceSignal::AmbientOcclusion: Defines.emplace_back("SIGNAL_AMBIENT_OCCLUSION", "1"); break;
	case EReferenceSignal::DiffuseGI: Defines.emplace_back("SIGNAL_DIFFUSE_GI", "1"); break;
	case EReferenceSignal::Reflections: Defines.emplace_back("SIGNAL_REFLECTIONS", "1"); break;
	case EReferenceSignal::Frame: break;
	}
	if (bFromGBuffer) { Defines.emplace_back("FROM_GBUFFER", "1"); }
	return MakePassRays("Reference/PathTrace.rgen", std::move(Defines), true);
}

void AddReferencePass(FFrameContext& Context, const FReferencePassInputs& Inputs)
{
	if (Context.GetRayGen(EFrameRayGen::Reference) == NoRayGen)
	{
		Context.Fail(FRTStatus::Error(ERTResult::Unsupported,
		    "the reference path tracer needs ray-tracing pipelines, which %s does not have", Context.Device.GetCapabilities().DeviceName));
		return;
	}
	Context.RequireRays();
	const FFrameContext* const Frame = &Context;
	const FAmbientOcclusionSettings Occlusion = GetAmbientOcclusionSettings();
	Context.Graph.AddPass("PathTrace", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Inputs.Sum, ERTAccess::StorageWrite | ERTAccess::ShaderRead);
		const FGBuffer& G = Inputs.GBuffer;
		for (const FGraphTexture Texture : {G.Depth, G.Normals, G.BaseColor, G.Material})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		return [=](FPassContext& Pass) {
			FReferenceConstants C{};
			C.Pass = Frame->Pass;
			C.Sum = Pass.GetBuffer(Inputs.Sum)->GetDeviceAddress();
			C.FirstSample = Inputs.FirstSample;
			C.SampleCount = Inputs.SampleCount;
			C.MaxBounces = Inputs.MaxBounces;
			C.FirstRow = Inputs.FirstRow;
			C.bPixelCenters = Inputs.bPixelCenters ? 1u : 0u;
			C.OcclusionRadius = Occlusion.Radius;
			C.OcclusionMask = Occlusion.InstanceMask;
			if (Inputs.GBuffer.Depth.IsValid())
			{
				C.Depth = Pass.GetTexture(Inputs.GBuffer.Depth)->GetSampledIndex();
				C.Normals = Pass.GetTexture(Inputs.GBuffer.Normals)->GetSampledIndex();
				C.BaseColor = Pass.GetTexture(Inputs.GBuffer.BaseColor)->GetSampledIndex();
				C.Material = Pass.GetTexture(Inputs.GBuffer.Material)->GetSampledIndex();
			}
			Pass.CountRays(uint64_t(Frame->Width) * Inputs.RowCount * Inputs.SampleCount);
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().TraceRays(
			    Frame->RayBindings->GetTable(), Frame->GetRayGen(EFrameRayGen::Reference), Frame->Width, Inputs.RowCount, 1);
		};
	});
}

} // namespace Lantern
