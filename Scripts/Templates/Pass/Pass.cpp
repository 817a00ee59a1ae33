// @TITLE@: as made by Scripts/NewPass, a pass that copies the roughness of the G-buffer.
#include "@NAME@/@NAME@.h"

#include "@NAME@Types.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable("r.RT.@NAME@", true, "Traces @LOWER@ for hosts that ask for it.");
TRTConsoleVariable<int32_t> CVarPath(
    "r.RT.@NAME@.Path", 0, "How @LOWER@ is traced. 0: as the device does best. 1: ray-tracing pipeline. 2: ray query.", {0, 2});
} // namespace

FPassRays Choose@NAME@Rays(const FPassQuery& Query)
{
	FPassRays Rays;
	if (!IsRayTracingEnabled() || !CVarEnable.GetOnRenderThread()) { return Rays; }
	if (!Query.Requests.Wanted.Has(ESignal::@NAME@)) { return Rays; } // no pass of the frame reads it
	Rays.Path = ChooseRayPath(Query, CVarPath, "@LOWER@ is");
	return Rays;
}

FGraphTexture Add@NAME@Pass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const std::optional<FRayDispatch> Dispatch =
	    RequireRayDispatch(Context, ESignal::@NAME@, ChooseSignalRays(Context, ESignal::@NAME@));
	if (!Dispatch || !GBuffer.Material.IsValid()) { return {}; }
	const FSignalInfo& Info = GetSignalInfo(ESignal::@NAME@);
	const FGraphTexture Output =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, Info.Format, ERTTextureUsage::CopySource}, Info.Pass);
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass(Info.Pass, [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Material, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			F@NAME@Constants Constants{};
			Constants.Pass = Frame->Pass;
			Constants.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			Constants.Material = GetSampledIndex(Pass, GBuffer.Material);
			Constants.Output = GetStorageIndex(Pass, Output);
			DispatchRays(Pass, *Frame, *Dispatch, Constants);
		};
	});
	return Output;
}

} // namespace Lantern
