// Shows a signal of the registry on the screen.
#include "DebugView/DebugView.h"

#include "DebugViewTypes.h"
#include "Denoise/Denoise.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Lights/LightCellsView.h"
#include "SignalPasses.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<std::string> CVarView("r.RT.Debug.View", "frame",
    "Shows one signal instead of the picture, by its name as lantern reference --help lists it. The value frame shows the picture. The "
    "value sun_tiles shows what is known of each tile of the sun's shadows, and sun_rays the pixels that traced sun rays. "
    "The value lamp_tiles shows how many local lights each tile asks, and lamp_rays the rays of each pixel to them. "
    "The value reflection_motion shows where what mirrors show was in the frame before. Each step of red and green is an eighth of a "
    "pixel, "
    "and blue says that it was not found. The value light_cells shows how many lights each light cell lists. The value radiance_cells "
    "shows "
    "the radiance cells that pixels lie "
    "in, "
    "darker if they have had few updates, and radiance_light the light that they know. The values PASS.confidence and PASS.change show the "
    "history of a filtered signal's pass: what it is worth, and what was dropped of it.");

/// Calls Visit(signal, name of a picture) for all pictures.
template <class TVisit>
void ForEachPicture(TVisit&& Visit)
{
	ForEachSignalPass([&](const FSignalPass& Pass) {
		for (const char* const* Name = Pass.Pictures; Name && *Name; ++Name) { Visit(Pass.Signal, *Name); }
	});
}
} // namespace

bool IsDebugPicture(std::string_view Name) { return CVarView.GetOnRenderThread() == Name; }

ESignal GetDebugView()
{
	if (IsDebugPicture(LightCellsPicture)) { return ESignal::Frame; }
	const std::string& Name = CVarView.GetOnRenderThread();
	std::optional<ESignal> Signal = FindSignal(Name);
	std::string Pictures = std::string(", ") + LightCellsPicture;
	ForEachSignalPass([&](const FSignalPass& Pass) {
		if (!Pass.ListFilters) { return; }
		const std::string Filter = GetSignalInfo(Pass.Signal).Pass;
		for (const char* const Picture : {ConfidencePicture, ChangePicture})
		{
			if (Name == Filter + Picture) { Signal = Pass.Signal; }
			Pictures += ", " + Filter + Picture;
		}
	});
	ForEachPicture([&](ESignal Of, const char* Picture) {
		if (Name == Picture) { Signal = Of; }
		Pictures += std::string(", ") + Picture;
	});
	if (!Signal) { LogOnce(ERTLogLevel::Warning, "r.RT.Debug.View: " + Quote(Name) + " is none of " + ListSignalNames() + Pictures); }
	return Signal.value_or(ESignal::Frame);
}

FGraphTexture AddDebugView(FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs& Outputs)
{
	if (IsDebugPicture(LightCellsPicture)) { return AddLightCellsView(Context, GBuffer, Outputs.Display); }
	const ESignal Signal = GetDebugView();
	if (Signal == ESignal::Frame) { return Outputs.Display; }
	const bool bPicture = Context.DebugPicture.IsValid();
	const FGraphTexture Input = bPicture ? Context.DebugPicture : Outputs.Get(Signal);
	const uint32_t Scale = Input.IsValid() ? DivideUp(Context.Width, Context.Graph.GetDesc(Input).Width) : 1;
	if (bPicture && Scale == 1) { return Input; }
	if (!Input.IsValid() || (!bPicture && !FindSignal(CVarView.GetOnRenderThread())))
	{
		LogOnce(ERTLogLevel::Info, "r.RT.Debug.View shows the picture: there is no " + CVarView.GetOnRenderThread() +
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
			C.Show = bPicture ? DEBUG_SHOW_PICTURE : GetSignalInfo(Signal).bRadiance ? DEBUG_SHOW_RADIANCE : DEBUG_SHOW_GREY;
			C.Scale = Scale;
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, DEBUG_VIEW_GROUP_SIZE);
		};
	});
	return Output;
}

} // namespace Lantern
