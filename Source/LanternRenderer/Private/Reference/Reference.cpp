// One dispatch of the reference path tracer: adds samples to a band of rows.
#include "LanternRenderer/Frame.h"
#include "PassTools.h"
#include "ReferenceTypes.h"

namespace Lantern
{

void AddReferencePass(FFrameContext& Context, const FReferencePassInputs& Inputs)
{
	if (Context.ReferenceRayGen == NoRayGen)
	{
		Context.Fail(FRTStatus::Error(ERTResult::Unsupported, "the reference path tracer needs ray-tracing pipelines, which %s does not have",
		                              Context.Device.GetCapabilities().DeviceName));
		return;
	}
	Context.RequireRays();
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("PathTrace", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Inputs.Sum, ERTAccess::StorageWrite | ERTAccess::ShaderRead);
		return [=](FPassContext& Pass) {
			FReferenceConstants C{};
			C.Pass = Frame->Pass;
			C.Sum = Pass.GetBuffer(Inputs.Sum)->GetDeviceAddress();
			C.FirstSample = Inputs.FirstSample;
			C.SampleCount = Inputs.SampleCount;
			C.MaxBounces = Inputs.MaxBounces;
			C.FirstRow = Inputs.FirstRow;
			Pass.CountRays(uint64_t(Frame->Width) * Inputs.RowCount * Inputs.SampleCount);
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().TraceRays(Frame->RayBindings->GetTable(), Frame->ReferenceRayGen, Frame->Width, Inputs.RowCount, 1);
		};
	});
}

} // namespace Lantern
