// Shows a signal of the registry on the screen.
#include "DebugView/DebugView.h"

#include "DebugViewTypes.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Lights/LightCellsView.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<std::string> CVarView("r.RT.Debug.View", "frame",
    "Shows something else than the picture (frame): a signal, as lantern reference --help names it, or light_cells, the lights of each "
    "light cell.");
constexpr const char* LightCellsView = "light_cells";
} // namespace

bool IsLightCellsView() { return CVarView.GetOnRenderThread() == LightCellsView; }

ESignal GetDebugView()
{
	if (IsLightCellsView()) { return ESignal::Frame; }
	const std::string& Name = CVarView.GetOnRenderThread();
	const std::optional<ESignal> Signal = FindSignal(Name);
	if (!Signal)
	{
		LogOnce(ERTLogLevel::Warning, "r.RT.Debug.View: " + Quote(Name) + " is none of " + ListSignalNames() + ", " + LightCellsView);
	}
	return Signal.value_or(ESignal::Frame);
}

FGraphTexture AddDebugView(FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs& Outputs)
{
	if (IsLightCellsView()) { return AddLightCellsView(Context, GBuffer, Outputs.Display); }
	const ESignal Signal = GetDebugView();
	const FGraphTexture Input = Outputs.Get(Signal);
	if (Signal == ESignal::Frame) { return Outputs.Display; }
	if (!Input.IsValid())
	{
		LogOnce(ERTLogLevel::Info, std::string("r.RT.Debug.View shows the picture: there is no ") + GetSignalInfo(Signal).Name +
		                               ". It is off, the scene has nothing for it, or its shaders are being compiled");
		return Outputs.Display;
	}
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeDebugViewSource());
	if (!Pipeline) { return Outputs.Display; }
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "DebugView");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("DebugView", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Input, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FDebugViewConstants C{};
			C.Pass = Frame->Pass;
			C.Input = GetSampledIndex(Pass, Input);
			C.Output = GetStorageIndex(Pass, Output);
			C.bRadiance = GetSignalInfo(Signal).bRadiance ? 1u : 0u;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, DEBUG_VIEW_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
